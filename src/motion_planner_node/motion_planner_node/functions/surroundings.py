"""What functions can see of the world: clearance, lines of sight and named regions."""

from __future__ import annotations

from functools import cached_property, lru_cache
from math import hypot

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions.field import Field
from motion_planner_node.world.hiding import least_obstructions
from motion_planner_node.world.model import Region, World
from motion_planner_node.world.shapes import Same, Shapes, shapes_of, shapes_of_region
from motion_planner_node.world.sight import obstructions
from motion_planner_node.world.signed_distance import clearances_with_slopes

_Array = NDArray[np.float64]

#: What rounding adds to a distance at most, as a share of the coordinates.
_ROUNDING = 1e-14

#: More than a distance loses when it underflows [m].
_SMALLEST = float(np.finfo(np.float64).tiny)


class SignedDistance:
    """Distance [m] from (x, y) to the nearest shape, negative in one (or outside the bounds)."""

    def __init__(self, shapes: Shapes) -> None:
        self._shapes = shapes

    def values(self, *arguments: _Array) -> _Array:
        """Distances (n,)."""
        return clearances_with_slopes(self._shapes, np.column_stack(arguments))[:, 0]

    def slopes(self, *arguments: _Array) -> tuple[_Array, _Array]:
        """A unit vector, away from the nearest point or, inside, towards it."""
        found = clearances_with_slopes(self._shapes, np.column_stack(arguments))
        return found[:, 1], found[:, 2]

    def bounds(self, *ranges: tuple[_Array, _Array]) -> tuple[_Array, _Array]:
        """From the distance in the middle, as it changes by at most a metre per metre."""
        (x_low, x_high), (y_low, y_high) = ranges
        reach = 0.5 * np.hypot(x_high - x_low, y_high - y_low)
        largest = np.maximum.reduce([np.abs(bound) for pair in ranges for bound in pair])
        known = np.isfinite(largest)
        middles = [np.where(known, low + 0.5 * (high - low), 0.0) for low, high in ranges]
        distance = self.values(*middles)
        reach = np.where(
            known, reach + _ROUNDING * (largest + np.abs(distance)) + _SMALLEST, np.inf
        )
        return distance - reach, distance + reach


class Obstruction:
    """By how much [m] obstacles are in the way between two points x, y and x, y.

    Negative where the straight line is free: then it is minus its distance from the nearest
    obstacle. Else it is how far the line would have to move sideways to get past.
    """

    def __init__(self, world: World) -> None:
        bounds = world.bounds
        self._shapes, _ = shapes_of(world)
        self._farthest = hypot(bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min)

    def values(self, *arguments: _Array) -> _Array:
        """Obstructions (n,)."""
        return obstructions(self._shapes, np.column_stack(arguments), self._farthest)[:, 0]

    def slopes(self, *arguments: _Array) -> tuple[_Array, ...]:
        """Derivatives by the four coordinates."""
        found = obstructions(self._shapes, np.column_stack(arguments), self._farthest)
        return tuple(found[:, 1:].T)

    def bounds(self, *ranges: tuple[_Array, _Array]) -> tuple[_Array, _Array]:
        """Positive bounds where one obstacle hides the second point from a whole box."""
        boxes = np.column_stack([bound for pair in ranges for bound in pair])
        low = least_obstructions(self._shapes, boxes)
        return low, np.full(len(low), np.inf)


class _Unknown:
    """A field of which nothing is known."""

    def values(self, *arguments: _Array) -> _Array:
        return np.full(len(arguments[0]), np.nan)

    def slopes(self, *arguments: _Array) -> tuple[_Array, ...]:
        return tuple(np.zeros(len(argument)) for argument in arguments)

    def bounds(self, *ranges: tuple[_Array, _Array]) -> tuple[_Array, _Array]:
        unbounded = np.full(len(ranges[0][0]), np.inf)
        return -unbounded, unbounded


class Surroundings:
    """The fields of one world; without a world nothing is known."""

    def __init__(self, world: World | None = None) -> None:
        self._world = world
        self._regions: dict[str, Field] = {}

    @cached_property
    def clearance(self) -> Field:
        """Distance [m] to the nearest obstacle or edge of the map, of x and y."""
        return SignedDistance(shapes_of(self._world)[0]) if self._world else _Unknown()

    @cached_property
    def sight(self) -> Field:
        """What is in the way between two points, of x, y, x and y."""
        return Obstruction(self._world) if self._world else _Unknown()

    def region(self, label: str) -> Field:
        """Signed distance [m] to a region's boundary, of x and y; negative inside."""
        if label not in self._regions:
            known: Region | None = self._world.regions.get(label) if self._world else None
            field = SignedDistance(shapes_of_region(known)) if known else _Unknown()
            self._regions[label] = field
        return self._regions[label]


def surroundings_of(world: World) -> Surroundings:
    """The surroundings of ``world``, kept for the next call."""
    return _kept(Same(world))


@lru_cache(maxsize=4)
def _kept(same: Same) -> Surroundings:
    return Surroundings(same.world)
