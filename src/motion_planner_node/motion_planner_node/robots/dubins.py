"""Dubins paths: the shortest ways of a forward-only car between two attitudes without obstacles.

L. E. Dubins, "On curves of minimal length with a constraint on average curvature, and with
prescribed initial and terminal positions and tangents", American Journal of Mathematics 79 (1957).
"""

from __future__ import annotations

from math import acos, atan2, cos, hypot, inf, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel

_End = tuple[float, float, float, float, float]

#: Turns of the six words: 1 is left, 0 straight, -1 right.
TURNS = np.array([[1, 0, 1], [-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, -1, 1], [-1, 1, -1]])

#: How far [m] a word may end from where it should, so that it need not drive a full circle.
END_TOLERANCE = 5e-10


@kernel
def _turned(angle: float, tolerance: float) -> float:
    """``angle`` in [0, 2 pi); what lacks less than ``tolerance`` [rad] of a full turn is none."""
    angle = angle % (2.0 * pi)
    return 0.0 if 2.0 * pi - angle <= tolerance else angle


@kernel
def _same_turns(
    side: float, radius: float, dx: float, dy: float, heading0: float, heading1: float
) -> tuple[float, float, float]:
    """Pieces [m] of the word that turns to the same ``side``, 1 or -1, at both ends.

    The straight piece joins circle centres that are (``dx``, ``dy``) [m] apart.  Where its heading
    is that of an end but for rounding it is made so, which hardly moves the end of the word.
    """
    straight = hypot(dx, dy)
    exact = END_TOLERANCE / (straight + 2.0 * radius)
    if straight < END_TOLERANCE:
        return radius * _turned(side * (heading1 - heading0), exact), 0.0, 0.0
    heading = atan2(dy, dx)
    aligned = 0.5 * min(END_TOLERANCE / straight, sqrt(END_TOLERANCE / radius))
    turn0 = _turned(side * (heading - heading0), aligned)
    if turn0 == 0.0:
        return 0.0, straight, radius * _turned(side * (heading1 - heading0), exact)
    turn1 = _turned(side * (heading1 - heading), aligned)
    if turn1 == 0.0:
        return radius * _turned(side * (heading1 - heading0), exact), straight, 0.0
    return radius * turn0, straight, radius * turn1


@kernel
def dubins_word(
    word: int,
    radius: float,
    x0: float,
    y0: float,
    heading0: float,
    x1: float,
    y1: float,
    heading1: float,
) -> tuple[float, float, float]:
    """Lengths [m] of the three pieces of word number ``word``, infinite when it does not exist.

    A piece follows the circle of turning radius ``radius`` [m] or a common tangent of two.
    """
    start = (x0, y0, heading0, cos(heading0), sin(heading0))
    end = (x1, y1, heading1, cos(heading1), sin(heading1))
    return _pieces(word, radius, start, end)


@kernel
def dubins_lengths(
    radius: float,
    x0: float,
    y0: float,
    heading0: float,
    x1: float,
    y1: float,
    heading1: float,
    lengths: NDArray[np.float64],
) -> None:
    """Fill ``lengths`` (6,) [m] with those of all words, infinite for those that do not exist."""
    start = (x0, y0, heading0, cos(heading0), sin(heading0))
    end = (x1, y1, heading1, cos(heading1), sin(heading1))
    for word in range(len(TURNS)):
        first, middle, last = _pieces(word, radius, start, end)
        lengths[word] = first + middle + last


@kernel
def _pieces(word: int, radius: float, start: _End, end: _End) -> tuple[float, float, float]:
    """As `dubins_word`, between ends of x, y, heading, and its cosine and sine."""
    x0, y0, heading0, cosine0, sine0 = start
    x1, y1, heading1, cosine1, sine1 = end
    first, last = TURNS[word, 0], TURNS[word, 2]
    if word < 2:
        half, middle = 0.5 * (heading1 - heading0), 0.5 * (heading1 + heading0)
        chord = 2.0 * radius * sin(half) * first
        dx, dy = (x1 - x0) - chord * cos(middle), (y1 - y0) - chord * sin(middle)
        return _same_turns(first, radius, dx, dy, heading0, heading1)
    dx = (x1 - x0) - radius * (last * sine1 - first * sine0)
    dy = (y1 - y0) + radius * (last * cosine1 - first * cosine0)
    distance = hypot(dx, dy)
    toward = atan2(dy, dx) if distance > 0.0 else heading0
    if word < 4:
        square = distance * distance - 4.0 * radius * radius
        if square < 0.0:
            return inf, inf, inf
        straight = sqrt(square)
        heading = toward + first * atan2(2.0 * radius, straight)
        exact = END_TOLERANCE / (straight + 2.0 * radius)
        return (
            radius * _turned(first * (heading - heading0), exact),
            straight,
            radius * _turned(last * (heading1 - heading), exact),
        )
    if distance > 4.0 * radius:
        return inf, inf, inf
    base = acos(distance / (4.0 * radius))
    tangent0 = toward + first * (base + 0.5 * pi)
    tangent1 = toward - first * (base + 0.5 * pi)
    exact = END_TOLERANCE / (4.0 * radius)
    return (
        radius * _turned(first * (tangent0 - heading0), exact),
        radius * (pi + 2.0 * base),
        radius * _turned(last * (heading1 - tangent1), exact),
    )
