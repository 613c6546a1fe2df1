"""Destinations that may be driven to, and how much they differ from each other."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.motion import Attitude


@dataclass(frozen=True, slots=True)
class Candidates:
    """Destinations, each a ``length`` away by estimate: the nearest first.

    The next action has to start there: one that may be a dead end is taken where others are far.

    Attributes:
        numbers: (n,) what tells them apart, in the order in which they were found
        rows: (n, 3) their attitudes
        lengths: (n,) how far they are [m]
        dead_ends: (n,) whether there may be no way on
    """

    numbers: NDArray[np.int64]
    rows: Array
    lengths: Array
    dead_ends: NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.numbers)

    def where(self, chosen: NDArray[np.bool_] | NDArray[np.intp]) -> Candidates:
        """Those that are ``chosen``, by a mask or by indices in their order."""
        return Candidates(
            self.numbers[chosen], self.rows[chosen], self.lengths[chosen], self.dead_ends[chosen]
        )

    def and_more(self, others: Candidates) -> Candidates:
        """These and ``others``."""
        both = Candidates(
            np.concatenate((self.numbers, others.numbers)),
            np.concatenate((self.rows, others.rows)),
            np.concatenate((self.lengths, others.lengths)),
            np.concatenate((self.dead_ends, others.dead_ends)),
        )
        return both.where(np.lexsort((both.numbers, both.lengths)))

    def without(self, others: Candidates) -> Candidates:
        """These but for ``others``."""
        return self.where(~np.isin(self.numbers, others.numbers))


NO_CANDIDATES = Candidates(
    np.zeros(0, np.int64), np.zeros((0, 3)), np.zeros(0), np.zeros(0, np.bool_)
)


def row_of(attitude: Attitude) -> Array:
    """``attitude`` as an array (1, 3)."""
    return np.array([[attitude.x, attitude.y, attitude.heading]], np.float64)


def attitude_of(row: Array) -> Attitude:
    """The attitude of a row (3,)."""
    return Attitude(*row.tolist())


def are_apart(rows: Array, others: Array, distance: float, angle: float) -> NDArray[np.bool_]:
    """Which attitudes (n, 3) are ``distance`` [m] from, or turned by ``angle`` [rad] to, all others (m, 3)."""
    off = rows[:, None, :] - others[None, :, :]
    turned = np.abs((off[..., 2] + pi) % (2.0 * pi) - pi)
    apart = (np.hypot(off[..., 0], off[..., 1]) >= distance) | (turned >= angle)
    return np.asarray(apart.all(axis=1))
