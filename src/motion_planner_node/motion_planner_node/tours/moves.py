"""Moves of the travelling-salesman problem over groups of attitudes: Or-opt and 2-opt, valued exactly.

A move is valued with the attitudes that are best after it.  What it leaves as it was is in tables: the
ways to each attitude from the start, those on from it, and those of the order turned round.  A way
that joins unchanged groups soon takes the same attitudes as before it: its lengths then differ from
the table's by one number for all attitudes, and so do all that follow.  So a move costs some steps of
dynamic programming, however many groups there are.

I. Or (1976); G. A. Croes (1958); J. L. Bentley, "Fast algorithms for geometric traveling salesman
problems" (1992), for the lists of neighbours.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.tours.chains import Groups, Indices, Table, joined, step, step_back

#: Groups next to each other that are moved together at most.
MOST_MOVED = 3
#: Groups, the nearest to each one, next to which it is tried.
NEIGHBOURS = 10
#: Lengths [m] that are as near as this are the same but for rounding.
SAME = 1e-7

#: Kinds of moves.
NONE, MOVED, REVERSED = range(3)


class Tables(NamedTuple):
    """An order of k groups and what is known of it; ``place`` is that of each group.

    to: (k, widest) [m] to each attitude from the start.
    on: (k, widest) [m] from each attitude to the end.
    back: (k, widest) [m] to each attitude from the end, the order turned round.
    rest_to, rest_on: room for the same without some of the groups.
    """

    order: Indices
    place: Indices
    to: Table
    on: Table
    back: Table
    rest_to: Table
    rest_on: Table


class Move(NamedTuple):
    """A move and the ``length`` [m] of the order after it.

    The places from ``first`` to ``last`` go behind the place ``after``, or stay there if it is REVERSED.
    They are ``turned`` round on the way if that is not 0.
    """

    length: float
    kind: int
    first: int
    last: int
    after: int
    turned: int


@kernel
def tables_of(groups: Groups, order: Indices) -> Tables:
    """The tables of a copy of ``order`` (k,), which holds all groups."""
    size, widest = len(order), groups.sizes.max()
    tables = Tables(
        order.copy(),
        np.empty(size, np.int64),
        np.empty((size, widest)),
        np.empty((size, widest)),
        np.empty((size, widest)),
        np.empty((size, widest)),
        np.empty((size, widest)),
    )
    fill(groups, tables)
    return tables


@kernel
def fill(groups: Groups, tables: Tables) -> None:
    """Work the tables out anew."""
    order, to, on, back = tables.order, tables.to, tables.on, tables.back
    size = len(order)
    for place in range(size):
        tables.place[order[place]] = place
    to[0], on[size - 1], back[size - 1] = inf, inf, inf
    to[0, 0] = 0.0
    for i in range(groups.sizes[order[size - 1]]):
        on[size - 1, i] = 0.0
        back[size - 1, i] = 0.0
    for place in range(1, size):
        step(groups, order[place - 1], order[place], to[place - 1], to[place])
    for place in range(size - 2, -1, -1):
        step_back(groups, order[place], order[place + 1], on[place + 1], on[place])
        step(groups, order[place + 1], order[place], back[place + 1], back[place])


@kernel
def neighbours(groups: Groups, most: int) -> Indices:
    """The ``most`` groups, at most, that it is cheapest to drive from or to each group: (k, m)."""
    size = len(groups.first)
    most = min(most, size - 1)
    near = np.empty((size, most), np.int64)
    least = np.full((size, size), inf, np.float32)
    for here in range(size):
        for there in range(size):
            if here != there:
                way = np.float32(inf)
                for i in range(groups.sizes[here]):
                    row = groups.costs[groups.first[here] + i]
                    for j in range(groups.sizes[there]):
                        way = min(way, row[groups.first[there] + j])
                least[here, there] = min(least[here, there], way)
                least[there, here] = min(least[there, here], way)
    for here in range(size):
        # A group is not near to itself, however far the others are.
        ranked = np.argsort(least[here], kind='mergesort')
        count = 0
        for there in ranked:
            if there != here and count < most:
                near[here, count] = there
                count += 1
    return near


@kernel
def _shift(ways: Table, known: Table, count: int) -> float:
    """What ``ways`` (count,) are longer [m] than ``known`` everywhere; NaN where that differs."""
    low, high = inf, -inf
    for i in range(count):
        if ways[i] == inf and known[i] == inf:
            continue
        apart = ways[i] - known[i]
        low, high = min(low, apart), max(high, apart)
        if not high - low <= SAME:
            return np.nan
    return low if low < inf else 0.0


@kernel
def _rest_to(groups: Groups, tables: Tables, first: int, last: int) -> tuple[int, float]:
    """Fill `rest_to` without the places ``first`` to ``last``, from the one after them on.

    Returns the place from which on the lengths are those in `to` and how much more, and that [m].
    """
    order, size = tables.order, len(tables.order)
    before, ways = order[first - 1], tables.to[first - 1]
    for place in range(last + 1, size):
        here, fresh = order[place], tables.rest_to[place]
        step(groups, before, here, ways, fresh)
        more = _shift(fresh, tables.to[place], groups.sizes[here])
        if more == more:
            return place, more
        before, ways = here, fresh
    return size, 0.0


@kernel
def _rest_on(groups: Groups, tables: Tables, first: int, last: int) -> tuple[int, float]:
    """As `_rest_to`, for `rest_on` from the place before ``first`` downwards."""
    order, size = tables.order, len(tables.order)
    for place in range(first - 1, -1, -1):
        here, fresh = order[place], tables.rest_on[place]
        if place == first - 1 and last + 1 == size:
            fresh[:] = inf
            fresh[: groups.sizes[here]] = 0.0
        else:
            follows = last + 1 if place == first - 1 else place + 1
            onward = tables.on[follows] if place == first - 1 else tables.rest_on[follows]
            step_back(groups, here, order[follows], onward, fresh)
        more = _shift(fresh, tables.on[place], groups.sizes[here])
        if more == more:
            return place, more
    return -1, 0.0


@kernel
def _ended(groups: Groups, tables: Tables, last: int, ways: Table, place: int, on: Table) -> float:
    """Length [m] of ``ways`` to the group ``last`` and ``on`` from ``place`` (k where it ends)."""
    if place == len(tables.order):
        return float(ways[: groups.sizes[last]].min())
    return joined(groups, last, tables.order[place], ways, on)


@kernel
def reversal(groups: Groups, tables: Tables, first: int, last: int) -> float:
    """Length [m] with the places from ``first`` > 0 to ``last`` turned round."""
    order, widest = tables.order, tables.to.shape[1]
    ways, fresh = np.empty(widest), np.empty(widest)
    ways[:] = tables.to[first - 1]
    before, more = order[first - 1], 0.0
    for place in range(last, first - 1, -1):
        here = order[place]
        step(groups, before, here, ways, fresh)
        more = _shift(fresh, tables.back[place], groups.sizes[here])
        if more == more:
            ways[:] = tables.back[first] + more
            break
        before = here
        ways, fresh = fresh, ways
    follows = last + 1
    onward = tables.on[follows] if follows < len(order) else tables.on[last]
    return _ended(groups, tables, order[first], ways, follows, onward)


@kernel
def _may_turn(groups: Groups, tables: Tables, bound: NDArray[np.bool_], i: int, j: int) -> bool:
    """Whether the precedences allow the places from i to j to be turned round."""
    order = tables.order
    for place in range(i, j):
        if bound[order[place]]:
            for later in range(place + 1, j + 1):
                if groups.before[order[place], order[later]]:
                    return False
    return True


@kernel
def _limits(
    groups: Groups, tables: Tables, bound: NDArray[np.bool_], first: int, last: int
) -> tuple[int, int]:
    """The places after which the precedences let the part from ``first`` to ``last`` go."""
    order = tables.order
    low, high = 0, len(order) - 1
    for moved in order[first : last + 1]:
        if bound[moved]:
            for place in range(first - 1, low, -1):
                if groups.before[order[place], moved]:
                    low = place
                    break
            for place in range(last + 1, high + 1):
                if groups.before[moved, order[place]]:
                    high = place - 1
                    break
    return low, high


@kernel
def best_move(
    groups: Groups, near: Indices, bound: NDArray[np.bool_], tables: Tables, group: int
) -> Move:
    """The best of the moves that put a part beginning at ``group``, or itself, next to others near.

    ``near`` (k, m) is as `neighbours` has it; ``bound`` (k,) says which groups have precedences.
    """
    order, size = tables.order, len(tables.order)
    widest = tables.to.shape[1]
    ways, fresh = np.empty(widest), np.empty(widest)
    best = Move(inf, NONE, 0, 0, 0, 0)
    first = tables.place[group]
    for last in range(first, min(first + MOST_MOVED, size)):
        low, high = _limits(groups, tables, bound, first, last)
        until, more_to = _rest_to(groups, tables, first, last)
        since, more_on = _rest_on(groups, tables, first, last)
        for turned in range(1 if last == first else 2):
            if turned and not _may_turn(groups, tables, bound, first, last):
                continue
            head, tail = order[last if turned else first], order[first if turned else last]
            for number in range(2 * near.shape[1]):
                if number < near.shape[1]:
                    after = tables.place[near[head, number]]
                else:
                    after = tables.place[near[tail, number - near.shape[1]]] - 1
                if after < low or after > high or first - 1 <= after <= last:
                    continue
                if after > last and after < until:
                    ways[:] = tables.rest_to[after]
                elif after > last:
                    ways[:] = tables.to[after] + more_to
                else:
                    ways[:] = tables.to[after]
                before = order[after]
                for k in range(last - first + 1):
                    here = order[last - k] if turned else order[first + k]
                    step(groups, before, here, ways, fresh)
                    ways, fresh = fresh, ways
                    before = here
                follows = after + 1
                if follows >= first or follows == size:
                    length = _ended(
                        groups, tables, tail, ways, follows, tables.on[min(follows, size - 1)]
                    )
                elif follows > since:
                    length = _ended(groups, tables, tail, ways, follows, tables.rest_on[follows])
                else:
                    length = more_on + _ended(
                        groups, tables, tail, ways, follows, tables.on[follows]
                    )
                if length < best.length:
                    best = Move(length, MOVED, first, last, after, turned)
    here = tables.place[group]
    for other in near[group]:
        there = tables.place[other]
        one, two = min(here, there), max(here, there)
        # The two groups become neighbours, either before the part that is turned round or after it.
        for offset in range(2):
            begin, end = (one + 1, two) if offset == 0 else (one, two - 1)
            if begin == 0 or begin >= end or not _may_turn(groups, tables, bound, begin, end):
                continue
            length = reversal(groups, tables, begin, end)
            if length < best.length:
                best = Move(length, REVERSED, begin, end, begin - 1, 1)
    return best


@kernel
def make(tables: Tables, move: Move) -> tuple[int, int]:
    """Change the order as ``move`` says, not yet the tables; its first and last place that changed."""
    order = tables.order
    part = order[move.first : move.last + 1].copy()
    if move.turned:
        part = part[::-1].copy()
    count = len(part)
    if move.kind == REVERSED:
        order[move.first : move.last + 1] = part
        return move.first, move.last
    if move.after > move.last:
        order[move.first : move.after + 1 - count] = order[move.last + 1 : move.after + 1].copy()
        order[move.after + 1 - count : move.after + 1] = part
        return move.first, move.after
    order[move.after + 1 + count : move.last + 1] = order[move.after + 1 : move.first].copy()
    order[move.after + 1 : move.after + 1 + count] = part
    return move.after + 1, move.last
