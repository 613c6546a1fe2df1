"""Make a path of words shorter, without ever leaving the free space.

A path is a list of attitudes (n, 3), each joined to the next by its shortest free word.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, hypot, inf, isqrt, pi, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Frame, Row, Rows, edge_lengths, free_word
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES

#: Pairs of attitudes that are joined between two looks at the clock.
CHUNK = 1500
#: Attitudes between which edges are tried, per square root of their number.
HUBS = 6.0
#: What an edge costs [m] beside its length, so that of equal paths the one of fewer edges is taken.
EDGE_COST = 1e-6


@kernel
def densified(frame: Frame, path: Rows, count: int, phase: float) -> tuple[Rows, Row]:
    """The attitudes of ``path`` and about ``count`` others on it, and how far [m] along it they are.

    The others are at even distances, the first of them at a share of ``phase`` of that.  There are
    none on a path that has no length, or an edge that is not free: that is infinitely long.
    """
    edges, pieces = np.empty(len(path) - 1), np.zeros((len(path) - 1, MOST_PIECES, 4))
    for i in range(len(edges)):
        edges[i] = free_word(frame, path[i], path[i + 1], inf, pieces[i])[0]
    length = edges.sum()
    others = count if 0.0 < length < inf else 0
    room = len(path) + others + 2 if others else len(path)
    rows, ways = np.empty((room, 3)), np.empty(room)
    spacing = length / others if others else inf
    size, way, due = 0, 0.0, phase * spacing
    for i in range(len(path)):
        x, y, heading = path[i, 0], path[i, 1], path[i, 2]
        rows[size, 0], rows[size, 1], rows[size, 2], ways[size] = x, y, heading, way
        size += 1
        if i == len(edges):
            break
        begun = way
        for k in range(MOST_PIECES if others else 0):
            bend, piece, direction, turn = pieces[i, k]
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
        way += edges[i]
    return rows[:size], ways[:size]


@kernel
def _join(
    frame: Frame,
    rows: Rows,
    ways: Row,
    hubs: NDArray[np.int64],
    hub_rows: Rows,
    hub_costs: Row,
    costs: Row,
    before: NDArray[np.int64],
    first: int,
    last: int,
) -> None:
    """Fill the arrays of all rows (n,) from hub ``first`` to ``last`` - 1; those before are filled."""
    for h in range(first, last):
        for j in range(hubs[h - 1] + 1, hubs[h] + 1):
            # The way along the rows is free; what is no shorter need not be checked.
            costs[j], before[j] = costs[j - 1] + ways[j] - ways[j - 1] + EDGE_COST, j - 1
        j = hubs[h]
        # From the hub before it there may be no other way than along the rows.
        others = h - 1 if hubs[h - 1] == j - 1 else h
        shorter, hub, _ = best_ending(
            frame, hub_rows[:others], hub_costs[:others], rows[j : j + 1], costs[j] - EDGE_COST
        )
        if hub >= 0:
            costs[j], before[j] = shorter + EDGE_COST, hubs[hub]
        hub_costs[h] = costs[j]


def best_subsequence(
    frame: Frame, rows: Rows, ways: Row, check_time: Callable[[], None]
) -> tuple[Rows, Row]:
    """The attitudes of ``rows`` (n, 3) that give a shortest path in their order, and its edges.

    The edges between neighbours are free, and ``ways`` (n,) tell how far [m] along them the rows are.
    All others are tried between hubs, so few of the rows that their pairs are in proportion to the
    rows. The first and the last are among them; the edges' lengths [m] are infinite where none is
    free. ``check_time`` is called now and then, and may raise.
    """
    count = len(rows)
    costs, before = np.zeros(count), np.full(count, -1, np.int64)
    wanted = min(ceil(HUBS * sqrt(count)), count)
    hubs = np.arange(wanted) * (count - 1) // (wanted - 1)
    hub_rows, hub_costs = rows[hubs], np.zeros(wanted)
    first = 1
    while first < wanted:
        check_time()
        # Up to there the numbers of the hubs, and so the pairs, come to about a chunk.
        last = min(max(isqrt(first * first + 2 * CHUNK), first + 1), wanted)
        _join(frame, rows, ways, hubs, hub_rows, hub_costs, costs, before, first, last)
        first = last
    chosen, j = [], count - 1
    while j >= 0:
        chosen.append(j)
        j = int(before[j])
    path = rows[chosen[::-1]]
    return path, edge_lengths(frame, path)


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
    points: int,
    reach: float,
    draws: Rows,
    check_time: Callable[[], None],
) -> Rows:
    """A path between the same ends that is not longer than ``path`` (n, 3).

    Where an edge of ``path`` is not free after all, by a hair, it is left as it is, for the exact
    check.  About ``points`` attitudes along the path are taken; those that make the shortest path are
    kept, and moved at random by up to ``reach`` [m]; ``draws`` (moves, 3) are numbers in [-1, 1].
    ``check_time`` is called now and then, and may raise.
    """
    rows, ways = densified(frame, path, points, 0.5 * (1.0 + float(draws[0, 0])))
    if not 0.0 < ways[-1] < inf:
        # A turn on the spot, no motion at all, or an edge that is not free.
        return path
    candidate, lengths = best_subsequence(frame, rows, ways, check_time)
    nudge(frame, candidate, lengths, reach, draws)
    return candidate if lengths.sum() < ways[-1] else path
