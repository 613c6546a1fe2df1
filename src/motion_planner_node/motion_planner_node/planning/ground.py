"""The scene as one kind of robot meets it: where it is free, where it gets to, how far it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import floor

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.turning_room import TurningRoom
from motion_planner_node.planning.boxes import Boxes, Pyramid
from motion_planner_node.planning.steps import steps_from
from motion_planner_node.robots.body import necessary_clearance
from motion_planner_node.robots.driving import shortest_between
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Room, Travel
from motion_planner_node.world.scene import Scene

#: Boxes on a side of the map where a grid over all of it is needed, free or not.
WHOLE_MAP_BOXES = 96
#: Attitudes from which ways on are looked for between two looks at the clock.
LOOKS = 32
#: Places on the rim of an area whose nearest obstacles are named.
RIM_PLACES = 256


@dataclass(frozen=True, slots=True)
class Area:
    """A connected part of the free space: ``size`` [m2] and what bounds it."""

    size: float
    obstacles: tuple[str, ...]


class Ground:
    """Free space of one robot in one world; immutable, and shared by all its requests."""

    def __init__(self, scene: Scene, robot: Robot):
        self.scene = scene
        self.robot = robot
        self._free = scene.free_space(robot.body)
        self._turning_room = TurningRoom(scene, robot)
        cells = self._free.cells
        self.cells = Pyramid(Boxes.of(cells.x_lo, cells.x_hi, cells.y_lo, cells.y_hi))
        #: Number of the connected part of the free space that each of ``cells`` is in, (n,).
        self.parts = self._free.components_of(*self.cells.boxes.centres)
        bounds = scene.world.bounds
        # Numbers of the cells on a grid with a closed cell all round; -1 where closed.
        side = self._free.resolution
        self._columns = np.rint((cells.x_lo - bounds.x_min) / side).astype(np.int32) + 1
        self._rows = np.rint((cells.y_lo - bounds.y_min) / side).astype(np.int32) + 1
        shape = (self._rows.max(initial=0) + 2, self._columns.max(initial=0) + 2)
        self._numbers = np.full(shape, -1, np.int32)
        self._numbers[self._rows, self._columns] = np.arange(len(cells))
        whole = Boxes.tiling(
            bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max, WHOLE_MAP_BOXES
        )
        self.everywhere = Pyramid(whole)
        #: Where the robot can be in some heading, for descents and proofs.
        self.room = Room(scene.shapes, necessary_clearance(robot.body))

    @property
    def needs_room_to_turn(self) -> bool:
        """Whether the robot only drives forward, and so turns round nowhere but on a circle."""
        model = MODELS[self.robot.kind]
        return not (model.turns or model.reverses or model.slides)

    def is_free(self, states: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of the attitudes (n, 3) the robot can stand in, shape (n,)."""
        return np.asarray(self.scene.is_free(states, self.robot.body))

    def trouble(self, attitude: Attitude) -> str:
        """What is wrong with standing at ``attitude``, as the end of a sentence; '' when nothing is."""
        bounds = self.scene.world.bounds
        here = f'({attitude.x:g}, {attitude.y:g})'
        outside = max(
            bounds.x_min - attitude.x,
            attitude.x - bounds.x_max,
            bounds.y_min - attitude.y,
            attitude.y - bounds.y_max,
        )
        if outside > 0.0:
            return f'{here} is {outside:.4g} m outside the map'
        if self.is_free(np.array([[attitude.x, attitude.y, attitude.heading]]))[0]:
            return ''
        name, clearance = self.scene.nearest_obstacle(attitude.x, attitude.y)
        if clearance < 0.0:
            return f'{here} is {-clearance:.4g} m inside {name}'
        return f'{here} is {clearance:.4g} m from {name}, {self.robot.lack}'

    def can_turn_round(
        self, states: NDArray[np.float64], check_time: Callable[[], None]
    ) -> NDArray[np.bool_]:
        """At which free attitudes (n, 3) there is room to turn, shape (n,); see `TurningRoom`.

        ``check_time`` is called now and then, and may raise.
        """
        result = np.ones(len(states), np.bool_)
        for first in range(0, len(states), LOOKS):
            check_time()
            part = slice(first, first + LOOKS)
            result[part] = self._turning_room.at(states[part])
        return result

    def part_of(self, attitude: Attitude) -> int:
        """Number of the connected part of the free space that ``attitude`` is in; -1 for none."""
        return self._free.component_of(attitude.x, attitude.y)

    def parts_of(self, states: NDArray[np.float64]) -> NDArray[np.int32]:
        """Numbers of the connected parts of the free space that attitudes (n, 3) are in, (n,)."""
        return self._free.components_of(states[:, 0], states[:, 1])

    def cell_of(self, attitude: Attitude) -> int:
        """Number of the one of ``cells`` that ``attitude`` is in; -1 for none."""
        row, column = self._square_of(attitude)
        rows, columns = self._numbers.shape
        inside = 0 <= row < rows and 0 <= column < columns
        return int(self._numbers[row, column]) if inside else -1

    def _square_of(self, attitude: Attitude) -> tuple[int, int]:
        bounds, side = self.scene.world.bounds, self._free.resolution
        row = floor((attitude.y - bounds.y_min) / side) + 1
        return row, floor((attitude.x - bounds.x_min) / side) + 1

    def least_ways(self, start: Attitude) -> NDArray[np.float64]:
        """Lengths [m] that no way of the robot from ``start`` into each of ``cells`` is below, (n,).

        See `steps_from`; 0 where ``start`` is in none of the cells.
        """
        if self.cell_of(start) < 0:
            return np.zeros(len(self.parts))
        steps = steps_from(self._numbers, *self._square_of(start))
        return np.asarray(np.maximum(steps - 1, 0) * self._free.resolution)

    def rim_of(self, chosen: NDArray[np.intp]) -> NDArray[np.intp]:
        """Those of the ``chosen`` ones of ``cells`` (n,) that have a cell beside them that is not."""
        mask = np.zeros(self._numbers.shape, np.bool_)
        rows, columns = self._rows[chosen], self._columns[chosen]
        mask[rows, columns] = True
        enclosed = mask[rows - 1, columns] & mask[rows + 1, columns]
        enclosed &= mask[rows, columns - 1] & mask[rows, columns + 1]
        return np.asarray(chosen[~enclosed])

    def ways_round(self, start: Attitude, states: NDArray[np.float64]) -> NDArray[np.float64]:
        """Estimated lengths [m], (n,), of the ways from ``start`` round obstacles to states (n, 3).

        The turning radius is not regarded.  Infinite where no way is known.
        """
        field = self._free.distance_from(start.x, start.y)
        return np.asarray(field.at(states[:, 0], states[:, 1]))

    def steered(
        self, starts: NDArray[np.float64], ends: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Lengths [m], (n,), of the shortest motions without obstacles, as `shortest_between`."""
        return shortest_between(starts, ends, self.robot)

    def estimates(self, start: Attitude, states: NDArray[np.float64]) -> NDArray[np.float64]:
        """Estimated lengths [m] of the motions from ``start`` to attitudes (n, 3), shape (n,).

        The larger of the shortest motion without obstacles and the way round the obstacles.
        """
        here = np.array([start.x, start.y, start.heading])
        around = self.ways_round(start, states)
        return np.asarray(np.maximum(around, self.steered(here, states)))

    def travel_from(self, start: Attitude) -> Travel:
        """The ways and estimates from ``start``, as a search for destinations wants them."""
        return Travel(
            lambda states: self.ways_round(start, states),
            lambda states: self.estimates(start, states),
            max(self.robot.turning_radius, self.robot.radius),
        )

    def area(self, part: int) -> Area:
        """Size and bounding obstacles of a connected part of the free space, biggest share first."""
        boxes = self.cells.boxes.chosen(self.parts == part)
        x, y = boxes.centres
        near = self.scene.clearance(np.column_stack([x, y])) < (
            necessary_clearance(self.robot.body) + 1.5 * self._free.resolution
        )
        rim = np.flatnonzero(near)
        rim = rim[:: max(1, len(rim) // RIM_PLACES)]
        names = [self.scene.nearest_obstacle(x[index], y[index])[0] for index in rim]
        by_share = sorted(set(names), key=lambda name: (-names.count(name), name))
        return Area(len(x) * self._free.resolution**2, tuple(by_share))
