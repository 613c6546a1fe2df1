"""The destinations that are known for one problem, and looking for more of them."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import AttemptResult
from motion_planner_node.functions import Array
from motion_planner_node.parameters import Parameters
from motion_planner_node.planning.candidates import (
    NO_CANDIDATES,
    Candidates,
    are_apart,
    attitude_of,
    row_of,
)
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.tried import Tried
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import descend, destinations_by_travel
from motion_planner_node.stopping import Watch

#: Destinations that are as near as this [m] and [rad] are the same one, found again.
SAME = 1e-3
#: Attitudes round an end that destinations beside it are looked for from, so far away: turning
#: radii, and [rad].
PROBES, ASIDE, TURNED = 48, 1.0, 0.5


class Pool:
    """Destinations that the robot can stand in and may get to; what will not do is noted in ``tried``.

    Attributes:
        candidates: those that may still be driven to
        known: (n, 3) all that the robot can stand in and is not walled off from
        rounds: how often they were looked for all over the map
        spread: how far [m] they are from each other at most
    """

    def __init__(
        self,
        problem: Problem,
        ground: Ground,
        parameters: Parameters,
        seed: int,
        tried: Tried,
        watch: Watch,
    ) -> None:
        self._problem = problem
        self._ground = ground
        self._count = parameters.destinations
        self._seed = seed
        self._tried = tried
        self._watch = watch
        #: The connected part of the free space that the start is in.
        self._here = ground.part_of(problem.start)
        self._seen = np.empty((0, 3))
        self.candidates = NO_CANDIDATES
        self.known = np.empty((0, 3))
        self.rounds = 0
        self.spread = 0.0

    def look_everywhere(self) -> None:
        """Look for destinations once more, all over the map."""
        self._watch.look()
        ground, start = self._ground, self._problem.start
        rows, lengths = destinations_by_travel(
            self._problem.program,
            start,
            ground.scene.world.bounds,
            np.random.default_rng([self._seed, self.rounds]),
            self._count,
            ground.room,
            ground.travel_from(start),
        )
        self.rounds += 1
        if len(rows):
            self.spread = max(self.spread, float(np.ptp(rows[:, :2], axis=0).max()))
        self._add(rows, lengths)

    def look_beside(self, end: Attitude) -> None:
        """Look for destinations round ``end`` with a way on."""
        robot, seen = self._ground.robot, len(self._seen)
        reach = ASIDE * max(robot.turning_radius, robot.radius)
        steps = np.random.default_rng([self._seed, self.rounds, seen]).normal(size=(PROBES, 3))
        rows = self.near(row_of(end) + steps * (reach, reach, TURNED))
        rows = rows[self.has_way_on(rows)] if len(rows) else rows
        self._add(rows, self._ground.estimates(self._problem.start, rows))

    def near(self, rows: Array) -> Array:
        """Destinations (k, 3) that descents from ``rows`` (n, 3) lead to."""
        ground = self._ground
        descent = descend(self._problem.program, rows, room=ground.room)
        states = descent.states[descent.satisfied]
        if not len(states):
            return states
        return states[ground.is_free(states) & self.is_near(states)]

    def is_near(self, rows: Array) -> NDArray[np.bool_]:
        """Which attitudes (n, 3) are in the part of the free space that the start is in."""
        return np.asarray(self._ground.parts_of(rows) == self._here)

    def has_way_on(self, rows: Array) -> NDArray[np.bool_]:
        """From which free attitudes (n, 3) there is surely a way on; also from the start itself."""
        open_ends = self._ground.can_turn_round(rows, self._watch.look)
        return np.asarray(open_ends | (rows == row_of(self._problem.start)).all(axis=1))

    def _add(self, rows: Array, lengths: Array) -> None:
        """Take destinations (n, 3), ``lengths`` (n,) [m] away by estimate, that are new."""
        if len(self._seen) and len(rows):
            # Those of one round differ from each other.
            new = are_apart(rows, self._seen, SAME, SAME)
            rows, lengths = rows[new], lengths[new]
        if not len(rows):
            return
        numbers = np.arange(1, len(rows) + 1) + len(self._seen)
        self._seen = np.concatenate((self._seen, rows))
        is_free = self._ground.is_free(rows)
        is_near = is_free & self.is_near(rows)
        if not is_near.all():
            self._note_out_of_reach(rows[~is_near], is_free[~is_near])
            rows, lengths, numbers = rows[is_near], lengths[is_near], numbers[is_near]
        self.known = np.concatenate((self.known, rows))
        more = Candidates(numbers, rows, lengths, ~self.has_way_on(rows))
        self.candidates = self.candidates.and_more(more)

    def _note_out_of_reach(self, rows: Array, are_free: NDArray[np.bool_]) -> None:
        """Note destinations (n, 3) that are in obstacles, or walled off."""
        for row, is_free in zip(rows, are_free.tolist(), strict=True):
            attitude = attitude_of(row)
            if is_free:
                self._tried.add(attitude, AttemptResult.NO_PATH, 'walled off from the start')
            else:
                trouble = self._ground.trouble(attitude)
                self._tried.add(attitude, AttemptResult.IN_OBSTACLE, trouble)
