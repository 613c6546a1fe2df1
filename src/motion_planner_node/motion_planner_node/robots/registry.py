"""All models.  A further one is a file of its own and its two lines in this one."""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots import car, differential, omnidirectional, reverse_car
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose

#: In the order of their numbers, which kernels know them by.
MODELS = {
    model.name: model
    for model in (car.MODEL, reverse_car.MODEL, differential.MODEL, omnidirectional.MODEL)
}

#: The number of each model.
STEERING = {name: number for number, name in enumerate(MODELS)}


@kernel
def word_of_model(
    steering: int,
    radius: float,
    number: int,
    start: Pose,
    end: Pose,
    pieces: NDArray[np.float64],
) -> float:
    """Word ``number`` of model ``steering``, as in `steering.word`."""
    if steering == 0:
        return car.word(radius, number, start, end, pieces)
    if steering == 1:
        return reverse_car.word(radius, number, start, end, pieces)
    if steering == 2:
        return differential.word(radius, number, start, end, pieces)
    if steering == 3:
        return omnidirectional.word(radius, number, start, end, pieces)
    return inf
