"""Make a path shorter: between its ends, and by ending it elsewhere in the region of destinations."""

from __future__ import annotations

from math import inf

import numpy as np

from motion_planner_node.paths.edges import Row, Rows, edge_lengths
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.shortening import densified, shortened
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.driving import shortest_between

#: Attitudes along a path that it may be made shorter between, and random moves of them.
POINTS, MOVES = 7, 24
#: Attitudes round which destinations are looked for in one refinement.
PROBES = 16
#: Attitudes along a path that are left for a better destination.
LEAVES = 8
#: Attitudes that ways to destinations are tried from between two looks at the clock.
STRETCH = 64
#: A word of no more than so many times the length of the shortest one is not made shorter.
STRAIGHT = 1.0 + 1e-9
#: A refinement that gains no more than this share of the length is the last one.
WORTHWHILE = 0.002
#: Share of the path, from its end, near which the probes are.
TAIL = 0.4


def simplified(query: Query, path: Rows) -> Rows:
    """A path between the same ends that is not longer than ``path`` (n, 3)."""
    query.check_time()
    if len(path) == 2:
        shortest = float(shortest_between(path[0], path[1:], query.robot)[0])
        if edge_lengths(query.frame, path)[0] <= STRAIGHT * shortest:
            return path
    draws = query.random.uniform(-1.0, 1.0, (MOVES, 3))
    return shortened(query.frame, path, POINTS, 2.0 * query.reach, draws, query.check_time)


def refined(query: Query, path: Rows) -> Rows:
    """A path that is not longer than ``path`` (n, 3) and may end at another destination of the region."""
    if query.region is None:
        return path
    before = inf
    for number in range(query.budget.refinements):
        query.check_time()
        along, ways = densified(query.frame, path, LEAVES, 0.0)
        length = float(ways[-1])
        if not 0.0 < length < inf or length > (1.0 - WORTHWHILE) * before:
            break
        ends = query.region(_probes(query, along, 0.5**number))
        if not len(ends):
            continue
        leave, end = _best_ending(query, along, ways, ends, length)
        if leave < 0:
            continue
        before = length
        path = simplified(query, np.vstack((along[: leave + 1], ends[end])))
    return path


def _best_ending(
    query: Query, along: Rows, ways: Row, ends: Rows, length: float
) -> tuple[int, int]:
    """As `best_ending`, with looks at the clock: where the path is left, and the end."""
    best, leave, end = length, -1, -1
    for first in range(0, len(along), STRETCH):
        query.check_time()
        part = slice(first, first + STRETCH)
        shorter, at, chosen = best_ending(query.frame, along[part], ways[part], ends, best)
        if at >= 0:
            best, leave, end = shorter, first + at, chosen
    return leave, end


def _probes(query: Query, along: Rows, scale: float) -> Rows:
    """Attitudes (n, 3) round those of the last part of a path."""
    tail = along[int((1.0 - TAIL) * len(along)) :]
    spread = scale * query.reach
    chosen = tail[query.random.integers(len(tail), size=PROBES)]
    return chosen + query.random.normal(size=(PROBES, 3)) * (spread, spread, 0.5)
