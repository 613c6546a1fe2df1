"""Exact tours through sets of places: one place of each set, in whatever order is shortest.

The dynamic programming of Bellman, and of Held and Karp, over subsets of the sets, with a row of
costs instead of one number: what is left costs something else from each place of a set.
"""

from __future__ import annotations

import heapq
import itertools
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Costs:
    """What it costs [m] to drive, infinite where there is no way.

    first: for each set (m_j,) from the start to its places
    between: for each pair of sets (m_i, m_j) from places of the one to places of the other
    """

    first: Sequence[Array]
    between: Mapping[tuple[int, int], Array]


@dataclass(frozen=True)
class Tour:
    """Sets in the order of the tour, the place taken of each, and what it costs [m]."""

    length: float
    order: tuple[int, ...]
    places: tuple[int, ...]


def shortest_tours(costs: Costs) -> Iterator[Tour]:
    """The best tour of each order of the sets, the shortest first; orders without a way are left out."""
    count = len(costs.first)
    everything = (1 << count) - 1
    left = _left(costs)
    number = itertools.count()
    # Orders begun: a bound that is exact, and what it costs to each place of each set so far.
    begun = [(0.0, next(number), (), ())]
    heap: list[tuple[float, int, tuple[int, ...], tuple[Array, ...]]] = list(begun)
    while heap:
        bound, _, order, rows = heapq.heappop(heap)
        if len(order) == count:
            yield Tour(bound, order, _places(costs, order, rows))
            continue
        remaining = everything & ~sum(1 << i for i in order)
        for j in _members(remaining):
            row = costs.first[j] if not order else _after(rows[-1], costs.between[order[-1], j])
            through = float(np.min(row + left[remaining & ~(1 << j), j]))
            if through < np.inf:
                heapq.heappush(heap, (through, next(number), (*order, j), (*rows, row)))


def _left(costs: Costs) -> Mapping[tuple[int, int], Array]:
    """For the sets in a mask, met after set i: the least cost of meeting them from each place of i."""
    count = len(costs.first)
    left: dict[tuple[int, int], Array] = {}
    for mask in range(1 << count):
        for i in range(count):
            if mask >> i & 1:
                continue
            best = np.full(len(costs.first[i]), np.inf if mask else 0.0)
            for j in _members(mask):
                onwards = costs.between[i, j] + left[mask & ~(1 << j), j]
                best = np.minimum(best, onwards.min(axis=1, initial=np.inf))
            left[mask, i] = best
    return left


def _places(costs: Costs, order: Sequence[int], rows: Sequence[Array]) -> tuple[int, ...]:
    """Which place of each set the cheapest way to the last set goes through."""
    places = [int(np.argmin(rows[-1]))]
    for k in range(len(order) - 1, 0, -1):
        onwards = rows[k - 1] + costs.between[order[k - 1], order[k]][:, places[-1]]
        places.append(int(np.argmin(onwards)))
    return tuple(places[::-1])


def _after(row: Array, between: Array) -> Array:
    return np.asarray((row[:, None] + between).min(axis=0, initial=np.inf))


def _members(mask: int) -> Iterator[int]:
    return (i for i in range(mask.bit_length()) if mask >> i & 1)
