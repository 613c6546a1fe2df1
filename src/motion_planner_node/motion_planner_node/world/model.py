"""The world as the motion planner knows it: immutable, in metres, frame ``map``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from motion_planner_node.robots.robot import Robot


@dataclass(frozen=True, slots=True)
class Bounds:
    """The map's rectangle [m]; a robot's disc has to stay inside."""

    x_min: float
    y_min: float
    x_max: float
    y_max: float


@dataclass(frozen=True, slots=True)
class WorldObject:
    """A static thing that preconditions can speak of; ``x`` and ``y`` [m] are always fields."""

    label: str
    fields: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Polygon:
    """A simple polygon, closed implicitly: the corners [m] in order."""

    name: str
    corners: tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Circle:
    """A disc: its centre and radius [m]."""

    name: str
    center: tuple[float, float]
    radius: float


Obstacle = Polygon | Circle

#: A named part of the map that constraints can speak of; robots may enter it.
Region = Polygon | Circle


#: A robot of model car, as the paper's.
CarModel = Robot


@dataclass(frozen=True, slots=True)
class World:
    """A snapshot; ``revision`` is a digest of the content, so equal worlds have equal revisions."""

    source: str
    revision: str
    bounds: Bounds
    objects: Mapping[str, WorldObject]
    obstacles: tuple[Obstacle, ...]
    robots: Mapping[str, Robot]
    regions: Mapping[str, Region] = field(default_factory=dict)
