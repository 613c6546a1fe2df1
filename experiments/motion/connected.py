"""Which places the disc can be moved between at all, however it may turn.

A goal that is walled off from the start is known at once from this: the search would have to look
at everything that the start leads to before it knew.
"""

from __future__ import annotations

from typing import cast

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from experiments.motion.aims import Aim, in_goal
from experiments.motion.geometry import Array, Ground, clearance, compiled

#: Cells per turning radius: gates that are too narrow by two of them are known to be.
FINE = 32.0
#: Half the diagonal of a cell, in its sides.
HALF = 0.7072

Labels = NDArray[np.int32]


@compiled
def _may_be_free(ground: Ground, cell: float, columns: int, rows: int) -> NDArray[np.bool_]:
    """In which cells (rows, columns) there may be a place where the disc is free."""
    result = np.empty((rows, columns), np.bool_)
    for j in range(rows):
        for i in range(columns):
            x, y = ground.bounds[0] + (i + 0.5) * cell, ground.bounds[1] + (j + 0.5) * cell
            result[j, i] = clearance(ground, x, y) >= ground.disc - HALF * cell
    return result


@compiled
def _meets(parts: Labels, corner: Array, cell: float, aim: Aim, part: int) -> bool:
    """Whether a goal has a place in a part of the world, as far as one can tell by cells."""
    rows, columns = parts.shape
    for j in range(rows):
        for i in range(columns):
            x, y = corner[0] + (i + 0.5) * cell, corner[1] + (j + 0.5) * cell
            if parts[j, i] == part and in_goal(aim, x, y, HALF * cell):
                return True
    return False


class Parts:
    """The connected parts of a world for one disc, none of them taken to be smaller than it is."""

    def __init__(self, ground: Ground) -> None:
        self._corner, self._cell = ground.bounds[:2], ground.radius / FINE
        columns, rows = np.ceil((ground.bounds[2:] - self._corner) / self._cell).astype(int)
        free = _may_be_free(ground, self._cell, columns, rows)
        self._parts = cast(Labels, label(free, np.ones((3, 3)))[0])

    def are_joined(self, start: Array, aim: Aim) -> bool:
        """Whether the disc may get from a free attitude (3,) to a place of the goal."""
        i, j = ((start[:2] - self._corner) / self._cell).astype(int)
        rows, columns = self._parts.shape
        part = self._parts[min(j, rows - 1), min(i, columns - 1)]
        return bool(_meets(self._parts, self._corner, self._cell, aim, part))
