"""A world made ready for geometry: exact clearances, exact collision, free space."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from motion_planner_node.robots.body import Body, necessary_clearance
from motion_planner_node.robots.motion import Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.clearance import clearance_at, clearances
from motion_planner_node.world.free_space import FreeSpace
from motion_planner_node.world.model import Obstacle, World
from motion_planner_node.world.shapes import shapes_of
from motion_planner_node.world.sweeps import are_free, chain_clearance, chain_is_free

MAP_EDGE = "the map's edge"


class Scene:
    """Geometry of one world; immutable, and cheap to ask."""

    def __init__(self, world: World) -> None:
        self.world = world
        self.shapes, self._names = shapes_of(world)
        self._free_spaces: Callable[[float], FreeSpace]
        self._free_spaces = lru_cache(maxsize=8)(partial(FreeSpace.of, self.shapes))

    def with_more(self, obstacles: Sequence[Obstacle]) -> Scene:
        """The scene of the same world with further ``obstacles``, much quicker than a new one."""
        more = Scene(replace(self.world, obstacles=(*self.world.obstacles, *obstacles)))
        boxes = np.array([obstacle.box for obstacle in obstacles]).reshape(-1, 4)
        shapes, spaces = more.shapes, self._free_spaces

        def space(margin: float) -> FreeSpace:
            return spaces(margin).with_more(shapes, boxes)

        more._free_spaces = lru_cache(maxsize=8)(space)
        return more

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
        return self._free_spaces(necessary_clearance(body))


def _chain(motion: Motion, robot: Robot) -> tuple[Body, NDArray[np.float64], NDArray[np.float64]]:
    start = np.array([motion.start.x, motion.start.y, motion.start.heading], dtype=np.float64)
    return robot.body, start, robot.pieces_of(motion.segments)
