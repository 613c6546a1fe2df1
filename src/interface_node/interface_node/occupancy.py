"""The world as a grid of free and occupied cells, for people's viewers."""

from __future__ import annotations

from math import ceil, cos, sin, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from interface_node.plan import Obstacle, Occupancy, World

#: More cells than this are never filled; the resolution grows instead.
MAX_CELLS = 4_000_000


def occupancy(world: World, resolution: float) -> Occupancy:
    """Rasterise the world: a cell is occupied when its centre lies in an obstacle.

    So is one that holds the centre of an occupied cell of the world's own map, which may be finer.
    The resolution [m] is at most that of the map, but grows where the bounds would take more than
    MAX_CELLS.
    """
    if world.map:
        resolution = min(resolution, world.map.resolution)
    x_min, y_min, x_max, y_max = world.bounds
    width, height = x_max - x_min, y_max - y_min
    resolution = max(
        resolution,
        # Half the cells leaves room for rounding up; the longer side alone must fit as well.
        sqrt(width) * sqrt(height) / sqrt(MAX_CELLS / 2),
        max(width, height) / (MAX_CELLS / 4),
    )
    columns, rows = ceil(width / resolution), ceil(height / resolution)
    x = x_min + (np.arange(columns, dtype=np.float64) + 0.5) * resolution
    y = y_min + (np.arange(rows, dtype=np.float64) + 0.5) * resolution
    occupied = np.zeros((rows, columns), dtype=np.bool_)
    for obstacle in world.obstacles:
        left, low, right, high = _box(obstacle)
        inner_x = slice(*np.searchsorted(x, (left, right)))
        inner_y = slice(*np.searchsorted(y, (low, high)))
        occupied[inner_y, inner_x] |= _inside(obstacle, x[inner_x][None, :], y[inner_y][:, None])
    grid = Occupancy(resolution, (x_min, y_min), occupied)
    if world.map:
        _add_map(grid, world.map)
    return grid


def _add_map(grid: Occupancy, other: Occupancy) -> None:
    """Mark in ``grid`` what is occupied in another grid, however fine and turned that is."""
    rows, columns = grid.occupied.shape
    c, s = cos(other.yaw), sin(other.yaw)
    most_rows, most_columns = other.occupied.shape
    for j in range(most_rows):
        i = np.flatnonzero(other.occupied[j]) + 0.5
        x = other.origin[0] + other.resolution * (c * i - s * (j + 0.5))
        y = other.origin[1] + other.resolution * (s * i + c * (j + 0.5))
        column = _floor((x - grid.origin[0]) / grid.resolution)
        row = _floor((y - grid.origin[1]) / grid.resolution)
        held = (row >= 0) & (row < rows) & (column >= 0) & (column < columns)
        grid.occupied[row[held], column[held]] = True
    dx = grid.origin[0] + (np.arange(columns) + 0.5) * grid.resolution - other.origin[0]
    for j in range(rows):
        dy = grid.origin[1] + (j + 0.5) * grid.resolution - other.origin[1]
        column = _floor((c * dx + s * dy) / other.resolution)
        row = _floor((c * dy - s * dx) / other.resolution)
        held = (row >= 0) & (row < most_rows) & (column >= 0) & (column < most_columns)
        grid.occupied[j, held] |= other.occupied[row[held], column[held]]


def _floor(values: NDArray[np.floating[Any]]) -> NDArray[np.int64]:
    return np.asarray(np.floor(values), dtype=np.int64)


def _box(obstacle: Obstacle) -> tuple[float, float, float, float]:
    if obstacle.corners:
        xs, ys = zip(*obstacle.corners, strict=True)
        return min(xs), min(ys), max(xs), max(ys)
    (x, y), radius = obstacle.center, obstacle.radius
    return x - radius, y - radius, x + radius, y + radius


def _inside(
    obstacle: Obstacle, x: NDArray[np.float64], y: NDArray[np.float64]
) -> NDArray[np.bool_]:
    """Which points lie in the obstacle; for a polygon by the parity of crossed edges."""
    if not obstacle.corners:
        return np.hypot(x - obstacle.center[0], y - obstacle.center[1]) <= obstacle.radius
    inside = np.zeros(np.broadcast_shapes(x.shape, y.shape), dtype=np.bool_)
    corners = obstacle.corners
    for (x0, y0), (x1, y1) in zip(corners, (*corners[1:], corners[0]), strict=True):
        if y0 == y1:
            continue
        crosses = (y0 > y) != (y1 > y)
        inside ^= crosses & (x < x0 + (y - y0) * ((x1 - x0) / (y1 - y0)))
    return inside
