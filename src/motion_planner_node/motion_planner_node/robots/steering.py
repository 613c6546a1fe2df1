"""Steering functions: motions between two attitudes without regard to obstacles, as words.

A word is a motion of a fixed kind of pieces.  Pieces are rows (curvature [1/m], signed length [m],
direction [rad], turn [rad]) as in `motion.Segment`; rows of zeros are no motion.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots import car
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.robots.registry import MODELS, STEERING, word_of_model

#: Pieces of a word at most.
MOST_PIECES = 5

_CAR = STEERING[car.MODEL.name]
_COUNTS = np.array([model.words for model in MODELS.values()])


@kernel
def words(steering: int) -> int:
    """How many words the model number ``steering`` has."""
    return int(_COUNTS[steering])


@kernel
def word(
    steering: int,
    radius: float,
    number: int,
    start: Pose,
    end: Pose,
    pieces: NDArray[np.float64],
) -> float:
    """Write word ``number`` from ``start`` to ``end`` to ``pieces`` (5, 4); return its length [m].

    ``radius`` [m] is the turning radius, 0 for models that turn on the spot.  The length, the sum
    of the pieces' absolute lengths, is infinite when there is no such word.
    """
    for i in range(MOST_PIECES):
        for k in range(4):
            pieces[i, k] = 0.0
    return word_of_model(steering, radius, number, start, end, pieces)


@kernel
def all_words(
    steering: int,
    radius: float,
    start: Pose,
    end: Pose,
    longest: float,
    pieces: NDArray[np.float64],
    lengths: NDArray[np.float64],
) -> None:
    """Write all words to ``pieces`` (w, 5, 4) and their lengths [m] to ``lengths`` (w,), as `word`.

    Of those that are ``longest`` [m] or more some may get infinite lengths.  ``pieces`` are zeros
    or what was written there for the same model.
    """
    if steering == _CAR:
        car.all_words(radius, start, end, longest, pieces, lengths)
        return
    for number in range(len(lengths)):
        lengths[number] = word(steering, radius, number, start, end, pieces[number])


@kernel
def tells_shortest(steering: int) -> bool:
    """Whether `shortest_word` takes much less than `all_words` for the model."""
    return steering == _CAR


@kernel
def shortest_word(
    steering: int,
    radius: float,
    start: Pose,
    end: Pose,
    longest: float,
    pieces: NDArray[np.float64],
) -> tuple[float, int]:
    """Write the shortest word of less than ``longest`` [m], the first of equals, to ``pieces`` (5, 4).

    Returns its length [m] and its number; infinite and -1 when there is none.
    """
    if steering == _CAR:
        return car.shortest_word(radius, start, end, longest, pieces)
    shortest, chosen = longest, -1
    for number in range(words(steering)):
        length = word(steering, radius, number, start, end, pieces)
        if length < shortest:
            shortest, chosen = length, number
    if chosen < 0:
        return inf, chosen
    word(steering, radius, chosen, start, end, pieces)
    return shortest, chosen


@kernel
def shortest_length(
    steering: int, radius: float, start: Pose, end: Pose, pieces: NDArray[np.float64]
) -> float:
    """Length [m] of the shortest word; ``pieces`` (5, 4) is overwritten.

    Much quicker than one word after the other for the car.
    """
    if steering == _CAR:
        return car.shortest_length(radius, start, end)
    shortest = inf
    for number in range(words(steering)):
        shortest = min(shortest, word(steering, radius, number, start, end, pieces))
    return shortest


@kernel
def shortest_lengths(
    steering: int, radius: float, starts: NDArray[np.float64], ends: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Lengths [m], shape (n,), of the shortest words from ``starts`` to ``ends``, both (n, 3)."""
    shortest, pieces = np.empty(len(starts)), np.zeros((MOST_PIECES, 4))
    for i in range(len(starts)):
        start = (starts[i, 0], starts[i, 1], starts[i, 2])
        end = (ends[i, 0], ends[i, 1], ends[i, 2])
        shortest[i] = shortest_length(steering, radius, start, end, pieces)
    return shortest
