"""A quick look at a motion, for what surely blocks it or surely leaves it free.

The clearance in the middle of a square cell bounds that of all the cell, as clearance changes by at
most a metre per metre.  So a few places along a motion tell of nine in ten blocked ones that they
are, and of free ones away from obstacles too, in less time than it takes to follow them.
"""

from __future__ import annotations

from math import cos, isnan, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import Body, necessary_clearance, sufficient_clearance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

#: What a look at a motion tells.
UNKNOWN, BLOCKED, FREE = range(3)
#: Places along a motion of several pieces, or one, that are looked at.
PLACES, ON_A_PIECE = 7, 1
#: Clearance [m] beyond the sufficient one, far more than what is lost by rounding.
SLACK = 1e-9


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
def glance(shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]) -> int:
    """Whether ``body`` can surely drive ``pieces`` (n, 4) from ``start``, or surely cannot."""
    total = 0.0
    for i in range(len(pieces)):
        total += abs(pieces[i, 1])
    spacing = total / (PLACES if len(pieces) > 1 else ON_A_PIECE)
    middles, necessary = shapes.middles, necessary_clearance(body)
    # All of the motion is as near as that to one of the places.
    sufficient = sufficient_clearance(body) + 0.5 * spacing + SLACK
    seen = FREE if total > 0.0 else UNKNOWN
    x, y, heading = start
    due = 0.5 * spacing
    for i in range(len(pieces)):
        bend, length, direction, turn = pieces[i]
        way = abs(length)
        if way > 0.0:
            sense = 1.0 if length > 0.0 else -1.0
            course = heading + direction
            cosine, sine = cos(course), sin(course)
            while due <= way:
                if bend == 0.0:
                    here_x, here_y = x + sense * due * cosine, y + sense * due * sine
                else:
                    turned = course + sense * bend * due
                    here_x = x + (sin(turned) - sine) / bend
                    here_y = y - (cos(turned) - cosine) / bend
                least, most = clearance_bounds(shapes, middles, here_x, here_y)
                if most < necessary:
                    return BLOCKED
                if not least >= sufficient:
                    seen = UNKNOWN
                due += spacing
            due -= way
        if i + 1 < len(pieces):
            x, y, heading = advance(x, y, heading, bend, length, direction, turn)
    return seen
