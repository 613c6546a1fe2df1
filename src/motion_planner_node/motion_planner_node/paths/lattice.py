"""A best-first search over attitudes: from all destinations back to the start, or from the start on.

The idea of hybrid A*: attitudes are continuous, and of those that fall into one cell of place and
heading the cheapest is kept.  D. Dolgov, S. Thrun, M. Montemerlo and J. Diebel, "Path planning for
autonomous vehicles in unknown semi-structured environments", IJRR 29 (2010).
"""

from __future__ import annotations

from math import floor, inf, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import (
    Frame,
    Row,
    Rows,
    free_word,
    shortest_length,
    shortest_word_if_free,
)
from motion_planner_node.paths.field import Field, field_at
from motion_planner_node.paths.open_list import OpenList, empty_open_list, pop, push
from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES
from motion_planner_node.world.sweeps import word_is_free

#: What happened to a search.
GOES_ON, ENDED, EXHAUSTED, FULL = range(4)

_LEFT, _BEST, _NODES, _EXPANDED = range(4)


class Grain(NamedTuple):
    """How fine a search is.

    corner: (2,) of the map, where the cells begin.
    cell: side [m] of a cell of places.
    headings: cells of a full turn.
    weight: 1 for the shortest path of the lattice, more for a quick one.
    """

    corner: Row
    cell: float
    headings: int
    weight: float


class Task(NamedTuple):
    """What is searched for.

    target: (3,) the attitude that a way leads to, or comes from.
    sign: 1 for ways from the roots to the target, -1 for ways from the target to the roots.
    moves: (m, 4) pieces that the robot can drive in a step.
    prices: (m,) what they cost [m].
    any_word: whether the last stretch to the target may be any word, not only the shortest one.
    """

    target: Row
    sign: float
    moves: Rows
    prices: Row
    any_word: bool


class Lattice(NamedTuple):
    """The attitudes of one search.

    rows: (n, 3) attitudes.
    costs: (n,) length [m] of the way between each and the root that it was reached from.
    links: (n,) the attitude before it on that way; -1 - k at root k.
    closed: (n,) whether it was expanded, or a cheaper one has taken its cell.
    table, holders: hash table of cells, and which attitude holds each.
    counts: expansions that are left once there is a way, the attitude where the best way reaches the
        target (-1 for none), number of attitudes, of expansions.
    best: (1,) length [m] of the best way.
    """

    rows: Rows
    costs: Row
    links: NDArray[np.int64]
    closed: NDArray[np.bool_]
    queue: OpenList
    table: NDArray[np.int64]
    holders: NDArray[np.int64]
    counts: NDArray[np.int64]
    best: Row


def new_lattice(most: int, longest: float, improving: int) -> Lattice:
    """Room for ``most`` attitudes of ways of less than ``longest`` [m].

    Once there is a way, ``improving`` more attitudes are expanded.
    """
    size = 1 << (2 * most - 1).bit_length()
    return Lattice(
        rows=np.empty((most, 3)),
        costs=np.empty(most),
        links=np.empty(most, np.int64),
        closed=np.empty(most, np.bool_),
        queue=empty_open_list(most),
        table=np.full(size, -1, np.int64),
        holders=np.empty(size, np.int64),
        counts=np.array([improving, -1, 0, 0], np.int64),
        best=np.array([longest]),
    )


def enlarged(lattice: Lattice, most: int) -> Lattice:
    """The same with room for ``most`` attitudes, which are no fewer."""
    larger = new_lattice(most, 0.0, 0)._replace(counts=lattice.counts, best=lattice.best)
    count, waiting = attitudes(lattice), int(lattice.queue.size[0])
    for old, new in zip(lattice[:4], larger[:4], strict=True):
        new[:count] = old[:count]
    larger.queue.keys[:waiting] = lattice.queue.keys[:waiting]
    larger.queue.items[:waiting] = lattice.queue.items[:waiting]
    larger.queue.size[0] = waiting
    _move_cells(lattice.table, lattice.holders, larger.table, larger.holders)
    return larger


@kernel
def _move_cells(
    table: NDArray[np.int64],
    holders: NDArray[np.int64],
    larger: NDArray[np.int64],
    their_holders: NDArray[np.int64],
) -> None:
    for slot in range(len(table)):
        if table[slot] != -1:
            to = _find(larger, table[slot])
            larger[to], their_holders[to] = table[slot], holders[slot]


@kernel
def _find(table: NDArray[np.int64], key: int) -> int:
    """Where a key is in the table or belongs."""
    mask = len(table) - 1
    slot = (key * 40503 + (key >> 7)) & mask
    while table[slot] != -1 and table[slot] != key:
        slot = (slot + 1) & mask
    return slot


@kernel
def _slot(lattice: Lattice, grain: Grain, x: float, y: float, heading: float) -> tuple[int, int]:
    """Where in the table the cell of an attitude is or belongs, and its key."""
    turns = heading / (2.0 * pi)
    sector = int((turns - floor(turns)) * grain.headings + 0.5) % grain.headings
    column, row = int((x - grain.corner[0]) / grain.cell), int((y - grain.corner[1]) / grain.cell)
    key = ((column << 24) + row) * grain.headings + sector
    return _find(lattice.table, key), key


@kernel
def _is_wanted(lattice: Lattice, slot: int, cost: float) -> bool:
    """Whether an attitude of this cost is better than what holds its cell."""
    if lattice.table[slot] == -1:
        return True
    holder = lattice.holders[slot]
    return not lattice.closed[holder] and cost < lattice.costs[holder]


@kernel
def _add(
    lattice: Lattice, slot: int, key: int, pose: Row, cost: float, link: int, rank: float
) -> None:
    """Put an attitude that is wanted into its cell and into the queue."""
    i = lattice.counts[_NODES]
    lattice.counts[_NODES] = i + 1
    lattice.rows[i] = pose
    lattice.costs[i] = cost
    lattice.links[i] = link
    lattice.closed[i] = False
    if lattice.table[slot] != -1:
        lattice.closed[lattice.holders[slot]] = True
    lattice.table[slot] = key
    lattice.holders[slot] = i
    push(lattice.queue, rank, i)


@kernel
def _rest(frame: Frame, field: Field, task: Task, pose: Row, pieces: Rows) -> float:
    """Estimated length [m] between ``pose`` and the target, infinite when no way leads there."""
    around = field_at(field, pose[0], pose[1])
    if around == inf:
        return inf
    if task.sign > 0.0:
        return max(around, shortest_length(frame, pose, task.target, pieces))
    return max(around, shortest_length(frame, task.target, pose, pieces))


@kernel
def plant(
    lattice: Lattice, frame: Frame, field: Field, grain: Grain, task: Task, roots: Rows, costs: Row
) -> None:
    """Begin at free ``roots`` (k, 3), to which ways of ``costs`` (k,) have led.

    There has to be room for them.
    """
    pieces = np.zeros((MOST_PIECES, 4))
    for k in range(len(roots)):
        slot, key = _slot(lattice, grain, roots[k, 0], roots[k, 1], roots[k, 2])
        rest = _rest(frame, field, task, roots[k], pieces)
        if rest < inf and _is_wanted(lattice, slot, costs[k]):
            rank = costs[k] + grain.weight * rest
            _add(lattice, slot, key, roots[k], costs[k], -1 - k, rank)


@kernel
def _shot(frame: Frame, task: Task, here: Row, longest: float, pieces: Rows) -> float:
    """Length [m] of the shortest word between ``here`` and the target, infinite where it is not free."""
    start, end = (here, task.target) if task.sign > 0.0 else (task.target, here)
    if task.any_word:
        return free_word(frame, start, end, longest, pieces)[0]
    return shortest_word_if_free(frame, start, end, longest, pieces)


@kernel
def grow(
    lattice: Lattice, frame: Frame, field: Field, grain: Grain, task: Task, expansions: int
) -> int:
    """Expand at most ``expansions`` attitudes.

    ``field`` are distances from the target.  Returns GOES_ON; EXHAUSTED when nothing is left to
    expand; FULL when there is no room left; ENDED when no better way is to be expected.
    """
    bounds = frame.shapes.bounds
    pose, pieces = np.empty(3), np.zeros((MOST_PIECES, 4))
    moves, sign = task.moves, task.sign
    for _ in range(expansions):
        if lattice.queue.size[0] == 0:
            return EXHAUSTED
        if lattice.counts[_NODES] + len(moves) > len(lattice.costs):
            return FULL
        rank, i = pop(lattice.queue)
        if rank >= lattice.best[0]:
            return ENDED
        if lattice.closed[i]:
            continue
        lattice.closed[i] = True
        lattice.counts[_EXPANDED] += 1
        if lattice.counts[_BEST] >= 0:
            lattice.counts[_LEFT] -= 1
            if lattice.counts[_LEFT] < 0:
                return ENDED
        here = lattice.rows[i]
        longest = lattice.best[0] - lattice.costs[i]
        length = _shot(frame, task, here, longest, pieces)
        if length < longest:
            lattice.best[0] = lattice.costs[i] + length
            lattice.counts[_BEST] = i
            continue
        for m in range(len(moves)):
            bend, way, direction, turn = moves[m]
            x, y, heading = advance(
                here[0], here[1], here[2], bend, sign * way, direction, sign * turn
            )
            if not (bounds[0] < x < bounds[2] and bounds[1] < y < bounds[3]):
                continue
            cost = lattice.costs[i] + task.prices[m]
            slot, key = _slot(lattice, grain, x, y, heading)
            if not _is_wanted(lattice, slot, cost):
                continue
            pose[0], pose[1], pose[2] = x, y, heading
            first = here if sign > 0.0 else pose
            if word_is_free(
                frame.shapes, frame.body, (first[0], first[1], first[2]), moves[m : m + 1]
            ):
                rest = _rest(frame, field, task, pose, pieces)
                if rest < inf:
                    _add(lattice, slot, key, pose, cost, i, cost + grain.weight * rest)
    return GOES_ON


def last_of_best(lattice: Lattice) -> int:
    """Number of the attitude from which the best way reaches the target; -1 for none."""
    return int(lattice.counts[_BEST])


def way_to(lattice: Lattice, i: int) -> tuple[int, Rows]:
    """Number of the root from which attitude ``i`` was reached, and the attitudes (n, 3) from it to ``i``."""
    rows = []
    while i >= 0:
        rows.append(lattice.rows[i])
        i = int(lattice.links[i])
    return -1 - i, np.array(rows[::-1])


def best_root(lattice: Lattice) -> int:
    """Number of the root of the most promising attitude in the queue, which is not empty."""
    i = int(lattice.queue.items[0])
    while i >= 0:
        i = int(lattice.links[i])
    return -1 - i


def attitudes(lattice: Lattice) -> int:
    """How many attitudes there are."""
    return int(lattice.counts[_NODES])


def expanded(lattice: Lattice) -> int:
    """How many attitudes were expanded."""
    return int(lattice.counts[_EXPANDED])
