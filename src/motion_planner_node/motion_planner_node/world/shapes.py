"""The obstacles and bounds of a world as arrays of fixed shape, for the compiled kernels."""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache
from math import ceil, cos, inf, sin, sqrt
from typing import Any, NamedTuple

import numpy as np
from numba import types
from numba.experimental import structref
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.index import Index, index_of
from motion_planner_node.world.map_edges import map_edges
from motion_planner_node.world.model import Bounds, Circle, OccupancyMap, Polygon, Region, World

#: Cells of which the clearance in the middle is kept, about.
MIDDLES = 1 << 16


@structref.register
class ShapesType(types.StructRef):
    """The type of `Shapes` in kernels."""


class Shapes(structref.StructRefProxy):
    """Polygons come first, discs after them, an occupancy map last; all in metres.

    Kernels get a reference to it, which is quicker to pass than a tuple of arrays.

    bounds: (4,) x_min, y_min, x_max, y_max.
    edges: (e, 4) x0, y0, x1, y1 of all polygons, those of one polygon and its holes next to each
        other, then those between free and occupied cells of the occupancy map. A point is in a
        polygon when a ray from it crosses an odd number of its edges.
    first_edge: (p + 1,) where the edges of each polygon begin, and those of the map.
    discs: (d, 3) x, y, radius.
    boxes: (p + d, 4) x_min, y_min, x_max, y_max of polygons and discs.
    frame, buckets, items, row_starts, row_edges: what is near a place, see `index.Index`.
    middles: (rows, columns) clearance [m] in the middle of square cells from the corner of the
        bounds on, not a number where nobody has asked for it yet; see `glance`.
    side: (1,) of these cells [m].
    occupied: (rows, columns) 1 where a cell of the map is occupied, the first row has the least y.
    cells: (6,) x, y [m] of the first cell's corner, cosine and sine of the map's yaw, side of a
        cell [m], and 1 if all outside of the cells is occupied.
    """

    edges: NDArray[np.float64]
    first_edge: NDArray[np.int64]
    discs: NDArray[np.float64]
    boxes: NDArray[np.float64]
    frame: NDArray[np.float64]
    buckets: NDArray[np.int32]
    items: NDArray[np.int32]
    row_starts: NDArray[np.int64]
    row_edges: NDArray[np.int32]
    middles: NDArray[np.float64]
    side: NDArray[np.float64]
    occupied: NDArray[np.uint8]
    cells: NDArray[np.float64]

    @property
    def bounds(self) -> NDArray[np.float64]:
        """The bounds (4,) [m], outside of kernels as well."""
        return _bounds(self)


@kernel
def _bounds(shapes: Shapes) -> NDArray[np.float64]:
    return shapes.bounds


structref.define_boxing(ShapesType, Shapes)

_ARRAYS = {
    'bounds': types.float64[::1],
    'edges': types.float64[:, ::1],
    'first_edge': types.int64[::1],
    'discs': types.float64[:, ::1],
    'boxes': types.float64[:, ::1],
    'frame': types.float64[::1],
    'buckets': types.int32[:, :, ::1],
    'items': types.int32[::1],
    'row_starts': types.int64[::1],
    'row_edges': types.int32[::1],
    'middles': types.float64[:, ::1],
    'side': types.float64[::1],
    'occupied': types.Array(types.uint8, 2, 'C', readonly=True),
    'cells': types.float64[::1],
}
#: For structures of kernels that hold shapes.
SHAPES_TYPE = ShapesType(list(_ARRAYS.items()))


@kernel
def _reference(
    outlines: tuple[NDArray[np.float64], ...],
    first_edge: NDArray[np.int64],
    index: Index,
    middles: NDArray[np.float64],
    side: NDArray[np.float64],
    occupied: NDArray[np.uint8],
    cells: NDArray[np.float64],
) -> Any:
    """The shapes with ``outlines``: bounds, edges, discs and boxes."""
    shapes = structref.new(SHAPES_TYPE)
    shapes.bounds, shapes.edges, shapes.discs, shapes.boxes = outlines
    shapes.first_edge = first_edge
    shapes.frame, shapes.buckets, shapes.items = index.frame, index.buckets, index.items
    shapes.row_starts, shapes.row_edges = index.row_starts, index.row_edges
    shapes.middles, shapes.side = middles, side
    shapes.occupied, shapes.cells = occupied, cells
    return shapes


class OpenShapes(NamedTuple):
    """The arrays of `Shapes` themselves: for inner loops that are to count no references."""

    bounds: NDArray[np.float64]
    edges: NDArray[np.float64]
    first_edge: NDArray[np.int64]
    discs: NDArray[np.float64]
    boxes: NDArray[np.float64]
    frame: NDArray[np.float64]
    buckets: NDArray[np.int32]
    items: NDArray[np.int32]
    row_starts: NDArray[np.int64]
    row_edges: NDArray[np.int32]
    occupied: NDArray[np.uint8]
    cells: NDArray[np.float64]


@kernel
def opened(shapes: Shapes) -> OpenShapes:
    """The arrays of ``shapes``; every kernel that takes shapes takes them as well."""
    return OpenShapes(
        shapes.bounds,
        shapes.edges,
        shapes.first_edge,
        shapes.discs,
        shapes.boxes,
        shapes.frame,
        shapes.buckets,
        shapes.items,
        shapes.row_starts,
        shapes.row_edges,
        shapes.occupied,
        shapes.cells,
    )


class Same:
    """A world that is equal only to itself."""

    __slots__ = ('world',)

    def __init__(self, world: World) -> None:
        self.world = world

    def __hash__(self) -> int:
        return id(self.world)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and other.world is self.world


#: What kernels take as shapes.
AnyShapes = Shapes | OpenShapes


def shapes_of(world: World) -> tuple[Shapes, tuple[str, ...]]:
    """The arrays of ``world``, and the names of the obstacles in the order of the arrays.

    Kept for the next call with the same world.
    """
    return _kept(Same(world))


@lru_cache(maxsize=4)
def _kept(same: Same) -> tuple[Shapes, tuple[str, ...]]:
    world = same.world
    return _shapes(world.bounds, world.obstacles, world.map)


def shapes_of_region(region: Region) -> Shapes:
    """The arrays of one region, without any bounds: the distance from it is its clearance."""
    return _shapes(Bounds(-inf, -inf, inf, inf), (region,), None)[0]


def shapes_within(bounds: Bounds) -> Shapes:
    """The arrays of a world without obstacles."""
    return _shapes(bounds, (), None)[0]


def _shapes(
    bounds: Bounds, obstacles: Iterable[Polygon | Circle], grid: OccupancyMap | None
) -> tuple[Shapes, tuple[str, ...]]:
    edges: list[tuple[float, float, float, float]] = []
    first_edge = [0]
    discs: list[tuple[float, float, float]] = []
    polygon_boxes: list[tuple[float, float, float, float]] = []
    disc_boxes: list[tuple[float, float, float, float]] = []
    polygon_names: list[str] = []
    disc_names: list[str] = []
    for obstacle in obstacles:
        if isinstance(obstacle, Polygon):
            for ring in obstacle.rings:
                following = ring[1:] + ring[:1]
                edges += [(*a, *b) for a, b in zip(ring, following, strict=True) if a != b]
            first_edge.append(len(edges))
            polygon_boxes.append(obstacle.box)
            polygon_names.append(obstacle.name)
        else:
            (x, y), radius = obstacle.center, obstacle.radius
            discs.append((x, y, radius))
            disc_boxes.append(obstacle.box)
            disc_names.append(obstacle.name)
    limits = np.array([bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max], dtype=np.float64)
    all_edges = np.array(edges, dtype=np.float64).reshape(-1, 4)
    all_discs = np.array(discs, dtype=np.float64).reshape(-1, 3)
    starts = np.array(first_edge, np.int64)
    if grid is not None:
        all_edges = np.concatenate([all_edges, map_edges(grid)])
    boxes = np.array(polygon_boxes + disc_boxes, dtype=np.float64).reshape(-1, 4)
    index = index_of(limits, all_edges, starts, all_discs)
    outlines = (limits, all_edges, all_discs, boxes)
    shapes: Shapes = _reference(outlines, starts, index, *_middles(limits), *_cells(grid))
    names = [*polygon_names, *disc_names]
    return shapes, tuple(names if grid is None else [*names, grid.name])


def _middles(bounds: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Room for the clearances in the middle of cells over ``bounds`` (4,), and the cells' side [m].

    None where the bounds are not finite: nothing drives there.
    """
    width, height = bounds[2:] - bounds[:2]
    if not (np.isfinite(bounds).all() and width > 0.0 and height > 0.0):
        return np.zeros((0, 0)), np.zeros(1)
    side = max(sqrt(width * height / MIDDLES), max(width, height) / MIDDLES)
    return np.full((ceil(height / side), ceil(width / side)), np.nan), np.array([side])


def _cells(grid: OccupancyMap | None) -> tuple[NDArray[np.uint8], NDArray[np.float64]]:
    if grid is None:
        return np.frombuffer(b'', np.uint8).reshape(0, 0), np.zeros(6)
    cells = [grid.x, grid.y, cos(grid.yaw), sin(grid.yaw), grid.resolution, grid.unknown_occupied]
    return grid.occupied, np.array(cells, dtype=np.float64)
