"""Where on the map a program can possibly be satisfied: boxes by interval arithmetic.

A box is given up only when interval bounds prove that no attitude in it meets the constraints, so
what remains covers all destinations. Nothing remaining is a proof that there are none.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import kernel, part
from motion_planner_node.satisfaction.bounding import is_possible, slot_ranges
from motion_planner_node.satisfaction.branch_and_prune import Bounded, possible
from motion_planner_node.satisfaction.recording import Table
from motion_planner_node.world.model import Bounds

#: Boxes are quartered until there would be more than this, or this often.
MOST_CELLS = 1024
_MOST_QUARTERINGS = 16


def possible_cells(
    program: Bounded, bounds: Bounds, rows: Sequence[int] | None = None, most: int = MOST_CELLS
) -> Array:
    """Equal boxes (n, 4) that cover all positions in ``bounds`` where the constraints can be met.

    They are x_lo, y_lo, x_hi, y_hi [m]. ``rows`` picks constraints by their index; all count by
    default. From more than half of ``most`` boxes on they are not made smaller.
    """
    cells = np.array([[bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max]])
    if program.table is not None:
        return _possible_primitive(program.table, program.limits(rows), cells, most)
    for _ in range(_MOST_QUARTERINGS):
        cells = _quartered(cells)
        x_lo, y_lo, x_hi, y_hi = cells.T
        cells = cells[possible_positions(program, x_lo, y_lo, x_hi, y_hi, rows)]
        if not 0 < len(cells) <= most // 2:
            break
    return cells


def possible_positions(
    program: Bounded,
    x_lo: Array,
    y_lo: Array,
    x_hi: Array,
    y_hi: Array,
    rows: Sequence[int] | None = None,
) -> NDArray[np.bool_]:
    """Which boxes of positions (n,) may hold a destination: False only where provably none does.

    ``rows`` picks constraints by their index; all count by default.
    """
    heading = np.full(len(x_lo), pi)
    low = np.column_stack((x_lo, y_lo, -heading))
    return possible(program, low, np.column_stack((x_hi, y_hi, heading)), rows)


@part
def _quarter(cells: Array, cell: int, quarter: int, into: Array, place: int) -> None:
    """Set row ``place`` of ``into`` to a quarter of row ``cell`` of ``cells``."""
    x_mid = 0.5 * (cells[cell, 0] + cells[cell, 2])
    y_mid = 0.5 * (cells[cell, 1] + cells[cell, 3])
    is_right, is_upper = quarter in (1, 2), quarter >= 2
    into[place, 0] = x_mid if is_right else cells[cell, 0]
    into[place, 1] = y_mid if is_upper else cells[cell, 1]
    into[place, 2] = cells[cell, 2] if is_right else x_mid
    into[place, 3] = cells[cell, 3] if is_upper else y_mid


@kernel
def _quartered(cells: Array) -> Array:
    """The four quarters (4 n, 4) of each of ``cells`` (n, 4), next to each other."""
    result = np.empty((4 * len(cells), 4))
    for index in range(len(result)):
        _quarter(cells, index // 4, index % 4, result, index)
    return result


@kernel
def _possible_primitive(table: Table, limits: Array, cells: Array, most: int) -> Array:
    """`possible_cells` of a program of primitive operations: one step for each quarter."""
    least, greatest = slot_ranges(table)
    least[2], greatest[2] = -pi, pi
    for _ in range(_MOST_QUARTERINGS):
        quarters, size = np.empty((4 * len(cells), 4)), 0
        for index in range(len(quarters)):
            _quarter(cells, index // 4, index % 4, quarters, size)
            for axis in range(2):
                least[axis], greatest[axis] = quarters[size, axis], quarters[size, 2 + axis]
            size += is_possible(table, limits, least, greatest)
        cells = quarters[:size]
        if not 0 < size <= most // 2:
            break
    return cells.copy()
