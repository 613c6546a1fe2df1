"""A quick look at a motion, for what surely blocks it.

The clearance in the middle of a square cell bounds that of all the cell, as clearance changes by at
most a metre per metre.  So a few places along a motion tell of nine in ten blocked ones that they
are, in less time than it takes to follow them to where they are blocked.
"""

from __future__ import annotations

from math import cos, isnan, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import Body, necessary_clearance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

#: Places along a motion that are looked at.
PLACES = 7


@kernel
def most_clearance(shapes: Shapes, middles: NDArray[np.float64], x: float, y: float) -> float:
    """What the clearance [m] at (x, y) is at most; ``middles`` are those of ``shapes``.

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
    return float(middle + side * sqrt(across * across + up * up))


@kernel
def is_blocked_at_a_glance(
    shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]
) -> bool:
    """Whether ``body`` surely cannot drive ``pieces`` (n, 4) from ``start``; False tells nothing."""
    middles, enough = shapes.middles, necessary_clearance(body)
    total = 0.0
    for i in range(len(pieces)):
        total += abs(pieces[i, 1])
    spacing = total / (PLACES + 1)
    x, y, heading = start
    due = spacing
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
                if most_clearance(shapes, middles, here_x, here_y) < enough:
                    return True
                due += spacing
            due -= way
        if i + 1 < len(pieces):
            x, y, heading = advance(x, y, heading, bend, length, direction, turn)
    return False
