"""What is asked of a planner of paths, and what all of them need to know."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.errors import Stopped
from motion_planner_node.paths.edges import Row, Rows, frame_of
from motion_planner_node.paths.field import Field, field_of
from motion_planner_node.paths.result import PathBudget
from motion_planner_node.robots.body import sufficient_clearance
from motion_planner_node.robots.driving import shortest_between
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.scene import Scene

#: Gives destinations (k, 3), k >= 0, free and as good as the goals, near attitudes (n, 3).
Region = Callable[[Rows], Rows]

#: Clearance that is kept beyond the needed one where start and goals have it, per radius.
SPARE_CLEARANCE = 0.002


class Query:
    """One search from ``start`` to any of ``goals`` (k, 3), k > 0; nothing outlives its answer.

    Start and goals are free, and not walled off from each other.  ``region`` names further
    destinations, where there are any.  Randomness depends on the ``seeds``, which are not negative.
    ``estimates`` (k,) are the lengths [m] of the motions by estimate, where they are known.
    """

    def __init__(
        self,
        scene: Scene,
        robot: Robot,
        start: Attitude,
        goals: Rows,
        seeds: tuple[int, ...],
        budget: PathBudget,
        should_stop: Callable[[], bool],
        region: Region | None = None,
        longest: float = inf,
        estimates: NDArray[np.float64] | None = None,
    ) -> None:
        self.scene = scene
        self.robot = robot
        self.attitude = start
        self.start: Row = np.array([start.x, start.y, start.heading], np.float64)
        self.goals = goals
        self.budget = budget
        self.region = region
        self.should_stop = should_stop
        #: No path of this length [m] or more is wanted.
        self.longest = longest
        #: What was tried in vain, as parts of a sentence.
        self.efforts: list[str] = []
        #: Whether a close look has shown that the start leads nowhere, or nothing to the goals.
        self.hopeless = False
        #: Whether it was the start.
        self.shut_in = False
        self._seeds = seeds
        self._estimates = estimates
        spare = float(scene.clearance(np.vstack((self.start, goals))).min()) - sufficient_clearance(
            robot.body
        )
        margin = robot.body.margin + min(max(spare, 0.0), SPARE_CLEARANCE * robot.radius)
        #: The robot's, with a little clearance to spare.
        self.body = robot.body._replace(margin=margin)
        #: What edges are made of and checked against.
        self.frame = frame_of(scene.shapes, self.body, robot.steering, robot.turning_radius)
        #: How far [m] attitudes are moved at first to see whether that is better.
        self.reach = max(robot.turning_radius, robot.radius)

    def field_from(self, row: Row) -> Field:
        """Travel distances from an attitude (3,)."""
        free = self.scene.free_space(self.robot.body)
        return field_of(free.distance_from(float(row[0]), float(row[1])))

    @cached_property
    def estimates(self) -> NDArray[np.float64]:
        """Estimated lengths [m] of the motions to the goals, (k,)."""
        if self._estimates is not None:
            return self._estimates
        free = self.scene.free_space(self.robot.body)
        travel = free.distance_from(float(self.start[0]), float(self.start[1]))
        around = travel.at(self.goals[:, 0], self.goals[:, 1])
        straight = shortest_between(self.start, self.goals, self.robot)
        return np.asarray(np.maximum(around, straight), np.float64)

    @cached_property
    def random(self) -> np.random.Generator:
        """The randomness of the seeds, which whoever looks for a path draws from in turn."""
        return np.random.default_rng(self._seeds)

    def check_time(self) -> None:
        """Raises Stopped when the search is to stop."""
        if self.should_stop():
            raise Stopped
