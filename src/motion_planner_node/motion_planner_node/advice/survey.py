"""What is known of a set of preconditions before anybody says where the robot starts."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.planning.boxes import Boxes
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import Impossible, hopeful_cells, walled_off
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import restarts

#: Descents from which destinations are known.
DESCENTS = 128
#: What a motion may end short of exactly meeting a constraint [m]; taken off lower bounds.
SLACK = 1e-6


@dataclass(slots=True)
class _Reachable:
    """What can be driven to from one connected part of the free space.

    ``states`` are attitudes (k, 3) to estimate the cost of, ``proof`` says that there are none.
    """

    boxes: Boxes
    states: NDArray[np.float64]
    proof: Impossible | None


@dataclass(slots=True)
class Survey:
    """Destinations of ``problem`` and the cells outside of which there are none.

    The problem's start is only a place holder: nothing in here depends on it.
    """

    problem: Problem
    ground: Ground
    _destinations: NDArray[np.float64]
    _cells: NDArray[np.intp]
    _reachable: dict[int, _Reachable] = field(default_factory=dict)

    @classmethod
    def of(cls, problem: Problem, ground: Ground, seed: int) -> Survey:
        """Descend from all over the map and ask which cells may hold a destination."""
        rng = np.random.default_rng([seed, 0])
        descent = restarts(problem.program, ground.scene.world.bounds, rng, DESCENTS)
        states = descent.states[descent.satisfied]
        states = states[ground.is_free(states)]
        return cls(problem, ground, states, hopeful_cells(problem, ground))

    def proof(self, start: Attitude) -> Impossible | None:
        """Why nothing can be driven to from ``start``, if so."""
        return self._from(start).proof

    def lower_bound(self, start: Attitude) -> float:
        """Length [m] that no motion from ``start`` to a destination is shorter than."""
        nearest = float(self._from(start).boxes.distances(start.x, start.y).min())
        return max(0.0, nearest - SLACK)

    def states(self, start: Attitude) -> NDArray[np.float64]:
        """Attitudes (k, 3), at least one, near which a motion from ``start`` may end."""
        return self._from(start).states

    def holds_at(self, start: Attitude) -> bool:
        """Whether the constraints are met at ``start`` already."""
        return not self.problem.program.unmet(start)

    def _from(self, start: Attitude) -> _Reachable:
        here = self.ground.part_of(start)
        if here not in self._reachable:
            self._reachable[here] = self._reached(start, here)
        return self._reachable[here]

    def _reached(self, start: Attitude, here: int) -> _Reachable:
        problem = self.problem.starting_at(start)
        boxes = self.ground.cells.boxes.chosen(self._cells[self.ground.parts[self._cells] == here])
        states = self._destinations[self.ground.parts_of(self._destinations) == here]
        if not len(states):
            x, y = boxes.centres
            states = np.column_stack([x, y, np.zeros(len(x))])
        return _Reachable(boxes, states, walled_off(problem, self.ground, self._cells))
