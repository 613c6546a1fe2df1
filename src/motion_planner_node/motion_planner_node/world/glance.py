"""A quick look at a motion: surely free, surely blocked, or to be looked at closely.

The clearance in the middle of a square cell bounds that of all the cell, as clearance changes by at
most a metre per metre.  So a few strides, each as long as the clearance allows, tell of most
motions whether they are free.

J. C. Hart, "Sphere tracing: a geometric method for the antialiased ray tracing of implicit
surfaces", The Visual Computer 12 (1996).
"""

from __future__ import annotations

from math import cos, isnan, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.body import Body, necessary_clearance, sufficient_clearance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

#: What a motion is at a glance.
BLOCKED, FREE, DOUBTFUL = range(3)
#: Strides of less than this share of a cell are not worth while: there the motion is in doubt.
SHORTEST = 0.25
#: Where it is in doubt it is looked at in steps of this share of a cell, for what surely blocks it.
STEP = 0.5


@kernel
def clearance_bounds(
    shapes: Shapes, middles: NDArray[np.float64], x: float, y: float
) -> tuple[float, float]:
    """What the clearance [m] at (x, y) is at least and at most; ``middles`` are those of ``shapes``.

    What is not known yet of the cell is worked out and kept: the same whoever asks first.
    """
    rows, columns = middles.shape
    side = shapes.side[0]
    across, up = (x - shapes.bounds[0]) / side, (y - shapes.bounds[1]) / side
    column, row = min(max(int(across), 0), columns - 1), min(max(int(up), 0), rows - 1)
    middle = middles[row, column]
    across, up = across - (column + 0.5), up - (row + 0.5)
    if isnan(middle):
        middle = clearance_at(shapes, x - across * side, y - up * side)[0]
        middles[row, column] = middle
    away = side * sqrt(across * across + up * up)
    return middle - away, middle + away


@kernel
def _stride(
    shapes: Shapes, middles: NDArray[np.float64], body: Body, x: float, y: float
) -> tuple[int, float]:
    """What standing at (x, y) is for ``body``, however it is turned, and how far [m] to go on."""
    low, high = clearance_bounds(shapes, middles, x, y)
    if high < necessary_clearance(body):
        return BLOCKED, 0.0
    stride = low - sufficient_clearance(body)
    side = shapes.side[0]
    return (FREE, stride) if stride >= SHORTEST * side else (DOUBTFUL, STEP * side)


@kernel
def glance(shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]) -> int:
    """What driving ``pieces`` (n, 4) from ``start`` is for ``body``: BLOCKED, FREE or DOUBTFUL."""
    middles = shapes.middles
    x, y, heading = start
    cosine, sine = cos(heading), sin(heading)
    verdict, stride = _stride(shapes, middles, body, x, y)
    for i in range(len(pieces)):
        bend, length, direction, turn = pieces[i]
        if length != 0.0:
            forward_x, forward_y = cosine, sine
            if direction != 0.0:
                forward_x, forward_y = cos(heading + direction), sin(heading + direction)
            way = abs(length)
            sense = 1.0 if length > 0.0 else -1.0
            begin_x, begin_y, begin_heading, done = x, y, heading, 0.0
            while done < way:
                if stride <= 0.0:
                    here, stride = _stride(shapes, middles, body, x, y)
                    if here == BLOCKED:
                        return BLOCKED
                    verdict = verdict if here == FREE else DOUBTFUL
                step = min(stride, way - done)
                stride -= step
                done = done + step if step < way - done else way
                if bend == 0.0:
                    x = begin_x + sense * done * forward_x
                    y = begin_y + sense * done * forward_y
                else:
                    heading = begin_heading + sense * bend * done
                    cosine, sine = cos(heading), sin(heading)
                    x = begin_x + (sine - forward_y) / bend
                    y = begin_y - (cosine - forward_x) / bend
        if turn != 0.0:
            heading += turn
            cosine, sine = cos(heading), sin(heading)
    if verdict == DOUBTFUL and _stride(shapes, middles, body, x, y)[0] == BLOCKED:
        return BLOCKED
    return verdict
