"""Square cells over the map: which of them are open, and how many it takes to estimate travel."""

from __future__ import annotations

from copy import copy
from math import ceil, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.world.regions import close_cells, travel_at_each, travel_distances
from motion_planner_node.world.shapes import Shapes

#: Cells of a grid for estimates of travel: no more than it takes, to be quick.
TRAVEL_CELLS = (8_000, 12_000, 20_000, 33_000, 55_000, 100_000)
#: No cell of theirs is wider than so many times the clearance that is needed, but for the last grid's.
TRAVEL_WIDTH = 2.5
#: Places that estimates are compared from, and those that they are compared at.
ORIGINS, PLACES = 5, 997
#: Estimates may fall short of those of a finer grid by this share, but for one in a hundred.
SHORTFALL = 0.05


class Grid:
    """At most ``most`` square cells over the map, some of them open.

    There are no more than ``on_shorter_side`` along its shorter side, where that is finite.
    """

    def __init__(
        self, shapes: Shapes, margin: float, most: int, on_shorter_side: float = inf
    ) -> None:
        width, height = (float(side) for side in shapes.bounds[2:] - shapes.bounds[:2])
        self.corner = (float(shapes.bounds[0]), float(shapes.bounds[1]))
        self.cell = max(_side(shapes, most), min(width, height) / on_shorter_side)
        self.columns = ceil(width / self.cell)
        self.rows = ceil(height / self.cell)
        self._margin = margin
        self.open = np.ones((self.rows, self.columns), np.bool_)
        close_cells(shapes, margin, self.cell, (0, self.rows, 0, self.columns), self.open)
        #: With a frame of closed cells all round, (rows + 2, columns + 2).
        self.framed = np.pad(self.open, 1)

    def with_more(self, shapes: Shapes, boxes: NDArray[np.float64]) -> Grid:
        """The same cells where there are more ``shapes``, those in ``boxes`` (n, 4) [m], than before."""
        grid = copy(self)
        grid.open = self.open.copy()
        corner, most = np.array(self.corner), np.array((self.columns, self.rows))
        low = np.clip(np.floor((boxes[:, :2] - self._margin - corner) / self.cell) - 1, 0, most)
        high = np.clip(np.ceil((boxes[:, 2:] + self._margin - corner) / self.cell) + 1, 0, most)
        for (left, bottom), (right, top) in zip(
            low.astype(int).tolist(), high.astype(int).tolist(), strict=True
        ):
            window = (bottom, top, left, right)
            close_cells(shapes, self._margin, self.cell, window, grid.open)
        grid.framed = np.pad(grid.open, 1)
        return grid

    def places(self, most: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Middles (n,), (n,) [m] from the corner, of at most ``most`` open cells all over the map."""
        cells = np.flatnonzero(self.open)
        cells = cells[np.linspace(0, len(cells) - 1, min(most, len(cells))).astype(np.int64)]
        rows, columns = np.divmod(cells, self.columns)
        return (columns + 0.5) * self.cell, (rows + 0.5) * self.cell

    def distances(
        self, origin: tuple[float, float], x: NDArray[np.float64], y: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Travel distances [m] between ``origin`` and points (n,), all from the corner of the map."""
        field = travel_distances(self.framed, self.cell, *origin)
        return travel_at_each(field, 0.0, 0.0, self.cell, x, y)


def _side(shapes: Shapes, most: int) -> float:
    """Side [m] of at most ``most`` square cells over the map."""
    width, height = (float(side) for side in shapes.bounds[2:] - shapes.bounds[:2])
    return max(sqrt(width * height / most), max(width, height) * 2.0 / most)


def travel_grid(shapes: Shapes, margin: float, fine: Grid) -> Grid:
    """The coarsest grid of `TRAVEL_CELLS` on which obstacles are in the way as on the ``fine`` one.

    On coarser ones ways lead through walls that are thinner than their cells.  A search is led astray
    by some of them that hardly count among all: hence `TRAVEL_WIDTH`.
    """
    origins, (x, y) = list(zip(*fine.places(ORIGINS), strict=True)), fine.places(PLACES)
    told = [fine.distances(origin, x, y) for origin in origins]
    widest = max(TRAVEL_WIDTH * margin, fine.cell)
    for most in TRAVEL_CELLS[:-1]:
        if _side(shapes, most) <= widest:
            grid = Grid(shapes, margin, most)
            if grid.cell <= fine.cell or not _falls_short(grid, origins, x, y, told):
                return grid
    return Grid(shapes, margin, TRAVEL_CELLS[-1])


def _falls_short(
    grid: Grid,
    origins: list[tuple[float, float]],
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    told: list[NDArray[np.float64]],
) -> bool:
    """Whether distances are shorter than what finer cells have ``told``, by more than two cells."""
    shorter, all_of_them = 0, 0
    for origin, distances in zip(origins, told, strict=True):
        known = distances < inf
        estimates = grid.distances(origin, x[known], y[known]) + 2.0 * grid.cell
        shorter += int((estimates < (1.0 - SHORTFALL) * distances[known]).sum())
        all_of_them += int(known.sum())
    return 100 * shorter > all_of_them
