"""The world as a grid of free and occupied cells, for people's viewers."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, sqrt

import numpy as np
from numpy.typing import NDArray

from interface_node.plan import Obstacle, World

#: More cells than this are never filled; the resolution grows instead.
MAX_CELLS = 4_000_000


@dataclass(frozen=True, slots=True)
class Occupancy:
    """Cells of side ``resolution`` [m], row by row from the corner ``origin`` (x, y) [m].

    ``occupied`` has the shape (rows, columns), rows to the north.
    """

    resolution: float
    origin: tuple[float, float]
    occupied: NDArray[np.bool_]


def occupancy(world: World, resolution: float) -> Occupancy:
    """Rasterise the world: a cell is occupied when its centre lies in an obstacle.

    The resolution [m] grows where the bounds would take more than MAX_CELLS.
    """
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
    return Occupancy(resolution, (x_min, y_min), occupied)


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
