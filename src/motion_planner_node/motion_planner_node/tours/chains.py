"""The shortest way through groups of attitudes in a given order: dynamic programming over the chain.

Group g holds the attitudes number ``first[g]`` up to ``first[g] + sizes[g]``; the matrix of costs [m]
is over all attitudes.  An order is a list of groups and begins with group 0, where the robot stands.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel

Costs = NDArray[np.float32]
Indices = NDArray[np.int64]
Table = NDArray[np.float64]


class Groups(NamedTuple):
    """What a tour is looked for among; ``before[i, j]`` says that group i has to come before j."""

    costs: Costs
    first: Indices
    sizes: Indices
    before: NDArray[np.bool_]


@kernel
def best_chain(groups: Groups, order: Indices) -> tuple[float, Indices]:
    """Length [m] of the shortest way through ``order`` (k,), and its attitudes (k,).

    Infinite where there is none; then any attitude of each group is given.
    """
    size = len(order)
    widest = groups.sizes.max()
    ways = np.full((size, widest), inf)
    came = np.zeros((size, widest), np.int64)
    ways[0, 0] = 0.0
    for place in range(1, size):
        here, there = order[place - 1], order[place]
        for j in range(groups.sizes[there]):
            for i in range(groups.sizes[here]):
                way = (
                    ways[place - 1, i]
                    + groups.costs[groups.first[here] + i, groups.first[there] + j]
                )
                if way < ways[place, j]:
                    ways[place, j], came[place, j] = way, i
    last = int(np.argmin(ways[size - 1, : groups.sizes[order[size - 1]]]))
    shortest = ways[size - 1, last]
    chosen = np.empty(size, np.int64)
    for place in range(size - 1, -1, -1):
        chosen[place] = groups.first[order[place]] + last
        last = came[place, last]
    return shortest, chosen


@kernel
def ways_to(groups: Groups, order: Indices) -> Table:
    """Lengths [m], (k, widest), of the shortest ways from the start to each attitude of each group."""
    ways = np.full((len(order), groups.sizes.max()), inf)
    ways[0, 0] = 0.0
    for place in range(1, len(order)):
        step(groups, order[place - 1], order[place], ways[place - 1], ways[place])
    return ways


@kernel
def ways_on(groups: Groups, order: Indices) -> Table:
    """Lengths [m], (k, widest), of the shortest ways from each attitude to the end of the chain."""
    size = len(order)
    ways = np.full((size, groups.sizes.max()), inf)
    ways[size - 1, : groups.sizes[order[size - 1]]] = 0.0
    for place in range(size - 2, -1, -1):
        step_back(groups, order[place], order[place + 1], ways[place + 1], ways[place])
    return ways


@kernel
def step(groups: Groups, here: int, there: int, ways: Table, result: Table) -> None:
    """Fill ``result`` with the lengths [m] to the attitudes of group ``there``, after ``ways``."""
    result[:] = inf
    for i in range(groups.sizes[here]):
        way = ways[i]
        if way < inf:
            row = groups.costs[groups.first[here] + i]
            for j in range(groups.sizes[there]):
                result[j] = min(result[j], way + row[groups.first[there] + j])


@kernel
def step_back(groups: Groups, here: int, there: int, onward: Table, result: Table) -> None:
    """Fill ``result`` with the lengths [m] from the attitudes of group ``here``, before ``onward``."""
    result[:] = inf
    for i in range(groups.sizes[here]):
        row = groups.costs[groups.first[here] + i]
        least = inf
        for j in range(groups.sizes[there]):
            least = min(least, row[groups.first[there] + j] + onward[j])
        result[i] = least


@kernel
def joined(groups: Groups, here: int, there: int, ways: Table, onward: Table) -> float:
    """The shortest way [m] over group ``here``, reached after ``ways``, and ``onward`` from ``there``."""
    least = inf
    for i in range(groups.sizes[here]):
        row = groups.costs[groups.first[here] + i]
        for j in range(groups.sizes[there]):
            least = min(least, ways[i] + row[groups.first[there] + j] + onward[j])
    return least
