"""Destination attitudes for a program: from the start itself, and from restarts all over the map."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from math import ceil, hypot, inf, pi, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction.descent import Descent, descend
from motion_planner_node.satisfaction.program import Program
from motion_planner_node.satisfaction.room import ANYWHERE, Room, within
from motion_planner_node.world.clearance import clearances
from motion_planner_node.world.model import Bounds

#: Descents for each destination that is wanted.
_OVERSAMPLING = 2.5

#: Share of the positions' spread that opposite headings count as.
_HEADING_WEIGHT = 0.5

#: Destinations nearer than this, in units of the spread, are the same one.
_SAME = 1e-6

#: Where destinations are looked for near the start: round it, at these multiples of the reach, and
#: at those of so many places for each destination that is wanted that are nearest by travel.
_AROUND = (0.1, 0.5, 1.0, 2.0, 4.0)
_PLACES = 24


class Travel(NamedTuple):
    """How far it is from the start.

    ways: estimated lengths [m], (n,), of the ways to attitudes (n, 3), quickly.
    lengths: the same with what the robot's steering makes of them.
    reach: distance [m] within which it matters how the robot steers.
    """

    ways: Callable[[Array], Array]
    lengths: Callable[[Array], Array]
    reach: float


def from_start(program: Program, start: Attitude, room: Room = ANYWHERE) -> Descent:
    """The descent from ``start`` alone, with which Algorithm 1 begins."""
    return descend(program, np.array([[start.x, start.y, start.heading]]), room=room)


def restarts(
    program: Program,
    bounds: Bounds,
    rng: np.random.Generator,
    count: int,
    room: Room = ANYWHERE,
) -> Descent:
    """``count`` descents from random attitudes, spread evenly over where they can succeed.

    Line 13 of Algorithm 1. Where no place can, the attitudes are spread over the whole map.
    """
    return descend(program, _spread_out(program, bounds, rng, count), room=room)


def _spread_out(program: Program, bounds: Bounds, rng: np.random.Generator, count: int) -> Array:
    """``count`` random attitudes (count, 3), spread evenly over where descents can succeed."""
    return _placed(program.places(bounds), rng.random(), rng.random((count, 3)))


@kernel
def _placed(cells: Array, first: float, shares: Array) -> Array:
    """An attitude (n, 3) for each row of ``shares`` (n, 3), evenly over ``cells`` from one on."""
    result = np.empty(shares.shape)
    for index in range(len(shares)):
        cell = int((index + first) * len(cells) / len(shares))
        for axis in range(2):
            low, high = cells[cell, axis], cells[cell, 2 + axis]
            result[index, axis] = low + shares[index, axis] * (high - low)
        result[index, 2] = pi * (1.0 - 2.0 * shares[index, 2])
    return result


def destinations(
    program: Program,
    start: Attitude,
    bounds: Bounds,
    rng: np.random.Generator,
    count: int,
    room: Room | None = None,
) -> Array:
    """At most ``count`` different attitudes (k, 3) in ``room`` that satisfy the program.

    The descent from ``start`` comes first if it succeeds; each further attitude is the one farthest
    from those before it. Descents that end in an obstacle, or outside ``bounds``, go on from there
    with the obstacles as one more constraint, which pushes them out. Without a ``room`` there are no
    obstacles. Only where no destination is free, blocked ones on the map are given. A program that
    says nothing about the attitude is satisfied at ``start`` or nowhere.
    """
    begin = _begin(program, start, bounds, rng, count)
    found = _sorted_out(program, descend(program, begin), room or within(bounds))
    return found[farthest_points(found, count)]


def destinations_by_travel(
    program: Program,
    start: Attitude,
    bounds: Bounds,
    rng: np.random.Generator,
    count: int,
    room: Room,
    travel: Travel,
) -> tuple[Array, Array]:
    """As `destinations`, and as many attitudes again: those that are nearest by ``travel``.

    For them descents also begin round the start, and where it is near. The second array (k,) are
    the ``travel.lengths`` of the attitudes.
    """
    begin = _begin(program, start, bounds, rng, count)
    if program.depends_on_attitude:
        begin = np.concatenate((begin, _near(program, begin[0], bounds, rng, count, travel)))
    found = _sorted_out(program, descend(program, begin), room)
    lengths = travel.lengths(found)
    chosen = farthest_points(found, count)
    is_added = np.zeros(len(found), np.bool_)
    is_added[np.argsort(lengths, kind='stable')[:count]] = True
    is_added[chosen] = False
    chosen = np.concatenate((chosen, np.flatnonzero(is_added)))
    return found[chosen], lengths[chosen]


def _begin(
    program: Program, start: Attitude, bounds: Bounds, rng: np.random.Generator, count: int
) -> Array:
    """Where descents to ``count`` destinations begin: (n, 3), the ``start`` first."""
    begin = np.array([[start.x, start.y, start.heading]])
    if not program.depends_on_attitude:
        return begin
    spread = _spread_out(program, bounds, rng, ceil(_OVERSAMPLING * count))
    return np.concatenate((begin, spread))


def _near(
    program: Program,
    start: Array,
    bounds: Bounds,
    rng: np.random.Generator,
    count: int,
    travel: Travel,
) -> Array:
    """Attitudes (n, 3) round ``start`` (3,), and others where descents can succeed near to it."""
    around = rng.normal(size=(count, 3))
    around[:, :2] *= travel.reach * _reaches(count)
    places = _spread_out(program, bounds, rng, _PLACES * count)
    nearest = np.argsort(travel.ways(places), kind='stable')[: 2 * count]
    return np.concatenate((start + around, places[nearest]))


@lru_cache(maxsize=16)
def _reaches(count: int) -> Array:
    """Multiples (count, 1) of the reach, in turn."""
    return np.resize(_AROUND, (count, 1))


def _sorted_out(program: Program, descent: Descent, room: Room) -> Array:
    """Where the descents end that satisfy the program, in their order: free places if there are any.

    Those that have ended in an obstacle are first pushed out of it.
    """
    blocked = clearances(room.shapes, descent.states) < room.clearance
    states, free = descent.states.copy(), descent.satisfied & ~blocked
    if blocked.any():
        again = descend(program, states[blocked], room=room)
        states[blocked], free[blocked] = again.states, again.satisfied
    if free.any():
        return states[free]
    low, high = room.shapes.bounds[:2], room.shapes.bounds[2:]
    on_map = ((low <= descent.states[:, :2]) & (descent.states[:, :2] <= high)).all(axis=1)
    return descent.states[descent.satisfied & blocked & on_map]


@kernel
def farthest_points(states: Array, count: int) -> NDArray[np.int64]:
    """Indices of ``count`` different states: the first, then always the one farthest from all."""
    total = len(states)
    chosen, size, last = np.zeros(min(count, total), np.int64), 0, 0
    if total == 0:
        return chosen
    spread = max(np.ptp(states[:, 0]), np.ptp(states[:, 1]), 1.0)
    nearest = np.full(total, inf)
    while size < len(chosen):
        chosen[size] = last
        size += 1
        farthest, most = 0, -inf
        for index in range(total):
            east, north = states[index, 0] - states[last, 0], states[index, 1] - states[last, 1]
            # Seldom: most are too far away on one axis to be nearer than before.
            if max(abs(east), abs(north)) / spread < nearest[index]:
                turned = abs(sin(0.5 * (states[index, 2] - states[last, 2])))
                apart = hypot(east, north) / spread + _HEADING_WEIGHT * turned
                nearest[index] = min(nearest[index], apart)
            if nearest[index] > most:
                farthest, most = index, nearest[index]
        if most <= _SAME:
            break
        last = farthest
    return chosen[:size]
