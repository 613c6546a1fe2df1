"""Distances of a robot's body, a disc or a polygon, from single edges and discs, exact."""

from __future__ import annotations

from math import cos, inf, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.body import Body
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import squared_distance_to_segment
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.traces import (
    Shift,
    Trace,
    box_of,
    distance_to_edge,
    distance_to_point,
    reverse,
    segment_distance,
    trace_of,
)


@kernel
def place(body: Body, pose: Pose, corners: NDArray[np.float64]) -> None:
    """Fill ``corners`` (k, 2) with those of ``body`` at ``pose``, frame ``map``."""
    c, s = cos(pose[2]), sin(pose[2])
    for i in range(len(corners)):
        x, y = body.corners[i, 0], body.corners[i, 1]
        corners[i, 0], corners[i, 1] = pose[0] + c * x - s * y, pose[1] + s * x + c * y


@kernel
def _contains(corners: NDArray[np.float64], x: float, y: float) -> bool:
    inside = False
    j = len(corners) - 1
    for i in range(len(corners)):
        x0, y0, x1, y1 = corners[j, 0], corners[j, 1], corners[i, 0], corners[i, 1]
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
        j = i
    return inside


@kernel
def standing_distance(shapes: Shapes, corners: NDArray[np.float64], item: int) -> float:
    """Distance [m] of a polygon from an edge or disc; 0 where they overlap."""
    edges, disc = shapes.edges, item - len(shapes.edges)
    least = inf
    j = len(corners) - 1
    for i in range(len(corners)):
        ax, ay, bx, by = corners[j, 0], corners[j, 1], corners[i, 0], corners[i, 1]
        j = i
        if disc < 0:
            x0, y0, x1, y1 = edges[item, 0], edges[item, 1], edges[item, 2], edges[item, 3]
            least = min(least, segment_distance(ax, ay, bx, by, x0, y0, x1, y1))
        else:
            x0, y0, radius = shapes.discs[disc, 0], shapes.discs[disc, 1], shapes.discs[disc, 2]
            away = sqrt(squared_distance_to_segment(x0, y0, ax, ay, bx, by))
            least = min(least, max(away - radius, 0.0))
    return 0.0 if least > 0.0 and _contains(corners, x0, y0) else least


@kernel
def moving_distance(shapes: Shapes, corners: NDArray[np.float64], shift: Shift, item: int) -> float:
    """Least distance [m] of a moving polygon from an edge or disc that it does not overlap at first.

    It is attained between a corner of one and an edge of the other.  A corner of the polygon has a
    trace on the map, a corner of the obstacle a trace in the frame of the polygon.
    """
    edges, disc = shapes.edges, item - len(shapes.edges)
    back = reverse(shift)
    least = inf
    if disc >= 0:
        trace = trace_of(back, shapes.discs[disc, 0], shapes.discs[disc, 1])
        return _distance_to_outline(trace, corners) - float(shapes.discs[disc, 2])
    x0, y0, x1, y1 = edges[item, 0], edges[item, 1], edges[item, 2], edges[item, 3]
    for i in range(len(corners)):
        trace = trace_of(shift, corners[i, 0], corners[i, 1])
        least = min(least, distance_to_edge(trace, x0, y0, x1, y1))
    least = min(least, _distance_to_outline(trace_of(back, x0, y0), corners))
    return min(least, _distance_to_outline(trace_of(back, x1, y1), corners))


@kernel
def _distance_to_outline(trace: Trace, corners: NDArray[np.float64]) -> float:
    least = inf
    j = len(corners) - 1
    for i in range(len(corners)):
        ax, ay, bx, by = corners[j, 0], corners[j, 1], corners[i, 0], corners[i, 1]
        least = min(least, distance_to_edge(trace, ax, ay, bx, by))
        j = i
    return least


@kernel
def trace_distance(shapes: Shapes, trace: Trace, item: int) -> float:
    """Distance [m] of the way of one point from an edge or a disc."""
    edges, disc = shapes.edges, item - len(shapes.edges)
    if disc < 0:
        return distance_to_edge(
            trace, edges[item, 0], edges[item, 1], edges[item, 2], edges[item, 3]
        )
    away = distance_to_point(trace, shapes.discs[disc, 0], shapes.discs[disc, 1])
    return away - float(shapes.discs[disc, 2])


@kernel
def room_in_bounds(shapes: Shapes, corners: NDArray[np.float64], pose: Pose, shift: Shift) -> float:
    """How far [m] a moving body stays inside the bounds: its corners or, without, its middle."""
    bounds = shapes.bounds
    least = inf
    for i in range(max(len(corners), 1)):
        x, y = (corners[i, 0], corners[i, 1]) if len(corners) else (pose[0], pose[1])
        box = box_of(trace_of(shift, x, y))
        west, south = box[0] - bounds[0], box[1] - bounds[1]
        least = min(least, west, south, bounds[2] - box[2], bounds[3] - box[3])
    return least
