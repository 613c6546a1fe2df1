"""One robot of a world: its model, its measures, and what follows from them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import copysign, tan

import numpy as np
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.body import Body, Corners, body_of
from motion_planner_node.robots.motion import Attitude, Motion, Segment, merged
from motion_planner_node.robots.registry import MODELS, STEERING


@dataclass(frozen=True, slots=True)
class Robot:
    """A robot whose ``kind`` is the name of a model in `registry.MODELS`.

    label: its name in the world.
    wheelbase [m], max_steering_angle [rad]: 0 for a model that does not steer.
    radius: [m] of the disc round (x, y) that holds the whole robot.
    speed: [m/s] along a drive or a slide.
    start: where it stands before the first action, when the world says so.
    footprint: corners [m] in the robot's frame, x forward, y left; none for the disc itself.
    safety_margin: [m] that the footprint keeps from obstacles and from the edge of the map.
    turning_speed: [rad/s] of a turn on the spot; 0 for a model that does not.
    """

    label: str
    wheelbase: float
    max_steering_angle: float
    radius: float
    speed: float
    start: Attitude | None = None
    kind: str = 'car'
    footprint: Corners = ()
    safety_margin: float = 0.0
    turning_speed: float = 0.0

    @property
    def components(self) -> tuple[str, ...]:
        """Components of the state vector, which constraints and commands can name."""
        return MODELS[self.kind].components

    @property
    def steering(self) -> int:
        """Number of the model, for kernels."""
        return STEERING[self.kind]

    @property
    def turning_radius(self) -> float:
        """Radius [m] of the circle driven at the largest steering angle; 0 for a turn on the spot."""
        return self.wheelbase / tan(self.max_steering_angle) if MODELS[self.kind].steers else 0.0

    @property
    def body(self) -> Body:
        """The shape and the clearance that it keeps; one object for all robots of this shape."""
        return body_of(self.footprint, self.radius, self.safety_margin)

    @property
    def extent(self) -> str:
        """What has to keep clear of obstacles and of the edge of the map, in words."""
        corners = len(self.footprint)
        shape = (
            f'its footprint of {corners} corners' if corners else f'its radius of {self.radius:g} m'
        )
        margin = f' and its safety margin of {self.safety_margin:g} m'
        return shape + margin if self.safety_margin else shape

    @property
    def lack(self) -> str:
        """What is wrong where a robot cannot stand, to be put behind the clearance there."""
        before = 'where there is no room for' if self.footprint else 'less than'
        return f'{before} {self.extent}'

    def curvature(self, steering_angle: float) -> float:
        """Curvature [1/m] of the arc driven at ``steering_angle`` [rad]."""
        return tan(steering_angle) / self.wheelbase if steering_angle else 0.0

    def pieces_of(self, segments: Iterable[Segment]) -> NDArray[np.float64]:
        """``segments`` as rows (n, 4) of curvature [1/m], length [m], direction and turn [rad]."""
        rows = [(self.curvature(s.steering_angle), s.length, s.direction, s.turn) for s in segments]
        return np.array(rows, dtype=np.float64).reshape(-1, 4)

    def segments_of(self, pieces: NDArray[np.float64]) -> tuple[Segment, ...]:
        """The segments of ``pieces`` (n, 4), arcs being driven at the largest steering angle.

        Pieces that are no motion are left out, neighbours of one command joined.
        """
        most = self.max_steering_angle
        return merged(
            Segment(copysign(most, bend) if bend else 0.0, length, direction, turn)
            for bend, length, direction, turn in pieces.tolist()
        )

    def space(self, bounds: tuple[float, float, float, float]) -> base.StateSpace:
        """OMPL's state space of the model over x_min, y_min, x_max, y_max [m]."""
        space = MODELS[self.kind].space(self.turning_radius)
        box = base.RealVectorBounds(2)
        for axis in (0, 1):
            box.setLow(axis, float(bounds[axis]))
            box.setHigh(axis, float(bounds[axis + 2]))
        space.setBounds(box)
        return space

    def duration(self, motion: Motion) -> float:
        """Time [s] that ``motion`` takes at the robot's speeds."""
        return float(sum(self.time_of(item.length, item.turn) for item in motion.segments))

    def time_of(self, length: float, turn: float) -> float:
        """Time [s] of a drive of ``length`` [m] or a ``turn`` [rad] on the spot."""
        turning = abs(turn) / self.turning_speed if turn else 0.0
        return abs(length) / self.speed + turning
