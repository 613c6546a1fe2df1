"""Clearances on a grid, and from it bounds of what is left to drive."""

from __future__ import annotations

from heapq import heappop, heappush
from math import inf, sqrt

import numpy as np

from experiments.motion.aims import Aim, in_goal
from experiments.motion.geometry import Array, Ground, clearance, compiled

#: A bound of the shortest way on a grid with moves to 16 neighbours is this share of its length.
SIXTEEN = 0.9732


@compiled
def field_of(ground: Ground, inside: Array, cell: float, columns: int, rows: int) -> Array:
    """Clearances [m] at the centres of cells, (rows, columns); -1 where ``inside`` is set."""
    field = np.empty((rows, columns))
    for j in range(rows):
        for i in range(columns):
            x = ground.bounds[0] + (i + 0.5) * cell
            y = ground.bounds[1] + (j + 0.5) * cell
            field[j, i] = -1.0 if inside[j, i] else clearance(ground, x, y)
    return field


@compiled
def distances_to_goal(field: Array, corner: Array, cell: float, margin: float, aim: Aim) -> Array:
    """Bounds [m] of the way from each cell to the goal, infinite where none leads there."""
    rows, columns = field.shape
    closed = margin - 0.7072 * cell
    result = np.full((rows, columns), inf)
    heap = [(0.0, 0)]
    heap.pop()
    for j in range(rows):
        for i in range(columns):
            x, y = corner[0] + (i + 0.5) * cell, corner[1] + (j + 0.5) * cell
            if field[j, i] >= closed and in_goal(aim, x, y, 0.7072 * cell):
                result[j, i] = 0.0
                heappush(heap, (0.0, j * columns + i))
    while len(heap) > 0:
        away, at = heappop(heap)
        j, i = at // columns, at % columns
        if away > result[j, i]:
            continue
        for dj in range(-2, 3):
            for di in range(-2, 3):
                if (abs(di) == 2 and abs(dj) != 1) or (abs(dj) == 2 and abs(di) != 1):
                    continue
                a, b = j + dj, i + di
                if a < 0 or b < 0 or a >= rows or b >= columns or field[a, b] < closed:
                    continue
                farther = away + SIXTEEN * cell * sqrt(float(di * di + dj * dj))
                if farther < result[a, b]:
                    result[a, b] = farther
                    heappush(heap, (farther, a * columns + b))
    return result
