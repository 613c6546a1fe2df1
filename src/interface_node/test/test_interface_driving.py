"""Driving: the closed form against the equations of motion, integrated step by step."""

from __future__ import annotations

from math import cos, dist, hypot, pi, sin, tan

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from interface_node.driving import MAX_SAMPLES, drive, sample
from interface_node.plan import Attitude, Segment

attitudes = st.builds(Attitude, st.floats(-500, 500), st.floats(-500, 500), st.floats(-3.14, 3.14))
motions = st.lists(
    st.builds(Segment, st.sampled_from([-0.5, 0.0, 0.5]), st.floats(0.01, 60)),
    min_size=1,
    max_size=4,
)


def runge_kutta(
    x: float, y: float, heading: float, segments: list[Segment], wheelbase: float
) -> tuple[float, float, float]:
    """Integrate x' = cos h, y' = sin h, h' = tan(phi) / L by the midpoint of each small step."""
    for segment in segments:
        steps = 2000
        ds = segment.length / steps
        rate = tan(segment.steering_angle) / wheelbase
        for _ in range(steps):
            middle = heading + rate * ds / 2
            x, y, heading = x + ds * cos(middle), y + ds * sin(middle), heading + rate * ds
    return x, y, heading


@settings(max_examples=25, deadline=None)
@given(attitudes, motions)
def test_the_end_is_where_the_equations_of_motion_lead(
    start: Attitude, segments: list[Segment]
) -> None:
    end = drive(start, segments, 8.0)
    x, y, heading = runge_kutta(start.x, start.y, start.heading, segments, 8.0)
    assert hypot(end.x - x, end.y - y) < 1e-4
    assert hypot(cos(end.heading) - cos(heading), sin(end.heading) - sin(heading)) < 1e-9
    assert -pi < end.heading <= pi


@settings(max_examples=50, deadline=None)
@given(attitudes, motions, st.floats(0.1, 20))
def test_samples_lie_on_the_way_and_close_together(
    start: Attitude, segments: list[Segment], spacing: float
) -> None:
    samples = sample(start, segments, 8.0, spacing)
    assert tuple(samples[0]) == (start.x, start.y, start.heading)
    end = drive(start, segments, 8.0)
    assert dist(samples[-1][:2], (end.x, end.y)) < 1e-9
    chords = np.hypot(*np.diff(samples[:, :2], axis=0).T)
    assert np.all(chords <= spacing + 1e-9)
    total = sum(segment.length for segment in segments)
    assert np.sum(chords) <= total + 1e-9


def test_a_very_long_motion_is_sampled_more_widely() -> None:
    samples = sample(Attitude(0.0, 0.0, 0.0), [Segment(0.0, 1e6)], 8.0, 0.01)
    assert len(samples) <= MAX_SAMPLES + 1


def test_a_car_drives_backwards_along_the_arc_that_it_came() -> None:
    start = Attitude(1.0, 2.0, 0.5)
    there = [Segment(0.5, 7.0), Segment(0.0, 3.0)]
    back = [Segment(0.0, -3.0), Segment(0.5, -7.0)]
    end = drive(start, [*there, *back], 8.0)
    assert hypot(end.x - start.x, end.y - start.y, end.heading - start.heading) < 1e-12


def test_slides_keep_the_heading_and_turns_the_place() -> None:
    start = Attitude(1.0, 2.0, pi / 2)
    slid, turned = Segment(0.0, 3.0, direction=-pi / 2), Segment(0.0, 0.0, turn=-pi)
    end = drive(start, [slid, turned], 0.0)
    assert hypot(end.x - 4.0, end.y - 2.0) < 1e-12
    assert abs(end.heading + pi / 2) < 1e-12
    rows = sample(start, [slid, turned], 0.0, 0.5)
    steps = np.diff(rows, axis=0)
    assert np.abs(steps[:, 2]).max() <= pi / 18 + 1e-9
    assert np.hypot(steps[:, 0], steps[:, 1]).max() <= 0.5 + 1e-9
    assert len(sample(start, [Segment(0.0, 0.0, turn=1e9)], 0.0, 0.5)) <= MAX_SAMPLES + 1
