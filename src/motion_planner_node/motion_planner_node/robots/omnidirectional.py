"""The omnidirectional robot: slides in any direction, and turns on the spot.

x' = v cos(heading + direction), y' = v sin(heading + direction), heading' = w, where one of v and w
is 0 at any time.  A motion without obstacles slides straight there and turns, or turns before.
"""

from __future__ import annotations

from math import atan2, hypot, inf

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.arcs import other_way, wrap_angle
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import COMPONENTS, Pose

MODEL = Model(
    name='omnidirectional',
    components=COMPONENTS,
    steers=False,
    reverses=False,
    slides=True,
    turns=True,
    words=4,
    space=lambda _: base.SE2StateSpace(),
)


@kernel
def word(_: float, number: int, start: Pose, end: Pose, pieces: NDArray[np.float64]) -> float:
    """Slide and turn as in `steering.word`; words 2 and 3 turn first, 1 and 3 the long way round."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance, turn = hypot(dx, dy), wrap_angle(end[2] - start[2])
    turns_first = number >= 2
    if turns_first and (distance == 0.0 or turn == 0.0):
        return inf
    if number % 2 == 1:
        turn = other_way(turn)
    course = atan2(dy, dx) - (end[2] if turns_first else start[2])
    slide, rotation = (1, 0) if turns_first else (0, 1)
    pieces[slide, 1], pieces[slide, 2] = distance, wrap_angle(course)
    pieces[rotation, 3] = turn
    return distance if abs(turn) < inf else inf
