"""A mission's plan, its world and how the search ended: the messages without ROS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from interface_node.history import Improvement


@dataclass(frozen=True, slots=True)
class Attitude:
    """Where a robot stands, frame ``map``: x, y [m] and heading [rad] in (-pi, pi]."""

    x: float
    y: float
    heading: float


@dataclass(frozen=True, slots=True)
class Segment:
    """One of: an arc or a straight line, a slide, a turn on the spot.

    An arc has a ``length`` [m], negative when driven backwards, and a ``steering_angle`` [rad],
    positive to the left; a slide a length and a ``direction`` [rad] from the heading, which stays;
    a turn on the spot no length but a ``turn`` [rad], counter-clockwise.
    """

    steering_angle: float
    length: float
    direction: float = 0.0
    turn: float = 0.0


@dataclass(frozen=True, slots=True)
class Residual:
    """How well a constraint is met: ``violation`` is 0 when it is, in the function's own unit."""

    constraint: str
    violation: float
    satisfied: bool


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One remark about a text; line and column count from 1, 0 is nowhere."""

    message: str
    source: str = ''
    line: int = 0
    column: int = 0
    text: str = ''
    warning: bool = False

    def __str__(self) -> str:
        where = ':'.join(str(part) for part in (self.source, self.line, self.column) if part)
        return f'{where}: {self.message}' if where else self.message


@dataclass(frozen=True, slots=True)
class Robot:
    """Of one model: wheelbase, radius [m], largest steering angle [rad], speeds [m/s] and [rad/s].

    ``footprint`` are corners [m] in the robot's frame, x forward and y left, none for a disc;
    ``safety_margin`` [m] is what it keeps from obstacles.
    """

    label: str
    wheelbase: float
    max_steering_angle: float
    radius: float
    speed: float = 0.0
    model: str = 'car'
    start: Attitude | None = None
    footprint: tuple[tuple[float, float], ...] = ()
    safety_margin: float = 0.0
    turning_speed: float = 0.0


@dataclass(frozen=True, slots=True)
class Obstacle:
    """A polygon by its corners [m], or a disc by its centre and radius [m] when it has none.

    Regions, which robots may enter, are told in the same way.
    """

    name: str
    corners: tuple[tuple[float, float], ...] = ()
    center: tuple[float, float] = (0.0, 0.0)
    radius: float = 0.0


@dataclass(frozen=True, slots=True)
class Occupancy:
    """Cells of side ``resolution`` [m], row by row from the corner ``origin`` (x, y) [m].

    ``occupied`` has the shape (rows, columns); rows go north, but for a turn by ``yaw`` [rad]
    about the corner.
    """

    resolution: float
    origin: tuple[float, float]
    occupied: NDArray[np.bool_]
    yaw: float = 0.0


@dataclass(frozen=True, slots=True)
class World:
    """What the motion planner planned in; ``bounds`` are x_min, y_min, x_max, y_max [m]."""

    source: str
    revision: str
    bounds: tuple[float, float, float, float]
    objects: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    obstacles: tuple[Obstacle, ...] = ()
    robots: tuple[Robot, ...] = ()
    regions: tuple[Obstacle, ...] = ()
    map: Occupancy | None = None

    def robot(self, label: str) -> Robot | None:
        """The robot of that label, or nothing."""
        return next((robot for robot in self.robots if robot.label == label), None)


@dataclass(frozen=True, slots=True)
class Step:
    """One action; ``agent`` is empty and there is no ``end`` when it is purely symbolic.

    ``state`` holds the attitudes of the agents before the action, ``end`` that of its agent after
    it. ``motion_start`` is where the segments begin, nothing when the robot was not driven; it is
    then that ``clearance`` [m], the least along the motion, and ``duration`` [s] mean something.
    """

    action: tuple[str, ...]
    cost: float = 0.0
    preconditions: str = ''
    state: Mapping[str, Attitude] = field(default_factory=dict)
    agent: str = ''
    objects: tuple[str, ...] = ()
    end: Attitude | None = None
    end_state: Mapping[str, Attitude] = field(default_factory=dict)
    assigned: bool = False
    motion_start: Attitude | None = None
    segments: tuple[Segment, ...] = ()
    length: float = 0.0
    duration: float = 0.0
    clearance: float = 0.0
    residuals: tuple[Residual, ...] = ()
    alternative: int = 0

    @property
    def start(self) -> Attitude | None:
        """Where the agent's segments begin; for an attitude that was set, that attitude."""
        if self.assigned:
            return self.end
        return self.motion_start or self.state.get(self.agent) or self.end


@dataclass(frozen=True, slots=True)
class Plan:
    """What a mission came to: the outcome's name, why, and the steps when it was solved."""

    mission: str
    outcome: str
    explanation: str = ''
    diagnostics: tuple[Diagnostic, ...] = ()
    world_path: str = ''
    world: World | None = None
    steps: tuple[Step, ...] = ()
    seed: int = 0
    planning_time: float = 0.0
    statistics: Mapping[str, float] = field(default_factory=dict)
    improvements: tuple[Improvement, ...] = ()

    @property
    def length(self) -> float:
        """Length [m] of all motions."""
        return float(sum(step.length for step in self.steps))

    @property
    def duration(self) -> float:
        """Time [s] that all motions take, one after the other."""
        return float(sum(step.duration for step in self.steps))

    @property
    def robot(self) -> Robot | None:
        """The robot that moves first, else the first that the world has."""
        if self.world is None:
            return None
        movers = [step.agent for step in self.steps if step.segments]
        placed = [step.agent for step in self.steps if step.agent]
        for label in (*movers, *placed):
            found = self.world.robot(label)
            if found:
                return found
        return self.world.robots[0] if self.world.robots else None
