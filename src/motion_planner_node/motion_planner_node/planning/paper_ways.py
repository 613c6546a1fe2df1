"""Motions as the paper finds them: Algorithm 1, asked for more when an alternative is wanted."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from motion_planner_node.codes import AttemptResult
from motion_planner_node.functions import Array
from motion_planner_node.planning.candidates import attitude_of, row_of
from motion_planner_node.planning.ways import Found, Way, Ways
from motion_planner_node.satisfaction.paper_mode import (
    PaperCriterion,
    PaperLimits,
    algorithm_1,
    random_states,
)


class PaperWays(Ways):
    """Motions in the order in which Algorithm 1 finds them; it proves nothing."""

    def _to_anywhere(self) -> Iterator[Found]:
        start, bounds = self._problem.start, self._ground.scene.world.bounds
        rng = np.random.default_rng([self._seed, 0])
        self._share = 0.0
        ways = algorithm_1(
            PaperCriterion(self._problem.program),
            row_of(start)[0],
            random_states(rng, (bounds.x_min, bounds.y_min), (bounds.x_max, bounds.y_max)),
            self._not_in_obstacle,
            self._find_path,
            PaperLimits(self._parameters.paper_tries, self._parameters.paper_steps),
        )
        for way in ways:
            if self._are_new(row_of(way[1]))[0]:
                yield self._answer(way)
            if self._has_failed:
                return

    def _not_in_obstacle(self, state: Array) -> bool:
        self._watch.look()
        if self._ground.is_free(state[None, :])[0]:
            return True
        attitude = attitude_of(state)
        trouble = self._ground.trouble(attitude)
        self.tried.add(attitude, AttemptResult.IN_OBSTACLE, trouble)
        return False

    def _find_path(self, state: Array) -> Way | None:
        self._number += 1
        only = self._only(self._number, state[None, :])
        return None if self._has_failed else self._plan(only, None)

    def forget(self) -> None:
        """Begin anew."""
        self._number = 0
        super().forget()
