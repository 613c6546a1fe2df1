"""How much the search for the best known tour tries, in counts."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Effort:
    """What one round tries.

    orders: orders of the photos that are made shorter
    bearings, distances: attitudes laid round an objective
    around: bearings from a corner, or from the middle of a disc, at which attitudes are laid round it
    moves: local moves of a whole tour before it is laid anew
    """

    orders: int
    bearings: int
    distances: int
    around: int
    moves: int


FULL = Effort(orders=24, bearings=72, distances=5, around=16, moves=12_000)
QUICK = Effort(orders=2, bearings=12, distances=2, around=4, moves=600)
