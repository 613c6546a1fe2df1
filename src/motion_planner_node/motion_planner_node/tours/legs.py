"""What it really costs to drive from one attitude to another, and what it is likely to cost."""

from __future__ import annotations

import itertools
from math import hypot, inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import (
    Frame,
    Row,
    Rows,
    edge_lengths,
    frame_of,
    free_word,
    shortest_length,
)
from motion_planner_node.paths.improving import simplified
from motion_planner_node.paths.planners import DEFAULT_PLANNER, planner_named
from motion_planner_node.paths.query import SPARE_CLEARANCE, Query
from motion_planner_node.paths.result import PathBudget
from motion_planner_node.planning.ground import Ground
from motion_planner_node.robots.body import Body
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.robots.steering import MOST_PIECES
from motion_planner_node.stopping import ShouldStop

#: A free word of no more than so many times the length of the shortest one is driven as it is.
DIRECT = 1.005
#: What a way round obstacles is expected to be, in lengths of the way without steering.
DETOUR = 1.15


def spare_body(robot: Robot) -> Body:
    """The robot's body with the little clearance to spare that paths are planned with.

    What touches an obstacle is not met again by a motion that begins a hair's breadth beside it.
    """
    body = robot.body
    return body._replace(margin=body.margin + SPARE_CLEARANCE * robot.radius)


class Legs:
    """Motions between attitudes of one robot, planned once each: rows of free words (k, 3)."""

    def __init__(self, ground: Ground, seed: int, should_stop: ShouldStop) -> None:
        robot = ground.robot
        self.frame = frame_of(
            ground.scene.shapes, spare_body(robot), robot.steering, robot.turning_radius
        )
        self._ground = ground
        self._seed = seed
        self._should_stop = should_stop
        self._known: dict[bytes, tuple[float, Rows]] = {}

    def leg(self, start: Row, end: Row) -> tuple[float, Rows]:
        """Length [m] of a short way between free attitudes (3,), and the attitudes along it (k, 3).

        Infinite when none was found.

        :raises Stopped: when it is to stop
        """
        key = start.tobytes() + end.tobytes()
        if key not in self._known:
            self._known[key] = self._found(start, end)
        return self._known[key]

    def length(self, rows: Rows) -> float:
        """Length [m] of the whole way through attitudes (k, 3)."""
        return sum(self.leg(a, b)[0] for a, b in itertools.pairwise(rows))

    def _found(self, start: Row, end: Row) -> tuple[float, Rows]:
        pieces = np.zeros((MOST_PIECES, 4))
        both = np.vstack((start, end))
        length = free_word(self.frame, start, end, inf, pieces)[0]
        if length <= DIRECT * shortest_length(self.frame, start, end, pieces):
            return length, both
        query = Query(
            self._ground.scene,
            self._ground.robot,
            Attitude(*start.tolist()),
            end[None, :].copy(),
            (self._seed,),
            PathBudget(),
            self._should_stop,
        )
        raw = planner_named(DEFAULT_PLANNER).find(query)
        if raw is None:
            return length, both
        rows = simplified(query, raw)
        planned = float(edge_lengths(self.frame, rows).sum())
        return (planned, rows) if planned < length else (length, both)


@kernel
def expected_lengths(
    frame: Frame, starts: Rows, ends: Rows, around: Row, steered: NDArray[np.bool_]
) -> Row:
    """Expected lengths [m], (n,), of the ways from ``starts`` to ``ends``: (n, 3), or (1, 3) for all.

    ``around`` (n,) [m] are the ways round the obstacles without steering; that is looked at only
    where ``steered`` says so.
    """
    result, pieces = np.empty(len(around)), np.zeros((MOST_PIECES, 4))
    for k in range(len(around)):
        start, end = starts[k % len(starts)], ends[k % len(ends)]
        straight = hypot(end[0] - start[0], end[1] - start[1])
        way = DETOUR * max(around[k], straight)
        if steered[k] and way < inf:
            way = max(way, DETOUR * shortest_length(frame, start, end, pieces))
            way = min(way, free_word(frame, start, end, way, pieces)[0])
        result[k] = way
    return result


@kernel
def lengths_over(frame: Frame, before: Row, middles: Rows, after: Row, goes_on: bool) -> Row:
    """Lengths [m], (n,), of the free words from ``before`` over each of ``middles`` to ``after``.

    Infinite where one is not free; unless it ``goes_on`` to ``after``, the way ends in the middle.
    """
    result, pieces = np.empty(len(middles)), np.zeros((MOST_PIECES, 4))
    best = inf
    for k in range(len(middles)):
        length = free_word(frame, before, middles[k], best, pieces)[0]
        if goes_on and length < best:
            length += free_word(frame, middles[k], after, best - length, pieces)[0]
        result[k] = length
        best = min(best, length)
    return result
