from __future__ import annotations

from math import cos, hypot, inf, nextafter, pi, remainder, sin, tan, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.driving import (
    end_of,
    integrate,
    sample,
    shortest_between,
    words_between,
)
from motion_planner_node.robots.motion import Attitude, Motion, Segment, merged
from motion_planner_node.robots.robot import Robot

CAR = Robot('rover', wheelbase=8.0, max_steering_angle=0.5, radius=5.0, speed=2.0)

headings = st.floats(-pi, pi)
steering_angles = st.sampled_from([-0.5, 0.0, 0.5])
segments = st.builds(Segment, steering_angles, st.floats(1e-6, 80.0))


@st.composite
def attitudes(draw: st.DrawFn) -> Attitude:
    scale = draw(st.sampled_from([0.0, 1e-6, 0.01, 1.0, 30.0, 500.0]))
    unit = st.floats(-1.0, 1.0)
    return Attitude(scale * draw(unit), scale * draw(unit), draw(headings))


def integrate_numerically(start: Attitude, driven: list[Segment]) -> Attitude:
    """Runge-Kutta on the paper's differential equations, in steps of 5 cm at most."""

    def slope(state: NDArray[np.float64], steering_angle: float) -> NDArray[np.float64]:
        return np.array([cos(state[2]), sin(state[2]), tan(steering_angle) / CAR.wheelbase])

    state = np.array([start.x, start.y, start.heading])
    for segment in driven:
        steps = int(np.ceil(segment.length / 0.05))
        h = segment.length / steps
        for _ in range(steps):
            k1 = slope(state, segment.steering_angle)
            k2 = slope(state + h / 2 * k1, segment.steering_angle)
            k3 = slope(state + h / 2 * k2, segment.steering_angle)
            k4 = slope(state + h * k3, segment.steering_angle)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return Attitude(*map(float, state))


def gap(a: Attitude, b: Attitude) -> float:
    return max(hypot(a.x - b.x, a.y - b.y), abs(remainder(a.heading - b.heading, tau)))


@settings(max_examples=25, deadline=None)
@given(attitudes(), st.lists(segments, max_size=4))
def test_closed_form_agrees_with_the_differential_equations(
    start: Attitude, driven: list[Segment]
) -> None:
    end = integrate(start, driven, CAR)
    assert gap(end, integrate_numerically(start, driven)) < 1e-7
    assert -pi < end.heading <= pi


@settings(deadline=None)
@given(attitudes(), attitudes())
def test_every_word_ends_where_it_should(start: Attitude, end: Attitude) -> None:
    words = words_between(start, end, CAR)
    assert 1 <= len(words) <= 6
    lengths = [sum(segment.length for segment in word) for word in words]
    assert lengths == sorted(lengths)
    for word in words:
        assert gap(integrate(start, word, CAR), end) < 2e-9
        assert {segment.steering_angle for segment in word} <= {-0.5, 0.0, 0.5}
        assert all(segment.length > 0.0 for segment in word)


def test_shortest_word_is_as_short_as_ompl_says() -> None:
    space = base.DubinsStateSpace(CAR.turning_radius)
    states = space.allocState(), space.allocState()
    rng = np.random.default_rng(7)
    for scale in (0.1, 1.0, 10.0, 50.0, 500.0):
        rows = rng.uniform(-1.0, 1.0, (500, 2, 3)) * [scale, scale, pi]
        ours = shortest_between(rows[:, 0], rows[:, 1], CAR)
        for pair, length in zip(rows, ours, strict=True):
            for state, (x, y, heading) in zip(states, pair, strict=True):
                state.setXY(x, y)
                state.setYaw(heading)
            assert length == pytest.approx(space.distance(*states), abs=1e-6)


@settings(deadline=None)
@given(attitudes(), st.lists(attitudes(), min_size=1, max_size=5))
def test_lengths_of_many_are_those_of_each(start: Attitude, ends: list[Attitude]) -> None:
    rows = np.array([[end.x, end.y, end.heading] for end in ends])
    lengths = shortest_between(np.array([start.x, start.y, start.heading]), rows, CAR)
    shortest = [words_between(start, end, CAR)[0] for end in ends]
    expected = [sum(segment.length for segment in word) for word in shortest]
    assert lengths == pytest.approx(expected, abs=1e-9)


@settings(deadline=None)
@given(attitudes(), st.floats(0.0, 300.0), st.floats(-1e-13, 1e-13))
def test_rounding_never_costs_a_full_circle(start: Attitude, ahead: float, turn: float) -> None:
    end = Attitude(
        start.x + ahead * cos(start.heading),
        start.y + ahead * sin(start.heading),
        start.heading + turn,
    )
    length = sum(segment.length for segment in words_between(start, end, CAR)[0])
    assert length == pytest.approx(ahead, abs=1e-5)


@settings(deadline=None)
@given(attitudes(), st.lists(segments, max_size=4), st.floats(0.1, 50.0))
def test_samples_are_on_the_motion_and_close_enough(
    start: Attitude, driven: list[Segment], spacing: float
) -> None:
    motion = Motion('rover', start, tuple(driven))
    rows = sample(motion, CAR, spacing)
    assert rows.shape[1] == 3
    steps = np.hypot(*np.diff(rows[:, :2], axis=0).T)
    assert (steps <= spacing + 1e-9).all()
    assert gap(Attitude(*rows[0]), start) < 1e-12
    assert gap(Attitude(*rows[-1]), end_of(motion, CAR)) < 1e-9
    assert ((rows[:, 2] > -pi) & (rows[:, 2] <= pi)).all()


def test_neighbours_of_one_steering_angle_are_joined_and_empty_segments_dropped() -> None:
    parts = [Segment(0.5, 1.0), Segment(0.0, 0.0), Segment(0.5, 2.0), Segment(0.0, 4.0)]
    assert merged(parts) == (Segment(0.5, 3.0), Segment(0.0, 4.0))


@settings(deadline=None)
@given(st.one_of(st.floats(-1e6, 1e6), st.sampled_from([pi, -pi, 3 * pi, nextafter(-pi, -inf)])))
def test_wrapped_angles_are_in_the_half_open_interval(angle: float) -> None:
    wrapped = wrap_angle(angle)
    assert -pi < wrapped <= pi
    assert abs(remainder(wrapped - angle, tau)) < 1e-9
    assert wrap_angle(wrapped) == wrapped
