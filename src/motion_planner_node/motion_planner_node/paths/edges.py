"""Edges between attitudes: the shortest word that is free."""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.body import Body
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.robots.steering import MOST_PIECES, shortest_word, word, words
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.sweeps import word_is_free

Row = NDArray[np.float64]


@kernel
def shortest_is_free(
    shapes: Shapes, body: Body, steering: int, radius: float, start: Pose, end: Pose
) -> bool:
    """Whether the shortest word from a free attitude to another is free for ``body``.

    ``steering`` and turning ``radius`` [m] are those of `robots.steering`.
    """
    pieces = np.zeros((MOST_PIECES, 4))
    number = shortest_word(steering, radius, start, end, pieces)[1]
    return number >= 0 and word_is_free(shapes, body, start, pieces)


@kernel
def free_word(
    shapes: Shapes,
    body: Body,
    steering: int,
    radius: float,
    start: Row,
    end: Row,
    longest: float,
    pieces: NDArray[np.float64],
) -> tuple[float, int]:
    """Write the shortest free word of less than ``longest`` [m] to ``pieces`` (5, 4).

    Returns its length [m] and number, infinite and -1 when there is none; ``start`` and ``end`` are
    attitudes (3,).
    """
    here, there = (start[0], start[1], start[2]), (end[0], end[1], end[2])
    count = words(steering)
    lengths = np.empty(count)
    for number in range(count):
        lengths[number] = word(steering, radius, number, here, there, pieces)
    for _ in range(count):
        number = int(np.argmin(lengths))
        length = lengths[number]
        if not length < longest:
            break
        word(steering, radius, number, here, there, pieces)
        if word_is_free(shapes, body, here, pieces):
            return length, number
        lengths[number] = inf
    return inf, -1
