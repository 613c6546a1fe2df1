"""Attitudes, and motions as constant-steering segments: the paper's three-valued command."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields


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


@dataclass(frozen=True, slots=True)
class Segment:
    """An arc of ``length`` [m] > 0 driven forward at ``steering_angle`` [rad], positive to the left."""

    steering_angle: float
    length: float


@dataclass(frozen=True, slots=True)
class Motion:
    """Segments of ``agent`` driven one after the other from ``start``; none when it stays."""

    agent: str
    start: Attitude
    segments: tuple[Segment, ...] = ()

    @property
    def length(self) -> float:
        """Sum of the segments' lengths [m]."""
        return float(sum(segment.length for segment in self.segments))


#: Attitudes of the agents, by label: all that changes while a plan is carried out.
GeometricState = Mapping[str, Attitude]
