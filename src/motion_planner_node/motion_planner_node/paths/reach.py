"""What a car that only drives forward may get to, over-estimated: for proofs that it gets nowhere else.

Attitudes are gathered in cells of place and heading. While a car of turning radius R drives s metres
(s / R at most a right angle), its heading turns by some D, -s / R <= D <= s / R. For each D its place is
within bounds in closed form: the heading is, all along, between those of turning one way as long as
can be and then the other. All cells that are met by these bounds are reached, from anywhere in a cell, unless the
car would have to pass places on the way that surely lack the clearance. So the car gets to no
attitude that is not within one stride of a cell that was reached.
"""

from __future__ import annotations

from functools import lru_cache
from math import ceil, floor, isnan, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.clearance import clearance_at
from motion_planner_node.world.shapes import Shapes

Array = NDArray[np.float64]

#: Cells of a full turn.
HEADINGS = 144
#: How far [turning radii] the car drives at a time.
STRIDE = 0.3
#: Cells on a side of the window that is looked at.
WINDOW = 128
#: Cells are no wider than these shares of the turning radius and of the clearance that is needed,
#: and places along a stride are no farther apart than that of the clearance: walls are not overlooked.
OF_RADIUS, OF_CLEARANCE, APART = 1.0 / 12.0, 0.5, 0.75
#: More than rounding moves a place [turning radii].
SLACK = 1e-9

_WIDTH = 2.0 * np.pi / HEADINGS
#: Cells that the heading may be off by at most after a stride.
_TURNS = int(np.ceil(STRIDE / _WIDTH))


class View(NamedTuple):
    """Where the window is on the map.

    x, y: [m] the place in the middle of the cell in its middle.
    cosine, sine: of the heading [rad] of its first axis.
    side: [m] of a cell.
    radius: [m] the turning radius.
    needed: [m] the least clearance of a place.
    """

    x: float
    y: float
    cosine: float
    sine: float
    side: float
    radius: float
    needed: float


class Search(NamedTuple):
    """How far a search has got.

    cells: (most, 3) that are reached, by both axes and heading; (0, 0, 0) is in the middle.
    waiting: (most,) numbers of those from which the car was not followed yet.
    sizes: (2,) how many there are of both.
    seen: (window, window, headings / 8) a bit for each cell that is reached, or that has no room.
    room: (2 window, 2 window) clearances [m] in the middles of quarters of cells, not a number where
        not known yet.
    """

    cells: NDArray[np.int64]
    waiting: NDArray[np.int64]
    sizes: NDArray[np.int64]
    seen: NDArray[np.uint8]
    room: Array


#: How a search goes: on, to its end, or out of the window or of room for more cells.
GOES_ON, ENDED, ESCAPED = range(3)


def _cosines(low: Array, high: Array) -> tuple[Array, Array]:
    """The least and the greatest cosine of the angles from ``low`` to ``high``."""
    ends = np.cos(low), np.cos(high)
    turn = 2.0 * np.pi
    has_most = np.floor(high / turn) >= np.ceil(low / turn)
    has_least = np.floor((high - np.pi) / turn) >= np.ceil((low - np.pi) / turn)
    least = np.where(has_least, -1.0, np.minimum(*ends))
    return least, np.where(has_most, 1.0, np.maximum(*ends))


def _turned(ahead: tuple[Array, Array], left: tuple[Array, Array], heading: NDArray[Any]) -> Array:
    """Bounds (..., 4) of moves: least and greatest of both axes, in units of the turning radius.

    ``ahead`` and ``left`` bound a move as a car sees it whose heading is ``heading``, give or take half a
    cell.
    """
    bounds = []
    for quarter in (0.0, 0.5 * np.pi):
        sides = []
        for f in ahead:
            for side in left:
                reach, angle = np.hypot(f, side), np.arctan2(side, f) + heading - quarter
                least, most = _cosines(angle - 0.5 * _WIDTH, angle + 0.5 * _WIDTH)
                sides.append((reach * least, reach * most))
        bounds.append(np.min([low for low, _ in sides], axis=0) - SLACK)
        bounds.append(np.max([high for _, high in sides], axis=0) + SLACK)
    return np.stack(np.broadcast_arrays(*bounds), axis=-1)


def _most_left(way: Array, turned: Array) -> Array:
    """How far left a car is at most after ``way``, that after a stride has turned by ``turned``."""
    turning = 0.5 * (STRIDE + turned)
    heading = np.where(way <= turning, way, 2.0 * turning - way)
    return np.where(
        way <= turning, 1.0 - np.cos(way), 1.0 - 2.0 * np.cos(turning) + np.cos(heading)
    )


@lru_cache(maxsize=8)
def strides(parts: int) -> Array:
    """Bounds (headings, 2 t + 1, parts, 4) of moves [turning radii], as `_turned` has them.

    From each cell of headings to each that is not more than t cells off, after each part of a stride.
    """
    offsets = np.arange(-_TURNS, _TURNS + 1)[None, :, None]
    heading = _WIDTH * np.arange(HEADINGS)[:, None, None]
    way = STRIDE * np.arange(1, parts + 1)[None, None, :] / parts
    least = np.clip(_WIDTH * (offsets - 1), -STRIDE, STRIDE)
    most = np.clip(_WIDTH * (offsets + 1), -STRIDE, STRIDE)
    left = -_most_left(way, -least), _most_left(way, most)
    return np.ascontiguousarray(_turned((np.sin(way), way), left, heading))


@lru_cache(maxsize=8)
def sweeps(parts: int) -> Array:
    """Bounds (headings, parts, 4) of moves [turning radii] during each part of a stride."""
    heading = _WIDTH * np.arange(HEADINGS)[:, None]
    begun = STRIDE * np.arange(parts)[None, :] / parts
    ended = begun + STRIDE / parts
    aside = 1.0 - np.cos(ended)
    return np.ascontiguousarray(_turned((np.sin(begun), ended), (-aside, aside), heading))


def parts_of(view: View) -> int:
    """In how many parts a stride is looked at."""
    return ceil(STRIDE * view.radius / (APART * view.needed))


def new_search(roots: NDArray[np.int64], most: int) -> Search:
    """A search from different cells ``roots`` (k, 3) in the window, that ends at ``most`` cells."""
    cells, waiting = np.empty((most, 3), np.int64), np.empty(most, np.int64)
    cells[: len(roots)], waiting[: len(roots)] = roots, np.arange(len(roots))
    seen = np.zeros((WINDOW, WINDOW, HEADINGS // 8), np.uint8)
    rows, columns = roots[:, 0] + WINDOW // 2, roots[:, 1] + WINDOW // 2
    bits = np.left_shift(1, roots[:, 2] % 8).astype(np.uint8)
    np.bitwise_or.at(seen, (rows, columns, roots[:, 2] // 8), bits)
    sizes = np.array([len(roots), len(roots)], np.int64)
    return Search(cells, waiting, sizes, seen, np.full((2 * WINDOW, 2 * WINDOW), np.nan))


@kernel
def _may_be_free(
    shapes: Shapes,
    view: View,
    room: Array,
    low_u: float,
    high_u: float,
    low_v: float,
    high_v: float,
) -> bool:
    """Whether a place in a box of the window may have the clearance; True where it is not in it."""
    half_side = 0.5 * view.side
    u, v = 0.5 * (low_u + high_u), 0.5 * (low_v + high_v)
    i, j = floor(u / half_side), floor(v / half_side)
    row, column = i + WINDOW, j + WINDOW
    if not (0 <= row < 2 * WINDOW and 0 <= column < 2 * WINDOW):
        return True
    middle_u, middle_v = (i + 0.5) * half_side, (j + 0.5) * half_side
    if isnan(room[row, column]):
        x = view.x + middle_u * view.cosine - middle_v * view.sine
        y = view.y + middle_u * view.sine + middle_v * view.cosine
        room[row, column] = clearance_at(shapes, x, y)[0]
    away = sqrt((u - middle_u) ** 2 + (v - middle_v) ** 2)
    half = 0.5 * sqrt((high_u - low_u) ** 2 + (high_v - low_v) ** 2)
    return bool(room[row, column] + (away + half) * (1.0 + 1e-9) >= view.needed)


@kernel
def _reach(
    shapes: Shapes,
    view: View,
    search: Search,
    heading: int,
    low_u: float,
    high_u: float,
    low_v: float,
    high_v: float,
) -> bool:
    """Take the cells of one heading that a box meets; whether they are in the window, and not too many."""
    side, half_window = view.side, WINDOW // 2
    bit = np.uint8(1 << (heading % 8))
    for i in range(floor(low_u / side + 0.5), floor(high_u / side + 0.5) + 1):
        for j in range(floor(low_v / side + 0.5), floor(high_v / side + 0.5) + 1):
            row, column = i + half_window, j + half_window
            if not (0 <= row < WINDOW and 0 <= column < WINDOW):
                return False
            if search.seen[row, column, heading // 8] & bit:
                continue
            search.seen[row, column, heading // 8] |= bit
            u, v = (i - 0.5) * side, (j - 0.5) * side
            if not _may_be_free(shapes, view, search.room, u, u + side, v, v + side):
                continue
            size, waiting = search.sizes[0], search.sizes[1]
            if size == len(search.cells):
                return False
            search.cells[size, 0], search.cells[size, 1], search.cells[size, 2] = i, j, heading
            search.waiting[waiting] = size
            search.sizes[0], search.sizes[1] = size + 1, waiting + 1
    return True


@kernel
def go_on(shapes: Shapes, view: View, moves: Array, search: Search, count: int) -> int:
    """Follow the car from at most ``count`` cells, by ``moves``, which are `strides`.

    The last ones that were reached come first: where there is a way out, it is soon found.
    """
    side = view.side
    for _ in range(count):
        if search.sizes[1] == 0:
            return ENDED
        search.sizes[1] -= 1
        cell = search.waiting[search.sizes[1]]
        heading = search.cells[cell, 2]
        low_u, low_v = (search.cells[cell, 0] - 0.5) * side, (search.cells[cell, 1] - 0.5) * side
        for number in range(moves.shape[1]):
            # Sharp turns first, so that what lies straight ahead is followed first.
            turn = number // 2 if number % 2 == 0 else moves.shape[1] - 1 - number // 2
            may_pass = True
            u0, u1, v0, v1 = 0.0, 0.0, 0.0, 0.0
            for part in range(moves.shape[2]):
                u0 = low_u + view.radius * moves[heading, turn, part, 0]
                u1 = low_u + side + view.radius * moves[heading, turn, part, 1]
                v0 = low_v + view.radius * moves[heading, turn, part, 2]
                v1 = low_v + side + view.radius * moves[heading, turn, part, 3]
                if not _may_be_free(shapes, view, search.room, u0, u1, v0, v1):
                    may_pass = False
                    break
            there = (heading + turn - moves.shape[1] // 2) % HEADINGS
            if may_pass and not _reach(shapes, view, search, there, u0, u1, v0, v1):
                return ESCAPED
    return GOES_ON
