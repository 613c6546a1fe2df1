"""The straight edges between the free and the occupied cells of an occupancy map."""

from __future__ import annotations

from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.model import OccupancyMap


@kernel
def _occupied(cells: NDArray[np.uint8], outside: int, row: int, column: int) -> bool:
    rows, columns = cells.shape
    if 0 <= row < rows and 0 <= column < columns:
        return bool(cells[row, column] != 0)
    return outside != 0


@kernel
def _runs(cells: NDArray[np.uint8], outside: int, most: int, runs: NDArray[np.int32]) -> int:
    """Count the edges and write the first of them to ``runs`` (n, 4); stop after ``most``.

    A row is column and row of one end and of the other, in cells from the first cell's corner.
    """
    rows, columns = cells.shape
    count = 0
    for along in range(2):
        lines, length = (rows, columns) if along == 0 else (columns, rows)
        for line in range(lines + 1):
            start = -1
            for i in range(length + 1):
                differs = False
                if i < length and along == 0:
                    differs = _occupied(cells, outside, line - 1, i) != _occupied(
                        cells, outside, line, i
                    )
                elif i < length:
                    differs = _occupied(cells, outside, i, line - 1) != _occupied(
                        cells, outside, i, line
                    )
                if differs and start < 0:
                    start = i
                elif not differs and start >= 0:
                    if count < len(runs) and along == 0:
                        runs[count] = start, line, i, line
                    elif count < len(runs):
                        runs[count] = line, start, line, i
                    count += 1
                    start = -1
            if count > most:
                return count
    return count


def count_edges(grid: OccupancyMap, most: int) -> int:
    """How many edges a map has; counting ends soon after ``most``."""
    nothing = np.zeros((0, 4), np.int32)
    return int(_runs(grid.occupied, int(grid.unknown_occupied), most, nothing))


def map_edges(grid: OccupancyMap) -> NDArray[np.float64]:
    """Edges (n, 4) x0, y0, x1, y1 [m]: straight ones as long as they go on, in frame ``map``."""
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
