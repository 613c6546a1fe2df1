"""Distances, Dubins words and collisions once more, for the reference: nothing of the planner's.

A motion counts as free when its disc is free at points so close together that none between them
can be nearer to an obstacle than ``slack`` allows, which is added to the disc.
"""

from __future__ import annotations

from collections.abc import Callable
from math import acos, atan2, ceil, cos, floor, hypot, inf, pi, sin, sqrt, tau
from typing import Any, NamedTuple, TypeVar, cast

import numba
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
_Function = TypeVar('_Function', bound=Callable[..., Any])


def compiled(function: _Function) -> _Function:
    """Compile ``function`` with numba, anew in each process."""
    return cast(_Function, numba.njit(nogil=True, error_model='numpy')(function))


class Ground(NamedTuple):
    """A world for one disc.

    bounds: (4,) x_min, y_min, x_max, y_max [m]
    edges: (e, 4) straight boundaries; discs: (d, 3) x, y, radius
    first, items: what is near each bucket: items[first[b]:first[b + 1]], discs after edges
    bucket: side [m] of a bucket; columns: buckets in a row
    reach: [m] up to which distances are told
    disc: [m] its radius; margin: the same with slack; step: [m] between two tested points
    """

    bounds: Array
    edges: Array
    discs: Array
    first: NDArray[np.int64]
    items: NDArray[np.int32]
    bucket: float
    columns: int
    reach: float
    disc: float
    margin: float
    step: float
    radius: float


@compiled
def _to_edge(x: float, y: float, edge: Array) -> float:
    dx, dy = edge[2] - edge[0], edge[3] - edge[1]
    square = dx * dx + dy * dy
    along = ((x - edge[0]) * dx + (y - edge[1]) * dy) / square if square > 0.0 else 0.0
    along = min(max(along, 0.0), 1.0)
    return hypot(x - edge[0] - along * dx, y - edge[1] - along * dy)


@compiled
def fill_buckets(
    bounds: Array, edges: Array, discs: Array, bucket: float, columns: int, rows: int, reach: float
) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Which edges and discs come nearer than ``reach`` to each bucket."""
    first = np.zeros(columns * rows + 1, np.int64)
    items = np.empty(0, np.int32)
    far = reach + 0.7072 * bucket
    for turn in range(2):
        if turn == 1:
            for b in range(columns * rows):
                first[b + 1] += first[b]
            items = np.empty(first[-1], np.int32)
            at = first[:-1].copy()
        for k in range(len(edges) + len(discs)):
            if k < len(edges):
                e = edges[k]
                low_x, high_x = min(e[0], e[2]), max(e[0], e[2])
                low_y, high_y = min(e[1], e[3]), max(e[1], e[3])
            else:
                d = discs[k - len(edges)]
                low_x, high_x, low_y, high_y = d[0] - d[2], d[0] + d[2], d[1] - d[2], d[1] + d[2]
            i0 = max(0, floor((low_x - far - bounds[0]) / bucket))
            i1 = min(columns - 1, floor((high_x + far - bounds[0]) / bucket))
            j0 = max(0, floor((low_y - far - bounds[1]) / bucket))
            j1 = min(rows - 1, floor((high_y + far - bounds[1]) / bucket))
            for j in range(j0, j1 + 1):
                for i in range(i0, i1 + 1):
                    x = bounds[0] + (i + 0.5) * bucket
                    y = bounds[1] + (j + 0.5) * bucket
                    if k < len(edges):
                        away = _to_edge(x, y, edges[k])
                    else:
                        disc = discs[k - len(edges)]
                        away = hypot(x - disc[0], y - disc[1]) - disc[2]
                    if away <= far:
                        b = j * columns + i
                        if turn == 0:
                            first[b + 1] += 1
                        else:
                            items[at[b]] = k
                            at[b] += 1
    return first, items


@compiled
def clearance(ground: Ground, x: float, y: float) -> float:
    """Distance [m] to the nearest boundary, at most ``reach``; of discs and bounds signed."""
    bounds = ground.bounds
    edge = min(x - bounds[0], bounds[2] - x, y - bounds[1], bounds[3] - y)
    best: float = min(float(edge), ground.reach)
    if best < 0.0:
        return best
    columns = ground.columns
    i = min(int((x - bounds[0]) / ground.bucket), columns - 1)
    rows = (len(ground.first) - 1) // columns
    b = min(int((y - bounds[1]) / ground.bucket), rows - 1) * columns + i
    count = len(ground.edges)
    for k in range(ground.first[b], ground.first[b + 1]):
        item = ground.items[k]
        if item < count:
            best = min(best, _to_edge(x, y, ground.edges[item]))
        else:
            d = ground.discs[item - count]
            best = min(best, hypot(x - d[0], y - d[1]) - d[2])
    return best


@compiled
def advanced(
    x: float, y: float, heading: float, turn: int, length: float, radius: float
) -> tuple[float, float, float]:
    """Where a drive of ``length`` [m] leads; ``turn`` is 1 for left, 0 straight, -1 right."""
    if turn == 0:
        return x + length * cos(heading), y + length * sin(heading), heading
    after = heading + turn * length / radius
    return (
        x + turn * radius * (sin(after) - sin(heading)),
        y - turn * radius * (cos(after) - cos(heading)),
        after,
    )


@compiled
def drive_is_free(
    ground: Ground, x: float, y: float, heading: float, turn: int, length: float
) -> bool:
    """Whether the disc is free on an arc or a straight way of ``length`` [m]."""
    done = 0.0
    while True:
        px, py, _ = advanced(x, y, heading, turn, done, ground.radius)
        room = clearance(ground, px, py) - ground.margin
        if room < 0.0:
            return False
        if done >= length:
            return True
        done = min(done + max(room, ground.step), length)


#: Edges from which on they are kept in smaller buckets.
MANY_EDGES = 1000
# Turns of the six Dubins words.
_TURNS = np.array([[1, 0, 1], [-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, -1, 1], [-1, 1, -1]])


@compiled
def _word(word: int, distance: float, alpha: float, beta: float) -> tuple[float, float, float]:
    """Pieces of a Dubins word in turning radii, after Shkel and Lumelsky; infinite for none."""
    if word in (1, 3, 5):
        # The mirror image of the word before.
        return _word_left(word - 1, distance, -alpha, -beta)
    return _word_left(word, distance, alpha, beta)


@compiled
def _turned(angle: float) -> float:
    """``angle`` [rad] in [0, 2 pi), where next to nothing below a full turn is none."""
    angle = angle % tau
    return 0.0 if tau - angle < 1e-9 else angle


@compiled
def _word_left(word: int, d: float, alpha: float, beta: float) -> tuple[float, float, float]:
    sa, sb, ca, cb = sin(alpha), sin(beta), cos(alpha), cos(beta)
    if word == 0:  # left, straight, left
        dx, dy = d + sa - sb, cb - ca
        toward = atan2(dy, dx)
        if hypot(dx, dy) < 1e-10:
            return _turned(beta - alpha), 0.0, 0.0
        return _turned(toward - alpha), hypot(dx, dy), _turned(beta - toward)
    if word == 2:  # left, straight, right
        dx, dy = d + sa + sb, -ca - cb
        square = dx * dx + dy * dy - 4.0
        if square < 0.0:
            return inf, inf, inf
        straight = sqrt(square)
        toward = atan2(dy, dx) + atan2(2.0, straight)
        return _turned(toward - alpha), straight, _turned(toward - beta)
    dx, dy = d + sa - sb, cb - ca  # left, right, left
    away = hypot(dx, dy)
    if away > 4.0:
        return inf, inf, inf
    middle = pi + 2.0 * acos(0.25 * away)
    first = _turned(atan2(dy, dx) + 0.5 * middle - alpha)
    return first, middle, _turned(beta - alpha - first + middle)


@compiled
def dubins(radius: float, start: Array, end: Array, lengths: Array, pieces: Array) -> None:
    """Fill in the lengths (6,) [m] and pieces (6, 3) [m] of all words between two attitudes."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    toward = atan2(dy, dx)
    distance = hypot(dx, dy) / radius
    alpha, beta = start[2] - toward, end[2] - toward
    for word in range(6):
        a, b, c = _word(word, distance, alpha, beta)
        pieces[word, 0], pieces[word, 1], pieces[word, 2] = radius * a, radius * b, radius * c
        lengths[word] = radius * (a + b + c)


@compiled
def dubins_length(radius: float, start: Array, end: Array) -> float:
    """Length [m] of the shortest Dubins word."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    toward = atan2(dy, dx)
    distance = hypot(dx, dy) / radius
    best = inf
    for word in range(6):
        a, b, c = _word(word, distance, start[2] - toward, end[2] - toward)
        best = min(best, a + b + c)
    return radius * best


@compiled
def free_word(
    ground: Ground, start: Array, end: Array, longest: float, pieces: Array
) -> tuple[float, int]:
    """Length [m] and number of the shortest free word below ``longest``; infinite and -1 for none.

    ``pieces`` (6, 3) is filled in.
    """
    lengths = np.empty(6)
    dubins(ground.radius, start, end, lengths, pieces)
    for _ in range(6):
        word = int(np.argmin(lengths))
        length = lengths[word]
        if not length < longest:
            break
        x, y, heading = start[0], start[1], start[2]
        free = True
        for k in range(3):
            if pieces[word, k] > 0.0:
                turn = _TURNS[word, k]
                if not drive_is_free(ground, x, y, heading, turn, pieces[word, k]):
                    free = False
                    break
                x, y, heading = advanced(x, y, heading, turn, pieces[word, k], ground.radius)
        if free:
            return length, word
        lengths[word] = inf
    return inf, -1


@compiled
def turn_of(word: int, piece: int) -> int:
    """Which way a piece of a word turns: 1 for left, 0 straight, -1 right."""
    return int(_TURNS[word, piece])


def make_ground(bounds: Array, edges: Array, discs: Array, disc: float, radius: float) -> Ground:
    """Prepare a world for a car with a disc of radius ``disc`` [m] that turns at ``radius`` [m]."""
    step = 0.05 * min(disc, radius)
    # Between two points of a curve at a distance `step`, its distance from an obstacle falls by at
    # most step^2 / 8 times the sum of the curvatures of the way and of the disc's rim.
    slack = step * step / 8.0 * (1.0 / disc + 1.0 / radius) + 1e-7
    # Where there are many boundaries, most of them had better be out of reach.
    far, side = (1.5, 0.5) if len(edges) < MANY_EDGES else (0.6, 0.15)
    reach = disc + far * radius
    bucket = max(side * radius, (bounds[2] - bounds[0]) / 800.0)
    columns = ceil((bounds[2] - bounds[0]) / bucket)
    rows = ceil((bounds[3] - bounds[1]) / bucket)
    first, items = fill_buckets(bounds, edges, discs, bucket, columns, rows, reach)
    return Ground(
        bounds, edges, discs, first, items, bucket, columns, reach, disc, disc + slack, step, radius
    )
