"""The way of a point of a moving body, a straight line or an arc, and its distance from edges.

The distance between an arc and a straight edge is taken at an end of either, at a crossing, or
where the edge's line comes nearest to the centre of the arc's circle.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import NamedTuple

from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.clearance import squared_distance_to_segment

Box = tuple[float, float, float, float]


class Shift(NamedTuple):
    """A turn of everything round a point or, where ``sweep`` is 0, a move along a straight line.

    cx, cy: [m] the point that stays; sweep: [rad] turned to the left; cosine, sine: of it.
    dx, dy: [m] the move.
    """

    cx: float
    cy: float
    sweep: float
    cosine: float
    sine: float
    dx: float
    dy: float


class Trace(NamedTuple):
    """The way of one point under a shift, from (ax, ay) to (bx, by) [m], or back.

    An arc leads round (cx, cy) at ``radius`` [m] from the unit vector u to v, by ``sweep`` [rad] to
    the left; a straight line has the sweep 0.
    """

    ax: float
    ay: float
    bx: float
    by: float
    cx: float
    cy: float
    radius: float
    ux: float
    uy: float
    vx: float
    vy: float
    sweep: float


@kernel
def turn_round(cx: float, cy: float, sweep: float) -> Shift:
    """The turn by ``sweep`` [rad] round (cx, cy)."""
    return Shift(cx, cy, sweep, cos(sweep), sin(sweep), 0.0, 0.0)


@kernel
def move_by(dx: float, dy: float) -> Shift:
    """The move along a straight line."""
    return Shift(0.0, 0.0, 0.0, 1.0, 0.0, dx, dy)


@kernel
def reverse(shift: Shift) -> Shift:
    """The same backwards: how the surroundings move when the body is thought to rest."""
    return Shift(shift.cx, shift.cy, -shift.sweep, shift.cosine, -shift.sine, -shift.dx, -shift.dy)


@kernel
def part(shift: Shift, share: float) -> Shift:
    """A ``share`` of a shift, from its beginning or its end."""
    if shift.sweep == 0.0:
        return move_by(share * shift.dx, share * shift.dy)
    return turn_round(shift.cx, shift.cy, share * shift.sweep)


@kernel
def shifted(shift: Shift, pose: Pose) -> Pose:
    """Where ``pose`` gets to."""
    if shift.sweep == 0.0:
        return pose[0] + shift.dx, pose[1] + shift.dy, pose[2]
    rx, ry = pose[0] - shift.cx, pose[1] - shift.cy
    return (
        shift.cx + shift.cosine * rx - shift.sine * ry,
        shift.cy + shift.sine * rx + shift.cosine * ry,
        pose[2] + shift.sweep,
    )


@kernel
def trace_of(shift: Shift, x: float, y: float) -> Trace:
    """The way of the point (x, y)."""
    if shift.sweep == 0.0:
        return Trace(x, y, x + shift.dx, y + shift.dy, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0)
    rx, ry = x - shift.cx, y - shift.cy
    radius = sqrt(rx * rx + ry * ry)
    ux, uy = (rx / radius, ry / radius) if radius > 0.0 else (1.0, 0.0)
    vx, vy = shift.cosine * ux - shift.sine * uy, shift.sine * ux + shift.cosine * uy
    bx, by = shift.cx + radius * vx, shift.cy + radius * vy
    if shift.sweep < 0.0:
        ux, uy, vx, vy = vx, vy, ux, uy
    return Trace(x, y, bx, by, shift.cx, shift.cy, radius, ux, uy, vx, vy, abs(shift.sweep))


@kernel
def _meets(trace: Trace, dx: float, dy: float) -> bool:
    """Whether an arc meets the direction d from its centre."""
    if trace.sweep >= 2.0 * pi:
        return True
    after_start = trace.ux * dy - trace.uy * dx >= 0.0
    before_end = dx * trace.vy - dy * trace.vx >= 0.0
    if trace.sweep <= pi:
        ahead = dx * (trace.ux + trace.vx) + dy * (trace.uy + trace.vy) >= 0.0
        return after_start and before_end and ahead
    return after_start or before_end


@kernel
def box_of(trace: Trace) -> Box:
    """The smallest box x_min, y_min, x_max, y_max that holds the whole trace."""
    low_x, high_x = min(trace.ax, trace.bx), max(trace.ax, trace.bx)
    low_y, high_y = min(trace.ay, trace.by), max(trace.ay, trace.by)
    if trace.sweep > 0.0:
        if _meets(trace, 1.0, 0.0):
            high_x = max(high_x, trace.cx + trace.radius)
        if _meets(trace, -1.0, 0.0):
            low_x = min(low_x, trace.cx - trace.radius)
        if _meets(trace, 0.0, 1.0):
            high_y = max(high_y, trace.cy + trace.radius)
        if _meets(trace, 0.0, -1.0):
            low_y = min(low_y, trace.cy - trace.radius)
    return low_x, low_y, high_x, high_y


@kernel
def distance_to_point(trace: Trace, x: float, y: float) -> float:
    """Distance [m] between a trace and a point."""
    if trace.sweep == 0.0:
        return sqrt(squared_distance_to_segment(x, y, trace.ax, trace.ay, trace.bx, trace.by))
    rx, ry = x - trace.cx, y - trace.cy
    if _meets(trace, rx, ry):
        return abs(sqrt(rx * rx + ry * ry) - trace.radius)
    to_a = (x - trace.ax) ** 2 + (y - trace.ay) ** 2
    to_b = (x - trace.bx) ** 2 + (y - trace.by) ** 2
    return sqrt(min(to_a, to_b))


@kernel
def segment_distance(
    ax: float, ay: float, bx: float, by: float, x0: float, y0: float, x1: float, y1: float
) -> float:
    """Distance [m] between the segment from a to b and a straight edge; 0 where they cross."""
    dx, dy = bx - ax, by - ay
    ex, ey = x1 - x0, y1 - y0
    start_side = (x0 - ax) * dy - (y0 - ay) * dx
    end_side = (x1 - ax) * dy - (y1 - ay) * dx
    a_side = (ax - x0) * ey - (ay - y0) * ex
    b_side = (bx - x0) * ey - (by - y0) * ex
    if start_side * end_side < 0.0 and a_side * b_side < 0.0:
        return 0.0
    square = min(
        squared_distance_to_segment(ax, ay, x0, y0, x1, y1),
        squared_distance_to_segment(bx, by, x0, y0, x1, y1),
        squared_distance_to_segment(x0, y0, ax, ay, bx, by),
        squared_distance_to_segment(x1, y1, ax, ay, bx, by),
    )
    return sqrt(square)


@kernel
def distance_to_edge(trace: Trace, x0: float, y0: float, x1: float, y1: float) -> float:
    """Distance [m] between a trace and a straight edge; 0 where they cross."""
    if trace.sweep == 0.0:
        return segment_distance(trace.ax, trace.ay, trace.bx, trace.by, x0, y0, x1, y1)
    ends = min(
        squared_distance_to_segment(trace.ax, trace.ay, x0, y0, x1, y1),
        squared_distance_to_segment(trace.bx, trace.by, x0, y0, x1, y1),
    )
    least = min(sqrt(ends), distance_to_point(trace, x0, y0), distance_to_point(trace, x1, y1))
    dx, dy = x1 - x0, y1 - y0
    length = sqrt(dx * dx + dy * dy)
    if length == 0.0:
        return least
    dx, dy = dx / length, dy / length
    rx, ry = x0 - trace.cx, y0 - trace.cy
    along = -(rx * dx + ry * dy)
    foot_x, foot_y = rx + along * dx, ry + along * dy
    offset = sqrt(foot_x * foot_x + foot_y * foot_y)
    if offset >= trace.radius:
        if 0.0 < along < length and offset - trace.radius < least and _meets(trace, foot_x, foot_y):
            least = offset - trace.radius
        return least
    half_chord = sqrt(trace.radius * trace.radius - offset * offset)
    for side in (-1.0, 1.0):
        crossing = along + side * half_chord
        if 0.0 <= crossing <= length and _meets(trace, rx + crossing * dx, ry + crossing * dy):
            return 0.0
    return least
