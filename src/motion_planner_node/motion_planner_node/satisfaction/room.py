"""Where a robot's disc can be, as one more constraint of a descent."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np

from motion_planner_node.world.model import Bounds
from motion_planner_node.world.shapes import Shapes


class Room(NamedTuple):
    """Obstacles and map edge, and the clearance [m] from them that is asked for."""

    shapes: Shapes
    clearance: float


def within(bounds: Bounds) -> Room:
    """All positions within ``bounds``."""
    edge = np.array([bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max], dtype=np.float64)
    return Room(
        Shapes(edge, np.zeros((0, 4)), np.zeros(1, np.int64), np.zeros((0, 3)), np.zeros((0, 4))),
        0.0,
    )


#: No limits at all.
ANYWHERE = within(Bounds(-inf, -inf, inf, inf))._replace(clearance=-inf)
