"""Proofs that no attitude at all will do: interval branch and prune over position and heading.

Boxes of attitudes are given up only when interval bounds prove that none in them meets the
constraints, and are halved otherwise. Nothing left is a proof; a spent budget is not.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.satisfaction.recording import Table
from motion_planner_node.satisfaction.room import ANYWHERE, Room
from motion_planner_node.world.clearance import clearances
from motion_planner_node.world.model import Bounds

#: Boxes looked at before a proof is given up.
BUDGET = 40_000
#: Boxes whose bounds are computed at a time: a program asks before each batch whether to stop.
BATCH = 1024


class Bounded(Protocol):
    """What is needed of a program: its functions and what they may be."""

    @property
    def table(self) -> Table | None:
        """The functions f_i as primitive operations, if they are."""
        ...

    @property
    def uses_heading(self) -> bool:
        """Whether it is worth while to halve ranges of headings."""
        ...

    def limits(self, rows: Sequence[int] | None, /) -> Array:
        """What the functions may be where the constraints number ``rows`` are met, (m, 3)."""
        ...

    def possible(self, low: Array, high: Array, limits: Array, /) -> NDArray[np.bool_]:
        """Which boxes (n, 3) of attitudes may hold one within ``limits``."""
        ...


@dataclass(frozen=True, slots=True)
class Remainder:
    """Boxes (n, 3) of x, y [m] and heading [rad] outside of which no attitude will do.

    ``examined`` is the number of boxes that were looked at.
    """

    low: Array
    high: Array
    examined: int

    @property
    def is_empty(self) -> bool:
        """Whether it is proven that there is none."""
        return not len(self.low)


def possible(
    program: Bounded, low: Array, high: Array, rows: Sequence[int] | None = None
) -> NDArray[np.bool_]:
    """Which boxes (n, 3) may hold an attitude that meets ``rows``, all by default."""
    limits = program.limits(rows)
    result = np.empty(len(low), dtype=np.bool_)
    for first in range(0, len(low), BATCH):
        batch = slice(first, first + BATCH)
        result[batch] = program.possible(low[batch], high[batch], limits)
    return result


def branch_and_prune(
    program: Bounded,
    bounds: Bounds,
    rows: Sequence[int] | None = None,
    room: Room = ANYWHERE,
    budget: int = BUDGET,
) -> Remainder:
    """Look for a proof that no attitude in ``bounds`` and ``room`` meets ``rows``, all by default.

    It ends with the proof, or with the boxes that the budget left over. It depends on nothing but its
    arguments.
    """
    sizes = np.array([bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min, 2.0 * pi])
    low = np.array([[bounds.x_min, bounds.y_min, -pi]])
    high = np.array([[bounds.x_max, bounds.y_max, pi]])
    weights = 1.0 / np.where(sizes > 0.0, sizes, 1.0)
    weights[2] *= program.uses_heading
    examined = 0
    while True:
        keep = possible(program, low, high, rows)
        keep &= _has_room(room, low, high)
        examined += len(low)
        low, high = low[keep], high[keep]
        widest = np.max((high - low) * weights, initial=0.0)
        if not len(low) or examined + 2 * len(low) > budget or widest < 1e-9:
            return Remainder(low, high, examined)
        low, high = _halved(low, high, weights)


def _has_room(room: Room, low: Array, high: Array) -> NDArray[np.bool_]:
    """Which boxes may hold a place with the room's clearance: it changes by a metre per metre."""
    if room.clearance == -np.inf:
        return np.ones(len(low), dtype=np.bool_)
    middle = np.ascontiguousarray(0.5 * (low + high))
    reach = 0.5 * np.hypot(high[:, 0] - low[:, 0], high[:, 1] - low[:, 1])
    return np.asarray(clearances(room.shapes, middle) + reach * (1.0 + 1e-9) >= room.clearance)


def _halved(low: Array, high: Array, weights: Array) -> tuple[Array, Array]:
    """Both halves of each box, across its longest side."""
    axis = np.argmax((high - low) * weights, axis=1)
    every = np.arange(len(low))
    middle = 0.5 * (low[every, axis] + high[every, axis])
    first_high, second_low = high.copy(), low.copy()
    first_high[every, axis] = middle
    second_low[every, axis] = middle
    return np.concatenate((low, second_low)), np.concatenate((first_high, high))
