"""The car that also drives backwards: three-valued steering angle, v > 0 or v < 0.

x' = v cos(heading), y' = v sin(heading), heading' = v / L tan(steering angle), the steering angle
one of -max, 0, +max.  Its shortest motions without obstacles are Reeds-Shepp paths.
"""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import COMPONENTS, Pose
from motion_planner_node.robots.reeds_shepp import PARTS, TURNS, WORDS, family_lengths

MODEL = Model(
    name='reverse_car',
    components=COMPONENTS,
    steers=True,
    reverses=True,
    slides=False,
    turns=False,
    words=WORDS,
    space=base.ReedsSheppStateSpace,
)


@kernel
def word(radius: float, number: int, start: Pose, end: Pose, pieces: NDArray[np.float64]) -> float:
    """Reeds-Shepp word ``number`` as in `steering.word`."""
    family = number // 4
    way = 1.0 if number % 2 == 0 else -1.0
    side = 1.0 if number % 4 < 2 else -1.0
    dx, dy = (end[0] - start[0]) / radius, (end[1] - start[1]) / radius
    phi = end[2] - start[2]
    x = dx * cos(start[2]) + dy * sin(start[2])
    y = dy * cos(start[2]) - dx * sin(start[2])
    if family in (7, 8):
        # Seen from the end, which these are driven from.
        x, y = x * cos(phi) + y * sin(phi), x * sin(phi) - y * cos(phi)
    t, u, v = family_lengths(family, way * x, side * y, way * side * phi)
    values = (t, u, v, -u, -0.5 * pi, 0.0)
    total = 0.0
    for i in range(5):
        length = way * radius * values[PARTS[family, i]]
        pieces[i, 0] = side * TURNS[family, i] / radius
        pieces[i, 1] = length
        total += abs(length)
    return total
