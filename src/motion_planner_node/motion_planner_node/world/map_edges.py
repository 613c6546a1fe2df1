"""The straight edges between the free and the occupied cells of an occupancy map."""

from __future__ import annotations

from functools import lru_cache
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.model import OccupancyMap


@kernel
def _runs(cells: NDArray[np.uint8], outside: int, most: int, runs: NDArray[np.int32]) -> int:
    """Count the edges and write the first of them to ``runs`` (n, 4); stop after ``most``.

    A row is column and row of one end and of the other, in cells from the first cell's corner.
    One pass, row by row: edges that go north are begun in one row and ended in a later one.
    """
    rows, columns = cells.shape
    count = 0
    below = np.full(columns, outside, np.uint8)
    here = np.full(columns, outside, np.uint8)
    begun = np.full(columns + 1, -1)
    for row in range(rows + 1):
        if row < rows:
            here[:] = cells[row]
        else:
            here[:] = outside
        start = -1
        west = outside
        for column in range(columns + 1):
            is_inside = column < columns
            east = int(here[column]) if is_inside else outside
            differs = is_inside and east != below[column]
            if differs and start < 0:
                start = column
            elif not differs and start >= 0:
                if count < len(runs):
                    runs[count] = start, row, column, row
                count += 1
                start = -1
            differs = row < rows and east != west
            if differs and begun[column] < 0:
                begun[column] = row
            elif not differs and begun[column] >= 0:
                if count < len(runs):
                    runs[count] = column, begun[column], column, row
                count += 1
                begun[column] = -1
            west = east
        if count > most:
            break
        below[:] = here
    return count


def count_edges(grid: OccupancyMap, most: int) -> int:
    """How many edges a map has; counting ends soon after ``most``."""
    nothing = np.zeros((0, 4), np.int32)
    return int(_runs(grid.occupied, int(grid.unknown_occupied), most, nothing))


@lru_cache(maxsize=2)
def map_edges(grid: OccupancyMap) -> NDArray[np.float64]:
    """Edges (n, 4) x0, y0, x1, y1 [m]: straight ones as long as they go on, in frame ``map``.

    Kept for the next world with the same map; cannot be written to.
    """
    edges = _placed(grid)
    edges.setflags(write=False)
    return edges


def _placed(grid: OccupancyMap) -> NDArray[np.float64]:
    occupied, outside = grid.occupied, int(grid.unknown_occupied)
    most = 2 * (len(occupied) + 1) * (occupied.shape[1] + 1)
    nothing = np.zeros((0, 4), np.int32)
    runs = np.empty((_runs(occupied, outside, most, nothing), 4), np.int32)
    _runs(occupied, outside, most, runs)
    local = runs * grid.resolution
    if grid.yaw == 0.0:
        return np.asarray(local + np.array([grid.x, grid.y, grid.x, grid.y]))
    x, y = local[:, 0::2], local[:, 1::2]
    c, s = cos(grid.yaw), sin(grid.yaw)
    edges = np.empty_like(local)
    edges[:, 0::2] = grid.x + c * x - s * y
    edges[:, 1::2] = grid.y + s * x + c * y
    return edges
