"""Where on the map a program can possibly be satisfied: boxes by interval arithmetic.

A box is given up only when interval bounds prove that no attitude in it meets the constraints, so
what remains covers all destinations. Nothing remaining is a proof that there are none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array, Interval
from motion_planner_node.satisfaction.row import Row
from motion_planner_node.world.model import Bounds

#: Boxes are halved until there would be more than this, or this often.
_MOST_CELLS = 1024
_MOST_HALVINGS = 16


@dataclass(frozen=True, slots=True)
class Cells:
    """Boxes of positions [m], arrays (n,)."""

    x_lo: Array
    x_hi: Array
    y_lo: Array
    y_hi: Array

    def __len__(self) -> int:
        return len(self.x_lo)

    def only(self, chosen: NDArray[np.bool_]) -> Cells:
        """The cells that are ``chosen``."""
        return Cells(self.x_lo[chosen], self.x_hi[chosen], self.y_lo[chosen], self.y_hi[chosen])

    def quartered(self) -> Cells:
        """Four cells for each, next to each other in the arrays."""
        x_mid, y_mid = 0.5 * (self.x_lo + self.x_hi), 0.5 * (self.y_lo + self.y_hi)
        return Cells(
            np.column_stack((self.x_lo, x_mid, x_mid, self.x_lo)).ravel(),
            np.column_stack((x_mid, self.x_hi, self.x_hi, x_mid)).ravel(),
            np.column_stack((self.y_lo, self.y_lo, y_mid, y_mid)).ravel(),
            np.column_stack((y_mid, y_mid, self.y_hi, self.y_hi)).ravel(),
        )


class Bounded(Protocol):
    """What is needed of a program: its rows and bounds of their functions over boxes."""

    rows: tuple[Row, ...]
    contradictions: tuple[str, ...]
    tolerance: float

    def bounds(self, x: Interval, y: Interval, /) -> list[Interval]:
        """Bounds of the functions f_i over boxes of positions, whatever the heading."""
        ...


def possible(
    program: Bounded, cells: Cells, rows: Sequence[int] | None = None
) -> NDArray[np.bool_]:
    """Which ``cells`` may hold a destination: False only where provably none does.

    ``rows`` picks constraints by their index; all count by default.
    """
    result = np.ones(len(cells), dtype=np.bool_)
    functions = program.bounds(Interval(cells.x_lo, cells.x_hi), Interval(cells.y_lo, cells.y_hi))
    for index in range(len(program.rows)) if rows is None else rows:
        row, function = program.rows[index], functions[index]
        if row.is_strict:
            result &= function.low < 0.0
        else:
            result &= function.low <= program.tolerance
        if row.is_equality:
            result &= function.high >= -program.tolerance
    return result


def possible_cells(program: Bounded, bounds: Bounds, rows: Sequence[int] | None = None) -> Cells:
    """Equal boxes that cover all positions within ``bounds`` where the constraints can be met.

    ``rows`` picks constraints by their index; all count by default.
    """
    cells = Cells(
        np.array([bounds.x_min]),
        np.array([bounds.x_max]),
        np.array([bounds.y_min]),
        np.array([bounds.y_max]),
    )
    cells = cells.only(possible(program, cells, rows))
    for _ in range(_MOST_HALVINGS):
        if not len(cells) or len(cells) > _MOST_CELLS // 2:
            break
        cells = cells.quartered()
        cells = cells.only(possible(program, cells, rows))
    return cells


def contradiction(program: Bounded, bounds: Bounds) -> str | None:
    """A sentence when no attitude within ``bounds`` can satisfy the program, else None.

    It names constraints none of which can be left out: one is missed everywhere, several exclude
    each other.
    """
    if program.contradictions:
        return program.contradictions[0]
    if len(possible_cells(program, bounds)):
        return None
    rows = list(range(len(program.rows)))
    for index in tuple(rows):
        others = [row for row in rows if row != index]
        if not len(possible_cells(program, bounds, others)):
            rows = others
    texts = ' and '.join(program.rows[index].text for index in rows)
    if len(rows) > 1:
        return f'{texts} exclude each other everywhere on the map'
    missed = _least_miss(program, bounds, rows[0])
    return f'{texts} holds nowhere on the map: missed by {missed:.6g} or more'


def _least_miss(program: Bounded, bounds: Bounds, index: int) -> float:
    """By how much the constraint is missed wherever on the map, at least."""
    edge = np.linspace(0.0, 1.0, 65)
    x = bounds.x_min + edge * (bounds.x_max - bounds.x_min)
    y = bounds.y_min + edge * (bounds.y_max - bounds.y_min)
    column, row = (index.ravel() for index in np.indices((64, 64)))
    function = program.bounds(Interval(x[column], x[column + 1]), Interval(y[row], y[row + 1]))[
        index
    ]
    missed = np.maximum(function.low, 0.0)
    if program.rows[index].is_equality:
        missed = np.maximum(missed, -function.high)
    return float(np.min(missed))
