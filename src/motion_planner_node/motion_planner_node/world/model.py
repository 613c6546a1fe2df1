"""The world as the motion planner knows it: immutable, in metres, frame ``map``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import cos, sin
from types import MappingProxyType
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.robot import Robot

_Value = TypeVar('_Value')


def _fixed(labelled: Mapping[str, _Value]) -> Mapping[str, _Value]:
    """A copy that cannot be changed."""
    return MappingProxyType(dict(labelled))


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

    def __post_init__(self) -> None:
        object.__setattr__(self, 'fields', _fixed(self.fields))


@dataclass(frozen=True, slots=True)
class Polygon:
    """A simple polygon, closed implicitly: the corners [m] in order.

    ``holes`` are simple polygons inside of it that do not belong to it; they neither meet each other
    nor its outline.
    """

    name: str
    corners: tuple[tuple[float, float], ...]
    holes: tuple[tuple[tuple[float, float], ...], ...] = ()

    @property
    def rings(self) -> tuple[tuple[tuple[float, float], ...], ...]:
        """The outline and those of the holes."""
        return (self.corners, *self.holes)

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Its x_min, y_min, x_max and y_max [m]."""
        xs, ys = zip(*self.corners, strict=True)
        return min(xs), min(ys), max(xs), max(ys)


@dataclass(frozen=True, slots=True)
class Circle:
    """A disc: its centre and radius [m]."""

    name: str
    center: tuple[float, float]
    radius: float

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Its x_min, y_min, x_max and y_max [m]."""
        (x, y), radius = self.center, self.radius
        return x - radius, y - radius, x + radius, y + radius


Obstacle = Polygon | Circle

#: A named part of the map that constraints can speak of; robots may enter it.
Region = Polygon | Circle


@dataclass(frozen=True, slots=True)
class OccupancyMap:
    """Square cells that are free or occupied; robots stay clear of the occupied ones.

    name: how answers call it.
    rows, columns: of cells; the first cell is the one at the corner, rows go north, columns east.
    cells: a byte for each cell, row by row, 1 where it is occupied and 0 where it is free.
    resolution: side [m] of a cell.
    x, y, yaw: corner [m] of the first cell and the angle [rad] that the map is turned about it.
    unknown_occupied: whether what is not known was taken for occupied; so is all that is outside.
    """

    name: str
    rows: int
    columns: int
    cells: bytes = field(repr=False)
    resolution: float
    x: float
    y: float
    yaw: float
    unknown_occupied: bool

    @property
    def occupied(self) -> NDArray[np.uint8]:
        """The cells (rows, columns), 1 where occupied; cannot be written to."""
        return np.frombuffer(self.cells, np.uint8).reshape(self.rows, self.columns)

    @property
    def bounds(self) -> Bounds:
        """The smallest rectangle along the axes that holds all cells."""
        width, height = self.columns * self.resolution, self.rows * self.resolution
        c, s = (cos(self.yaw), sin(self.yaw)) if self.yaw else (1.0, 0.0)
        xs = [self.x + c * dx - s * dy for dx in (0.0, width) for dy in (0.0, height)]
        ys = [self.y + s * dx + c * dy for dx in (0.0, width) for dy in (0.0, height)]
        return Bounds(min(xs), min(ys), max(xs), max(ys))


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
    map: OccupancyMap | None = None

    def __post_init__(self) -> None:
        for name in ('objects', 'robots', 'regions'):
            object.__setattr__(self, name, _fixed(getattr(self, name)))
