"""Exact distances from points to the obstacles and the edge of the map."""

from __future__ import annotations

from math import floor, hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.index import COVER, COVERED, FIRST, LAST, OPEN, SKIP, bucket_at
from motion_planner_node.world.shapes import AnyShapes


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
def _deepest(shapes: AnyShapes, x: float, y: float, nearest: float) -> tuple[float, int]:
    """The least signed distance [m] to all polygons and discs, if below ``nearest``; else that."""
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
def _depth_in_outlines(shapes: AnyShapes, row: int, x: float, y: float) -> tuple[float, int]:
    """The least signed distance [m] to a polygon that holds (x, y), in a row of buckets; else 0."""
    edges, first_edge, row_edges = shapes.edges, shapes.first_edge, shapes.row_edges
    last_at = shapes.row_starts[row + 1]
    depth, which = 0.0, -1
    inside, polygon, last = False, -1, 0
    for at in range(shapes.row_starts[row], last_at):
        edge = row_edges[at]
        if edge >= last:
            while first_edge[polygon + 1] <= edge:
                polygon += 1
            last = first_edge[polygon + 1]
        y0, y1 = edges[edge, 1], edges[edge, 3]
        if (y0 > y) != (y1 > y):
            x0, x1 = edges[edge, 0], edges[edge, 2]
            if x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
                inside = not inside
        if inside and (at + 1 == last_at or row_edges[at + 1] >= last):
            inside = False
            distance = _distance_to_polygon(edges, first_edge[polygon], last, x, y)
            if distance < depth:
                depth, which = distance, polygon
    return depth, which


@kernel
def inside_a_cell(shapes: AnyShapes, x: float, y: float) -> bool:
    """Whether (x, y) is in an occupied cell of the occupancy map."""
    occupied, cells = shapes.occupied, shapes.cells
    rows, columns = occupied.shape
    if rows == 0:
        return False
    dx, dy = x - cells[0], y - cells[1]
    column = floor((dx * cells[2] + dy * cells[3]) / cells[4])
    row = floor((dy * cells[2] - dx * cells[3]) / cells[4])
    if 0 <= row < rows and 0 <= column < columns:
        return bool(occupied[int(row), int(column)] != 0)
    return bool(cells[5] != 0.0)


@kernel
def nearest_item(
    shapes: AnyShapes, x: float, y: float, lowest: int, nearest: float
) -> tuple[float, int]:
    """Distance [m] to and number of the nearest item from number ``lowest`` on.

    ``nearest`` and -1 when there is none nearer than that.  Looks at rings of buckets, from the
    first one that is not empty, until no further one can hold anything nearer.
    """
    edges, discs = shapes.edges, shapes.discs
    buckets, items, size = shapes.buckets, shapes.items, shapes.frame[2]
    rows, columns, _ = buckets.shape
    row, column, rim = bucket_at(shapes.frame, buckets, x, y)
    which, square = -1, max(nearest, 0.0) ** 2
    ring = int(buckets[row, column, SKIP])
    while ring < rows + columns and (ring == 0 or (ring - 1) * size + rim < nearest):
        for j in range(max(row - ring, 0), min(row + ring, rows - 1) + 1):
            is_whole = j == row - ring or j == row + ring
            i = column - ring
            if i < 0:
                i = 0 if is_whole else column + ring
            while i <= min(column + ring, columns - 1):
                skip = max(int(buckets[j, i, SKIP]), 1)
                if buckets[j, i, SKIP] == 0:
                    for at in range(buckets[j, i, FIRST], buckets[j, i, LAST]):
                        item = items[at]
                        disc = item - len(edges)
                        if item < lowest:
                            continue
                        if disc < 0:
                            x0, y0, x1, y1 = edges[item]
                            apart = squared_distance_to_segment(x, y, x0, y0, x1, y1)
                            if apart < square:
                                nearest, which, square = sqrt(apart), int(item), apart
                        else:
                            dx, dy = x - discs[disc, 0], y - discs[disc, 1]
                            away = sqrt(dx * dx + dy * dy) - discs[disc, 2]
                            if away < nearest:
                                nearest, which = away, int(item)
                                square = max(away, 0.0) ** 2
                i += skip if is_whole else 2 * ring
        ring += 1
    return nearest, which


@kernel
def _obstacle_of(shapes: AnyShapes, item: int) -> int:
    """The number of the obstacle that an item belongs to; the occupancy map has the last one."""
    if item < 0:
        return -1
    outlines = shapes.first_edge[-1]
    polygons = len(shapes.first_edge) - 1
    if item < outlines:
        return int(np.searchsorted(shapes.first_edge, item, 'right')) - 1
    if item < len(shapes.edges):
        return len(shapes.boxes)
    return polygons + item - len(shapes.edges)


@kernel
def clearance_within(shapes: AnyShapes, x: float, y: float, reach: float) -> tuple[float, int]:
    """As `clearance_at`, but never more than ``reach`` [m]: beyond it nothing is looked for."""
    bounds = shapes.bounds
    nearest = min(x - bounds[0], bounds[2] - x, y - bounds[1], bounds[3] - y)
    if not nearest >= 0.0:
        return _deepest(shapes, x, y, nearest)
    nearest = min(nearest, reach)
    row, column, _ = bucket_at(shapes.frame, shapes.buckets, x, y)
    cover = shapes.buckets[row, column, COVER]
    if cover != OPEN:
        depth, polygon = (
            _deepest(shapes, x, y, 0.0)
            if cover == COVERED
            else _depth_in_outlines(shapes, row, x, y)
        )
        if polygon >= 0:
            depth, item = nearest_item(shapes, x, y, len(shapes.edges), depth)
            return depth, polygon if item < 0 else _obstacle_of(shapes, item)
    if inside_a_cell(shapes, x, y):
        depth, _ = nearest_item(shapes, x, y, int(shapes.first_edge[-1]), inf)
        return -depth, len(shapes.boxes)
    nearest, item = nearest_item(shapes, x, y, 0, nearest)
    return nearest, _obstacle_of(shapes, item)


@kernel
def clearance_at(shapes: AnyShapes, x: float, y: float) -> tuple[float, int]:
    """Distance [m] from (x, y) to the nearest obstacle or map edge, and which obstacle that is.

    Negative inside an obstacle or outside the bounds; -1 stands for the edge of the map, and the
    number after the last polygon and disc for the occupancy map.
    """
    return clearance_within(shapes, x, y, inf)


@kernel
def clearances(shapes: AnyShapes, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Clearances [m], shape (n,), at ``points`` of shape (n, 2) or wider."""
    result = np.empty(len(points))
    for i in range(len(points)):
        result[i] = clearance_at(shapes, points[i, 0], points[i, 1])[0]
    return result
