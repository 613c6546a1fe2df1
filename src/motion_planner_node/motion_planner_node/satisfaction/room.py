"""Where a robot's disc can be, as one more constraint of a descent."""

from __future__ import annotations

from math import inf
from typing import NamedTuple

from motion_planner_node.world.model import Bounds
from motion_planner_node.world.shapes import Shapes, shapes_within


class Room(NamedTuple):
    """Obstacles and map edge, and the clearance [m] from them that is asked for."""

    shapes: Shapes
    clearance: float


def within(bounds: Bounds) -> Room:
    """All positions within ``bounds``."""
    return Room(shapes_within(bounds), 0.0)


#: No limits at all.
ANYWHERE = within(Bounds(-inf, -inf, inf, inf))._replace(clearance=-inf)
