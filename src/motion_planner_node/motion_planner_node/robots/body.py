"""The shape of a robot and the distance that it keeps, as the kernels take them."""

from __future__ import annotations

from functools import lru_cache
from math import hypot
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel

#: A robot may touch a boundary, and rounding may press it in by as much as this [m].
TOUCH = 1e-9

Corners = tuple[tuple[float, float], ...]


class Body(NamedTuple):
    """A disc round the robot's reference point, or a simple polygon that holds that point.

    corners: (k, 2) x forward, y left [m] in the robot's frame; k is 0 for a disc.
    radius: [m] of the disc, or of the smallest one round the reference point with all corners.
    inner_radius: [m] of the largest disc round the reference point that is inside the body.
    margin: clearance [m] to keep: of the reference point for a disc, of the outline for a polygon.
    """

    corners: NDArray[np.float64]
    radius: float
    inner_radius: float
    margin: float


@lru_cache(maxsize=1024)
def body_of(footprint: Corners, radius: float, safety_margin: float) -> Body:
    """The body of a polygon ``footprint``, or of a disc of ``radius`` [m] when it has no corners."""
    corners = np.array(footprint, dtype=np.float64).reshape(-1, 2)
    if not len(corners):
        margin = max(radius + safety_margin - TOUCH, TOUCH)
        return Body(corners, float(radius), float(radius), float(margin))
    outer = max(hypot(x, y) for x, y in footprint)
    following = footprint[1:] + footprint[:1]
    inner = min(distance_from_edge(*a, *b) for a, b in zip(footprint, following, strict=True))
    return Body(corners, float(outer), float(inner), float(max(safety_margin - TOUCH, TOUCH)))


def distance_from_edge(x0: float, y0: float, x1: float, y1: float) -> float:
    """Distance [m] from the origin to the straight edge between two corners."""
    dx, dy = x1 - x0, y1 - y0
    square = dx * dx + dy * dy
    along = min(max(-(x0 * dx + y0 * dy) / square, 0.0), 1.0) if square > 0.0 else 0.0
    return hypot(x0 + along * dx, y0 + along * dy)


@kernel
def sufficient_clearance(body: Body) -> float:
    """Clearance [m] of the reference point with which the body is free, however it is turned."""
    return body.margin if len(body.corners) == 0 else body.radius + body.margin


@kernel
def necessary_clearance(body: Body) -> float:
    """Clearance [m] of the reference point without which the body is not free in any heading."""
    return body.margin if len(body.corners) == 0 else body.inner_radius + body.margin
