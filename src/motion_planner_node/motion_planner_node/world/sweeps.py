"""Exact collision and clearance of a body that is driven along arcs, slides and turns.

A motion is followed in steps: over ground where the index knows of nothing near in one stride, and
else with the edges and discs of the buckets round each step, all of them exactly.
"""

from __future__ import annotations

from math import cos, inf, sin, sqrt

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import Body
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.bodies import (
    moving_distance,
    place,
    room_in_bounds,
    standing_distance,
    trace_distance,
)
from motion_planner_node.world.clearance import clearance_within
from motion_planner_node.world.glance import FREE, UNKNOWN, glance
from motion_planner_node.world.index import FIRST, LAST, SKIP, bucket_at, empty_radius
from motion_planner_node.world.shapes import Shapes
from motion_planner_node.world.traces import (
    Shift,
    box_of,
    move_by,
    part,
    shifted,
    trace_of,
    turn_round,
)

#: Items that are remembered so as not to be looked at twice in one step; a power of 2.
_REMEMBERED = 64


@kernel
def _step_distance(
    shapes: Shapes,
    body: Body,
    corners: NDArray[np.float64],
    pose: Pose,
    shift: Shift,
    enough: float,
    least: float,
) -> float:
    """The least of ``least`` and the distances [m] of everything near one step.

    Once it is known to be below ``enough``, any value below that.
    """
    place(body, pose, corners)
    trace = trace_of(shift, pose[0], pose[1])
    box = box_of(trace)
    is_standing = shift.sweep == 0.0 and shift.dx == 0.0 and shift.dy == 0.0
    reach = body.radius if len(corners) else 0.0
    beyond = reach + least
    buckets, items = shapes.buckets, shapes.items
    first_row, first_column, _ = bucket_at(shapes.frame, buckets, box[0] - beyond, box[1] - beyond)
    last_row, last_column, _ = bucket_at(shapes.frame, buckets, box[2] + beyond, box[3] + beyond)
    # What is in one bucket is there once.
    repeats = first_row != last_row or first_column != last_column
    seen = np.full(_REMEMBERED if repeats else 0, -1)
    for row in range(first_row, last_row + 1):
        column = first_column
        while column <= last_column:
            here = column
            column += max(int(buckets[row, here, SKIP]), 1)
            for at in range(buckets[row, here, FIRST], buckets[row, here, LAST]):
                item = int(items[at])
                if repeats:
                    if seen[item % _REMEMBERED] == item:
                        continue
                    seen[item % _REMEMBERED] = item
                distance = trace_distance(shapes, trace, item)
                if len(corners):
                    if distance >= reach + least:
                        continue
                    if distance < body.inner_radius + enough:
                        return -inf
                    if is_standing:
                        distance = standing_distance(shapes, corners, item)
                    else:
                        distance = moving_distance(shapes, corners, shift, item)
                if distance < least:
                    least = distance
                    if least < enough:
                        return least
    return least


@kernel
def _shift_distance(
    shapes: Shapes,
    body: Body,
    corners: NDArray[np.float64],
    pose: Pose,
    shift: Shift,
    enough: float,
    least: float,
) -> float:
    """The least of ``least`` and the distances [m] to everything while ``shift`` is carried out.

    From the outline of a polygon, from the middle of a disc; once it is known to be below
    ``enough``, any value below that.
    """
    place(body, pose, corners)
    least = min(least, room_in_bounds(shapes, corners, pose, shift))
    if least < enough:
        return least
    if shift.sweep == 0.0:
        length = sqrt(shift.dx * shift.dx + shift.dy * shift.dy)
    else:
        rx, ry = pose[0] - shift.cx, pose[1] - shift.cy
        length = abs(shift.sweep) * sqrt(rx * rx + ry * ry)
    size = shapes.frame[2]
    reach = body.radius if len(corners) else 0.0
    done = 0.0
    while True:
        here = shifted(part(shift, done / length), pose) if done > 0.0 else pose
        stride = empty_radius(shapes.frame, shapes.buckets, here[0], here[1]) - reach - least
        if stride < 0.5 * size:
            stride = min(reach + least + 2.0 * size, length - done)
            step = part(shift, stride / length) if stride < length else shift
            least = _step_distance(shapes, body, corners, here, step, enough, least)
            if least < enough:
                return least
        done += stride
        if not done < length:
            return least


@kernel
def _pieces_distance(
    shapes: Shapes,
    body: Body,
    start: Pose,
    pieces: NDArray[np.float64],
    enough: float,
    least: float,
) -> float:
    """The same while ``pieces`` (n, 4) are driven from ``start``, which is free."""
    corners = np.empty_like(body.corners)
    pose = start
    for i in range(len(pieces)):
        bend, length, direction, turn = pieces[i]
        course = pose[2] + direction
        if length != 0.0:
            if bend == 0.0:
                shift = move_by(length * cos(course), length * sin(course))
            else:
                center_x, center_y = pose[0] - sin(course) / bend, pose[1] + cos(course) / bend
                shift = turn_round(center_x, center_y, bend * length)
            least = _shift_distance(shapes, body, corners, pose, shift, enough, least)
        if turn != 0.0 and len(corners) and least >= enough:
            x, y, heading = advance(pose[0], pose[1], pose[2], bend, length, direction, 0.0)
            shift = turn_round(x, y, turn)
            least = _shift_distance(shapes, body, corners, (x, y, heading), shift, enough, least)
        if least < enough:
            return least
        pose = advance(pose[0], pose[1], pose[2], bend, length, direction, turn)
    return least


@kernel
def _standing(shapes: Shapes, body: Body, pose: Pose, enough: float, most: float) -> float:
    """Distance [m] of a standing body from everything, at most ``most``.

    From the outline of a polygon, from the middle of a disc.  Once it is known to be below
    ``enough``, any value below that.
    """
    reach = body.radius if len(body.corners) else 0.0
    clearance = clearance_within(shapes, pose[0], pose[1], reach + most)[0]
    if len(body.corners) == 0:
        return clearance
    if clearance >= reach + most:
        return most
    if not clearance >= max(body.inner_radius + enough, 0.0):
        return -inf
    corners = np.empty_like(body.corners)
    place(body, pose, corners)
    nowhere = move_by(0.0, 0.0)
    least = min(most, room_in_bounds(shapes, corners, pose, nowhere))
    if least < enough:
        return least
    return _step_distance(shapes, body, corners, pose, nowhere, enough, least)


@kernel
def is_free_at(shapes: Shapes, body: Body, pose: Pose) -> bool:
    """Whether ``body`` can stand at ``pose``."""
    return _standing(shapes, body, pose, body.margin, body.margin) >= body.margin


@kernel
def are_free(shapes: Shapes, body: Body, attitudes: NDArray[np.float64]) -> NDArray[np.bool_]:
    """At which of ``attitudes`` (n, 3) the ``body`` can stand, shape (n,)."""
    result = np.empty(len(attitudes), np.bool_)
    for i in range(len(attitudes)):
        pose = (attitudes[i, 0], attitudes[i, 1], attitudes[i, 2])
        result[i] = is_free_at(shapes, body, pose)
    return result


@kernel
def word_is_free(shapes: Shapes, body: Body, start: Pose, pieces: NDArray[np.float64]) -> bool:
    """Whether driving ``pieces`` (n, 4) is free from ``start``, itself free.

    Pieces are rows of curvature [1/m], length [m], direction [rad] and turn [rad].
    """
    seen = glance(shapes, body, start, pieces)
    if seen != UNKNOWN:
        return seen == FREE
    margin = body.margin
    return _pieces_distance(shapes, body, start, pieces, margin, margin) >= margin


@kernel
def chain_is_free(
    shapes: Shapes, body: Body, start: NDArray[np.float64], pieces: NDArray[np.float64]
) -> bool:
    """Whether driving ``pieces`` (n, 4) from ``start`` (3,) is free, as `word_is_free` does."""
    pose = (start[0], start[1], start[2])
    return is_free_at(shapes, body, pose) and word_is_free(shapes, body, pose, pieces)


@kernel
def chain_clearance(
    shapes: Shapes, body: Body, start: NDArray[np.float64], pieces: NDArray[np.float64]
) -> float:
    """Least distance [m] of the body from obstacles and bounds while ``pieces`` (n, 4) are driven.

    0 when the body hits one.
    """
    pose = (start[0], start[1], start[2])
    touching = 0.0 if len(body.corners) else body.radius
    least = _standing(shapes, body, pose, touching, inf)
    if least > touching:
        least = _pieces_distance(shapes, body, pose, pieces, touching, least)
    return max(least - touching, 0.0)
