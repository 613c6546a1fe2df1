"""Make a way of the lattice shorter by local moves, its end anywhere in the goal."""

from __future__ import annotations

from math import hypot, inf, pi

import numpy as np

from experiments.motion.aims import Aim, heading_error, in_goal
from experiments.motion.geometry import (
    Array,
    Ground,
    advanced,
    compiled,
    free_word,
    turn_of,
)

#: What a word costs [m] per turning radius beside its length, so that of equal ways the simpler is taken.
WORD = 1e-7
ROUNDS = 4
POINTS = 64
MOVES = 1500


@compiled
def word_lengths(ground: Ground, way: Array) -> Array:
    """Lengths [m], (n - 1,), between the attitudes (n, 3) of ``way``."""
    pieces = np.empty((6, 3))
    lengths = np.empty(len(way) - 1)
    for i in range(len(lengths)):
        lengths[i] = free_word(ground, way[i], way[i + 1], inf, pieces)[0]
    return lengths


@compiled
def way_length(ground: Ground, way: Array) -> float:
    """Length [m] of the way through attitudes (n, 3); infinite where it is not free."""
    return float(word_lengths(ground, way).sum())


@compiled
def dense(ground: Ground, way: Array, spacing: float, phase: float) -> Array:
    """The attitudes of ``way`` and others along it."""
    pieces = np.empty((6, 3))
    rows = [(way[0, 0], way[0, 1], way[0, 2])]
    due = phase
    for i in range(len(way) - 1):
        _, word = free_word(ground, way[i], way[i + 1], inf, pieces)
        if word >= 0:
            x, y, heading = way[i, 0], way[i, 1], way[i, 2]
            for k in range(3):
                turn, length = turn_of(word, k), pieces[word, k]
                while due < length:
                    rows.append(advanced(x, y, heading, turn, due, ground.radius))
                    due += spacing
                due -= length
                x, y, heading = advanced(x, y, heading, turn, length, ground.radius)
        rows.append((way[i + 1, 0], way[i + 1, 1], way[i + 1, 2]))
    result = np.empty((len(rows), 3))
    for i in range(len(rows)):
        result[i, 0], result[i, 1], result[i, 2] = rows[i]
    return result


@compiled
def sparse(ground: Ground, rows: Array, most: int) -> Array:
    """Those of ``rows`` (n, 3), in order and not more than ``most`` apart, that make the way shortest."""
    count = len(rows)
    pieces = np.empty((6, 3))
    cost, before = np.full(count, inf), np.full(count, -1, np.int64)
    cost[0] = 0.0
    for j in range(1, count):
        for i in range(j - 1, max(j - most, 0) - 1, -1):
            longest = cost[j] - cost[i] - WORD * ground.radius
            if longest > hypot(rows[j, 0] - rows[i, 0], rows[j, 1] - rows[i, 1]):
                length, word = free_word(ground, rows[i], rows[j], longest, pieces)
                if word >= 0:
                    cost[j], before[j] = cost[i] + length + WORD * ground.radius, i
    chosen = [count - 1]
    while chosen[-1] > 0:
        chosen.append(before[chosen[-1]])
    result = np.empty((len(chosen), 3))
    for k in range(len(chosen)):
        result[k] = rows[chosen[len(chosen) - 1 - k]]
    return result


@compiled
def displace(ground: Ground, pose: Array, draw: Array, reach: float, other: Array) -> None:
    """Set ``other`` (3,) to ``pose`` (3,), moved by up to ``reach`` [m] as ``draw`` (4,) has it."""
    size = reach * 0.5 ** (16.0 * draw[3])
    other[0] = pose[0] + size * draw[0]
    other[1] = pose[1] + size * draw[1]
    other[2] = pose[2] + min(size / ground.radius, pi) * draw[2]


@compiled
def take_if_shorter(
    ground: Ground, way: Array, lengths: Array, i: int, other: Array, pieces: Array
) -> None:
    """Put ``other`` in the place of attitude ``i`` > 0 where that makes ``way`` shorter.

    ``lengths`` are those of `word_lengths`, and are kept up to date; ``pieces`` (6, 3) are room.
    """
    is_last = i == len(way) - 1
    total = lengths[i - 1]
    if not is_last:
        total += lengths[i]
    first = free_word(ground, way[i - 1], other, total, pieces)[0]
    if not first < total:
        return
    second = 0.0
    if not is_last:
        second = free_word(ground, other, way[i + 1], total - first, pieces)[0]
    if first + second < total:
        way[i] = other
        lengths[i - 1] = first
        if not is_last:
            lengths[i] = second


@compiled
def moved(ground: Ground, way: Array, aim: Aim, draws: Array, reach: float) -> None:
    """Move single attitudes of ``way`` where that makes it shorter, the last within the goal."""
    count = len(way)
    if count < 2:
        return
    lengths = word_lengths(ground, way)
    other, pieces = np.empty(3), np.empty((6, 3))
    for k in range(len(draws)):
        i = 1 + k % (count - 1)
        displace(ground, way[i], draws[k], reach, other)
        if i == count - 1:
            if not in_goal(aim, other[0], other[1], 0.0):
                continue
            # Onto the headings that the goal allows: the nearest of them.
            off = heading_error(aim, other[0], other[1], other[2])
            if off > 0.0:
                step = off * (1.0 + 1e-15)
                if heading_error(aim, other[0], other[1], other[2] + step) > 1e-9:
                    step = -step
                other[2] += step
                if heading_error(aim, other[0], other[1], other[2]) > 1e-9:
                    continue
        take_if_shorter(ground, way, lengths, i, other, pieces)


def polished(
    ground: Ground, way: Array, aim: Aim, seed: int, rounds: int = ROUNDS
) -> tuple[Array, float]:
    """A way that is not longer than ``way`` (n, 3), and its length [m]."""
    random = np.random.default_rng(seed)
    best, length = way, float(way_length(ground, way))
    for number in range(rounds):
        spacing = length / POINTS if length > 0.0 else 1.0
        # At first the states of the lattice themselves, which may be many.
        rows = dense(ground, best, spacing, spacing * float(random.random())) if number else best
        candidate = sparse(ground, rows, POINTS)
        draws = random.uniform(-1.0, 1.0, (MOVES, 4))
        draws[:, 3] = np.abs(draws[:, 3])
        moved(ground, candidate, aim, draws, 2.0 * ground.radius)
        shorter = float(way_length(ground, candidate))
        if shorter < length:
            best, length = candidate, shorter
    return best, length
