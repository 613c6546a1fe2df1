"""Short tours through many groups of attitudes: insertion, Or-opt, 2-opt, and double bridges.

Every move is valued with the attitudes that are best after it: a table of the ways to each place and
one of the ways on from there, and a step of dynamic programming for what is between.  So the moves
are those of the generalised, asymmetric travelling-salesman problem; the precedences bound them.

I. Or (1976); G. A. Croes (1958); O. Martin, S. W. Otto, E. W. Felten, "Large-step Markov chains for
the traveling salesman problem" (1991).
"""

from __future__ import annotations

from math import inf

import numpy as np

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.chains import (
    Groups,
    Indices,
    best_chain,
    joined,
    step,
    ways_on,
    ways_to,
)
from motion_planner_node.tours.exact import any_order

#: Groups next to each other that are moved together at most.
MOST_MOVED = 3
#: What a move has to gain [m].
GAIN = 1e-3
#: Places between the first and the last cut of a double bridge at most.
BRIDGE = 50


@kernel
def best_place(groups: Groups, rest: Indices, moved: Indices) -> tuple[float, int]:
    """Length [m] of ``rest`` with ``moved`` inserted where that is shortest, and after which place.

    Infinite and -1 where the precedences leave no place or there is no way.
    """
    low, high = 0, len(rest)
    for place in range(1, len(rest)):
        for group in moved:
            if groups.before[rest[place], group]:
                low = place
            if groups.before[group, rest[place]]:
                high = min(high, place)
    to, on = ways_to(groups, rest), ways_on(groups, rest)
    widest = groups.sizes.max()
    ways, further = np.empty(widest), np.empty(widest)
    best, chosen = inf, -1
    for place in range(low, high):
        step(groups, rest[place], moved[0], to[place], ways)
        for k in range(1, len(moved)):
            step(groups, moved[k - 1], moved[k], ways, further)
            ways, further = further, ways
        last = moved[len(moved) - 1]
        if place + 1 < len(rest):
            length = joined(groups, last, rest[place + 1], ways, on[place + 1])
        else:
            length = ways[: groups.sizes[last]].min()
        if length < best:
            best, chosen = length, place
    return best, chosen


@kernel
def best_reversal(groups: Groups, order: Indices, end: int) -> tuple[float, int]:
    """Length [m] with the places from some first one to ``end`` reversed, and which is the first.

    Infinite and -1 where there is none.
    """
    to, on = ways_to(groups, order), ways_on(groups, order)
    widest = groups.sizes.max()
    head = order[end]
    # Ways through the reversed part, from each attitude of its head to each of its last group.
    through, further = np.full((widest, widest), inf), np.empty((widest, widest))
    for i in range(groups.sizes[head]):
        through[i, i] = 0.0
    ways, onward = np.empty(widest), np.empty(widest)
    best, chosen = inf, -1
    for first in range(end - 1, 0, -1):
        for place in range(first + 1, end + 1):
            if groups.before[order[first], order[place]]:
                return best, chosen
        for i in range(groups.sizes[head]):
            step(groups, order[first + 1], order[first], through[i], further[i])
        through, further = further, through
        step(groups, order[first - 1], head, to[first - 1], ways)
        onward[:] = inf
        for i in range(groups.sizes[head]):
            for j in range(groups.sizes[order[first]]):
                onward[j] = min(onward[j], ways[i] + through[i, j])
        if end + 1 < len(order):
            length = joined(groups, order[first], order[end + 1], onward, on[end + 1])
        else:
            length = onward[: groups.sizes[order[first]]].min()
        if length < best:
            best, chosen = length, first
    return best, chosen


def inserted(groups: Groups, sequence: Indices, should_stop: ShouldStop) -> Indices:
    """A tour that is built by inserting the groups of ``sequence`` where each is cheapest.

    :raises Stopped: when ``should_stop`` said so
    """
    order = np.zeros(1, np.int64)
    for group in sequence:
        go_on(should_stop)
        place = best_place(groups, order, np.array([group]))[1]
        if place < 0:
            return any_order(groups)
        order = np.insert(order, place + 1, group)
    return order


def improved(
    groups: Groups, order: Indices, changed: Indices, should_stop: ShouldStop
) -> tuple[float, Indices]:
    """Length [m] and a tour that no move makes shorter, where ``order`` is new about ``changed``.

    :raises Stopped: when ``should_stop`` said so
    """
    length = best_chain(groups, order)[0]
    waiting = list(dict.fromkeys(int(group) for group in changed))
    while waiting:
        go_on(should_stop)
        group = waiting.pop(0)
        better, candidate = _best_move(groups, order, group)
        if better < length - GAIN:
            places = np.flatnonzero(candidate != order)
            near = range(max(1, places[0] - 1), min(len(order), places[-1] + 2))
            if len(near) > 12:
                near = [*near[:6], *near[-6:]]  # type: ignore[assignment]
            length, order = better, candidate
            known = set(waiting)
            waiting += [int(order[k]) for k in near if int(order[k]) not in known]
    return length, order


def _best_move(groups: Groups, order: Indices, group: int) -> tuple[float, Indices]:
    """The best of the moves that begin or end at ``group``: the length [m] after it, and the tour."""
    place = int(np.flatnonzero(order == group)[0])
    best, result = inf, order
    for size in range(1, min(MOST_MOVED, len(order) - place) + 1):
        rest = np.delete(order, np.arange(place, place + size))
        moved = order[place : place + size].copy()
        for turned in (moved, moved[::-1].copy())[: 1 if size == 1 else 2]:
            if turned is not moved and groups.before[np.ix_(moved, moved)].any():
                continue
            length, after = best_place(groups, rest, turned)
            if length < best:
                best, result = length, np.insert(rest, after + 1, turned)
    length, first = best_reversal(groups, order, place)
    if length < best:
        best, result = length, order.copy()
        result[first : place + 1] = order[first : place + 1][::-1]
    return best, result


def short_tour(
    groups: Groups,
    begin: Indices | None,
    rng: np.random.Generator,
    bridges: int,
    should_stop: ShouldStop,
) -> Indices:
    """A short tour, from ``begin`` or from insertion on; ``bridges`` is how often it is shaken.

    :raises Stopped: when ``should_stop`` said so
    """
    goals = len(groups.first) - 1
    order = inserted(groups, 1 + rng.permutation(goals), should_stop) if begin is None else begin
    length, order = improved(groups, order, order[1:], should_stop)
    for _ in range(bridges if goals >= 4 else 0):
        shaken, cuts = _bridged(order, rng)
        if _breaks(groups, shaken):
            continue
        shorter, candidate = improved(groups, shaken, cuts, should_stop)
        if shorter < length:
            length, order = shorter, candidate
    return order


def _bridged(order: Indices, rng: np.random.Generator) -> tuple[Indices, Indices]:
    """``order`` with two neighbouring parts exchanged, and the groups at the cuts."""
    span = min(BRIDGE, len(order) - 1)
    begin = 1 + int(rng.integers(len(order) - span))
    a, b, c = np.sort(begin + rng.choice(span + 1, 3, replace=False)).tolist()
    shaken = np.concatenate((order[:a], order[b:c], order[a:b], order[c:]))
    ends = {a - 1, a, a + c - b - 1, a + c - b, c - 1, c}
    return shaken, shaken[[place for place in sorted(ends) if 1 <= place < len(order)]]


def _breaks(groups: Groups, order: Indices) -> bool:
    """Whether ``order`` breaks a precedence."""
    return bool(np.tril(groups.before[np.ix_(order, order)]).any())
