"""Lines of sight to whole boxes: what surely hides a point from all places of one."""

from __future__ import annotations

from math import asin, atan2, hypot, inf, pi, sin

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.sight import four, holds, side, three

#: What rounding takes from a bound, as a share of the lengths.
_ROUNDING = 1e-12


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
    ox, oy, middle, low = four(view)
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
            if not holds(shapes, k, ox, oy):
                least = max(least, _hidden_by_polygon(shapes, k, box, near, view))
            continue
        cx, cy, radius = three(shapes.discs[k - polygons])
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
        x0, y0, x1, y1 = four(shapes.edges[i])
        turn = _turn(atan2(y0 - oy, x0 - ox), view[2])
        farthest = max(farthest, hypot(x0 - ox, y0 - oy))
        if turn < first:
            first, at_first = turn, i
        if turn > last:
            last, at_last = turn, i
        here = side(x0, y0, x1, y1, ox, oy)
        slack = _ROUNDING * (abs(x0) + abs(y0) + abs(ox) + abs(oy)) * hypot(x1 - x0, y1 - y0)
        beyond = abs(here) > slack
        for corner in range(4):
            there = side(x0, y0, x1, y1, box[corner % 2], box[2 + corner // 2])
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
