"""What is known of a set of preconditions before anybody says where the robot starts."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import (
    Impossible,
    contradiction,
    hopeful_cells,
    walled_off,
)
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import restarts

#: Descents from which destinations are known.
DESCENTS = 128
#: Destinations of one part of the free space that are kept, evenly chosen.
MOST_STATES = 48


@dataclass(frozen=True, slots=True)
class Reach:
    """What can be driven to from one connected part of the free space.

    Attributes:
        cells: numbers of the ground's cells that may hold a destination, packed as bits
        outermost: numbers (n,) of those of them that have others beside them
        rim: (n, 4) x_lo, y_lo, x_hi, y_hi [m] of the outermost cells; from anywhere outside of the
            cells one of these is the nearest
        states: (k, 3) attitudes, at least one, near which a motion may end
        proof: why nothing can be driven to, if so
    """

    cells: NDArray[np.uint8]
    outermost: NDArray[np.intp]
    rim: NDArray[np.float64]
    states: NDArray[np.float64]
    proof: Impossible | None

    def holds(self, cell: int) -> bool:
        """Whether the ground's ``cell`` may hold a destination."""
        return bool(self.cells[cell >> 3] >> (7 - (cell & 7)) & 1)


@dataclass(slots=True)
class Survey:
    """Destinations of ``problem`` and the cells outside of which there are none.

    The problem's start is only a place holder: nothing in here depends on it.
    """

    problem: Problem
    ground: Ground
    _destinations: NDArray[np.float64]
    _cells: NDArray[np.uint8]
    _reaches: dict[int, Reach] = field(default_factory=dict)

    @classmethod
    def of(cls, problem: Problem, ground: Ground, seed: int) -> Survey:
        """Descend from all over the map and ask which cells may hold a destination."""
        rng = np.random.default_rng([seed, 0])
        descent = restarts(problem.program, ground.scene.world.bounds, rng, DESCENTS)
        states = descent.states[descent.satisfied]
        states = states[ground.is_free(states)]
        return cls(problem, ground, states, _packed(ground, hopeful_cells(problem, ground)))

    @property
    def contradiction(self) -> Impossible | None:
        """Why nobody can ever meet the constraints, as far as their text shows."""
        return contradiction(self.problem)

    def reach(self, start: Attitude, here: int) -> Reach:
        """What can be driven to from ``start``, as far as connected parts of the free space tell.

        ``here`` is the number of the part that ``start`` is in.
        """
        if here not in self._reaches:
            self._reaches[here] = self._reached(start, here)
        return self._reaches[here]

    def holds_at(self, start: Attitude) -> bool:
        """Whether the constraints are met at ``start`` already."""
        return self.problem.program.holds_at(start)

    def _reached(self, start: Attitude, here: int) -> Reach:
        ground = self.ground
        count = len(ground.parts)
        hopeful = np.flatnonzero(np.unpackbits(self._cells, count=count))
        proof = walled_off(self.problem.starting_at(start), ground, hopeful)
        chosen = hopeful[ground.parts[hopeful] == here]
        outermost = ground.rim_of(chosen)
        boxes = ground.cells.boxes.chosen(outermost)
        rim = np.column_stack([boxes.x_lo, boxes.y_lo, boxes.x_hi, boxes.y_hi])
        states = self._destinations[ground.parts_of(self._destinations) == here]
        if not len(states):
            x, y = boxes.centres
            states = np.column_stack([x, y, np.zeros(len(x))])
        even = spread(len(states), MOST_STATES)
        # Mostly all is in one part: thousands of bytes that need not be kept twice.
        cells = self._cells if len(chosen) == len(hopeful) else _packed(ground, chosen)
        return Reach(cells, outermost, rim, states[even], proof)


def spread(count: int, most: int) -> NDArray[np.int64]:
    """At most ``most`` of the numbers below ``count``, evenly spread."""
    chosen = min(count, most)
    return (np.arange(chosen) * 2 + 1) * count // max(2 * chosen, 1)


def _packed(ground: Ground, cells: NDArray[np.intp]) -> NDArray[np.uint8]:
    mask = np.zeros(len(ground.parts), np.bool_)
    mask[cells] = True
    return np.packbits(mask)
