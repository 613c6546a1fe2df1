"""Motions as the paper finds them: Algorithm 1, asked for more when an alternative is wanted."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from motion_planner_node.codes import AttemptResult
from motion_planner_node.functions import Array
from motion_planner_node.planning.stream import Candidate, Found, Stream, Way
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction.paper_mode import (
    PaperCriterion,
    PaperLimits,
    algorithm_1,
    random_states,
)


class PaperStream(Stream):
    """Motions in the order in which Algorithm 1 finds them; it proves nothing."""

    def _generate(self) -> Iterator[Found]:
        start, bounds = self._problem.start, self._ground.scene.world.bounds
        rng = np.random.default_rng([self._seed, 0])
        self._share = 0.0
        ways = algorithm_1(
            PaperCriterion(self._problem.program),
            np.array([start.x, start.y, start.heading]),
            random_states(rng, (bounds.x_min, bounds.y_min), (bounds.x_max, bounds.y_max)),
            self._not_in_obstacle,
            self._find_path,
            PaperLimits(self._parameters.paper_tries, self._parameters.paper_steps),
        )
        for way in ways:
            if self._is_new(way[1]):
                yield self._answer(way)
            if self._has_failed:
                return

    def _not_in_obstacle(self, state: Array) -> bool:
        self._check_time()
        if self._ground.is_free(state[None, :])[0]:
            return True
        attitude = _attitude(state)
        trouble = self._ground.trouble(attitude)
        self.tried.add(attitude, AttemptResult.IN_OBSTACLE, trouble)
        return False

    def _find_path(self, state: Array) -> Way | None:
        self._number += 1
        candidate = Candidate(self._number, _attitude(state))
        self._candidates = [candidate]
        return None if self._has_failed else self._plan([candidate], None)

    def _restart(self) -> None:
        self._number = 0
        super()._restart()


def _attitude(state: Array) -> Attitude:
    return Attitude(*(float(number) for number in state))
