"""Attitudes that photos can be taken from, attitudes at corners, and the words that join them."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, inf, pi

import numba
import numpy as np
from numpy.typing import NDArray

from experiments.motion.geometry import Array, Ground, compiled, free_word
from experiments.motion.goals import Goal
from experiments.motion.lattice import Lattice
from experiments.paper.best_known.effort import Effort
from experiments.paper.orders import Costs, Tour

#: Legs longer than this many times the straight way, and more turns beside, are of no use.
DETOUR, TURNS = 1.6, 8.0


@dataclass(frozen=True)
class Roadmap:
    """Attitudes (m, 3) of each goal, attitudes (w, 3) between them, and how they are joined.

    hops: (w, w) the next attitude between on the way from one to the other, -1 for none
    """

    goals: Sequence[Array]
    between: Array
    costs: Costs
    start: Array
    ground: Ground
    leaving: Sequence[Array]
    arriving: Sequence[Array]
    ways: Array
    hops: NDArray[np.int32]

    def leg(self, origin: int, place: int, goal: int, to: int) -> Array:
        """The attitudes (n, 3) of the way from one goal's place (-1 for the start) to another's."""
        first = self.start if origin < 0 else self.goals[origin][place]
        last = self.goals[goal][to]
        row = self.leaving[-1][0] if origin < 0 else self.leaving[origin][place]
        through = row[:, None] + self.ways + self.arriving[goal][:, to]
        a, b = np.unravel_index(int(np.argmin(through)), through.shape)
        direct = free_word(self.ground, first, last, inf, np.empty((6, 3)))[0]
        if direct <= through[a, b]:
            return np.vstack([first, last])
        nodes = [int(a)]
        while nodes[-1] != b:
            nodes.append(int(self.hops[nodes[-1], b]))
        return np.vstack([first, self.between[nodes], last])

    def legs(self, tour: Tour) -> list[Array]:
        """The attitudes (n, 3) of the ways that a tour takes from place to place."""
        stops = [(-1, 0), *zip(tour.order, tour.places, strict=True)]
        return [self.leg(*a, *b) for a, b in itertools.pairwise(stops)]


def photo_attitudes(
    goal: Goal, lattice: Lattice, random: np.random.Generator, effort: Effort
) -> Array:
    """Free attitudes (m, 3) of a goal on rings round its object, turned at random."""
    ring = goal.rings[0]
    bearings = np.linspace(-pi, pi, effort.bearings, endpoint=False) + random.uniform(0.0, 2.0 * pi)
    rows = [
        (
            ring.x + away * np.cos(bearing),
            ring.y + away * np.sin(bearing),
            bearing + pi + goal.angle,
        )
        for away in np.linspace(ring.low, ring.high, effort.distances)
        for bearing in bearings
    ]
    attitudes = np.array(rows)
    return attitudes[_inside(attitudes, lattice)]


def corner_attitudes(
    corners: Array, lattice: Lattice, random: np.random.Generator, effort: Effort
) -> Array:
    """Free attitudes (w, 3) that pass each of ``corners`` (c, 3) x, y, radius closely, either way."""
    margin = lattice.ground.margin
    bearings = np.linspace(0.0, 2.0 * pi, effort.around, endpoint=False) + random.uniform(
        0.0, 2.0 * pi
    )
    rows = [
        (
            x + (radius + margin + 0.05) * np.cos(bearing),
            y + (radius + margin + 0.05) * np.sin(bearing),
            bearing + side * 0.5 * pi,
        )
        for x, y, radius in corners
        for bearing in bearings
        for side in (-1.0, 1.0)
    ]
    attitudes = np.array(rows)
    return attitudes[_inside(attitudes, lattice)]


def make(start: Array, goals: Sequence[Array], between: Array, ground: Ground) -> Roadmap:
    """Join everything by free words, and find the shortest ways through the attitudes between."""
    ways, hops = shortest_ways(words(ground, between, between, joined_to_itself=True))
    leaving = [words(ground, rows, between) for rows in (*goals, start[None])]
    arriving = [words(ground, between, rows) for rows in goals]
    reached = [_through(row, ways) for row in leaving]
    costs = Costs(
        first=[
            np.minimum(words(ground, start[None], rows), _through(reached[-1], arriving[j]))[0]
            for j, rows in enumerate(goals)
        ],
        between={
            (i, j): np.minimum(words(ground, a, b), _through(reached[i], arriving[j]))
            for i, a in enumerate(goals)
            for j, b in enumerate(goals)
            if i != j
        },
    )
    return Roadmap(goals, between, costs, start, ground, leaving, arriving, ways, hops)


def _inside(rows: Array, lattice: Lattice) -> NDArray[np.bool_]:
    low, high = lattice.ground.bounds[:2], lattice.ground.bounds[2:]
    inside = np.asarray(((rows[:, :2] > low) & (rows[:, :2] < high)).all(axis=1))
    inside[inside] = lattice.is_free(rows[inside])
    return inside


@compiled
def words(ground: Ground, origins: Array, ends: Array, joined_to_itself: bool = False) -> Array:
    """Lengths (n, m) [m] of the shortest free words, infinite where they would be of no use."""
    lengths = np.full((len(origins), len(ends)), inf)
    pieces = np.empty((6, 3))
    for i in range(len(origins)):
        for j in range(len(ends)):
            if joined_to_itself and i == j:
                lengths[i, j] = 0.0
                continue
            away = hypot(ends[j, 0] - origins[i, 0], ends[j, 1] - origins[i, 1])
            longest = DETOUR * away + TURNS * ground.radius
            lengths[i, j] = free_word(ground, origins[i], ends[j], longest, pieces)[0]
    return lengths


@compiled
def shortest_ways(lengths: Array) -> tuple[Array, NDArray[np.int32]]:
    """Floyd and Warshall: the shortest ways (w, w) [m], and the next attitude on each."""
    count = len(lengths)
    ways = lengths.copy()
    hops = np.full((count, count), -1, np.int32)
    for i in range(count):
        for j in range(count):
            if ways[i, j] < inf:
                hops[i, j] = j
    for k in range(count):
        for i in range(count):
            head = ways[i, k]
            if head == inf:
                continue
            for j in range(count):
                if head + ways[k, j] < ways[i, j]:
                    ways[i, j] = head + ways[k, j]
                    hops[i, j] = hops[i, k]
    return ways, hops


@numba.njit(nogil=True, fastmath={'nsz', 'contract'})
def _through(left: Array, right: Array) -> Array:
    """The product (n, m) of (n, k) and (k, m) in which adding multiplies and the least is the sum."""
    result = np.full((len(left), right.shape[1]), inf)
    for i in range(len(left)):
        for k in range(len(right)):
            head = left[i, k]
            if head < inf:
                for j in range(right.shape[1]):
                    result[i, j] = min(result[i, j], head + right[k, j])
    return result
