"""A length that no tour of photos can undercut.

Whoever photographs an objective stands at most ``high`` from it, so a drive that begins farther
away crosses the circle of that radius round it. Take from a drive the first crossing of each
circle: these points, in some order, lie on it, so it is no shorter than the shortest tour of one
point on each circle, in whatever order, headings and the turning radius set aside. That tour is
found exactly over arcs of the circles (`orders`); a point is at most half an arc from its arc's
middle, so half an arc is taken off at both ends of each leg.

Ways go round the obstacles, each grown by the robot's radius less half an arc: then the middle of an
arc can be joined to every point of it that the robot can be at. They are the shortest ones of a
visibility graph, whose corners are those of slightly larger obstacles than those that block.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely.geometry.base import BaseGeometry

from experiments.paper.orders import Costs, shortest_tours

Array = NDArray[np.float64]
#: [m] by which the obstacles that block are smaller than those whose corners are gone round.
GAP = 0.01
#: Points on a quarter of a rounded corner, and of a disc; between them it is cut off, inwards.
CORNER, DISC = 2, 4


def outlines(obstacles: Iterable[Mapping[str, Any]]) -> list[BaseGeometry]:
    """The obstacles of a world file, discs as polygons of few corners inside them."""
    return [
        shapely.Polygon(each['polygon'])
        if 'polygon' in each
        else shapely.Point(each['circle']['center']).buffer(
            each['circle']['radius'], quad_segs=DISC
        )
        for each in obstacles
    ]


def lower_bound(
    start: Array,
    centres: Array,
    high: float,
    obstacles: Sequence[BaseGeometry],
    bounds: Array,
    radius: float,
    arc: float,
) -> float:
    """A bound [m] of all tours from ``start`` (2,) of attitudes not farther than ``high`` from ``centres``.

    obstacles: shapes that a disc of ``radius`` [m] has to keep clear of
    bounds: x_min, y_min, x_max, y_max [m] that the disc has to stay in
    arc: length [m] of the arcs that the circles are cut into, less than twice the radius

    Raises ValueError when the start is within a circle: then the argument does not hold.
    """
    if (np.hypot(*(centres - start).T) <= high).any():
        raise ValueError('the start is within reach of an objective')
    half = 0.5 * arc
    grown = [shape.buffer(radius - half, quad_segs=CORNER) for shape in obstacles]
    blocking = [shape.buffer(radius - half - GAP, quad_segs=CORNER) for shape in obstacles]
    solid = shapely.union_all(blocking)
    room = shapely.box(*bounds).buffer(-(radius - half), join_style='mitre')
    corners = np.vstack([np.empty((0, 2)), *(_corners(shape, room) for shape in grown)])
    circles = [_arcs(centre, high, arc, room, solid) for centre in centres]
    ways = _Ways(corners, solid)
    first = [np.maximum(ways.lengths(start[None], rows)[0] - half, 0.0) for rows in circles]
    between = {}
    for (i, a), (j, b) in itertools.combinations(enumerate(circles), 2):
        between[i, j] = np.maximum(ways.lengths(a, b) - arc, 0.0)
        between[j, i] = between[i, j].T
    return next(shortest_tours(Costs(first, between))).length


class _Ways:
    """Shortest ways round obstacles, by a visibility graph of their corners."""

    def __init__(self, corners: Array, solid: BaseGeometry) -> None:
        self._corners, self._solid = corners, solid
        shapely.prepare(solid)
        ways = self._seen(corners, corners)
        for k in range(len(corners)):
            ways = np.minimum(ways, ways[:, k, None] + ways[None, k])
        self._between = ways

    def lengths(self, origins: Array, ends: Array) -> Array:
        """The shortest ways (n, m) [m] from origins (n, 2) to ends (m, 2)."""
        direct = self._seen(origins, ends)
        if not len(self._corners):
            return direct
        reached = _least_sums(self._seen(origins, self._corners), self._between)
        return np.minimum(direct, _least_sums(reached, self._seen(self._corners, ends)))

    def _seen(self, origins: Array, ends: Array) -> Array:
        """Straight distances (n, m) [m], infinite where an obstacle is between."""
        pairs = np.stack(np.broadcast_arrays(origins[:, None], ends[None]), axis=2)
        lines = shapely.linestrings(pairs.reshape(-1, 2, 2))
        hidden = shapely.intersects(self._solid, lines).reshape(pairs.shape[:2])
        away = np.hypot(*np.moveaxis(pairs[:, :, 1] - pairs[:, :, 0], -1, 0))
        return np.asarray(np.where(hidden, np.inf, away))


def _least_sums(left: Array, right: Array) -> Array:
    return np.array([(row[:, None] + right).min(axis=0) for row in left])


def _arcs(centre: Array, high: float, arc: float, room: BaseGeometry, solid: BaseGeometry) -> Array:
    """The middles (m, 2) of the arcs that the robot may be on."""
    angles = np.linspace(0.0, 2.0 * np.pi, int(np.ceil(2.0 * np.pi * high / arc)), endpoint=False)
    middles = centre + high * np.column_stack([np.cos(angles), np.sin(angles)])
    points = shapely.points(middles)
    return np.asarray(middles[shapely.covers(room, points) & ~shapely.intersects(solid, points)])


def _corners(shape: BaseGeometry, room: BaseGeometry) -> Array:
    corners = np.asarray(shapely.get_coordinates(shape.exterior)[:-1])
    return np.asarray(corners[shapely.covers(room, shapely.points(corners))])
