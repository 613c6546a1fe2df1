"""Cars that drive at random, by steps of the kinematic equations, until they hit something."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, remainder, sin, tau

import numpy as np
import shapely
from numpy.typing import NDArray

from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world.model import Polygon, World

#: Lower left corner, width and height [m].
Wall = tuple[float, float, float, float]


def walls_of(walls: Sequence[Wall]) -> tuple[Polygon, ...]:
    """Rectangular obstacles: wall0, wall1 and so on."""
    return tuple(
        Polygon(f'wall{k}', ((a, b), (a + w, b), (a + w, b + h), (a, b + h)))
        for k, (a, b, w, h) in enumerate(walls)
    )


@dataclass(frozen=True)
class Drives:
    """How cars of ``radius`` [m] drive: ``number`` times at most ``steps`` steps of ``step`` [m].

    They steer to a side, or straight ahead, at ``bend`` [1/m] for some steps of the range ``held``.
    """

    radius: float
    bend: float
    step: float
    number: int
    steps: int
    held: tuple[int, int]

    def attitudes(self, world: World, starts: Sequence[Attitude], seed: int) -> NDArray[np.float64]:
        """Attitudes (n, 3) on the way from ``starts`` in turn; obstacles are polygons."""
        bounds = world.bounds
        room = shapely.box(bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max)
        for wall in world.obstacles:
            assert isinstance(wall, Polygon)
            room = room.difference(shapely.Polygon(wall.corners))
        room = room.buffer(-self.radius + 1e-6)
        shapely.prepare(room)
        random, passed = np.random.default_rng(seed), []
        for number in range(self.number):
            start = starts[number % len(starts)]
            x, y, heading, bend = start.x, start.y, start.heading, 0.0
            for step in range(self.steps):
                if step % int(random.integers(*self.held)) == 0:
                    bend = self.bend * float(random.integers(-1, 2))
                x += self.step * cos(heading + 0.5 * self.step * bend)
                y += self.step * sin(heading + 0.5 * self.step * bend)
                heading += self.step * bend
                if not shapely.contains_xy(room, x, y):
                    break
                passed.append((x, y, remainder(heading, tau)))
        return np.array(passed).reshape(-1, 3)
