"""Destination attitudes for a program: from the start itself, and from restarts all over the map."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction.cells import possible_cells
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
    cells = possible_cells(program, bounds)
    if not len(cells):
        cells = possible_cells(program, bounds, [])
    chosen = ((np.arange(count) + rng.random()) * len(cells) / count).astype(np.int64)
    along = rng.random((count, 3))
    x = cells.x_lo[chosen] + along[:, 0] * (cells.x_hi - cells.x_lo)[chosen]
    y = cells.y_lo[chosen] + along[:, 1] * (cells.y_hi - cells.y_lo)[chosen]
    states = np.column_stack((x, y, np.pi * (1.0 - 2.0 * along[:, 2])))
    return descend(program, states, room=room)


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
    with the obstacles as one more constraint, which pushes them out. Without a ``room`` there are
    no obstacles. Only where no destination is free, blocked ones on the map are given. A program
    that says nothing about the attitude is satisfied at ``start`` or nowhere.
    """
    room = within(bounds) if room is None else room
    descent = from_start(program, start)
    free, blocked = _sorted_out(program, descent, room)
    if program.depends_on_attitude:
        tries = int(np.ceil(_OVERSAMPLING * count))
        more = _sorted_out(program, restarts(program, bounds, rng, tries), room)
        free, blocked = np.concatenate((free, more[0])), np.concatenate((blocked, more[1]))
    found = free if len(free) else blocked
    return found[_farthest_points(found, count)]


def _sorted_out(program: Program, descent: Descent, room: Room) -> tuple[Array, Array]:
    """Where the descents end that satisfy the program: in free places, and in blocked ones.

    Those that have ended in an obstacle are first pushed out of it.
    """
    blocked = clearances(room.shapes, descent.states) < room.clearance
    free = descent.states[descent.satisfied & ~blocked]
    if not blocked.any():
        return free, descent.states[:0]
    again = descend(program, descent.states[blocked], room=room)
    free = np.concatenate((free, again.states[again.satisfied]))
    low, high = room.shapes.bounds[:2], room.shapes.bounds[2:]
    on_map = ((low <= descent.states[:, :2]) & (descent.states[:, :2] <= high)).all(axis=1)
    return free, descent.states[descent.satisfied & blocked & on_map]


def _farthest_points(states: Array, count: int) -> NDArray[np.int64]:
    """Indices of ``count`` different states: the first, then always the one farthest from all."""
    if not len(states):
        return np.zeros(0, dtype=np.int64)
    spread = max(float(np.max(np.ptp(states[:, :2], axis=0))), 1.0)
    x, y = states[:, 0] / spread, states[:, 1] / spread
    turned = 0.5 * _HEADING_WEIGHT * np.exp(1j * states[:, 2])
    position = x + 1j * y
    chosen = [0]
    nearest = np.full(len(states), np.inf)
    while len(chosen) < count:
        last = chosen[-1]
        apart = np.abs(position - position[last]) + np.abs(turned - turned[last])
        np.minimum(nearest, apart, out=nearest)
        farthest = int(np.argmax(nearest))
        if nearest[farthest] <= _SAME:
            break
        chosen.append(farthest)
    return np.array(chosen, dtype=np.int64)
