"""Make a path of Dubins words shorter, without ever leaving the free space.

A path is a list of attitudes (n, 3), each joined to the next by its shortest free word.
"""

from __future__ import annotations

from math import inf, pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import free_word
from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.dubins import TURNS, dubins_word
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes

Rows = NDArray[np.float64]

#: What an edge costs [m] beside its length, so that of equal paths the one of fewer edges is taken.
EDGE_COST = 1e-6


@kernel
def edge_lengths(shapes: Shapes, margin: float, radius: float, path: Rows) -> Rows:
    """Lengths [m], shape (n - 1,), of the edges of ``path`` (n, 3), infinite where none is free."""
    lengths = np.empty(len(path) - 1)
    for i in range(len(lengths)):
        lengths[i] = free_word(shapes, margin, radius, path[i], path[i + 1], inf)[0]
    return lengths


@kernel
def densified(
    shapes: Shapes, margin: float, radius: float, path: Rows, spacing: float, phase: float
) -> Rows:
    """The attitudes of ``path`` and others on it, about ``spacing`` [m] apart from ``phase`` on."""
    room = len(path) + int(edge_lengths(shapes, margin, radius, path).sum() / spacing) + 2
    rows = np.empty((room, 3))
    size, due = 0, phase
    for i in range(len(path)):
        x, y, heading = path[i, 0], path[i, 1], path[i, 2]
        rows[size, 0], rows[size, 1], rows[size, 2] = x, y, heading
        size += 1
        if i + 1 == len(path):
            break
        word = free_word(shapes, margin, radius, path[i], path[i + 1], inf)[1]
        end = path[i + 1]
        pieces = dubins_word(word, radius, x, y, heading, end[0], end[1], end[2])
        for k in range(3):
            bend = TURNS[word, k] / radius
            while due < pieces[k] and size + len(path) - i - 1 < room:
                rows[size, 0], rows[size, 1], rows[size, 2] = advance(x, y, heading, bend, due)
                size += 1
                due += spacing
            due -= pieces[k]
            x, y, heading = advance(x, y, heading, bend, pieces[k])
    return rows[:size]


@kernel
def best_subsequence(shapes: Shapes, margin: float, radius: float, rows: Rows) -> Rows:
    """The attitudes of ``rows`` (n, 3) that give the shortest path in their order.

    The first and the last are among them.
    """
    count = len(rows)
    costs, before = np.empty(count), np.empty(count, np.int64)
    costs[0], before[0] = 0.0, -1
    for j in range(1, count):
        costs[j], before[j] = inf, -1
        for i in range(j):
            longest = costs[j] - costs[i] - EDGE_COST
            if longest > 0.0:
                length, word = free_word(shapes, margin, radius, rows[i], rows[j], longest)
                if word >= 0:
                    costs[j], before[j] = costs[i] + length + EDGE_COST, i
    size, j = 0, count - 1
    while j >= 0:
        size += 1
        j = before[j]
    chosen = np.empty((size, 3))
    j = count - 1
    for k in range(size - 1, -1, -1):
        for axis in range(3):
            chosen[k, axis] = rows[j, axis]
        j = before[j]
    return chosen


@kernel
def nudge(
    shapes: Shapes, margin: float, radius: float, path: Rows, step: float, draws: Rows
) -> None:
    """Move the inner attitudes of ``path`` where that shortens it, by up to ``step`` [m].

    ``draws`` (m, 3) are numbers in [-1, 1]; later moves are smaller.
    """
    if len(path) < 3:
        return
    lengths = edge_lengths(shapes, margin, radius, path)
    moved = np.empty(3)
    for k in range(len(draws)):
        i = 1 + k % (len(path) - 2)
        reach = step * 0.5 ** (6.0 * k / len(draws))
        moved[0] = path[i, 0] + reach * draws[k, 0]
        moved[1] = path[i, 1] + reach * draws[k, 1]
        moved[2] = path[i, 2] + min(reach / radius, 0.5 * pi) * draws[k, 2]
        total = lengths[i - 1] + lengths[i]
        first = free_word(shapes, margin, radius, path[i - 1], moved, total)[0]
        second = free_word(shapes, margin, radius, moved, path[i + 1], total - first)[0]
        if first + second < total:
            for axis in range(3):
                path[i, axis] = moved[axis]
            lengths[i - 1], lengths[i] = first, second


def shortened(
    shapes: Shapes, margin: float, radius: float, path: Rows, points: int, draws: Rows
) -> Rows:
    """A path between the same ends that is not longer than ``path`` (n, 3), whose edges are free.

    Each round takes about ``points`` attitudes along the path, keeps those that make the shortest
    path, and moves these at random; ``draws`` (rounds, moves, 3) are numbers in [-1, 1].
    """
    length = float(edge_lengths(shapes, margin, radius, path).sum())
    for moves in draws:
        spacing = length / points
        phase = spacing * 0.5 * (1.0 + float(moves[0, 0]))
        rows = densified(shapes, margin, radius, path, spacing, phase)
        candidate = best_subsequence(shapes, margin, radius, rows)
        nudge(shapes, margin, radius, candidate, 2.0 * radius, moves)
        shorter = float(edge_lengths(shapes, margin, radius, candidate).sum())
        if shorter < length:
            path, length = candidate, shorter
    return path
