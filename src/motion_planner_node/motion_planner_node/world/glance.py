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
from motion_planner_node.robots.kernel import kernel, part
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

#: What a look at a motion tells.
UNKNOWN, BLOCKED, FREE = range(3)
#: Places along a motion of several pieces, or one, that are looked at.
PLACES, ON_A_PIECE = 7, 1
#: Clearance [m] beyond the sufficient one, far more than what is lost by rounding.
SLACK = 1e-9


#: What tells the cells: x and y [m] of the first one's corner, and their side [m].
_Cells = tuple[float, float, float]


@kernel
def _cells_of(shapes: Shapes) -> _Cells:
    bounds = shapes.bounds
    return bounds[0], bounds[1], shapes.side[0]


@part
def _cell_at(
    middles: NDArray[np.float64], cells: _Cells, x: float, y: float
) -> tuple[int, int, float]:
    """Row and column of the cell of (x, y), and how far [m] its middle is."""
    left, bottom, side = cells
    across, up = (x - left) / side, (y - bottom) / side
    column = min(max(int(across), 0), middles.shape[1] - 1)
    row = min(max(int(up), 0), middles.shape[0] - 1)
    across, up = across - (column + 0.5), up - (row + 0.5)
    return row, column, side * sqrt(across * across + up * up)


@kernel
def _worked_out(shapes: Shapes, row: int, column: int) -> float:
    """The clearance [m] in the middle of a cell, which is kept."""
    left, bottom, side = _cells_of(shapes)
    middle = clearance_at(shapes, left + (column + 0.5) * side, bottom + (row + 0.5) * side)[0]
    shapes.middles[row, column] = middle
    return middle


@kernel
def clearance_bounds(shapes: Shapes, x: float, y: float) -> tuple[float, float]:
    """What the clearance [m] at (x, y) is at least and at most.

    What is not known yet of the cell is worked out and kept: the same whoever asks first.
    """
    row, column, away = _cell_at(shapes.middles, _cells_of(shapes), x, y)
    middle = shapes.middles[row, column]
    if isnan(middle):
        middle = _worked_out(shapes, row, column)
    return middle - away, middle + away


@kernel
def glance(shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]) -> int:
    """Whether ``body`` can surely drive ``pieces`` (n, 4) from ``start``, or surely cannot."""
    total = 0.0
    for i in range(len(pieces)):
        total += abs(pieces[i, 1])
    spacing = total / (PLACES if len(pieces) > 1 else ON_A_PIECE)
    # Of what is looked up at each place no reference is counted there.
    middles, cells = shapes.middles, _cells_of(shapes)
    necessary = necessary_clearance(body)
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
                row, column, away = _cell_at(middles, cells, here_x, here_y)
                middle = middles[row, column]
                if isnan(middle):
                    middle = _worked_out(shapes, row, column)
                if middle + away < necessary:
                    return BLOCKED
                if not middle - away >= sufficient:
                    seen = UNKNOWN
                due += spacing
            due -= way
        if i + 1 < len(pieces):
            x, y, heading = advance(x, y, heading, bend, length, direction, turn)
    return seen
