"""A decomposition of the map into coarse cells that knows the obstacles, and leads through it."""

from __future__ import annotations

from heapq import heappop, heappush
from math import hypot, inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Rows
from motion_planner_node.world.free_space import FreeSpace
from motion_planner_node.world.regions import components, labels_at

Cell = tuple[int, int]

#: A cell that is nearly closed counts as this much open, so that it is entered when nothing else is.
LEAST_OPEN = 0.05


class Decomposition:
    """Square cells over the map, each with a weight: what a metre in it counts for a lead.

    Where obstacles cut a cell into pieces, each piece has neighbours of its own.
    """

    def __init__(self, free: FreeSpace, part: int, side: float) -> None:
        """Cells of about ``side`` [m] over connected ``part`` of the free space."""
        fine, width = free.cells, free.resolution
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
        self.open = np.minimum(counts * (width / side) ** 2, 1.0)
        self.weights = 1.0 / np.maximum(self.open, LEAST_OPEN)
        self._fine = (float(x.min()) - 0.5 * width, float(y.min()) - 0.5 * width, width)
        column = np.rint((x - x.min()) / width).astype(np.int64)
        row = np.rint((y - y.min()) / width).astype(np.int64)
        # With closed lines between the cells no component goes on in the next one.
        apart = np.zeros(
            (int(row.max()) + self.shape[0], int(column.max()) + self.shape[1]), np.bool_
        )
        apart[row + rows, column + columns] = True
        numbers = components(apart)[row + rows, column + columns]
        self._pieces = np.full((int(row.max()) + 1, int(column.max()) + 1), -1, np.int32)
        self._pieces[row, column] = numbers
        first = np.unique(numbers, return_index=True)[1]
        self._cells = list(zip(rows[first].tolist(), columns[first].tolist(), strict=True))
        self._next = _neighbours(self._pieces, len(first))

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

    def lead(self, start: Rows, ends: Rows) -> list[Cell]:
        """The chain of cells of least weight from a place to any of others, (n, 2) or wider [m].

        Cells that follow each other are joined by free space; empty when there is no chain.
        """
        (first,), last = self._pieces_at(start), set(self._pieces_at(ends))
        costs, before = {first: 0.0}, {first: first}
        queue, done = [(0.0, first)], set()
        while queue:
            cost, piece = heappop(queue)
            if piece in done:
                continue
            done.add(piece)
            if piece in last:
                chain = [piece]
                while chain[-1] != first:
                    chain.append(before[chain[-1]])
                return [self._cells[number] for number in chain[::-1]]
            cell = self._cells[piece]
            for near in self._next[piece]:
                other = self._cells[near]
                step = hypot(other[0] - cell[0], other[1] - cell[1])
                weight = 0.5 * (self.weights[cell] + self.weights[other])
                through = cost + step * float(weight)
                if through < costs.get(near, inf):
                    costs[near], before[near] = through, piece
                    heappush(queue, (through, near))
        return []

    def _pieces_at(self, places: Rows) -> list[int]:
        """Numbers of the pieces at free places."""
        x, y = np.ascontiguousarray(places[:, 0]), np.ascontiguousarray(places[:, 1])
        return list(map(int, labels_at(self._pieces, *self._fine, x, y)))

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


def _neighbours(pieces: NDArray[np.int32], count: int) -> list[list[int]]:
    """The pieces next to each of ``count`` ones, by their numbers in fine cells, -1 where closed."""
    framed = np.pad(pieces, 1, constant_values=-1)
    pairs = [np.empty((0, 2), np.int32)]
    for row, column in ((0, 1), (1, 0), (1, 1), (1, -1)):
        one, other = framed, np.roll(framed, (-row, -column), (0, 1))
        joined = (one >= 0) & (other >= 0) & (one != other)
        pairs.append(np.unique(np.stack((one[joined], other[joined]), axis=1), axis=0))
    near: list[set[int]] = [set() for _ in range(count)]
    for one, other in np.vstack(pairs).tolist():
        near[one].add(other)
        near[other].add(one)
    return [sorted(numbers) for numbers in near]
