"""The paper's car: forward only, with a three-valued steering angle.

x' = v cos(heading), y' = v sin(heading), heading' = v / L tan(steering angle), where v > 0 and the
steering angle is one of -max, 0, +max.  Its shortest motions without obstacles are Dubins paths.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.dubins import TURNS, dubins_lengths, dubins_word
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
    lengths = dubins_word(number, radius, *start, *end)
    for i in range(3):
        pieces[i, 0] = TURNS[number, i] / radius
        pieces[i, 1] = lengths[i]
    return lengths[0] + lengths[1] + lengths[2]


@kernel
def word_lengths(radius: float, start: Pose, end: Pose, lengths: NDArray[np.float64]) -> None:
    """The lengths [m] of all words as in `steering.word_lengths`."""
    dubins_lengths(radius, *start, *end, lengths)
