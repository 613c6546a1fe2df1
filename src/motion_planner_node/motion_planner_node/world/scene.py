"""A world made ready for geometry: exact clearances, exact collision, free space."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motion_planner_node.robots.car import curvature
from motion_planner_node.robots.motion import Motion
from motion_planner_node.world.clearance import clearance_at, clearances
from motion_planner_node.world.free_space import FreeSpace
from motion_planner_node.world.model import CarModel, World
from motion_planner_node.world.shapes import shapes_of
from motion_planner_node.world.sweeps import chain_is_free

#: A disc may touch a boundary, and rounding may press it in by as much as this [m].
TOUCH = 1e-9

MAP_EDGE = "the map's edge"


def required_clearance(radius: float) -> float:
    """The clearance [m] at which a disc of ``radius`` [m] counts as free."""
    return max(radius - TOUCH, TOUCH)


class Scene:
    """Geometry of one world; immutable, and cheap to ask."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.shapes, self._names = shapes_of(world)
        self._free_space = lru_cache(maxsize=8)(self._new_free_space)

    def _new_free_space(self, radius: float) -> FreeSpace:
        return FreeSpace(self.shapes, required_clearance(radius))

    def clearance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Distances [m], shape (n,), from ``points`` (n, 2) to the nearest obstacle or map edge.

        Exact outside of obstacles; negative inside one and outside the map.
        """
        array = np.ascontiguousarray(np.atleast_2d(np.asarray(points, float)))
        return clearances(self.shapes, array)

    def is_free(self, attitudes: ArrayLike, radius: float) -> NDArray[np.bool_]:
        """Which of ``attitudes`` (n, 3) a disc of ``radius`` [m] can be in, shape (n,)."""
        return self.clearance(attitudes) >= required_clearance(radius)

    def nearest_obstacle(self, x: float, y: float) -> tuple[str, float]:
        """The name of the obstacle nearest to (x, y), or ``MAP_EDGE``, and the clearance [m]."""
        distance, which = clearance_at(self.shapes, float(x), float(y))
        return (MAP_EDGE if which < 0 else self._names[which]), float(distance)

    def motion_is_free(self, motion: Motion, car: CarModel) -> bool:
        """Whether the disc of ``car`` is free all along ``motion``: exact, not sampled."""
        chain = np.array(
            [(curvature(s.steering_angle, car), s.length) for s in motion.segments], float
        ).reshape(-1, 2)
        start = np.array([motion.start.x, motion.start.y, motion.start.heading], float)
        return bool(chain_is_free(self.shapes, required_clearance(car.radius), start, chain))

    def free_space(self, radius: float) -> FreeSpace:
        """Where a disc of ``radius`` [m] can be, and how far it is to drive; kept by radius."""
        return self._free_space(radius)
