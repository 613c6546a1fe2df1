"""Driving a car by its three-valued command: where constant-steering segments lead."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, cos, pi, remainder, sin, tan, tau

import numpy as np
from numpy.typing import NDArray

from interface_node.plan import Attitude, Segment

#: More attitudes than this are never sampled from one motion; the spacing grows instead.
MAX_SAMPLES = 20_000


def follow(start: Attitude, segment: Segment, wheelbase: float, distance: float) -> Attitude:
    """Where the car is after ``distance`` [m] of the segment: closed form of the paper's model.

    x' = cos(heading), y' = sin(heading), heading' = tan(steering angle) / wheelbase, per metre.
    """
    turned = tan(segment.steering_angle) / wheelbase * distance
    # An arc's chord: shorter than the arc by sinc of half the angle that it turns through.
    chord = distance * (sin(turned / 2) / (turned / 2) if turned else 1.0)
    along = start.heading + turned / 2
    heading = remainder(start.heading + turned, tau)
    return Attitude(
        start.x + chord * cos(along),
        start.y + chord * sin(along),
        pi if heading == -pi else heading,
    )


def drive(start: Attitude, segments: Sequence[Segment], wheelbase: float) -> Attitude:
    """Where the car ends after all segments."""
    for segment in segments:
        start = follow(start, segment, wheelbase, segment.length)
    return start


def sample(
    start: Attitude, segments: Sequence[Segment], wheelbase: float, spacing: float
) -> NDArray[np.float64]:
    """Attitudes along the motion, shape (n, 3): x, y [m] and heading [rad].

    Neighbours are at most ``spacing`` [m] apart, unless that took more than MAX_SAMPLES; the
    ends of every segment are among them.
    """
    total = sum(segment.length for segment in segments)
    spacing = max(spacing, total / MAX_SAMPLES)
    attitudes = [start]
    for segment in segments:
        origin = attitudes[-1]
        pieces = max(1, ceil(segment.length / spacing))
        attitudes += [
            follow(origin, segment, wheelbase, segment.length * k / pieces)
            for k in range(1, pieces + 1)
        ]
    return np.array([(a.x, a.y, a.heading) for a in attitudes], dtype=np.float64)
