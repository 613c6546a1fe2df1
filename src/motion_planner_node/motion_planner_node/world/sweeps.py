"""Exact collision of a disc that is driven along arcs and straight segments.

The distance between an arc and a straight edge is taken at an end of either, at a crossing, or
where the edge's line comes nearest to the centre of the arc's circle.
"""

from __future__ import annotations

from math import cos, hypot, pi, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import Body, sufficient_clearance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import clearance_at, squared_distance_to_segment
from motion_planner_node.world.shapes import Shapes


@kernel
def _segments_keep_apart(
    ax: float,
    ay: float,
    bx: float,
    by: float,
    x0: float,
    y0: float,
    x1: float,
    y1: float,
    margin: float,
) -> bool:
    """Whether the segment from a to b is at least ``margin`` [m] away from a straight edge."""
    square = margin * margin
    if (
        squared_distance_to_segment(ax, ay, x0, y0, x1, y1) < square
        or squared_distance_to_segment(bx, by, x0, y0, x1, y1) < square
        or squared_distance_to_segment(x0, y0, ax, ay, bx, by) < square
        or squared_distance_to_segment(x1, y1, ax, ay, bx, by) < square
    ):
        return False
    dx, dy = bx - ax, by - ay
    ex, ey = x1 - x0, y1 - y0
    start_side = (x0 - ax) * dy - (y0 - ay) * dx
    end_side = (x1 - ax) * dy - (y1 - ay) * dx
    a_side = (ax - x0) * ey - (ay - y0) * ex
    b_side = (bx - x0) * ey - (by - y0) * ex
    return not (start_side * end_side < 0.0 and a_side * b_side < 0.0)


@kernel
def _swept(dx: float, dy: float, ux: float, uy: float, vx: float, vy: float, sweep: float) -> bool:
    """Whether direction d is met by turning left from unit vector u by ``sweep`` [rad] up to v."""
    if sweep >= 2.0 * pi:
        return True
    after_start = ux * dy - uy * dx >= 0.0
    before_end = dx * vy - dy * vx >= 0.0
    if sweep <= pi:
        return after_start and before_end and (dx * (ux + vx) + dy * (uy + vy) >= 0.0)
    return after_start or before_end


@kernel
def _distance_to_arc(
    x: float,
    y: float,
    radius: float,
    u: tuple[float, float],
    v: tuple[float, float],
    sweep: float,
) -> float:
    """Distance [m] from (x, y) to an arc round the origin from direction ``u`` left to ``v``."""
    if _swept(x, y, u[0], u[1], v[0], v[1], sweep):
        return abs(hypot(x, y) - radius)
    return min(
        hypot(x - radius * u[0], y - radius * u[1]), hypot(x - radius * v[0], y - radius * v[1])
    )


@kernel
def _arc_keeps_apart(
    radius: float,
    u: tuple[float, float],
    v: tuple[float, float],
    sweep: float,
    x0: float,
    y0: float,
    x1: float,
    y1: float,
    margin: float,
) -> bool:
    """Whether an arc round the origin is at least ``margin`` [m] away from a straight edge."""
    square = margin * margin
    if (
        squared_distance_to_segment(radius * u[0], radius * u[1], x0, y0, x1, y1) < square
        or squared_distance_to_segment(radius * v[0], radius * v[1], x0, y0, x1, y1) < square
        or _distance_to_arc(x0, y0, radius, u, v, sweep) < margin
        or _distance_to_arc(x1, y1, radius, u, v, sweep) < margin
    ):
        return False
    dx, dy = x1 - x0, y1 - y0
    length = hypot(dx, dy)
    dx, dy = dx / length, dy / length
    along = -(x0 * dx + y0 * dy)
    foot_x, foot_y = x0 + along * dx, y0 + along * dy
    offset = hypot(foot_x, foot_y)
    if offset >= radius:
        return not (
            0.0 < along < length
            and offset - radius < margin
            and _swept(foot_x, foot_y, u[0], u[1], v[0], v[1], sweep)
        )
    half_chord = sqrt(radius * radius - offset * offset)
    for side in (-1.0, 1.0):
        crossing = along + side * half_chord
        if 0.0 <= crossing <= length and _swept(
            x0 + crossing * dx, y0 + crossing * dy, u[0], u[1], v[0], v[1], sweep
        ):
            return False
    return True


@kernel
def arc_is_free(
    shapes: Shapes,
    margin: float,
    x: float,
    y: float,
    heading: float,
    curvature: float,
    length: float,
) -> bool:
    """Whether the disc of radius ``margin`` [m] meets no boundary on its way along one arc.

    That the start is outside all obstacles is for the caller to know.
    """
    end_x, end_y, _ = advance(x, y, heading, curvature, length)
    low_x, low_y, high_x, high_y = min(x, end_x), min(y, end_y), max(x, end_x), max(y, end_y)
    straight = curvature == 0.0
    radius, center_x, center_y, sweep = 0.0, 0.0, 0.0, 0.0
    u, v = (1.0, 0.0), (1.0, 0.0)
    if not straight:
        radius = 1.0 / abs(curvature)
        side = 1.0 if curvature > 0.0 else -1.0
        center_x, center_y = x - side * radius * sin(heading), y + side * radius * cos(heading)
        sweep = length / radius
        u = (side * sin(heading), -side * cos(heading))
        end_heading = heading + side * sweep
        v = (side * sin(end_heading), -side * cos(end_heading))
        if side < 0.0:
            u, v = v, u
        if _swept(1.0, 0.0, u[0], u[1], v[0], v[1], sweep):
            high_x = max(high_x, center_x + radius)
        if _swept(-1.0, 0.0, u[0], u[1], v[0], v[1], sweep):
            low_x = min(low_x, center_x - radius)
        if _swept(0.0, 1.0, u[0], u[1], v[0], v[1], sweep):
            high_y = max(high_y, center_y + radius)
        if _swept(0.0, -1.0, u[0], u[1], v[0], v[1], sweep):
            low_y = min(low_y, center_y - radius)
    bounds = shapes.bounds
    if (
        low_x - bounds[0] < margin
        or low_y - bounds[1] < margin
        or bounds[2] - high_x < margin
        or bounds[3] - high_y < margin
    ):
        return False
    polygons = len(shapes.first_edge) - 1
    for i in range(len(shapes.boxes)):
        box = shapes.boxes[i]
        if (
            box[0] - high_x >= margin
            or low_x - box[2] >= margin
            or box[1] - high_y >= margin
            or low_y - box[3] >= margin
        ):
            continue
        if i >= polygons:
            disc = shapes.discs[i - polygons]
            if straight:
                distance = sqrt(squared_distance_to_segment(disc[0], disc[1], x, y, end_x, end_y))
            else:
                distance = _distance_to_arc(
                    disc[0] - center_x, disc[1] - center_y, radius, u, v, sweep
                )
            if distance - disc[2] < margin:
                return False
            continue
        for e in range(shapes.first_edge[i], shapes.first_edge[i + 1]):
            edge = shapes.edges[e]
            if straight:
                if not _segments_keep_apart(
                    x, y, end_x, end_y, edge[0], edge[1], edge[2], edge[3], margin
                ):
                    return False
            elif not _arc_keeps_apart(
                radius,
                u,
                v,
                sweep,
                edge[0] - center_x,
                edge[1] - center_y,
                edge[2] - center_x,
                edge[3] - center_y,
                margin,
            ):
                return False
    return True


@kernel
def word_is_free(shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]) -> bool:
    """Whether driving ``pieces`` (n, 4) is free from ``start``, itself free.

    Pieces are rows of curvature [1/m], length [m], direction [rad] and turn [rad].
    """
    margin = sufficient_clearance(body)
    x, y, heading = start
    for i in range(len(pieces)):
        bend, length, direction, turn = pieces[i]
        end = advance(x, y, heading, bend, length, direction, turn)
        course = heading + direction
        if length < 0.0:
            # The arc that leads backwards from here is the one that leads here from its end.
            course = end[2] + direction
            free = arc_is_free(shapes, margin, end[0], end[1], course, bend, -length)
        else:
            free = length == 0.0 or arc_is_free(shapes, margin, x, y, course, bend, length)
        if not free:
            return False
        x, y, heading = end
    return True


@kernel
def chain_is_free(
    shapes: Shapes,
    body: Body,
    start: NDArray[np.float64],
    pieces: NDArray[np.float64],
) -> bool:
    """Whether driving ``pieces`` (n, 4) from ``start`` (3,) is free, as `word_is_free` does."""
    pose = (start[0], start[1], start[2])
    if clearance_at(shapes, pose[0], pose[1])[0] < sufficient_clearance(body):
        return False
    return word_is_free(shapes, body, pose, pieces)
