"""Attitudes, and motions as segments of constant command: the paper's three-valued one for a car."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields

#: x, y [m] and heading [rad], as the kernels take it.
Pose = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Attitude:
    """Where a robot stands, frame ``map``: x, y [m] and heading [rad] in (-pi, pi]."""

    x: float
    y: float
    heading: float


#: Components of the state vector of a model that moves in attitudes, in order: gradients have it.
COMPONENTS = tuple(field.name for field in fields(Attitude))

#: Those of them that are angles: equal modulo 2 pi.
ANGULAR_COMPONENTS = ('heading',)

#: Segments of less than this [m] or [rad] are below the resolution of a map and are left out.
SHORTEST_SEGMENT = 1e-12


@dataclass(frozen=True, slots=True)
class Segment:
    """One of: an arc or a straight line, a slide, a turn on the spot.

    steering_angle: [rad] of the drive, positive to the left.
    length: [m], negative when driven backwards; 0 for a turn on the spot.
    direction: [rad] of a slide, counter-clockwise from the heading, which does not change.
    turn: [rad] turned on the spot, counter-clockwise.
    """

    steering_angle: float
    length: float
    direction: float = 0.0
    turn: float = 0.0


@dataclass(frozen=True, slots=True)
class Motion:
    """Segments of ``agent`` driven one after the other from ``start``; none when it stays."""

    agent: str
    start: Attitude
    segments: tuple[Segment, ...] = ()

    @property
    def length(self) -> float:
        """Sum of the segments' lengths [m], all counted positive."""
        return float(sum(abs(segment.length) for segment in self.segments))


#: Attitudes of the agents, by label: all that changes while a plan is carried out.
GeometricState = Mapping[str, Attitude]


def merged(segments: Iterable[Segment]) -> tuple[Segment, ...]:
    """``segments`` without empty ones, neighbours of one command joined."""
    result: list[Segment] = []
    for segment in segments:
        if abs(segment.length) < SHORTEST_SEGMENT and abs(segment.turn) < SHORTEST_SEGMENT:
            continue
        if result and _command(result[-1]) == _command(segment):
            before = result[-1]
            result[-1] = Segment(
                segment.steering_angle,
                before.length + segment.length,
                segment.direction,
                before.turn + segment.turn,
            )
        else:
            result.append(segment)
    return tuple(result)


def _command(segment: Segment) -> tuple[float, float, int, int]:
    """What stays the same while a segment is driven: steering, direction, and which way it goes."""
    length, turn = segment.length, segment.turn
    return (
        segment.steering_angle,
        segment.direction,
        (length > 0.0) - (length < 0.0),
        (turn > 0.0) - (turn < 0.0),
    )
