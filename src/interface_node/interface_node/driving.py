"""Driving a robot by its segments: where arcs, slides and turns on the spot lead."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, cos, pi, remainder, sin, tan, tau

import numpy as np
from numpy.typing import NDArray

from interface_node.plan import Attitude, Segment

#: More attitudes than this are never sampled from one motion; the spacing grows instead.
MAX_SAMPLES = 20_000
#: A turn on the spot is sampled at steps of at most this [rad], as far as MAX_SAMPLES allows.
TURN_SPACING = pi / 18


def follow(start: Attitude, segment: Segment, wheelbase: float, share: float = 1.0) -> Attitude:
    """Where the robot is after a ``share`` of the segment: closed form of the paper's model.

    x' = cos(heading), y' = sin(heading), heading' = tan(steering angle) / wheelbase, per metre. A
    slide leads off at an angle from the heading, a turn on the spot turns only.
    """
    length, angle = segment.length * share, segment.steering_angle
    turned = tan(angle) / wheelbase * length if angle else 0.0
    # An arc's chord: shorter than the arc by sinc of half the angle that it turns through.
    chord = length * (sin(turned / 2) / (turned / 2) if turned else 1.0)
    along = start.heading + turned / 2 + segment.direction
    heading = remainder(start.heading + turned + segment.turn * share, tau)
    return Attitude(
        start.x + chord * cos(along),
        start.y + chord * sin(along),
        pi if heading == -pi else heading,
    )


def drive(start: Attitude, segments: Sequence[Segment], wheelbase: float) -> Attitude:
    """Where the robot ends after all segments."""
    for segment in segments:
        start = follow(start, segment, wheelbase)
    return start


def sample(
    start: Attitude, segments: Sequence[Segment], wheelbase: float, spacing: float
) -> NDArray[np.float64]:
    """Attitudes along the motion, shape (n, 3): x, y [m] and heading [rad].

    Neighbours are at most ``spacing`` [m] and TURN_SPACING apart, unless that took more than
    MAX_SAMPLES; the ends of every segment are among them.
    """
    spacing = max(spacing, sum(abs(segment.length) for segment in segments) / MAX_SAMPLES)
    turning = max(TURN_SPACING, sum(abs(segment.turn) for segment in segments) / MAX_SAMPLES)
    attitudes = [start]
    for segment in segments:
        origin = attitudes[-1]
        pieces = max(1, ceil(abs(segment.length) / spacing), ceil(abs(segment.turn) / turning))
        attitudes += [follow(origin, segment, wheelbase, k / pieces) for k in range(1, pieces + 1)]
    return np.array([(a.x, a.y, a.heading) for a in attitudes], dtype=np.float64)
