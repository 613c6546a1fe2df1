"""Lines of sight: what is between two points, by how much, and where it hides a whole box."""

from __future__ import annotations

from math import asin, atan2, hypot, inf, pi, sin

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes

#: Nearer than this [m] to its boundary nothing is inside an obstacle.
TOUCH = 1e-9

#: What rounding takes from a bound, as a share of the lengths.
_ROUNDING = 1e-12


@kernel
def _three(row: NDArray[np.float64]) -> tuple[float, float, float]:
    return row[0], row[1], row[2]


@kernel
def _four(row: NDArray[np.float64]) -> tuple[float, float, float, float]:
    return row[0], row[1], row[2], row[3]


@kernel
def _contains(shapes: Shapes, polygon: int, x: float, y: float) -> bool:
    inside = False
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = _four(shapes.edges[i])
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
    return inside


@kernel
def _side(ax: float, ay: float, bx: float, by: float, x: float, y: float) -> float:
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
def _holds(shapes: Shapes, polygon: int, x: float, y: float) -> bool:
    """Whether (x, y) is inside a polygon and not on its boundary."""
    if not _contains(shapes, polygon, x, y):
        return False
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = _four(shapes.edges[i])
        if _nearest_to_segment(x, y, x0, y0, x1, y1)[0] <= TOUCH:
            return False
    return True


@kernel
def _free_distance(
    shapes: Shapes, polygon: int, sight: NDArray[np.float64], slopes: NDArray[np.float64]
) -> float:
    """Distance [m] of a line of sight px, py, ox, oy from a polygon's boundary; 0 across it.

    ``slopes`` receives its derivatives by the four coordinates.
    """
    px, py, ox, oy = _four(sight)
    least = inf
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = _four(shapes.edges[i])
        between = _side(px, py, ox, oy, x0, y0) * _side(px, py, ox, oy, x1, y1) < 0.0
        if between and _side(x0, y0, x1, y1, px, py) * _side(x0, y0, x1, y1, ox, oy) < 0.0:
            return 0.0
        for end in range(3):
            if end == 0:
                distance, share = _nearest_to_segment(x0, y0, px, py, ox, oy)
                to_x, to_y = x0, y0
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
def _way_round(
    shapes: Shapes, polygon: int, sight: NDArray[np.float64], slopes: NDArray[np.float64]
) -> float:
    """How far [m] the line through a line of sight has to move sideways to pass a polygon."""
    px, py, ox, oy = _four(sight)
    length = hypot(px - ox, py - oy)
    slopes[:] = 0.0
    if length == 0.0:
        return 0.0
    east, north = (px - ox) / length, (py - oy) / length
    left, right, at_left, at_right = -inf, -inf, 0, 0
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        aside = east * (shapes.edges[i, 1] - oy) - north * (shapes.edges[i, 0] - ox)
        if aside > left:
            left, at_left = aside, i
        if -aside > right:
            right, at_right = -aside, i
    sign = 1.0 if left <= right else -1.0
    corner = at_left if left <= right else at_right
    cx, cy = shapes.edges[corner, 0] - ox, shapes.edges[corner, 1] - oy
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
    px, py, ox, oy = _four(sight)
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
            cx, cy, radius = _three(shapes.discs[k - polygons])
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
            if _holds(shapes, k, ox, oy):
                continue
            value = -_free_distance(shapes, k, sight, slopes)
            slopes *= -1.0
            if value == 0.0 or _contains(shapes, k, px, py):
                value = _way_round(shapes, k, sight, slopes)
        if value > result[0]:
            result[0], result[1:] = value, slopes


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
        else:
            result[i] = 0.0
            result[i, 0] = np.nan
    return result


@kernel
def _turn(angle: float, middle: float) -> float:
    """``angle`` minus ``middle`` in [-pi, pi]."""
    turn = angle - middle
    if turn > pi:
        return turn - 2.0 * pi
    return turn + 2.0 * pi if turn < -pi else turn


@kernel
def _hidden_by(ax: float, ay: float, bx: float, by: float, view: NDArray[np.float64]) -> float:
    """How far [m] each line of sight in ``view`` is from passing both a and b, at least.

    ``view`` is ox, oy, the direction of the middle [rad], and the least and the greatest turn
    from it. Not positive where the view is not all between a and b.
    """
    ox, oy, middle, low = _four(view)
    high = view[4]
    first, second = _turn(atan2(ay - oy, ax - ox), middle), _turn(atan2(by - oy, bx - ox), middle)
    first_length, second_length = hypot(ax - ox, ay - oy), hypot(bx - ox, by - oy)
    if first > second:
        first, second = second, first
        first_length, second_length = second_length, first_length
    if first >= low or second <= high or second - first >= pi:
        return -inf
    right = first_length * min(sin(low - first), sin(high - first))
    left = second_length * min(sin(second - low), sin(second - high))
    return min(left, right) - _ROUNDING * (first_length + second_length + abs(ox) + abs(oy))


@kernel
def _least_obstruction(shapes: Shapes, box: NDArray[np.float64]) -> float:
    """A bound below which the obstruction between a point and a box of points cannot be."""
    ox, oy = box[4], box[6]
    if not np.isfinite(box).all() or box[4] != box[5] or box[6] != box[7]:
        return -inf
    near = hypot(max(box[0] - ox, ox - box[1], 0.0), max(box[2] - oy, oy - box[3], 0.0))
    if near == 0.0:
        return -inf
    middle = atan2(0.5 * (box[2] + box[3]) - oy, 0.5 * (box[0] + box[1]) - ox)
    view = np.array([ox, oy, middle, inf, -inf])
    for corner in range(4):
        turn = _turn(atan2(box[2 + corner // 2] - oy, box[corner % 2] - ox), middle)
        view[3], view[4] = min(view[3], turn), max(view[4], turn)
    least = -inf
    polygons = len(shapes.first_edge) - 1
    for k in range(len(shapes.boxes)):
        if k < polygons:
            if not _holds(shapes, k, ox, oy):
                least = max(least, _hidden_by_polygon(shapes, k, box, near, view))
            continue
        cx, cy, radius = _three(shapes.discs[k - polygons])
        away = hypot(cx - ox, cy - oy)
        if away > radius and near > away + radius:
            turn = _turn(atan2(cy - oy, cx - ox), middle)
            if max(abs(turn - view[3]), abs(turn - view[4])) < asin(radius / away):
                aside = max(abs(sin(turn - view[3])), abs(sin(turn - view[4])))
                slack = _ROUNDING * (away + abs(ox) + abs(oy))
                least = max(least, radius - away * aside - slack)
    return least


@kernel
def _hidden_by_polygon(
    shapes: Shapes, polygon: int, box: NDArray[np.float64], near: float, view: NDArray[np.float64]
) -> float:
    """The same for one polygon: an edge of it hides the box, or its whole outline does."""
    ox, oy = view[0], view[1]
    least, farthest = -inf, 0.0
    first, last, at_first, at_last = inf, -inf, 0, 0
    for i in range(shapes.first_edge[polygon], shapes.first_edge[polygon + 1]):
        x0, y0, x1, y1 = _four(shapes.edges[i])
        turn = _turn(atan2(y0 - oy, x0 - ox), view[2])
        farthest = max(farthest, hypot(x0 - ox, y0 - oy))
        if turn < first:
            first, at_first = turn, i
        if turn > last:
            last, at_last = turn, i
        here = _side(x0, y0, x1, y1, ox, oy)
        slack = _ROUNDING * (abs(x0) + abs(y0) + abs(ox) + abs(oy)) * hypot(x1 - x0, y1 - y0)
        beyond = abs(here) > slack
        for corner in range(4):
            there = _side(x0, y0, x1, y1, box[corner % 2], box[2 + corner // 2])
            beyond = beyond and (there < -slack if here > 0.0 else there > slack)
        if beyond:
            least = max(least, _hidden_by(x0, y0, x1, y1, view))
    if near > farthest and -0.5 * pi < first and last < 0.5 * pi:
        ax, ay = shapes.edges[at_first, 0], shapes.edges[at_first, 1]
        bx, by = shapes.edges[at_last, 0], shapes.edges[at_last, 1]
        least = max(least, _hidden_by(ax, ay, bx, by, view))
    return least


@kernel
def least_obstructions(shapes: Shapes, boxes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Bounds [m] (n,) below the obstructions between boxes of points and one point each.

    ``boxes`` (n, 8) are the least and greatest px, py, ox, oy. Minus infinity where nothing is
    proven: where more than one obstacle is needed, or the second point is not one point.
    """
    result = np.empty(len(boxes))
    for i in range(len(boxes)):
        result[i] = _least_obstruction(shapes, boxes[i])
    return result
