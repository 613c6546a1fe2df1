"""Where on the map a program can possibly be satisfied: boxes by interval arithmetic.

A box is given up only when interval bounds prove that no attitude in it meets the constraints, so
what remains covers all destinations. Nothing remaining is a proof that there are none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.satisfaction.branch_and_prune import Bounded, possible
from motion_planner_node.world.model import Bounds

#: Boxes are halved until there would be more than this, or this often.
MOST_CELLS = 1024
_MOST_HALVINGS = 16
#: They are halved so often before anything is asked about them.
_FIRST_HALVINGS = 4


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


def possible_cells(
    program: Bounded, bounds: Bounds, rows: Sequence[int] | None = None, most: int = MOST_CELLS
) -> Cells:
    """Equal boxes that cover all positions within ``bounds`` where the constraints can be met.

    ``rows`` picks constraints by their index; all count by default.  From more than half of ``most``
    boxes on they are not made smaller.
    """
    cells = _first_cells(bounds)
    cells = cells.only(possible_positions(program, cells, rows))
    for _ in range(_FIRST_HALVINGS, _MOST_HALVINGS):
        if not len(cells) or len(cells) > most // 2:
            break
        cells = cells.quartered()
        cells = cells.only(possible_positions(program, cells, rows))
    return cells


@lru_cache(maxsize=8)
def _first_cells(bounds: Bounds) -> Cells:
    cells = Cells(
        np.array([bounds.x_min]),
        np.array([bounds.x_max]),
        np.array([bounds.y_min]),
        np.array([bounds.y_max]),
    )
    for _ in range(_FIRST_HALVINGS):
        cells = cells.quartered()
    return cells


def possible_positions(
    program: Bounded, cells: Cells, rows: Sequence[int] | None = None
) -> NDArray[np.bool_]:
    """Which ``cells`` may hold a destination: False only where provably none does.

    ``rows`` picks constraints by their index; all count by default.
    """
    heading = np.full(len(cells), np.pi)
    low = np.column_stack((cells.x_lo, cells.y_lo, -heading))
    return possible(program, low, np.column_stack((cells.x_hi, cells.y_hi, heading)), rows)
