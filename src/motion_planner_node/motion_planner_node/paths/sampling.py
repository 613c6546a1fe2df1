"""OMPL's bidirectional sampling planner in the robot's own kinematics.

J. J. Kuffner and S. M. LaValle, "RRT-Connect: an efficient approach to single-query path planning",
ICRA 2000, on the state space of the robot's model.
"""

from __future__ import annotations

from collections.abc import Callable
from math import pi, remainder, tau
from threading import Lock

import numpy as np
from numpy.typing import NDArray
from ompl import base, geometric, util

from motion_planner_node.errors import Stopped
from motion_planner_node.paths.edges import shortest_is_free
from motion_planner_node.robots.body import Body, sufficient_clearance
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

util.setLogLevel(util.LogLevel.LOG_NONE)

# OMPL hands out seeds process-wide: two searches at a time would take them from each other.
_ONE_AT_A_TIME = Lock()


class _Edges(base.MotionValidator):
    """An edge is valid when its shortest word is free as a whole."""

    def __init__(
        self, information: base.SpaceInformation, shapes: Shapes, body: Body, robot: Robot
    ) -> None:
        super().__init__(information)
        self._frame = (shapes, body, robot.steering, robot.turning_radius)

    def checkMotion(self, start: base.State, end: base.State) -> bool:
        """Whether the edge from ``start`` to ``end`` is valid."""
        return shortest_is_free(
            *self._frame,
            (start.getX(), start.getY(), start.getYaw()),
            (end.getX(), end.getY(), end.getYaw()),
        )


class _Iterations:
    """Ends a search after a number of iterations, or when it is to stop."""

    def __init__(self, most: int, should_stop: Callable[[], bool]) -> None:
        self._left = most
        self._should_stop = should_stop

    def __call__(self) -> bool:
        if self._should_stop():
            raise Stopped
        self._left -= 1
        return self._left < 0


def _state(space: base.StateSpace, attitude: Attitude) -> base.State:
    state = space.allocState()
    state.setXY(attitude.x, attitude.y)
    # OMPL's angles are in [-pi, pi): it would take a heading of pi for invalid, and wait in vain.
    heading = remainder(attitude.heading, tau)
    state.setYaw(heading if heading < pi else -pi)
    return state


def sample_path(
    shapes: Shapes,
    body: Body,
    robot: Robot,
    start: Attitude,
    goal: Attitude,
    seed: int,
    iterations: int,
    should_stop: Callable[[], bool],
) -> NDArray[np.float64] | None:
    """Attitudes (n, 3) from ``start`` to ``goal`` whose shortest words are free.

    ``body`` is that of ``robot``, its margin perhaps wider.  None when there was none after
    ``iterations``.  Raises Stopped when ``should_stop`` says so.
    """
    x_min, y_min, x_max, y_max = (float(value) for value in shapes.bounds)
    space = robot.space((x_min, y_min, x_max, y_max))
    margin = sufficient_clearance(body)
    information = base.SpaceInformation(space)
    information.setStateValidityChecker(
        lambda state: bool(clearance_at(shapes, state.getX(), state.getY())[0] >= margin)
    )
    edges = _Edges(information, shapes, body, robot)
    information.setMotionValidator(edges)
    problem = base.ProblemDefinition(information)
    problem.setStartAndGoalStates(_state(space, start), _state(space, goal))
    enough = base.PlannerTerminationCondition(_Iterations(iterations, should_stop))
    with _ONE_AT_A_TIME:
        util.RNG.setSeed(seed)
        information.setup()
        planner = geometric.RRTConnect(information)
        planner.setProblemDefinition(problem)
        planner.setup()
        planner.solve(enough)
    if not problem.hasExactSolution():
        return None
    states = problem.getSolutionPath().getStates()
    return np.array([(s.getX(), s.getY(), s.getYaw()) for s in states])
