"""Exact distances from points to the obstacles and the edge of the map."""

from __future__ import annotations

from math import hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes


@kernel
def squared_distance_to_segment(
    x: float, y: float, x0: float, y0: float, x1: float, y1: float
) -> float:
    """Squared distance [m^2] from (x, y) to the straight segment from (x0, y0) to (x1, y1)."""
    dx, dy = x1 - x0, y1 - y0
    along = (x - x0) * dx + (y - y0) * dy
    square = dx * dx + dy * dy
    along = 0.0 if along <= 0.0 else (1.0 if along >= square else along / square)
    ex, ey = x - (x0 + along * dx), y - (y0 + along * dy)
    return ex * ex + ey * ey


@kernel
def _distance_to_polygon(
    edges: NDArray[np.float64], first: int, last: int, x: float, y: float
) -> float:
    """Distance [m] to the boundary with ``edges`` (e, 4) from ``first`` on, negative inside."""
    square, inside = inf, False
    for i in range(first, last):
        x0, y0, x1, y1 = edges[i, 0], edges[i, 1], edges[i, 2], edges[i, 3]
        square = min(square, squared_distance_to_segment(x, y, x0, y0, x1, y1))
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
    return -sqrt(square) if inside else sqrt(square)


@kernel
def clearance_at(shapes: Shapes, x: float, y: float) -> tuple[float, int]:
    """Distance [m] from (x, y) to the nearest obstacle or map edge, and which obstacle that is.

    Negative inside an obstacle or outside the map; -1 stands for the map's edge.
    """
    bounds = shapes.bounds
    nearest = min(x - bounds[0], bounds[2] - x, y - bounds[1], bounds[3] - y)
    which = -1
    polygons = len(shapes.first_edge) - 1
    for i in range(len(shapes.boxes)):
        outside_x = max(shapes.boxes[i, 0] - x, 0.0, x - shapes.boxes[i, 2])
        if outside_x > 0.0 and outside_x >= nearest:
            continue
        outside_y = max(shapes.boxes[i, 1] - y, 0.0, y - shapes.boxes[i, 3])
        outside = hypot(outside_x, outside_y)
        if outside > 0.0 and outside >= nearest:
            continue
        if i < polygons:
            first, last = shapes.first_edge[i], shapes.first_edge[i + 1]
            distance = _distance_to_polygon(shapes.edges, first, last, x, y)
        else:
            disc = i - polygons
            away = hypot(x - shapes.discs[disc, 0], y - shapes.discs[disc, 1])
            distance = away - shapes.discs[disc, 2]
        if distance < nearest:
            nearest, which = distance, i
    return nearest, which


@kernel
def clearances(shapes: Shapes, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Clearances [m], shape (n,), at ``points`` of shape (n, 2) or wider."""
    result = np.empty(len(points))
    for i in range(len(points)):
        result[i] = clearance_at(shapes, points[i, 0], points[i, 1])[0]
    return result
