"""The car-like model with the three-valued command (paper, section on kinematics): forward only.

x' = cos(heading), y' = sin(heading), heading' = tan(steering angle) / wheelbase per metre driven.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import isfinite, tan
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance, wrap_angle
from motion_planner_node.robots.dubins import TURNS, dubins_word, shortest_lengths
from motion_planner_node.robots.motion import Attitude, Motion, Segment

if TYPE_CHECKING:
    from motion_planner_node.world.model import CarModel

#: Segments shorter than this [m] are below the resolution of a map and are left out.
SHORTEST_SEGMENT = 1e-12


def curvature(steering_angle: float, car: CarModel) -> float:
    """Curvature [1/m] of the arc driven at ``steering_angle`` [rad]."""
    return tan(steering_angle) / car.wheelbase


def integrate(start: Attitude, segments: Iterable[Segment], car: CarModel) -> Attitude:
    """The attitude after driving ``segments`` from ``start``, in closed form."""
    x, y, heading = float(start.x), float(start.y), float(start.heading)
    for segment in segments:
        bend = curvature(segment.steering_angle, car)
        x, y, heading = advance(x, y, heading, bend, float(segment.length))
    return Attitude(x, y, wrap_angle(heading))


def end_of(motion: Motion, car: CarModel) -> Attitude:
    """The attitude in which ``motion`` ends."""
    return integrate(motion.start, motion.segments, car)


def sample(motion: Motion, car: CarModel, spacing: float) -> NDArray[np.float64]:
    """Attitudes (n, 3) along ``motion``, at most ``spacing`` [m] > 0 apart.

    The start, every joint of two segments and the end are among them.
    """
    start = motion.start
    x, y, heading = float(start.x), float(start.y), float(start.heading)
    rows = [(x, y, wrap_angle(heading))]
    for segment in motion.segments:
        bend = curvature(segment.steering_angle, car)
        pieces = max(1, int(np.ceil(segment.length / spacing)))
        for piece in range(1, pieces + 1):
            row = advance(x, y, heading, bend, segment.length * (piece / pieces))
            rows.append((row[0], row[1], wrap_angle(row[2])))
        x, y, heading = row
    return np.array(rows)


def merged(segments: Iterable[Segment]) -> tuple[Segment, ...]:
    """``segments`` without empty ones, neighbours of the same steering angle joined."""
    result: list[Segment] = []
    for segment in segments:
        if segment.length < SHORTEST_SEGMENT:
            continue
        if result and result[-1].steering_angle == segment.steering_angle:
            length = result[-1].length + segment.length
            result[-1] = Segment(segment.steering_angle, length)
        else:
            result.append(segment)
    return tuple(result)


def word_segments(word: int, pieces: Sequence[float], car: CarModel) -> tuple[Segment, ...]:
    """The segments of Dubins word number ``word`` whose pieces have these lengths [m]."""
    return merged(
        Segment(float(turn) * car.max_steering_angle, float(length))
        for turn, length in zip(TURNS[word], pieces, strict=True)
    )


def dubins_pieces(
    word: int, start: Attitude, end: Attitude, car: CarModel
) -> tuple[float, float, float] | None:
    """Lengths [m] of the pieces of Dubins word number ``word``; None when there is no such word."""
    pieces = dubins_word(
        word,
        car.turning_radius,
        *(float(value) for value in (start.x, start.y, start.heading)),
        *(float(value) for value in (end.x, end.y, end.heading)),
    )
    return pieces if isfinite(sum(pieces)) else None


def dubins_words(start: Attitude, end: Attitude, car: CarModel) -> list[tuple[Segment, ...]]:
    """The Dubins words, at most six, that lead from ``start`` to ``end``, shortest first."""
    words = []
    for word in range(len(TURNS)):
        pieces = dubins_pieces(word, start, end, car)
        if pieces is not None:
            words.append(word_segments(word, pieces, car))
    # The segments' own lengths, not the pieces': leaving out a tiny piece changes the sum.
    return sorted(words, key=lambda segments: sum(segment.length for segment in segments))


def dubins_lengths(
    starts: NDArray[np.float64], ends: NDArray[np.float64], car: CarModel
) -> NDArray[np.float64]:
    """Lengths [m] of the shortest obstacle-free motions, shape (n,): a lower bound.

    ``starts`` and ``ends`` have the shapes (n, 3) or (3,), which is then used for all.
    """
    starts, ends = np.broadcast_arrays(
        np.atleast_2d(np.asarray(starts, float)), np.atleast_2d(np.asarray(ends, float))
    )
    return shortest_lengths(
        car.turning_radius, np.ascontiguousarray(starts), np.ascontiguousarray(ends)
    )
