"""The free space of a disc as a grid of cells: a sound over-approximation, and travel in it.

A cell is closed only when no point of it has the clearance that the disc needs.  So two points in
different components are proven not to be connected; points in one component need not be.
"""

from __future__ import annotations

from math import hypot, inf, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.clearance import clearance_within
from motion_planner_node.world.shapes import Shapes

#: How often a doubtful cell is quartered before it is called open.
DEEPEST = 6
#: Of the queue of a front, which is about a cell wide.
BUCKETS, BUCKETS_PER_CELL = 64, 8


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
def close_cells(
    shapes: Shapes,
    margin: float,
    cell: float,
    window: tuple[int, int, int, int],
    cells: NDArray[np.bool_],
) -> None:
    """Close those of the square ``cells`` [m] from the map's corner that cannot be free.

    Only those in the ``window`` are looked at: the first row and the one after the last, and columns.
    """
    half = 0.5 * cell
    for row in range(window[0], window[1]):
        for column in range(window[2], window[3]):
            x = shapes.bounds[0] + (column + 0.5) * cell
            y = shapes.bounds[1] + (row + 0.5) * cell
            cells[row, column] &= _is_open(shapes, margin, x, y, half)


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
    framed: NDArray[np.bool_], cell: float, x: float, y: float
) -> NDArray[np.float64]:
    """Shortest distances [m] inside open cells from (x, y), relative to the grid's corner.

    ``framed`` (rows + 2, columns + 2) are the cells and a frame of closed ones, and so is the
    result.  Infinite where the cells do not lead; nothing else than an estimate anywhere.

    J. A. Sethian, "A fast marching level set method for monotonically advancing fronts", PNAS 93
    (1996), with the queue of L. Yatziv, A. Bartesaghi and G. Sapiro, "O(N) implementation of the
    fast marching algorithm", J. Comp. Phys. 212 (2006): what is next to another in a bucket may
    come first.
    """
    rows, width = framed.shape
    times, waits = np.full(rows * width, inf), framed.copy().reshape(rows * width)
    # Each bucket is a list of entries, each of them a cell and the entry after it.
    heads = np.full(BUCKETS, -1, np.int64)
    cells, after = np.empty(4 * len(times), np.int32), np.empty(4 * len(times), np.int32)
    count, left, per_metre = 0, 0, BUCKETS_PER_CELL / cell
    j0 = min(max(int(y / cell), 0), rows - 3)
    i0 = min(max(int(x / cell), 0), width - 3)
    for j in range(max(j0, 1), min(j0 + 3, rows - 1)):
        for i in range(max(i0, 1), min(i0 + 3, width - 1)):
            k = j * width + i
            if waits[k]:
                times[k] = hypot((i - 0.5) * cell - x, (j - 0.5) * cell - y)
                bucket = int(times[k] * per_metre) % BUCKETS
                cells[count], after[count], heads[bucket] = k, heads[bucket], count
                count, left = count + 1, left + 1
    bucket = 0
    while left:
        entry = heads[bucket]
        if entry < 0:
            bucket = (bucket + 1) % BUCKETS
            continue
        heads[bucket] = after[entry]
        left -= 1
        k = cells[entry]
        if not waits[k]:
            continue
        waits[k] = False
        for neighbour in (k - 1, k + 1, k - width, k + width):
            if waits[neighbour]:
                arrival = _arrival(times, neighbour, width, cell)
                if arrival < times[neighbour]:
                    times[neighbour] = arrival
                    to = int(arrival * per_metre) % BUCKETS
                    cells[count], after[count], heads[to] = neighbour, heads[to], count
                    count, left = count + 1, left + 1
    return times.reshape((rows, width))


@kernel
def travel_at(
    distances: NDArray[np.float64], left: float, low: float, cell: float, x: float, y: float
) -> float:
    """The estimate [m] at (x, y) between the middles of cells; infinite where no way leads.

    ``distances`` are as `travel_distances` has them, the corner of their grid is (left, low).
    """
    rows, columns = distances.shape
    across = min(max((x - left) / cell + 0.5, 0.5), columns - 1.5)
    up = min(max((y - low) / cell + 0.5, 0.5), rows - 1.5)
    i, j = int(across), int(up)
    total, weights = 0.0, 0.0
    for b in range(2):
        for a in range(2):
            distance = distances[j + b, i + a]
            if distance < inf:
                weight = abs(1 - b - (up - j)) * abs(1 - a - (across - i)) + 1e-12
                total += weight * distance
                weights += weight
    return float(total / weights) if weights > 0.0 else inf


@kernel
def travel_at_each(
    distances: NDArray[np.float64],
    left: float,
    low: float,
    cell: float,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
) -> NDArray[np.float64]:
    """`travel_at` points with coordinates of shape (n,)."""
    result = np.empty(len(x))
    for index in range(len(x)):
        result[index] = travel_at(distances, left, low, cell, x[index], y[index])
    return result


@kernel
def labels_at(
    labels: NDArray[np.int32],
    left: float,
    low: float,
    cell: float,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
) -> NDArray[np.int32]:
    """The ``labels`` of the cells at points, shape (n,); -1 outside of the grid."""
    rows, columns = labels.shape
    result = np.full(len(x), -1, np.int32)
    for index in range(len(x)):
        across, up = (x[index] - left) / cell, (y[index] - low) / cell
        if 0.0 <= across <= columns and 0.0 <= up <= rows:
            result[index] = labels[min(int(up), rows - 1), min(int(across), columns - 1)]
    return result
