"""A query as OMPL sees it: states, validity and edges of the robot's model, and an end by counts."""

from __future__ import annotations

from math import inf, pi, remainder, tau
from threading import Lock

import numpy as np
from ompl import base, util

from motion_planner_node.paths.edges import Frame, Row, shortest_word_if_free
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.steering import MOST_PIECES
from motion_planner_node.world.sweeps import is_free_at

util.setLogLevel(util.LogLevel.LOG_NONE)

#: OMPL hands out seeds process-wide: two searches at a time would take them from each other.
ONE_AT_A_TIME = Lock()

#: One state of each model, used under the lock above: OMPL's bindings never free them.
_STATES: dict[str, base.State] = {}


class Edges(base.MotionValidator):
    """An edge is valid when its shortest word is free as a whole."""

    def __init__(self, information: base.SpaceInformation, frame: Frame) -> None:
        super().__init__(information)
        self._frame = frame
        self._pieces = np.zeros((MOST_PIECES, 4))

    def checkMotion(self, start: base.State, end: base.State) -> bool:
        """Whether the edge from ``start`` to ``end`` is valid."""
        here, there = _row_of(start), _row_of(end)
        return shortest_word_if_free(self._frame, here, there, inf, self._pieces) < inf


def _row_of(state: base.State) -> Row:
    return np.array([state.getX(), state.getY(), state.getYaw()])


class Iterations:
    """Ends a search after a number of iterations, or when it is to stop."""

    def __init__(self, query: Query, most: int) -> None:
        self._query = query
        self._left = most

    def __call__(self) -> bool:
        """Whether the search has to end."""
        self._query.check_time()
        self._left -= 1
        return self._left < 0


def space_of(query: Query) -> base.StateSpace:
    """The state space of the robot's model over the map."""
    x_min, y_min, x_max, y_max = (float(value) for value in query.scene.shapes.bounds)
    return query.robot.space((x_min, y_min, x_max, y_max))


def information_of(query: Query, space: base.StateSpace) -> base.SpaceInformation:
    """Which states and edges of ``space`` are free."""
    information = base.SpaceInformation(space)
    shapes, body = query.scene.shapes, query.body
    information.setStateValidityChecker(
        lambda state: is_free_at(shapes, body, (state.getX(), state.getY(), state.getYaw()))
    )
    information.setMotionValidator(Edges(information, query.frame))
    return information


def state_at(query: Query, space: base.StateSpace, row: Row) -> base.State:
    """A state of ``space`` at an attitude (3,), good until the next one is asked for."""
    kind = query.robot.kind
    if kind not in _STATES:
        _STATES[kind] = space.allocState()
    state = _STATES[kind]
    state.setXY(float(row[0]), float(row[1]))
    # OMPL's angles are in [-pi, pi): it would take a heading of pi for invalid, and wait in vain.
    heading = remainder(float(row[2]), tau)
    state.setYaw(heading if heading < pi else -pi)
    return state


def drawn_seed(query: Query) -> int:
    """A seed for OMPL, which takes 0 for none."""
    return int(query.random.integers(1, 2**31))
