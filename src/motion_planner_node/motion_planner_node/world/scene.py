"""A world made ready for geometry: exact clearances, exact collision, free space."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motion_planner_node.robots.body import Body, necessary_clearance
from motion_planner_node.robots.motion import Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.clearance import clearance_at, clearances
from motion_planner_node.world.free_space import FreeSpace
from motion_planner_node.world.model import World
from motion_planner_node.world.shapes import shapes_of
from motion_planner_node.world.sweeps import are_free, chain_clearance, chain_is_free

MAP_EDGE = "the map's edge"


class Scene:
    """Geometry of one world; immutable, and cheap to ask."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.shapes, self._names = shapes_of(world)
        self._free_space = lru_cache(maxsize=8)(self._new_free_space)

    def _new_free_space(self, margin: float) -> FreeSpace:
        return FreeSpace(self.shapes, margin)

    def clearance(self, points: ArrayLike) -> NDArray[np.float64]:
        """Distances [m], shape (n,), from ``points`` (n, 2) to the nearest obstacle or map edge.

        Exact outside of obstacles; negative inside one and outside the map.
        """
        array = np.ascontiguousarray(np.atleast_2d(np.asarray(points, float)))
        return clearances(self.shapes, array)

    def is_free(self, attitudes: ArrayLike, body: Body) -> NDArray[np.bool_]:
        """Which of ``attitudes`` (n, 3) the ``body`` can be in, shape (n,)."""
        array = np.ascontiguousarray(np.atleast_2d(np.asarray(attitudes, float)))
        return are_free(self.shapes, body, array)

    def nearest_obstacle(self, x: float, y: float) -> tuple[str, float]:
        """The name of the obstacle nearest to (x, y), or ``MAP_EDGE``, and the clearance [m]."""
        distance, which = clearance_at(self.shapes, float(x), float(y))
        return (MAP_EDGE if which < 0 else self._names[which]), float(distance)

    def motion_is_free(self, motion: Motion, robot: Robot) -> bool:
        """Whether the body of ``robot`` is free all along ``motion``: exact, not sampled."""
        return bool(chain_is_free(self.shapes, *_chain(motion, robot)))

    def motion_clearance(self, motion: Motion, robot: Robot) -> float:
        """Least distance [m] of the body of ``robot`` from obstacles and bounds along ``motion``.

        Exact, not sampled; 0 or less when it hits one.
        """
        return float(chain_clearance(self.shapes, *_chain(motion, robot)))

    def free_space(self, body: Body) -> FreeSpace:
        """Where a ``body`` can be in some heading, and how far it is to drive."""
        return self._free_space(necessary_clearance(body))


def _chain(motion: Motion, robot: Robot) -> tuple[Body, NDArray[np.float64], NDArray[np.float64]]:
    start = np.array([motion.start.x, motion.start.y, motion.start.heading], dtype=np.float64)
    return robot.body, start, robot.pieces_of(motion.segments)
