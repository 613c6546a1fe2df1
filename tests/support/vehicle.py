"""A robot of a world file by the textbook: its commands, its equations of motion, its outline.

Nothing here is the planner's: motions are integrated numerically, distances are shapely's.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

#: [m], [rad] allowed between two numbers that should be equal.
TOLERANCE = 1e-6
#: [m] and [rad] between two samples of a motion.
SPACING = 0.05
TURN_SPACING = 0.02

Pose = tuple[float, float, float]
Rows = NDArray[np.float64]

#: For each model: whether it steers, drives backwards, slides, turns on the spot.
ABILITIES = {
    'car': (True, False, False, False),
    'reverse_car': (True, True, False, False),
    'differential': (False, True, False, True),
    'omnidirectional': (False, False, True, True),
}


class Vehicle:
    """One entry of a world file's ``robots``."""

    def __init__(self, robot: Mapping[str, Any]):
        self.steers, self.reverses, self.slides, self.turns = ABILITIES[robot['model']]
        self.wheelbase = float(robot['wheelbase']) if self.steers else math.inf
        self.most = float(robot['max_steering_angle']) if self.steers else 0.0
        self.margin = float(robot.get('safety_margin', 0.0))
        self.footprint = np.array(robot.get('footprint', []), dtype=np.float64).reshape(-1, 2)
        self.radius = float(robot.get('radius', 0.0))

    def wrong_commands(self, segments: list[list[float]]) -> Iterator[str]:
        """Say in sentences which segments are no commands of the robot."""
        for steering, length, direction, turn in map(_whole, segments):
            if steering not in (-self.most, 0.0, self.most):
                yield f'steering angle {steering} is no command of the robot'
            if length < 0 and not self.reverses:
                yield f'a segment of {length} m'
            if direction and not (self.slides and steering == 0.0):
                yield f'a slide in direction {direction}'
            if turn and not (self.turns and length == 0.0):
                yield f'a turn of {turn} on the spot'
            if not length and not turn:
                yield 'an empty segment'

    def drive(self, start: Pose, segments: list[list[float]]) -> Rows:
        """Integrate the equations of motion; attitudes (n, 3), all starts and ends among them.

        With the speed v = 1 or -1 and the steering angle phi: x' = v cos h, y' = v sin h, h' = v / L
        tan(phi), by the fourth-order rule of Runge and Kutta; a slide has its course instead of h.
        """
        parts = [np.array([start])]
        for steering, length, direction, turn in map(_whole, segments):
            x, y, heading = parts[-1][-1]
            count = max(1, math.ceil(abs(length) / SPACING), math.ceil(abs(turn) / TURN_SPACING))
            speed = math.copysign(1.0, length) if length else 0.0
            step = abs(length) / count
            rate = speed * math.tan(steering) / self.wheelbase
            headings = heading + np.arange(count + 1) * (rate * step + turn / count)
            before = headings[:-1] + direction
            middle, after = before + 0.5 * rate * step, before + rate * step
            dx = speed * step / 6.0 * (np.cos(before) + 4.0 * np.cos(middle) + np.cos(after))
            dy = speed * step / 6.0 * (np.sin(before) + 4.0 * np.sin(middle) + np.sin(after))
            parts.append(np.column_stack([x + np.cumsum(dx), y + np.cumsum(dy), headings[1:]]))
        return np.concatenate(parts)

    def collisions(
        self, driven: Rows, obstacles: Mapping[str, BaseGeometry], bounds: BaseGeometry
    ) -> Iterator[str]:
        """Say in sentences what the robot comes too close to in the attitudes ``driven`` (n, 3)."""
        reach = float(np.hypot(*self.footprint.T).max()) if len(self.footprint) else self.radius
        # A body that is a disc is judged at its centre.
        needed = self.margin if len(self.footprint) else self.margin + self.radius
        places = shapely.points(driven[:, :2])
        for label, wall in {**obstacles, "the map's edge": bounds.exterior}.items():
            near = shapely.distance(places, wall) < reach + self.margin
            bodies = self._bodies(driven[near])
            clearance = float(shapely.distance(bodies, wall).min(initial=math.inf))
            if clearance < needed - TOLERANCE:
                yield f'{clearance} m from {label}, not {needed}'
            # Distances are 0 for a touch and for an overlap: only the latter reaches further in.
            inner = wall.buffer(-TOLERANCE, join_style='mitre')
            if shapely.intersects(bodies, inner).any():
                yield f'inside {label}'
        if not shapely.covers(bounds.buffer(TOLERANCE), self._bodies(driven)).all():
            yield 'leaves the map'

    def outline(self, attitude: Pose) -> BaseGeometry:
        """What it covers where it stands, without its margin."""
        if len(self.footprint):
            return self._bodies(np.array([attitude]))[0]
        return outline_of({'circle': {'center': attitude[:2], 'radius': self.radius}})

    def _bodies(self, driven: Rows) -> NDArray[Any]:
        """Outlines (n,) at attitudes; the centres of a disc."""
        if not len(self.footprint):
            return np.asarray(shapely.points(driven[:, :2]))
        c, s = np.cos(driven[:, 2:]), np.sin(driven[:, 2:])
        x = driven[:, :1] + c * self.footprint[:, 0] - s * self.footprint[:, 1]
        y = driven[:, 1:2] + s * self.footprint[:, 0] + c * self.footprint[:, 1]
        return np.asarray(shapely.polygons(np.stack([x, y], axis=-1)))


def motion_faults(
    vehicle: Vehicle,
    start: Pose,
    segments: list[list[float]],
    end: Pose,
    obstacles: Mapping[str, BaseGeometry],
    bounds: BaseGeometry,
) -> Iterator[str]:
    """Everything that is wrong with one motion: commands, where it ends, what it comes too close to."""
    yield from vehicle.wrong_commands(segments)
    driven = vehicle.drive(start, segments)
    last = (float(driven[-1, 0]), float(driven[-1, 1]), float(driven[-1, 2]))
    if not gap(last, end) <= TOLERANCE:
        yield f'drives to {last}, not to {end}'
    yield from vehicle.collisions(driven, obstacles, bounds)


def gap(first: Pose, second: Pose) -> float:
    """The largest difference between two attitudes [m or rad], headings as directions."""
    turned = math.remainder(first[2] - second[2], math.tau)
    return max(abs(first[0] - second[0]), abs(first[1] - second[1]), abs(turned))


def outline_of(obstacle: Mapping[str, Any]) -> BaseGeometry:
    """The shape of one entry of a world file's ``obstacles``."""
    if 'polygon' in obstacle:
        return shapely.Polygon(obstacle['polygon'])
    # A circle is judged by a polygon inside it: the checker must not refuse what is right.
    circle = obstacle['circle']
    return shapely.Point(circle['center']).buffer(circle['radius'], quad_segs=512)


def _whole(segment: list[float]) -> tuple[float, float, float, float]:
    """Steering angle, length, direction, turn: the last two are left out where they are 0."""
    steering, length, direction, turn = [*segment, 0.0, 0.0][:4]
    return steering, length, direction, turn
