"""Short tours through many groups of attitudes: insertion, Or-opt, 2-opt, and double bridges.

O. Martin, S. W. Otto, E. W. Felten, "Large-step Markov chains for the traveling salesman problem"
(1991); the moves are those of `moves`, the precedences bound them.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.chains import Groups, Indices, joined, step, ways_on, ways_to
from motion_planner_node.tours.exact import any_order
from motion_planner_node.tours.moves import (
    NEIGHBOURS,
    NONE,
    Tables,
    best_move,
    fill,
    make,
    neighbours,
    tables_of,
)

#: What a move has to gain [m].
GAIN = 1e-3
#: Places between the first and the last cut of a double bridge at most.
BRIDGE = 50
#: Groups whose moves are looked at between two questions whether to stop.
MOVES_AT_A_TIME = 32
#: Places on both sides of a change whose groups are looked at again.
AROUND = 3


@kernel
def best_place(groups: Groups, rest: Indices, group: int) -> tuple[float, int]:
    """Length [m] of ``rest`` with ``group`` inserted where that is shortest, and after which place.

    Infinite and -1 where the precedences leave no place or there is no way.
    """
    low, high = 0, len(rest)
    for place in range(1, len(rest)):
        if groups.before[rest[place], group]:
            low = place
        if groups.before[group, rest[place]]:
            high = min(high, place)
    to, on = ways_to(groups, rest), ways_on(groups, rest)
    ways = np.empty(groups.sizes.max())
    best, chosen = inf, -1
    for place in range(low, high):
        step(groups, rest[place], group, to[place], ways)
        if place + 1 < len(rest):
            length = joined(groups, group, rest[place + 1], ways, on[place + 1])
        else:
            length = ways[: groups.sizes[group]].min()
        if length < best:
            best, chosen = length, place
    return best, chosen


def inserted(groups: Groups, sequence: Indices, should_stop: ShouldStop) -> Indices:
    """A tour that is built by inserting the groups of ``sequence`` where each is cheapest.

    :raises Stopped: when ``should_stop`` said so
    """
    order = np.zeros(1, np.int64)
    for group in sequence:
        go_on(should_stop)
        place = best_place(groups, order, int(group))[1]
        if place < 0:
            return any_order(groups)
        order = np.insert(order, place + 1, group)
    return order


class LocalSearch:
    """Looks for shorter orders of ``groups``; their costs as they are when it is made say what is near."""

    def __init__(self, groups: Groups, should_stop: ShouldStop) -> None:
        self._groups, self._should_stop = groups, should_stop
        self._near = neighbours(groups, NEIGHBOURS)
        inner = groups.before[1:, 1:]
        self._bound = np.concatenate(([False], inner.any(axis=0) | inner.any(axis=1)))

    def tour(self, begin: Indices | None, bridges: int, rng: np.random.Generator) -> Indices:
        """A short tour, from ``begin`` or from insertion on; ``bridges`` is how often it is shaken.

        :raises Stopped: when ``should_stop`` said so
        """
        order = begin
        if order is None:
            sequence = 1 + rng.permutation(len(self._bound) - 1)
            order = inserted(self._groups, sequence, self._should_stop)
        length, order = self.improved(order, order)
        for _ in range(bridges if len(order) > 4 else 0):
            other, cuts = _bridged(order, rng)
            if self._breaks(other):
                continue
            shorter, candidate = self.improved(other, cuts)
            if shorter < length:
                length, order = shorter, candidate
        return order

    def improved(self, order: Indices, changed: Indices) -> tuple[float, Indices]:
        """Length [m] and a tour that no move makes shorter, where ``order`` is new about ``changed``.

        :raises Stopped: when ``should_stop`` said so
        """
        tables = tables_of(self._groups, order)
        waiting = np.zeros(len(order), np.bool_)
        queue = np.empty(len(order), np.int64)
        changed = np.array([group for group in dict.fromkeys(changed.tolist()) if group], np.int64)
        queue[: len(changed)] = changed
        waiting[changed] = True
        ends = np.array([0, len(changed)])
        while ends[1]:
            go_on(self._should_stop)
            _improve(self._groups, self._near, self._bound, tables, queue, waiting, ends)
        return float(tables.on[0, 0]), tables.order

    def _breaks(self, order: Indices) -> bool:
        """Whether ``order`` breaks a precedence."""
        return bool(np.tril(self._groups.before[np.ix_(order, order)]).any())


@kernel
def _improve(
    groups: Groups,
    near: Indices,
    bound: NDArray[np.bool_],
    tables: Tables,
    queue: Indices,
    waiting: NDArray[np.bool_],
    ends: Indices,
) -> None:
    """Make the best moves of the first groups in the queue, a ring with ``ends`` (first, count)."""
    size = len(tables.order)
    for _ in range(MOVES_AT_A_TIME):
        if ends[1] == 0:
            return
        group = queue[ends[0]]
        ends[0], ends[1] = (ends[0] + 1) % size, ends[1] - 1
        waiting[group] = False
        move = best_move(groups, near, bound, tables, group)
        if move.kind == NONE or not move.length < tables.on[0, 0] - GAIN:
            continue
        begin, end = make(tables, move)
        fill(groups, tables)
        for place in range(max(1, begin - AROUND), min(size, end + AROUND + 1)):
            # What was only shifted or turned round has neighbours that it had before.
            if begin + AROUND <= place <= end - AROUND:
                continue
            other = tables.order[place]
            if not waiting[other]:
                waiting[other] = True
                queue[(ends[0] + ends[1]) % size] = other
                ends[1] += 1


def _bridged(order: Indices, rng: np.random.Generator) -> tuple[Indices, Indices]:
    """``order`` with two neighbouring parts exchanged, and the groups at the cuts."""
    span = min(BRIDGE, len(order) - 1)
    begin = 1 + int(rng.integers(len(order) - span))
    a, b, c = np.sort(begin + rng.choice(span + 1, 3, replace=False)).tolist()
    shaken = np.concatenate((order[:a], order[b:c], order[a:b], order[c:]))
    ends = {a - 1, a, a + c - b - 1, a + c - b, c - 1, c}
    return shaken, shaken[[place for place in sorted(ends) if 1 <= place < len(order)]]
