"""Motions in closed form: where they end, poses along them, the shortest without obstacles."""

from __future__ import annotations

from collections.abc import Iterable
from math import ceil, isfinite, pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance, wrap_angle
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.robots.robot import Robot
from motion_planner_node.robots.steering import MOST_PIECES, shortest_lengths, word, words

#: A turn on the spot is sampled at steps of at most this [rad].
TURN_SPACING = pi / 18


def integrate(start: Attitude, segments: Iterable[Segment], robot: Robot) -> Attitude:
    """The attitude after driving ``segments`` from ``start``, in closed form."""
    x, y, heading = float(start.x), float(start.y), float(start.heading)
    for segment in segments:
        bend, length = robot.curvature(segment.steering_angle), segment.length
        x, y, heading = advance(x, y, heading, bend, length, segment.direction, segment.turn)
    return Attitude(x, y, wrap_angle(heading))


def end_of(motion: Motion, robot: Robot) -> Attitude:
    """The attitude in which ``motion`` ends."""
    return integrate(motion.start, motion.segments, robot)


def sample(motion: Motion, robot: Robot, spacing: float) -> NDArray[np.float64]:
    """Attitudes along ``motion``, shape (n, 3), as `timed_sample` takes them."""
    return timed_sample(motion, robot, spacing)[:, :3]


def timed_sample(motion: Motion, robot: Robot, spacing: float) -> NDArray[np.float64]:
    """Attitudes along ``motion`` and their times [s] from its start, shape (n, 4).

    They are at most ``spacing`` [m] > 0 and 10 degrees of turn apart.  The start, every joint of two
    segments and the end are among them.
    """
    start = motion.start
    x, y, heading = float(start.x), float(start.y), float(start.heading)
    rows, begun = [(x, y, wrap_angle(heading), 0.0)], 0.0
    for bend, length, direction, turn in robot.pieces_of(motion.segments).tolist():
        steps = steps_of(length, turn, spacing)
        time = robot.time_of(length, turn)
        for step in range(1, steps + 1):
            share = step / steps
            row = advance(x, y, heading, bend, length * share, direction, turn * share)
            rows.append((row[0], row[1], wrap_angle(row[2]), begun + time * share))
        x, y, heading = row
        begun += time
    return np.array(rows)


def steps_of(length: float, turn: float, spacing: float) -> int:
    """How many steps of at most ``spacing`` [m] and 10 degrees a segment is sampled in."""
    return max(1, ceil(abs(length) / spacing), ceil(abs(turn) / TURN_SPACING))


def words_between(start: Attitude, end: Attitude, robot: Robot) -> list[tuple[Segment, ...]]:
    """The words of the robot's model that lead from ``start`` to ``end``, shortest first."""
    pieces = np.zeros((MOST_PIECES, 4))
    ends = _pose(start), _pose(end)
    found = [
        robot.segments_of(pieces)
        for number in range(words(robot.steering))
        if isfinite(word(robot.steering, robot.turning_radius, number, *ends, pieces))
    ]
    # The segments' own lengths, not the pieces': leaving out a tiny piece changes the sum.
    return sorted(found, key=lambda segments: sum(abs(segment.length) for segment in segments))


def shortest_between(
    starts: NDArray[np.float64], ends: NDArray[np.float64], robot: Robot
) -> NDArray[np.float64]:
    """Lengths [m] of the shortest obstacle-free motions, shape (n,): a lower bound.

    ``starts`` and ``ends`` have the shapes (n, 3), or (3,) or (1, 3) of one that is used for all.
    """
    several = [len(rows) for rows in (starts, ends) if rows.ndim == 2 and len(rows) != 1]
    count = several[0] if several else 1
    return shortest_lengths(
        robot.steering, robot.turning_radius, _repeated(starts, count), _repeated(ends, count)
    )


def _repeated(rows: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Attitudes (count, 3): ``rows``, or the only one for all."""
    if rows.shape == (count, 3):
        return np.ascontiguousarray(rows, np.float64)
    result = np.empty((count, 3))
    result[:] = rows
    return result


def _pose(attitude: Attitude) -> tuple[float, float, float]:
    return float(attitude.x), float(attitude.y), float(attitude.heading)
