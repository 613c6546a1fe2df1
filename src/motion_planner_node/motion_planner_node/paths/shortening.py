"""Make a path of words shorter, without ever leaving the free space.

A path is a list of attitudes (n, 3), each joined to the next by its shortest free word.
"""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, inf, isqrt, pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Frame, Row, Rows, edge_lengths, free_word
from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES

#: Pairs of attitudes that are joined between two looks at the clock.
CHUNK = 1500
#: What an edge costs [m] beside its length, so that of equal paths the one of fewer edges is taken.
EDGE_COST = 1e-6


@kernel
def densified(
    frame: Frame,
    path: Rows,
    spacing: float,
    phase: float,
) -> Rows:
    """The attitudes of ``path`` and others on it, about ``spacing`` [m] apart from ``phase`` on."""
    room = len(path) + int(edge_lengths(frame, path).sum() / spacing) + 2
    rows, pieces = np.empty((room, 3)), np.zeros((MOST_PIECES, 4))
    size, due = 0, phase
    for i in range(len(path)):
        x, y, heading = path[i, 0], path[i, 1], path[i, 2]
        rows[size, 0], rows[size, 1], rows[size, 2] = x, y, heading
        size += 1
        if i + 1 == len(path):
            break
        free_word(frame, path[i], path[i + 1], inf, pieces)
        for k in range(MOST_PIECES):
            bend, length, direction, turn = pieces[k]
            way = abs(length)
            while due < way and size + len(path) - i - 1 < room:
                share = due / way
                rows[size, 0], rows[size, 1], rows[size, 2] = advance(
                    x, y, heading, bend, length * share, direction, turn * share
                )
                size += 1
                due += spacing
            due -= way
            x, y, heading = advance(x, y, heading, bend, length, direction, turn)
    return rows[:size]


@kernel
def _join(
    frame: Frame, rows: Rows, costs: Row, before: NDArray[np.int64], first: int, last: int
) -> None:
    """Fill ``costs`` and ``before`` (n,) from ``first`` to ``last`` - 1; those before are filled."""
    pieces = np.zeros((MOST_PIECES, 4))
    for j in range(first, last):
        costs[j], before[j] = inf, -1
        # The way along the rows comes first: what is no shorter need not be checked.
        for k in range(j):
            i = k - 1 if k > 0 else j - 1
            longest = costs[j] - costs[i] - EDGE_COST
            if longest > 0.0:
                length, word = free_word(frame, rows[i], rows[j], longest, pieces)
                if word >= 0:
                    costs[j], before[j] = costs[i] + length + EDGE_COST, i


def best_subsequence(frame: Frame, rows: Rows, check_time: Callable[[], None]) -> Rows:
    """The attitudes of ``rows`` (n, 3) that give the shortest path in their order.

    The first and the last are among them.  ``check_time`` is called now and then, and may raise.
    """
    costs, before = np.zeros(len(rows)), np.full(len(rows), -1, np.int64)
    first = 1
    while first < len(rows):
        check_time()
        # Up to there the numbers of the attitudes, and so the pairs, come to about a chunk.
        last = min(max(isqrt(first * first + 2 * CHUNK), first + 1), len(rows))
        _join(frame, rows, costs, before, first, last)
        first = last
    chosen, j = [], len(rows) - 1
    while j >= 0:
        chosen.append(j)
        j = int(before[j])
    return np.ascontiguousarray(rows[chosen[::-1]])


@kernel
def nudge(frame: Frame, path: Rows, step: float, draws: Rows) -> None:
    """Move the inner attitudes of ``path`` where that shortens it, by up to ``step`` [m].

    ``draws`` (m, 3) are numbers in [-1, 1]; later moves are smaller.
    """
    if len(path) < 3:
        return
    lengths = edge_lengths(frame, path)
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
    points: int,
    reach: float,
    draws: Rows,
    check_time: Callable[[], None],
) -> Rows:
    """A path between the same ends that is not longer than ``path`` (n, 3), whose edges are free.

    Where one of them is not after all, by a hair, the path is left as it is, for the exact check.
    Each round takes about ``points`` attitudes along the path, keeps those that make the shortest
    path, and moves these at random by up to ``reach`` [m]; ``draws`` (rounds, moves, 3) are
    numbers in [-1, 1].  ``check_time`` is called now and then, and may raise.
    """
    length = float(edge_lengths(frame, path).sum())
    for moves in draws:
        spacing = length / points
        if not 0.0 < spacing < inf:
            # A turn on the spot, no motion at all, or an edge that is not free.
            break
        phase = spacing * 0.5 * (1.0 + float(moves[0, 0]))
        rows = densified(frame, path, spacing, phase)
        candidate = best_subsequence(frame, rows, check_time)
        nudge(frame, candidate, reach, moves)
        shorter = float(edge_lengths(frame, candidate).sum())
        if shorter < length:
            path, length = candidate, shorter
    return path
