"""The obstacles and bounds of a world as arrays of fixed shape, for the compiled kernels."""

from __future__ import annotations

from collections.abc import Iterable
from math import inf
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.world.model import Bounds, Circle, Polygon, Region, World


class Shapes(NamedTuple):
    """Polygons come first, discs after them; all in metres.

    bounds: (4,) x_min, y_min, x_max, y_max.
    edges: (e, 4) x0, y0, x1, y1 of all polygons, those of one polygon next to each other.
    first_edge: (p + 1,) where the edges of each polygon begin.
    discs: (d, 3) x, y, radius.
    boxes: (p + d, 4) x_min, y_min, x_max, y_max of polygons and discs.
    """

    bounds: NDArray[np.float64]
    edges: NDArray[np.float64]
    first_edge: NDArray[np.int64]
    discs: NDArray[np.float64]
    boxes: NDArray[np.float64]


def shapes_of(world: World) -> tuple[Shapes, tuple[str, ...]]:
    """The arrays of ``world``, and the names of the obstacles in the order of the arrays."""
    return _shapes(world.bounds, world.obstacles)


def shapes_of_region(region: Region) -> Shapes:
    """The arrays of one region, without any bounds: the distance from it is its clearance."""
    return _shapes(Bounds(-inf, -inf, inf, inf), (region,))[0]


def _shapes(bounds: Bounds, outlines: Iterable[Polygon | Circle]) -> tuple[Shapes, tuple[str, ...]]:
    edges: list[tuple[float, float, float, float]] = []
    first_edge = [0]
    discs: list[tuple[float, float, float]] = []
    polygon_boxes: list[tuple[float, float, float, float]] = []
    disc_boxes: list[tuple[float, float, float, float]] = []
    polygon_names: list[str] = []
    disc_names: list[str] = []
    for obstacle in outlines:
        if isinstance(obstacle, Polygon):
            following = obstacle.corners[1:] + obstacle.corners[:1]
            edges += [(*a, *b) for a, b in zip(obstacle.corners, following, strict=True) if a != b]
            first_edge.append(len(edges))
            xs, ys = zip(*obstacle.corners, strict=True)
            polygon_boxes.append((min(xs), min(ys), max(xs), max(ys)))
            polygon_names.append(obstacle.name)
        else:
            (x, y), radius = obstacle.center, obstacle.radius
            discs.append((x, y, radius))
            disc_boxes.append((x - radius, y - radius, x + radius, y + radius))
            disc_names.append(obstacle.name)
    shapes = Shapes(
        bounds=np.array([bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max], float),
        edges=np.array(edges, float).reshape(-1, 4),
        first_edge=np.array(first_edge, np.int64),
        discs=np.array(discs, float).reshape(-1, 3),
        boxes=np.array(polygon_boxes + disc_boxes, float).reshape(-1, 4),
    )
    return shapes, (*polygon_names, *disc_names)


def shapes_near(shapes: Shapes, x_min: float, y_min: float, x_max: float, y_max: float) -> Shapes:
    """Only those polygons and discs whose boxes meet a rectangle [m]; the bounds as they are."""
    boxes = shapes.boxes
    near = (boxes[:, 0] <= x_max) & (boxes[:, 2] >= x_min)
    near &= (boxes[:, 1] <= y_max) & (boxes[:, 3] >= y_min)
    sizes = np.diff(shapes.first_edge)
    polygons, discs = near[: len(sizes)], near[len(sizes) :]
    return Shapes(
        bounds=shapes.bounds,
        edges=shapes.edges[np.repeat(polygons, sizes)],
        first_edge=np.concatenate([[0], np.cumsum(sizes[polygons])]).astype(np.int64),
        discs=shapes.discs[discs],
        boxes=boxes[near],
    )
