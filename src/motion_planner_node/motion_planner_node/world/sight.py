"""Lines of sight: what is between two points, and by how much."""

from __future__ import annotations

from math import hypot, inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.clearance import inside_a_cell, nearest_item
from motion_planner_node.world.index import FIRST, LAST, SKIP, bucket_at, empty_radius
from motion_planner_node.world.shapes import Shapes

#: Nearer than this [m] to its boundary nothing is inside an obstacle.
TOUCH = 1e-9


@kernel
def three(row: NDArray[np.float64]) -> tuple[float, float, float]:
    """The numbers of a row."""
    return row[0], row[1], row[2]


@kernel
def four(row: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """The numbers of a row."""
    return row[0], row[1], row[2], row[3]


@kernel
def contains(shapes: Shapes, polygon: int, x: float, y: float) -> bool:
    """Whether (x, y) is inside a polygon, or perhaps on its boundary."""
    inside = False
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = four(shapes.edges[i])
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
    return inside


@kernel
def side(ax: float, ay: float, bx: float, by: float, x: float, y: float) -> float:
    """Positive where (x, y) is on the left of the way from a to b."""
    return (bx - ax) * (y - ay) - (by - ay) * (x - ax)


@kernel
def _nearest_to_segment(
    x: float, y: float, ax: float, ay: float, bx: float, by: float
) -> tuple[float, float]:
    """Distance from (x, y) to the segment from a to b, and where on it, from 0 to 1."""
    dx, dy = bx - ax, by - ay
    square = dx * dx + dy * dy
    along = 0.0
    if square > 0.0:
        along = min(max(((x - ax) * dx + (y - ay) * dy) / square, 0.0), 1.0)
    return hypot(x - ax - along * dx, y - ay - along * dy), along


@kernel
def holds(shapes: Shapes, polygon: int, x: float, y: float) -> bool:
    """Whether (x, y) is inside a polygon and not on its boundary."""
    if not contains(shapes, polygon, x, y):
        return False
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = four(shapes.edges[i])
        if _nearest_to_segment(x, y, x0, y0, x1, y1)[0] <= TOUCH:
            return False
    return True


@kernel
def free_distance(
    shapes: Shapes,
    first: int,
    last: int,
    sight: NDArray[np.float64],
    slopes: NDArray[np.float64],
) -> float:
    """Distance [m] of a line of sight px, py, ox, oy from the edges from ``first`` on; 0 across one.

    ``slopes`` receives its derivatives by the four coordinates.
    """
    px, py, ox, oy = four(sight)
    least = inf
    for i in range(first, last):
        x0, y0, x1, y1 = four(shapes.edges[i])
        between = side(px, py, ox, oy, x0, y0) * side(px, py, ox, oy, x1, y1) < 0.0
        if between and side(x0, y0, x1, y1, px, py) * side(x0, y0, x1, y1, ox, oy) < 0.0:
            return 0.0
        for end in range(4):
            if end == 0 or end == 3:
                to_x, to_y = (x0, y0) if end == 0 else (x1, y1)
                distance, share = _nearest_to_segment(to_x, to_y, px, py, ox, oy)
            else:
                share = end - 1.0
                x, y = (px, py) if end == 1 else (ox, oy)
                distance, along = _nearest_to_segment(x, y, x0, y0, x1, y1)
                to_x, to_y = x0 + along * (x1 - x0), y0 + along * (y1 - y0)
            if distance < least:
                least = distance
                if distance > 0.0:
                    east = (px + share * (ox - px) - to_x) / distance
                    north = (py + share * (oy - py) - to_y) / distance
                    slopes[0], slopes[1] = (1.0 - share) * east, (1.0 - share) * north
                    slopes[2], slopes[3] = share * east, share * north
    return least


@kernel
def way_round(
    shapes: Shapes,
    first: int,
    last: int,
    sight: NDArray[np.float64],
    slopes: NDArray[np.float64],
) -> float:
    """How far [m] the line through a line of sight has to move sideways to pass these edges."""
    px, py, ox, oy = four(sight)
    length = hypot(px - ox, py - oy)
    slopes[:] = 0.0
    if length == 0.0:
        return 0.0
    east, north = (px - ox) / length, (py - oy) / length
    left, right = -inf, -inf
    left_x, left_y, right_x, right_y = 0.0, 0.0, 0.0, 0.0
    for i in range(first, last):
        for end in range(0, 4, 2):
            cx, cy = shapes.edges[i, end] - ox, shapes.edges[i, end + 1] - oy
            aside = east * cy - north * cx
            if aside > left:
                left, left_x, left_y = aside, cx, cy
            if -aside > right:
                right, right_x, right_y = -aside, cx, cy
    sign = 1.0 if left <= right else -1.0
    cx, cy = (left_x, left_y) if left <= right else (right_x, right_y)
    aside = east * cy - north * cx
    slopes[0] = sign * (cy - aside * east) / length
    slopes[1] = sign * (-cx - aside * north) / length
    slopes[2] = sign * north - slopes[0]
    slopes[3] = -sign * east - slopes[1]
    return float(max(sign * aside, 0.0))


@kernel
def _obstruction(
    shapes: Shapes, sight: NDArray[np.float64], farthest: float, result: NDArray[np.float64]
) -> None:
    """Fill ``result`` (5,) with the obstruction of ``sight`` (4,) and its derivatives."""
    px, py, ox, oy = four(sight)
    slopes = np.zeros(4)
    result[:] = 0.0
    result[0] = -farthest
    polygons = len(shapes.first_edge) - 1
    for k in range(len(shapes.boxes)):
        box = shapes.boxes[k]
        beside_x = max(box[0] - max(px, ox), min(px, ox) - box[2], 0.0)
        beside_y = max(box[1] - max(py, oy), min(py, oy) - box[3], 0.0)
        beside = hypot(beside_x, beside_y)
        if beside > 0.0 and -beside <= result[0]:
            continue
        if k >= polygons:
            cx, cy, radius = three(shapes.discs[k - polygons])
            if hypot(cx - ox, cy - oy) < radius - TOUCH:
                continue
            distance, share = _nearest_to_segment(cx, cy, px, py, ox, oy)
            value = radius - distance
            east, north = 1.0, 0.0
            if distance > 0.0:
                east = (px + share * (ox - px) - cx) / distance
                north = (py + share * (oy - py) - cy) / distance
            slopes[0], slopes[1] = -(1.0 - share) * east, -(1.0 - share) * north
            slopes[2], slopes[3] = -share * east, -share * north
        else:
            if holds(shapes, k, ox, oy):
                continue
            first, last = shapes.first_edge[k], shapes.first_edge[k + 1]
            value = -free_distance(shapes, first, last, sight, slopes)
            slopes *= -1.0
            if value == 0.0 or contains(shapes, k, px, py):
                value = way_round(shapes, first, last, sight, slopes)
        if value > result[0]:
            result[0], result[1:] = value, slopes


@kernel
def _past_edges(
    shapes: Shapes, sight: NDArray[np.float64], but: int, result: NDArray[np.float64]
) -> tuple[int, float]:
    """Raise ``result`` (5,) by the edges of the occupancy map, of which one does not count.

    Returns the crossed edge nearest to (ox, oy), -1 without any, and how far [m] away that is.
    """
    px, py, ox, oy = four(sight)
    length = hypot(ox - px, oy - py)
    frame, buckets, items = shapes.frame, shapes.buckets, shapes.items
    lowest, slopes = shapes.first_edge[-1], np.zeros(4)
    reach = max(-result[0], 0.0)
    close, item = nearest_item(shapes, px, py, lowest, reach)
    reach = reach if item == but else close
    nearest, crossed, done = inf, -1, 0.0
    while True:
        share = done / length if length > 0.0 else 0.0
        x, y = px + share * (ox - px), py + share * (oy - py)
        stride = empty_radius(frame, buckets, x, y) - reach
        if stride < 0.5 * frame[2]:
            stride = min(reach + 2.0 * frame[2], length - done)
            share = (done + stride) / length if length > 0.0 else 0.0
            end_x, end_y = px + share * (ox - px), py + share * (oy - py)
            row, left, _ = bucket_at(frame, buckets, min(x, end_x) - reach, min(y, end_y) - reach)
            last, right, _ = bucket_at(frame, buckets, max(x, end_x) + reach, max(y, end_y) + reach)
            for j in range(row, last + 1):
                i = left
                while i <= right:
                    for at in range(buckets[j, i, FIRST], buckets[j, i, LAST]):
                        edge = int(items[at])
                        if not lowest <= edge < len(shapes.edges) or edge == but:
                            continue
                        value = -free_distance(shapes, edge, edge + 1, sight, slopes)
                        slopes *= -1.0
                        if value == 0.0:
                            x0, y0, x1, y1 = four(shapes.edges[edge])
                            here = side(px, py, ox, oy, x0, y0)
                            along = here / (here - side(px, py, ox, oy, x1, y1))
                            away = hypot(x0 + along * (x1 - x0) - ox, y0 + along * (y1 - y0) - oy)
                            if away < nearest:
                                nearest, crossed = away, edge
                            value = way_round(shapes, edge, edge + 1, sight, slopes)
                        if value > result[0]:
                            result[0], result[1:] = value, slopes
                            reach = min(reach, max(-value, 0.0))
                    i += max(int(buckets[j, i, SKIP]), 1)
        done += stride
        if not done < length:
            return crossed, nearest


@kernel
def _obstruction_by_map(
    shapes: Shapes, sight: NDArray[np.float64], result: NDArray[np.float64]
) -> None:
    """Raise ``result`` (5,) by what the occupancy map hides.

    A point in an occupied cell is seen when the line enters occupied cells only to get there.
    """
    entered = -1
    if inside_a_cell(shapes, sight[2], sight[3]):
        entered, _ = _past_edges(shapes, sight, -1, result.copy())
    _past_edges(shapes, sight, entered, result)


@kernel
def obstructions(
    shapes: Shapes, sights: NDArray[np.float64], farthest: float
) -> NDArray[np.float64]:
    """Obstructions [m] and their derivatives by px, py, ox, oy for ``sights`` (n, 4): (n, 5).

    Minus the distance of the line of sight from the nearest obstacle, at least ``-farthest``; where
    it is blocked, how far it has to move sideways to get past the obstacle. An obstacle that holds
    the point (ox, oy) does not hide it.
    """
    result = np.empty((len(sights), 5))
    for i in range(len(sights)):
        if np.isfinite(sights[i]).all():
            _obstruction(shapes, sights[i], farthest, result[i])
            if len(shapes.occupied):
                _obstruction_by_map(shapes, sights[i], result[i])
        else:
            result[i] = 0.0
            result[i, 0] = np.nan
    return result
