"""Edges between attitudes: the shortest Dubins word that is free."""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.dubins import dubins_word, shortest_word
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.sweeps import word_is_free

Row = NDArray[np.float64]


@kernel
def shortest_is_free(
    shapes: Shapes,
    margin: float,
    radius: float,
    x0: float,
    y0: float,
    heading0: float,
    x1: float,
    y1: float,
    heading1: float,
) -> bool:
    """Whether the shortest word from a free attitude to another is free for ``margin`` [m]."""
    word, a, b, c = shortest_word(radius, x0, y0, heading0, x1, y1, heading1)
    return word_is_free(shapes, margin, radius, (x0, y0, heading0), word, (a, b, c))


@kernel
def free_word(
    shapes: Shapes, margin: float, radius: float, start: Row, end: Row, longest: float
) -> tuple[float, int]:
    """Length [m] and number of the shortest free word of less than ``longest`` [m].

    Infinite and -1 when there is none; ``start`` and ``end`` are attitudes (3,).
    """
    x0, y0, heading0 = start[0], start[1], start[2]
    x1, y1, heading1 = end[0], end[1], end[2]
    lengths = np.empty(6)
    for word in range(6):
        a, b, c = dubins_word(word, radius, x0, y0, heading0, x1, y1, heading1)
        lengths[word] = a + b + c
    for _ in range(6):
        word = int(np.argmin(lengths))
        length = lengths[word]
        if not length < longest:
            break
        pieces = dubins_word(word, radius, x0, y0, heading0, x1, y1, heading1)
        if word_is_free(shapes, margin, radius, (x0, y0, heading0), word, pieces):
            return length, word
        lengths[word] = inf
    return inf, -1
