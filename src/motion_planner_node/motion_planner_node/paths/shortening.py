"""Make a path of words shorter, without ever leaving the free space.

A path is a list of attitudes (n, 3), each joined to the next by its shortest free word.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, inf, isqrt, pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Frame, Row, Rows, free_word
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES

#: Pairs of attitudes that are joined between two looks at the clock.
CHUNK = 1500
#: What an edge costs [m] beside its length, so that of equal paths the one of fewer edges is taken.
EDGE_COST = 1e-6


@kernel
def densified(
    frame: Frame, path: Rows, length: float, count: int, phase: float
) -> tuple[Rows, Row]:
    """The attitudes of ``path`` and about ``count`` others on it, and how far [m] along it they are.

    ``length`` [m] is that of the path, whose edges are free; the others are at even distances, the
    first of them at a share of ``phase`` of that.
    """
    room = len(path) + count + 2
    rows, ways, pieces = np.empty((room, 3)), np.empty(room), np.zeros((MOST_PIECES, 4))
    size, spacing, way = 0, length / count, 0.0
    due = phase * spacing
    for i in range(len(path)):
        x, y, heading = path[i, 0], path[i, 1], path[i, 2]
        rows[size, 0], rows[size, 1], rows[size, 2], ways[size] = x, y, heading, way
        size += 1
        if i + 1 == len(path):
            break
        edge = free_word(frame, path[i], path[i + 1], inf, pieces)[0]
        if edge == inf:
            continue
        begun = way
        for k in range(MOST_PIECES):
            bend, piece, direction, turn = pieces[k]
            left = abs(piece)
            while due < left and size + len(path) - i - 1 < room:
                share = due / left
                rows[size, 0], rows[size, 1], rows[size, 2] = advance(
                    x, y, heading, bend, piece * share, direction, turn * share
                )
                ways[size] = begun + due
                size += 1
                due += spacing
            due -= left
            begun += left
            x, y, heading = advance(x, y, heading, bend, piece, direction, turn)
        way += edge
    return rows[:size], ways[:size]


@kernel
def _join(
    frame: Frame,
    rows: Rows,
    costs: Row,
    edges: Row,
    before: NDArray[np.int64],
    first: int,
    last: int,
) -> None:
    """Fill the arrays of (n,) from ``first`` to ``last`` - 1; those before are filled."""
    pieces = np.zeros((MOST_PIECES, 4))
    for j in range(first, last):
        # The way along the rows comes first: what is no shorter need not be checked.
        length = free_word(frame, rows[j - 1], rows[j], inf, pieces)[0]
        costs[j], before[j] = costs[j - 1] + length, j - 1
        shorter, i, _ = best_ending(frame, rows[: j - 1], costs[: j - 1], rows[j : j + 1], costs[j])
        if i >= 0:
            costs[j], before[j] = shorter, i
        edges[j] = costs[j] - costs[before[j]]
        costs[j] += EDGE_COST


def best_subsequence(frame: Frame, rows: Rows, check_time: Callable[[], None]) -> tuple[Rows, Row]:
    """The attitudes of ``rows`` (n, 3) that give the shortest path in their order, and its edges.

    The first and the last are among them; the edges' lengths [m] are infinite where none is free.
    ``check_time`` is called now and then, and may raise.
    """
    costs, edges = np.zeros(len(rows)), np.zeros(len(rows))
    before = np.full(len(rows), -1, np.int64)
    first = 1
    while first < len(rows):
        check_time()
        # Up to there the numbers of the attitudes, and so the pairs, come to about a chunk.
        last = min(max(isqrt(first * first + 2 * CHUNK), first + 1), len(rows))
        _join(frame, rows, costs, edges, before, first, last)
        first = last
    chosen, j = [], len(rows) - 1
    while j >= 0:
        chosen.append(j)
        j = int(before[j])
    return rows[chosen[::-1]], edges[chosen[-2::-1]]


@kernel
def nudge(frame: Frame, path: Rows, lengths: Row, step: float, draws: Rows) -> None:
    """Move the inner attitudes of ``path`` where that shortens it, by up to ``step`` [m].

    ``lengths`` are those of its edges, and are kept up to date. ``draws`` (m, 3) are numbers in
    [-1, 1]; later moves are smaller.
    """
    if len(path) < 3:
        return
    moved, pieces = np.empty(3), np.zeros((MOST_PIECES, 4))
    for k in range(len(draws)):
        i = 1 + k % (len(path) - 2)
        reach = step * 0.5 ** (6.0 * k / len(draws))
        moved[0] = path[i, 0] + reach * draws[k, 0]
        moved[1] = path[i, 1] + reach * draws[k, 1]
        moved[2] = path[i, 2] + min(reach / frame.radius, 0.5 * pi) * draws[k, 2]
        total = lengths[i - 1] + lengths[i]
        rest = hypot(path[i + 1, 0] - moved[0], path[i + 1, 1] - moved[1])
        first = free_word(frame, path[i - 1], moved, total - rest, pieces)[0]
        second = free_word(frame, moved, path[i + 1], total - first, pieces)[0]
        if first + second < total:
            for axis in range(3):
                path[i, axis] = moved[axis]
            lengths[i - 1], lengths[i] = first, second


def shortened(
    frame: Frame,
    path: Rows,
    length: float,
    points: int,
    reach: float,
    draws: Rows,
    check_time: Callable[[], None],
) -> tuple[Rows, float]:
    """A path between the same ends that is not longer than ``path`` (n, 3), and its length [m].

    ``length`` [m] is that of ``path``, whose edges are free.  Where one of them is not after all, by
    a hair, the path is left as it is, for the exact check.  About ``points`` attitudes along the path
    are taken; those that make the shortest path are kept, and moved at random by up to ``reach``
    [m]; ``draws`` (moves, 3) are numbers in [-1, 1].  ``check_time`` is called now and then, and may
    raise.
    """
    if not 0.0 < length < inf:
        # A turn on the spot, no motion at all, or an edge that is not free.
        return path, length
    rows, _ = densified(frame, path, length, points, 0.5 * (1.0 + float(draws[0, 0])))
    candidate, lengths = best_subsequence(frame, rows, check_time)
    nudge(frame, candidate, lengths, reach, draws)
    shorter = float(lengths.sum())
    return (candidate, shorter) if shorter < length else (path, length)
