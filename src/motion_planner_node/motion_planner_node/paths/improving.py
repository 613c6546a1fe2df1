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


def length_of(query: Query, path: Rows) -> float:
    """Length [m] of ``path`` (n, 3)."""
    return float(edge_lengths(query.frame, path).sum())


def simplified(query: Query, path: Rows, length: float) -> tuple[Rows, float]:
    """A path between the same ends that is not longer than ``length`` [m], which is that of ``path``.

    And its own length [m].
    """
    query.check_time()
    if len(path) == 2:
        shortest = float(shortest_between(path[0], path[1:], query.robot)[0])
        if length <= STRAIGHT * shortest:
            return path, length
    draws = query.random.uniform(-1.0, 1.0, (MOVES, 3))
    reach = 2.0 * query.reach
    return shortened(query.frame, path, length, POINTS, reach, draws, query.check_time)


def refined(query: Query, path: Rows, length: float) -> tuple[Rows, float]:
    """A path that is not longer and may end at another destination of the region; and its length.

    ``length`` [m] is that of ``path``.
    """
    if query.region is None:
        return path, length
    for number in range(query.budget.refinements):
        query.check_time()
        if not 0.0 < length < inf:
            break
        along, ways = densified(query.frame, path, length, LEAVES, 0.0)
        ends = query.region(_probes(query, along, 0.5**number))
        if not len(ends):
            continue
        shorter, leave, end = _best_ending(query, along, ways, ends, length)
        if leave < 0:
            continue
        before = length
        path, length = simplified(query, np.vstack((along[: leave + 1], ends[end])), shorter)
        if length > (1.0 - WORTHWHILE) * before:
            break
    return path, length


def _best_ending(
    query: Query, along: Rows, ways: Row, ends: Rows, length: float
) -> tuple[float, int, int]:
    """As `best_ending`, with looks at the clock."""
    best, leave, end = length, -1, -1
    for first in range(0, len(along), STRETCH):
        query.check_time()
        part = slice(first, first + STRETCH)
        shorter, at, chosen = best_ending(query.frame, along[part], ways[part], ends, best)
        if at >= 0:
            best, leave, end = shorter, first + at, chosen
    return best, leave, end


def _probes(query: Query, along: Rows, scale: float) -> Rows:
    """Attitudes (n, 3) round those of the last part of a path."""
    tail = along[int((1.0 - TAIL) * len(along)) :]
    spread = scale * query.reach
    chosen = tail[query.random.integers(len(tail), size=PROBES)]
    return chosen + query.random.normal(size=(PROBES, 3)) * (spread, spread, 0.5)
