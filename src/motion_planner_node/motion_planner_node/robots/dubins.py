"""Dubins paths: the shortest ways of a forward-only car between two attitudes without obstacles.

L. E. Dubins, "On curves of minimal length with a constraint on average curvature, and with
prescribed initial and terminal positions and tangents", American Journal of Mathematics 79 (1957).
"""

from __future__ import annotations

from math import acos, atan2, cos, hypot, inf, pi, sin, sqrt
from typing import NamedTuple

import numpy as np

from motion_planner_node.robots.kernel import kernel

#: Lengths [m] of the three pieces of a word.
Lengths = tuple[float, float, float]

#: Turns of the six words: 1 is left, 0 straight, -1 right.
TURNS = np.array([[1, 0, 1], [-1, 0, -1], [1, 0, -1], [-1, 0, 1], [1, -1, 1], [-1, 1, -1]])

#: How far [m] a word may end from where it should, so that it need not drive a full circle.
END_TOLERANCE = 5e-10


class Ends(NamedTuple):
    """The ends of words, and what all words between them are made of.

    dx, dy: [m] from the first to the last.
    heading0, heading1: [rad] of the first and the last, with cosines and sines.
    sine_half: of half the difference of the headings.
    cosine_middle, sine_middle: of the heading half-way between them.
    """

    dx: float
    dy: float
    heading0: float
    heading1: float
    cosine0: float
    sine0: float
    cosine1: float
    sine1: float
    sine_half: float
    cosine_middle: float
    sine_middle: float


@kernel
def _turned(angle: float, tolerance: float) -> float:
    """``angle`` in [0, 2 pi); what lacks less than ``tolerance`` [rad] of a full turn is none."""
    turn = 2.0 * pi
    # As the remainder, to the last bit, but quicker for what differences of angles are.
    if angle < 0.0:
        angle = angle + turn if angle >= -turn else angle % turn
    elif angle >= turn:
        angle = angle - turn if angle < 2.0 * turn else angle % turn
    return 0.0 if turn - angle <= tolerance else angle


@kernel
def _same_turns(
    side: float, radius: float, dx: float, dy: float, heading0: float, heading1: float
) -> Lengths:
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
def between(x0: float, y0: float, heading0: float, x1: float, y1: float, heading1: float) -> Ends:
    """The two ends of a word."""
    half, middle = 0.5 * (heading1 - heading0), 0.5 * (heading1 + heading0)
    return Ends(
        x1 - x0,
        y1 - y0,
        heading0,
        heading1,
        cos(heading0),
        sin(heading0),
        cos(heading1),
        sin(heading1),
        sin(half),
        cos(middle),
        sin(middle),
    )


@kernel
def dubins_word(word: int, radius: float, ends: Ends, longest: float) -> Lengths:
    """Lengths [m] of the three pieces of word number ``word``.

    Infinite when it does not exist, or when its middle piece alone is ``longest`` [m] or more: then
    the others are not worked out.  A piece follows the circle of turning radius ``radius`` [m] or a
    common tangent of two.
    """
    none = (inf, inf, inf)
    first, last = TURNS[word, 0], TURNS[word, 2]
    if word < 2:
        chord = 2.0 * radius * ends.sine_half * first
        dx, dy = ends.dx - chord * ends.cosine_middle, ends.dy - chord * ends.sine_middle
        if hypot(dx, dy) >= longest:
            return none
        return _same_turns(first, radius, dx, dy, ends.heading0, ends.heading1)
    dx = ends.dx - radius * (last * ends.sine1 - first * ends.sine0)
    dy = ends.dy + radius * (last * ends.cosine1 - first * ends.cosine0)
    distance = hypot(dx, dy)
    if word < 4:
        square = distance * distance - 4.0 * radius * radius
        if square < 0.0:
            return none
        straight = sqrt(square)
        if straight >= longest:
            return none
        toward = atan2(dy, dx) if distance > 0.0 else ends.heading0
        heading = toward + first * atan2(2.0 * radius, straight)
        exact = END_TOLERANCE / (straight + 2.0 * radius)
        return (
            radius * _turned(first * (heading - ends.heading0), exact),
            straight,
            radius * _turned(last * (ends.heading1 - heading), exact),
        )
    if distance > 4.0 * radius or pi * radius >= longest:
        return none
    base = acos(distance / (4.0 * radius))
    toward = atan2(dy, dx) if distance > 0.0 else ends.heading0
    tangent0 = toward + first * (base + 0.5 * pi)
    tangent1 = toward - first * (base + 0.5 * pi)
    exact = END_TOLERANCE / (4.0 * radius)
    return (
        radius * _turned(first * (tangent0 - ends.heading0), exact),
        radius * (pi + 2.0 * base),
        radius * _turned(last * (ends.heading1 - tangent1), exact),
    )


@kernel
def shortest_dubins(radius: float, ends: Ends, longest: float) -> tuple[float, int, Lengths]:
    """Length [m], number and pieces [m] of the shortest word of less than ``longest`` [m].

    Infinite and -1 when there is none.
    """
    shortest, number, lengths = longest, -1, (inf, inf, inf)
    for word in range(len(TURNS)):
        first, middle, last = dubins_word(word, radius, ends, shortest)
        if first + middle + last < shortest:
            shortest, number, lengths = first + middle + last, word, (first, middle, last)
    return (shortest if number >= 0 else inf), number, lengths
