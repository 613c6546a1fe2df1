"""The shortest tour through few groups of attitudes, by dynamic programming over sets of groups.

M. Held and R. M. Karp, "A dynamic programming approach to sequencing problems" (1962), with an
attitude to choose in each group.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.chains import Costs, Groups, Indices

#: Steps of the programme for which it is taken at most: some 0.1 s.
MOST_STEPS = 5e7
#: Goals for which it is taken at most: the memory doubles with each.
MOST_EXACT = 14
#: Sets of groups that are worked on between two questions whether to stop.
SETS_AT_A_TIME = 64


def is_small(groups: Groups) -> bool:
    """Whether `best_tour` is quick enough."""
    goals, widest = len(groups.first) - 1, float(groups.sizes.max())
    return goals <= MOST_EXACT and 2.0**goals * (goals * widest) ** 2 / 4.0 <= MOST_STEPS


def best_tour(groups: Groups, should_stop: ShouldStop) -> Indices:
    """The order of the shortest tour, group 0 first; one of those that the precedences allow.

    :raises Stopped: when ``should_stop`` said so
    """
    goals = len(groups.first) - 1
    needed = np.zeros(goals, np.int64)
    for i, j in zip(*np.nonzero(groups.before[1:, 1:]), strict=True):
        needed[j] |= 1 << int(i)
    widest = int(groups.sizes.max())
    lengths = np.full((1 << goals, goals, widest), inf, np.float32)
    came = np.full((1 << goals, goals, widest, 2), -1, np.int16)
    _begin(groups, needed, lengths)
    for begin in range(0, 1 << goals, SETS_AT_A_TIME):
        go_on(should_stop)
        _extend(groups, needed, lengths, came, begin, min(begin + SETS_AT_A_TIME, 1 << goals))
    return _order(groups, needed, lengths, came)


@kernel
def _begin(groups: Groups, needed: Indices, lengths: Costs) -> None:
    for g in range(len(needed)):
        if needed[g] == 0:
            for i in range(groups.sizes[g + 1]):
                lengths[1 << g, g, i] = groups.costs[0, groups.first[g + 1] + i]


@kernel
def _extend(
    groups: Groups,
    needed: Indices,
    lengths: Costs,
    came: NDArray[np.int16],
    begin: int,
    end: int,
) -> None:
    goals = len(needed)
    for visited in range(begin, end):
        for last in range(goals):
            if not visited >> last & 1:
                continue
            for i in range(groups.sizes[last + 1]):
                way = lengths[visited, last, i]
                if not way < inf:
                    continue
                row = groups.costs[groups.first[last + 1] + i]
                for g in range(goals):
                    if visited >> g & 1 or needed[g] & ~visited:
                        continue
                    more, offset = visited | 1 << g, groups.first[g + 1]
                    for j in range(groups.sizes[g + 1]):
                        longer = way + row[offset + j]
                        if longer < lengths[more, g, j]:
                            lengths[more, g, j] = longer
                            came[more, g, j, 0], came[more, g, j, 1] = last, i


def _order(groups: Groups, needed: Indices, lengths: Costs, came: NDArray[np.int16]) -> Indices:
    goals = len(needed)
    visited = (1 << goals) - 1
    last, i = np.unravel_index(int(np.argmin(lengths[visited])), lengths[visited].shape)
    if not lengths[visited, last, i] < inf:
        return any_order(groups)
    order: list[int] = []
    here, at = int(last), int(i)
    while here >= 0:
        order.append(here + 1)
        before, at = (int(number) for number in came[visited, here, at])
        visited &= ~(1 << here)
        here = before
    return np.array([0, *reversed(order)], np.int64)


def any_order(groups: Groups) -> Indices:
    """The groups in the order of their numbers, as far as the precedences allow."""
    left = list(range(1, len(groups.first)))
    order = [0]
    while left:
        free = next(g for g in left if not groups.before[left, g].any())
        left.remove(free)
        order.append(free)
    return np.array(order, np.int64)
