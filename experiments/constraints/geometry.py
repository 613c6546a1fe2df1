"""The functions of the language once more, for the judge: plain math, and shapely for polygons."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from shapely.geometry import LineString, Point, Polygon

Position = tuple[float, float]


@dataclass(frozen=True)
class Angle:
    """A number of radians that is compared modulo 2 pi."""

    radians: float


@dataclass(frozen=True)
class Somebody:
    """An agent or an object: its fields by name."""

    fields: Mapping[str, float]

    @property
    def at(self) -> Position:
        """Where it is."""
        return self.fields['x'], self.fields['y']

    @property
    def heading(self) -> float:
        """Where an agent looks [rad]."""
        return self.fields['heading']


@dataclass(frozen=True)
class Area:
    """An obstacle or a region, as the world file has it: a polygon or a circle."""

    description: Mapping[str, Any]

    @cached_property
    def _polygon(self) -> Any:
        return Polygon(self.description['polygon'])

    def signed_distance(self, at: Position) -> float:
        """Distance [m] to the boundary, negative inside."""
        if 'circle' in self.description:
            circle = self.description['circle']
            return math.dist(at, circle['center']) - float(circle['radius'])
        point = Point(at)
        away = float(self._polygon.exterior.distance(point))
        return -away if self._polygon.contains(point) else away

    def crossing(self, one: Position, other: Position) -> float:
        """How long [m] the way between two places is inside."""
        if 'polygon' in self.description:
            return float(LineString([one, other]).intersection(self._polygon).length)
        centre, radius = self.description['circle']['center'], self.description['circle']['radius']
        nearest = _distance_to_segment(centre, one, other)
        return 2.0 * math.sqrt(max(radius**2 - nearest**2, 0.0))


@dataclass(frozen=True)
class Surroundings:
    """The map: its obstacles and bounds."""

    obstacles: tuple[Area, ...]
    bounds: tuple[float, float, float, float]

    def clearance(self, agent: Somebody) -> float:
        """Distance [m] to the nearest obstacle or edge."""
        (x, y), (x_min, y_min, x_max, y_max) = agent.at, self.bounds
        edges = min(x - x_min, x_max - x, y - y_min, y_max - y)
        return min([edges, *(obstacle.signed_distance(agent.at) for obstacle in self.obstacles)])

    def hidden(self, agent: Somebody, target: Somebody) -> float:
        """How long [m] the line of sight runs through obstacles that do not hold the target."""
        return sum(
            obstacle.crossing(agent.at, target.at)
            for obstacle in self.obstacles
            if obstacle.signed_distance(target.at) >= 0.0
        )


def _bearing(one: Somebody, other: Somebody) -> float:
    (x, y), (to_x, to_y) = one.at, other.at
    return math.atan2(to_y - y, to_x - x) if (x, y) != (to_x, to_y) else math.nan


def _relative(one: Somebody, other: Somebody, turned: float = 0.0) -> Angle:
    return Angle(one.heading - _bearing(one, other) + turned)


def _between(one: Angle | float, other: Angle | float) -> float:
    first, second = (a.radians if isinstance(a, Angle) else a for a in (one, other))
    return abs(math.remainder(first - second, math.tau))


def _distance_to_segment(at: Position, start: Position, end: Position) -> float:
    vector = end[0] - start[0], end[1] - start[1]
    square = vector[0] ** 2 + vector[1] ** 2
    along = (at[0] - start[0]) * vector[0] + (at[1] - start[1]) * vector[1]
    share = min(max(along / square, 0.0), 1.0) if square else 0.0
    return math.dist(at, (start[0] + share * vector[0], start[1] + share * vector[1]))


def _track(agent: Somebody, start: Somebody, end: Somebody) -> complex:
    """Along (real) and across (imaginary, positive on the left) the line through two places."""
    here, there = complex(*agent.at) - complex(*start.at), complex(*end.at) - complex(*start.at)
    return here * there.conjugate() / abs(there)


def functions(world: Surroundings) -> dict[str, Callable[..., Any]]:
    """All functions by name; what is compared with zero when it stands alone is in CONDITIONS."""
    return {
        'distance': lambda one, other: math.dist(one.at, other.at),
        'equidistant': lambda a, b, c: math.dist(a.at, b.at) - math.dist(a.at, c.at),
        'bearing': lambda one, other: Angle(_bearing(one, other)),
        'heading': lambda one: Angle(one.heading),
        'same_heading': lambda one, other: Angle(one.heading - other.heading),
        'rel_angle': _relative,
        'facing': _relative,
        'object_on_left': lambda one, other: _relative(one, other, math.pi / 2),
        'object_on_right': lambda one, other: _relative(one, other, -math.pi / 2),
        'object_behind': lambda one, other: _relative(one, other, math.pi),
        'field_of_view': lambda one, other, angle: (
            _between(Angle(one.heading), Angle(_bearing(one, other))) - angle / 2
        ),
        'distance_to_segment': lambda a, b, c: _distance_to_segment(a.at, b.at, c.at),
        'along_track': lambda a, b, c: _track(a, b, c).real,
        'cross_track': lambda a, b, c: _track(a, b, c).imag,
        'inside': lambda agent, region: region.signed_distance(agent.at),
        'outside': lambda agent, region: region.signed_distance(agent.at),
        'distance_to_boundary': lambda agent, region: abs(region.signed_distance(agent.at)),
        'clearance': world.clearance,
        'visible': world.hidden,
        'cos_and_sin': Angle,
        'angle_between': _between,
        'deg': math.radians,
        'abs': abs,
        'min': min,
        'max': max,
    }


#: How a function that stands alone compares with zero.
CONDITIONS = {
    **dict.fromkeys(('inside', 'visible', 'field_of_view'), '<='),
    'outside': '>=',
    **dict.fromkeys(('facing', 'object_on_left', 'object_on_right', 'object_behind'), '='),
    **dict.fromkeys(('same_heading', 'equidistant'), '='),
}
