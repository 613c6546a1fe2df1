"""Make a whole tour shorter by local moves that keep every photo possible."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan2, hypot

import numpy as np
from numpy.typing import NDArray

from experiments.motion.geometry import Array, Ground, compiled
from experiments.motion.polishing import (
    dense,
    displace,
    sparse,
    take_if_shorter,
    way_length,
    word_lengths,
)

#: Rounds without a gain of this share after which it ends.
PATIENCE, GAIN = 4, 1e-4
#: Attitudes laid along a leg, and those that a word may pass over.
POINTS, PASSED = 48, 24


@compiled
def moved(
    ground: Ground, way: Array, ring_of: NDArray[np.int64], rings: Array, draws: Array, reach: float
) -> None:
    """Move single attitudes of ``way`` (n, 3), but for the first, where that makes it shorter.

    Those whose ``ring_of`` is not -1 stay on that ring: ``rings`` (k, 5) are x, y, least and
    greatest distance [m], and the heading less the bearing of the middle [rad].
    """
    count = len(way)
    lengths = word_lengths(ground, way)
    other, pieces = np.empty(3), np.empty((6, 3))
    for k in range(len(draws)):
        i = 1 + k % (count - 1)
        displace(ground, way[i], draws[k], reach, other)
        if ring_of[i] >= 0:
            ring = rings[ring_of[i]]
            away = hypot(other[0] - ring[0], other[1] - ring[1])
            # A hair inside, so that rounding leaves it on the ring.
            wanted = min(max(away, ring[2] + 1e-9), ring[3] - 1e-9)
            other[0] = ring[0] + (other[0] - ring[0]) * wanted / away
            other[1] = ring[1] + (other[1] - ring[1]) * wanted / away
            other[2] = atan2(ring[1] - other[1], ring[0] - other[0]) + ring[4]
        take_if_shorter(ground, way, lengths, i, other, pieces)


def polished(
    ground: Ground, legs: Sequence[Array], rings: Array, random: np.random.Generator, moves: int
) -> tuple[list[Array], float]:
    """Legs (n, 3) that are together not longer than ``legs``, and their length [m].

    Leg i leads to ring i of ``rings``, as `moved` wants them; ``moves`` are tried before the attitudes
    along the legs are laid anew.
    """
    best = list(legs)
    length = sum(float(way_length(ground, leg)) for leg in best)
    idle = 0
    while idle < PATIENCE:
        laid = [_laid(ground, leg, random) for leg in best]
        way = np.vstack([laid[0][:1], *(leg[1:] for leg in laid)])
        lasts = np.cumsum([len(leg) - 1 for leg in laid])
        ring_of = np.full(len(way), -1)
        ring_of[lasts] = np.arange(len(laid))
        draws = random.uniform(-1.0, 1.0, (moves, 4))
        draws[:, 3] = np.abs(draws[:, 3])
        moved(ground, way, ring_of, rings, draws, 2.0 * ground.radius)
        shorter = float(way_length(ground, way))
        idle = 0 if shorter < length * (1.0 - GAIN) else idle + 1
        if shorter < length:
            length = shorter
            firsts = [0, *lasts[:-1]]
            best = [way[a : b + 1] for a, b in zip(firsts, lasts, strict=True)]
    return best, length


def _laid(ground: Ground, leg: Array, random: np.random.Generator) -> Array:
    """The leg through other attitudes on it, where they make it no longer."""
    spacing = float(way_length(ground, leg)) / POINTS
    if spacing == 0.0:
        return leg
    rows = dense(ground, leg, spacing, spacing * float(random.random()))
    return np.asarray(sparse(ground, rows, PASSED))
