"""The free space of a disc as a grid of cells: a sound over-approximation, and travel in it.

A cell is closed only when no point of it has the clearance that the disc needs.  So two points in
different components are proven not to be connected; points in one component need not be.
"""

from __future__ import annotations

from heapq import heappop, heappush
from math import hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.clearance import clearance_within
from motion_planner_node.world.shapes import Shapes

#: How often a doubtful cell is quartered before it is called open.
DEEPEST = 6


@kernel
def _is_open(shapes: Shapes, margin: float, x: float, y: float, half: float) -> bool:
    """Whether the square of half side ``half`` [m] round (x, y) may have a point of this clearance.

    Clearance changes by at most a metre per metre, so one in the middle bounds the whole square.
    """
    stack = [(x, y, half, 0)]
    while stack:
        x, y, half, depth = stack.pop()
        clearance = clearance_within(shapes, x, y, margin)[0]
        if clearance >= margin:
            return True
        if clearance + half * sqrt(2.0) < margin:
            continue
        if depth >= DEEPEST:
            return True
        half *= 0.5
        stack.append((x - half, y - half, half, depth + 1))
        stack.append((x - half, y + half, half, depth + 1))
        stack.append((x + half, y - half, half, depth + 1))
        stack.append((x + half, y + half, half, depth + 1))
    return False


@kernel
def open_cells(
    shapes: Shapes, margin: float, cell: float, columns: int, rows: int
) -> NDArray[np.bool_]:
    """Which of the ``rows`` x ``columns`` square cells [m] from the map's corner may be free."""
    result = np.empty((rows, columns), np.bool_)
    half = 0.5 * cell
    for row in range(rows):
        for column in range(columns):
            x = shapes.bounds[0] + (column + 0.5) * cell
            y = shapes.bounds[1] + (row + 0.5) * cell
            result[row, column] = _is_open(shapes, margin, x, y, half)
    return result


@kernel
def components(cells: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Numbers from 0 of the eight-connected components of the open ``cells``; -1 where closed."""
    rows, columns = cells.shape
    labels = np.full((rows, columns), -1, np.int32)
    label = 0
    for row in range(rows):
        for column in range(columns):
            if not cells[row, column] or labels[row, column] >= 0:
                continue
            labels[row, column] = label
            stack = [(row, column)]
            while stack:
                j, i = stack.pop()
                for b in range(max(j - 1, 0), min(j + 2, rows)):
                    for a in range(max(i - 1, 0), min(i + 2, columns)):
                        if cells[b, a] and labels[b, a] < 0:
                            labels[b, a] = label
                            stack.append((b, a))
            label += 1
    return labels


@kernel
def _arrival(times: NDArray[np.float64], k: int, width: int, cell: float) -> float:
    """Distance at cell k whose neighbours have ``times``: upwind solution of |grad| = 1."""
    a, b = min(times[k - 1], times[k + 1]), min(times[k - width], times[k + width])
    if abs(a - b) >= cell:
        return float(min(a, b) + cell)
    return float(0.5 * (a + b + sqrt(2.0 * cell * cell - (a - b) * (a - b))))


@kernel
def travel_distances(
    cells: NDArray[np.bool_], cell: float, x: float, y: float
) -> NDArray[np.float64]:
    """Shortest distances [m] inside the open ``cells`` from (x, y), relative to the grid's corner.

    J. A. Sethian, "A fast marching level set method for monotonically advancing fronts", PNAS 93
    (1996).  Infinite where the cells do not lead; nothing else than an estimate anywhere.
    """
    rows, columns = cells.shape
    # Row by row with a frame of closed cells, so that every cell has four neighbours.
    width = columns + 2
    times = np.full((rows + 2) * width, inf)
    waits = np.zeros((rows + 2) * width, np.bool_)
    for row in range(rows):
        for column in range(columns):
            waits[(row + 1) * width + column + 1] = cells[row, column]
    heap = [(0.0, 0)]
    heap.pop()
    j0 = min(max(int(y / cell), 0), rows - 1)
    i0 = min(max(int(x / cell), 0), columns - 1)
    for j in range(max(j0 - 1, 0), min(j0 + 2, rows)):
        for i in range(max(i0 - 1, 0), min(i0 + 2, columns)):
            if cells[j, i]:
                k = (j + 1) * width + i + 1
                times[k] = hypot((i + 0.5) * cell - x, (j + 0.5) * cell - y)
                heappush(heap, (times[k], k))
    while heap:
        _, k = heappop(heap)
        if not waits[k]:
            continue
        waits[k] = False
        for neighbour in (k - 1, k + 1, k - width, k + width):
            if waits[neighbour]:
                arrival = _arrival(times, neighbour, width, cell)
                if arrival < times[neighbour]:
                    times[neighbour] = arrival
                    heappush(heap, (arrival, neighbour))
    return times.reshape((rows + 2, width))[1:-1, 1:-1].copy()
