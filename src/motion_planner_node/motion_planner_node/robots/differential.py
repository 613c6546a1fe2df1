"""The differential drive: straight ahead or back, and turns on the spot.

x' = v cos(heading), y' = v sin(heading), heading' = w, where one of v and w is 0 at any time.  A
motion without obstacles turns, drives straight, and turns again.
"""

from __future__ import annotations

from math import atan2, hypot, inf, pi

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.arcs import other_way, wrap_angle
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import COMPONENTS, Pose

MODEL = Model(
    name='differential',
    components=COMPONENTS,
    steers=False,
    reverses=True,
    slides=False,
    turns=True,
    words=8,
    space=lambda _: base.SE2StateSpace(),
)

#: Ends that are as near as this [m] are one place: what is left is a turn.
SAME_PLACE = 5e-10


@kernel
def word(_: float, number: int, start: Pose, end: Pose, pieces: NDArray[np.float64]) -> float:
    """Turn, straight and turn as in `steering.word`.

    The first four words drive in that of the two ways, ahead and back, that turns less; the others
    in the other way.  Of four, each pair of turns is made the short way or the long way round.
    """
    dx, dy = end[0] - start[0], end[1] - start[1]
    distance = hypot(dx, dy)
    if distance < SAME_PLACE:
        if number not in (0, 2):
            return inf
        turn = wrap_angle(end[2] - start[2])
        pieces[0, 3] = turn if number == 0 else other_way(turn)
        return 0.0 if abs(pieces[0, 3]) < inf else inf
    course = atan2(dy, dx)
    first, last = wrap_angle(course - start[2]), wrap_angle(end[2] - course)
    back_first, back_last = wrap_angle(first + pi), wrap_angle(last + pi)
    backwards = abs(back_first) + abs(back_last) < abs(first) + abs(last)
    if number >= 4:
        backwards = not backwards
    if backwards:
        first, last, distance = back_first, back_last, -distance
    if number % 2 == 1:
        first = other_way(first)
    if number % 4 >= 2:
        last = other_way(last)
    pieces[0, 3], pieces[1, 1], pieces[2, 3] = first, distance, last
    return abs(distance) if abs(first) + abs(last) < inf else inf
