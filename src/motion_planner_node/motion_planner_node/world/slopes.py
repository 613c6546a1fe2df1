"""Clearance and the direction in which it grows, for descents that keep out of obstacles."""

from __future__ import annotations

from math import inf, sqrt

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.clearance import (
    clearance_at,
    nearest_item,
    squared_distance_to_segment,
)
from motion_planner_node.world.shapes import AnyShapes


@kernel
def clearance_with_slope(shapes: AnyShapes, x: float, y: float) -> tuple[float, float, float]:
    """Clearance [m] at (x, y), negative inside obstacles, and its derivatives by x and y.

    The derivatives are a unit vector; where several obstacles or edges are nearest it points away
    from one of them, and on an edge it is that edge's normal.
    """
    clearance, which = clearance_at(shapes, x, y)
    if which < 0:
        return clearance, *_away_from_edge(shapes, x, y)
    polygons = len(shapes.first_edge) - 1
    first, last = 0, 0
    if which == len(shapes.boxes):
        first = nearest_item(shapes, x, y, shapes.first_edge[-1], inf)[1]
        last = first + 1
    elif which < polygons:
        first, last = shapes.first_edge[which], shapes.first_edge[which + 1]
    if first == last:
        near_x, near_y = shapes.discs[which - polygons, 0], shapes.discs[which - polygons, 1]
        sign = 1.0
    else:
        near_x, near_y = _nearest_point(shapes, first, last, x, y)
        sign = -1.0 if clearance < 0.0 else 1.0
    length = sqrt((x - near_x) ** 2 + (y - near_y) ** 2)
    if length == 0.0:
        if first == last:
            return clearance, 1.0, 0.0
        return clearance, *_out_of(shapes, first, last, x, y)
    return clearance, sign * (x - near_x) / length, sign * (y - near_y) / length


@kernel
def _away_from_edge(shapes: AnyShapes, x: float, y: float) -> tuple[float, float]:
    bounds = shapes.bounds
    west, east = x - bounds[0], bounds[2] - x
    south, north = y - bounds[1], bounds[3] - y
    nearest = min(west, east, south, north)
    if nearest == west:
        return 1.0, 0.0
    if nearest == east:
        return -1.0, 0.0
    return 0.0, 1.0 if nearest == south else -1.0


@kernel
def _nearest_point(
    shapes: AnyShapes, first: int, last: int, x: float, y: float
) -> tuple[float, float]:
    """The point of the edges from ``first`` on that is nearest to (x, y)."""
    least, near_x, near_y = inf, x, y
    for i in range(first, last):
        x0, y0 = shapes.edges[i, 0], shapes.edges[i, 1]
        dx, dy = shapes.edges[i, 2] - x0, shapes.edges[i, 3] - y0
        along = ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy)
        along = min(max(along, 0.0), 1.0)
        square = (x - x0 - along * dx) ** 2 + (y - y0 - along * dy) ** 2
        if square < least:
            least, near_x, near_y = square, x0 + along * dx, y0 + along * dy
    return near_x, near_y


@kernel
def _out_of(shapes: AnyShapes, first: int, last: int, x: float, y: float) -> tuple[float, float]:
    """The normal, pointing to where it is free, of the one of these edges that (x, y) lies on."""
    least, normal_x, normal_y = inf, 1.0, 0.0
    for i in range(first, last):
        x0, y0, x1, y1 = shapes.edges[i]
        square = squared_distance_to_segment(x, y, x0, y0, x1, y1)
        if square < least:
            length = sqrt((x1 - x0) ** 2 + (y1 - y0) ** 2)
            least, normal_x, normal_y = square, (y1 - y0) / length, (x0 - x1) / length
    step = 1e-6
    clearance, _ = clearance_at(shapes, x + step * normal_x, y + step * normal_y)
    return (normal_x, normal_y) if clearance > 0.0 else (-normal_x, -normal_y)
