"""An exhaustive search over x, y and heading with the car's own commands: left, straight, right.

Each step turns by one heading bin or drives as far straight, so headings stay on the bins exactly
and positions are exact; of the states in one cell only the one reached on the shortest way is kept.
States come in order of the way driven plus a bound of what is left, and from those near
the goal exact Dubins words to attitudes of the goal are tried. The search ends when no state is left
that could lead to a shorter way, so it says whether there is a way at its resolution.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, inf, tau

import numpy as np
from numpy.typing import NDArray

from experiments.motion.aims import Aim
from experiments.motion.bounds import distances_to_goal, field_of
from experiments.motion.geometry import Array, Ground, clearance
from experiments.motion.search import search

#: Cells of the grid of bounds per turning radius.
GRID = 4.0
#: States that are looked at before a search is broken off.
MOST_STATES = 6_000_000
#: Ways that are handed out at most.
WAYS = 3


@dataclass(frozen=True)
class Found:
    """What a search said: ``ways`` are attitudes (n, 3) joined by free Dubins words, best first.

    ``exhausted`` is whether no state was left that could lead to a shorter way.
    """

    ways: tuple[Array, ...]
    length: float
    states: int
    exhausted: bool


class Lattice:
    """Searches in one world for one car, with what they share."""

    def __init__(self, ground: Ground, inside: Array, grid: float, bins: int) -> None:
        self.ground = ground
        # A little more room, so that the same ways are free whatever points on them are looked at.
        self._roomy = ground._replace(margin=2.0 * ground.margin - ground.disc)
        self.grid = grid
        self.bins = bins
        rows, columns = inside.shape
        self.field = field_of(ground, inside, grid, columns, rows)
        self.cell = 0.75 * ground.radius * tau / bins
        bounds = ground.bounds
        self._shape = (
            ceil((bounds[3] - bounds[1]) / self.cell),
            ceil((bounds[2] - bounds[0]) / self.cell),
            bins,
        )
        self._states = np.empty(self._shape, np.int32)

    def is_free(self, rows: Array) -> NDArray[np.bool_]:
        """Which of the attitudes (n, 3) the disc can be in."""
        bounds = self.ground.bounds
        i = np.clip((rows[:, 0] - bounds[0]) / self.grid, 0, self.field.shape[1] - 1).astype(int)
        j = np.clip((rows[:, 1] - bounds[1]) / self.grid, 0, self.field.shape[0] - 1).astype(int)
        room = np.array([clearance(self.ground, x, y) for x, y, _ in rows])
        return np.asarray((room >= self.ground.margin) & (self.field[j, i] > -1.0))

    def find(self, start: Array, aim: Aim) -> Found:
        """Search for ways from an attitude (3,) to a goal."""
        bounds = self.ground.bounds
        bound = distances_to_goal(self.field, bounds, self.grid, self.ground.margin, aim)
        self._states.fill(-1)
        states, parents, shots, exhausted = search(
            self._roomy, self.field, self.grid, bound, start, aim, self._states, self.cell,
            MOST_STATES,
        )  # fmt: skip
        ways = []
        for shot in shots[::-1][:WAYS]:
            nodes = [int(shot[0])]
            while parents[nodes[-1]] >= 0:
                nodes.append(int(parents[nodes[-1]]))
            rows = states[nodes[::-1], :3]
            ways.append(np.vstack([rows, shot[None, 1:4]]))
        length = float(shots[-1, 4]) if len(shots) else inf
        return Found(tuple(ways), length, len(states), bool(exhausted))
