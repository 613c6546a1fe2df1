"""Signed distances of many points from shapes, with the directions in which they grow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.slopes import clearance_with_slope


@kernel
def clearances_with_slopes(shapes: Shapes, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Clearances [m] at ``points`` (n, 2) and their derivatives by x and y: (n, 3).

    NaN without slope where a coordinate is not finite.
    """
    result = np.zeros((len(points), 3))
    for i in range(len(points)):
        x, y = points[i, 0], points[i, 1]
        if np.isfinite(x) and np.isfinite(y):
            value, by_x, by_y = clearance_with_slope(shapes, x, y)
            result[i, 0], result[i, 1], result[i, 2] = value, by_x, by_y
        else:
            result[i, 0] = np.nan
    return result
