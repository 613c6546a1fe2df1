"""A decomposition of the map into coarse cells that knows the obstacles, and leads through it."""

from __future__ import annotations

from heapq import heappop, heappush
from math import hypot

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.world.free_space import FreeSpace

Cell = tuple[int, int]

#: A cell that is nearly closed counts as this much open, so that it is entered when nothing else is.
LEAST_OPEN = 0.05


class Decomposition:
    """Square cells over the map, each with a weight: what a metre in it counts for a lead."""

    def __init__(self, free: FreeSpace, part: int, side: float) -> None:
        """Cells of about ``side`` [m] over connected ``part`` of the free space."""
        fine = free.cells
        x, y = 0.5 * (fine.x_lo + fine.x_hi), 0.5 * (fine.y_lo + fine.y_hi)
        inside = free.components_of(x, y) == part
        x, y = x[inside], y[inside]
        self._corner = (float(x.min()) - 0.5 * side, float(y.min()) - 0.5 * side)
        self.side = side
        columns, rows = self._indices(x, y)
        self.shape = (int(rows.max()) + 1, int(columns.max()) + 1)
        counts = np.zeros(self.shape)
        np.add.at(counts, (rows, columns), 1.0)
        #: Share of each cell that is open, (rows, columns).
        self.open = np.minimum(counts * (free.resolution / side) ** 2, 1.0)
        self.weights = 1.0 / np.maximum(self.open, LEAST_OPEN)

    def _indices(
        self, x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        return (
            np.floor((x - self._corner[0]) / self.side).astype(np.int64),
            np.floor((y - self._corner[1]) / self.side).astype(np.int64),
        )

    def cell_of(self, x: float, y: float) -> Cell:
        """Row and column of the cell at (x, y) [m], or of the nearest one."""
        row = int((y - self._corner[1]) // self.side)
        column = int((x - self._corner[0]) // self.side)
        return (
            min(max(row, 0), self.shape[0] - 1),
            min(max(column, 0), self.shape[1] - 1),
        )

    def lead(self, start: Cell, ends: set[Cell]) -> list[Cell]:
        """The chain of cells of least weight from ``start`` to any of ``ends``; none if there is none."""
        costs, before = {start: 0.0}, {start: start}
        queue, done = [(0.0, start)], set()
        while queue:
            cost, cell = heappop(queue)
            if cell in done:
                continue
            done.add(cell)
            if cell in ends:
                chain = [cell]
                while chain[-1] != start:
                    chain.append(before[chain[-1]])
                return chain[::-1]
            for row in range(max(cell[0] - 1, 0), min(cell[0] + 2, self.shape[0])):
                for column in range(max(cell[1] - 1, 0), min(cell[1] + 2, self.shape[1])):
                    if self.open[row, column] <= 0.0:
                        continue
                    step = hypot(row - cell[0], column - cell[1])
                    weight = 0.5 * (self.weights[cell] + self.weights[row, column])
                    through = cost + step * float(weight)
                    if through < costs.get((row, column), np.inf):
                        costs[row, column], before[row, column] = through, cell
                        heappush(queue, (through, (row, column)))
        return []

    def corridor(self, lead: list[Cell], width: int) -> NDArray[np.bool_]:
        """The open cells at most ``width`` cells away from ``lead``, (rows, columns)."""
        mask = np.zeros(self.shape, np.bool_)
        for row, column in lead:
            rows = slice(max(row - width, 0), row + width + 1)
            mask[rows, max(column - width, 0) : column + width + 1] = True
        return np.asarray(mask & (self.open > 0.0))

    def box(self, corridor: NDArray[np.bool_]) -> tuple[float, float, float, float]:
        """The rectangle x_min, y_min, x_max, y_max [m] round a corridor."""
        rows, columns = np.nonzero(corridor)
        x, y = self._corner
        return (
            x + float(columns.min()) * self.side,
            y + float(rows.min()) * self.side,
            x + float(columns.max() + 1) * self.side,
            y + float(rows.max() + 1) * self.side,
        )
