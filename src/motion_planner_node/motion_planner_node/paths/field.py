"""Travel distances round the obstacles, as the kernels look them up."""

from __future__ import annotations

from math import hypot
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.free_space import TravelField
from motion_planner_node.world.regions import travel_at


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
    around = travel_at(field.distances, field.corner[0], field.corner[1], field.cell, x, y)
    return max(around, hypot(x - field.origin[0], y - field.origin[1]))
