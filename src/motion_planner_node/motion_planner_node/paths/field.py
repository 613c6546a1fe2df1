"""Travel distances round the obstacles, as the kernels look them up."""

from __future__ import annotations

from math import hypot, inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.free_space import TravelField


class Field(NamedTuple):
    """Distances [m] from one point, at the middles of cells of a grid.

    distances: (rows + 2, columns + 2), infinite where no way leads and all round the grid.
    origin: (2,) the point.
    corner: (2,) of the grid.
    cell: side [m] of a cell.
    """

    distances: NDArray[np.float64]
    origin: NDArray[np.float64]
    corner: NDArray[np.float64]
    cell: float


def field_of(travel: TravelField) -> Field:
    """``travel`` for the kernels."""
    return Field(
        travel.distances,
        np.array(travel.origin, np.float64),
        np.array(travel.corner, np.float64),
        float(travel.cell),
    )


@kernel
def field_at(field: Field, x: float, y: float) -> float:
    """Estimated distance [m] at (x, y); infinite where no way leads."""
    rows, columns = field.distances.shape
    across = min(max((x - field.corner[0]) / field.cell + 0.5, 0.5), columns - 1.5)
    up = min(max((y - field.corner[1]) / field.cell + 0.5, 0.5), rows - 1.5)
    i, j = int(across), int(up)
    total, weights = 0.0, 0.0
    for b in range(2):
        for a in range(2):
            distance = field.distances[j + b, i + a]
            if distance < inf:
                weight = abs(1 - b - (up - j)) * abs(1 - a - (across - i)) + 1e-12
                total += weight * distance
                weights += weight
    if weights == 0.0:
        return inf
    return max(total / weights, hypot(x - field.origin[0], y - field.origin[1]))
