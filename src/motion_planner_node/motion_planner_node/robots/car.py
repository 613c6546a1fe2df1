"""The paper's car: forward only, with a three-valued steering angle.

x' = v cos(heading), y' = v sin(heading), heading' = v / L tan(steering angle), where v > 0 and the
steering angle is one of -max, 0, +max.  Its shortest motions without obstacles are Dubins paths.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.dubins import (
    TURNS,
    Ends,
    Lengths,
    between,
    dubins_word,
    shortest_dubins,
)
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import COMPONENTS, Pose

MODEL = Model(
    name='car',
    components=COMPONENTS,
    steers=True,
    reverses=False,
    slides=False,
    turns=False,
    words=len(TURNS),
    space=base.DubinsStateSpace,
)


@kernel
def word(radius: float, number: int, start: Pose, end: Pose, pieces: NDArray[np.float64]) -> float:
    """Dubins word ``number`` as in `steering.word`."""
    return _write(radius, number, between(*start, *end), inf, pieces)


@kernel
def all_words(
    radius: float,
    start: Pose,
    end: Pose,
    longest: float,
    pieces: NDArray[np.float64],
    lengths: NDArray[np.float64],
) -> None:
    """All Dubins words as in `steering.all_words`."""
    ends = between(*start, *end)
    for number in range(len(TURNS)):
        lengths[number] = _write(radius, number, ends, longest, pieces[number])


@kernel
def shortest_length(radius: float, start: Pose, end: Pose) -> float:
    """Length [m] of the shortest Dubins word."""
    return shortest_dubins(radius, between(*start, *end), inf)[0]


@kernel
def shortest_word(
    radius: float, start: Pose, end: Pose, longest: float, pieces: NDArray[np.float64]
) -> tuple[float, int]:
    """Write the shortest Dubins word of less than ``longest`` [m], if any, to ``pieces`` (5, 4).

    Returns its length [m] and its number; infinite and -1 when there is none.
    """
    length, number, lengths = shortest_dubins(radius, between(*start, *end), longest)
    if number >= 0:
        pieces[:] = 0.0
        _put(radius, number, lengths, pieces)
    return length, number


@kernel
def _write(
    radius: float, number: int, ends: Ends, longest: float, pieces: NDArray[np.float64]
) -> float:
    lengths = dubins_word(number, radius, ends, longest)
    _put(radius, number, lengths, pieces)
    return lengths[0] + lengths[1] + lengths[2]


@kernel
def _put(radius: float, number: int, lengths: Lengths, pieces: NDArray[np.float64]) -> None:
    for i in range(3):
        pieces[i, 0] = TURNS[number, i] / radius
        pieces[i, 1] = lengths[i]
