"""Every model's steering function against its differential equations, OMPL and symmetry."""

from __future__ import annotations

from math import cos, hypot, inf, isfinite, pi, remainder, sin, tan, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from ompl import base
from scipy.integrate import solve_ivp

from motion_planner_node.robots.driving import (
    integrate,
    sample,
    shortest_between,
    words_between,
)
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot
from motion_planner_node.robots.steering import MOST_PIECES, shortest_word, word, words

ROBOTS = {
    'car': Robot('r', 8.0, 0.5, 1.0, 2.0),
    'reverse_car': Robot('r', 8.0, 0.5, 1.0, 2.0, kind='reverse_car'),
    'differential': Robot('r', 0.0, 0.0, 1.0, 2.0, kind='differential', turning_speed=0.5),
    'omnidirectional': Robot('r', 0.0, 0.0, 1.0, 2.0, kind='omnidirectional', turning_speed=0.5),
}
robots = st.sampled_from(list(ROBOTS.values()))
headings = st.floats(-pi, pi)


def attitudes(reach: float = 100.0) -> st.SearchStrategy[Attitude]:
    return st.builds(Attitude, st.floats(-reach, reach), st.floats(-reach, reach), headings)


def gap(one: Attitude, other: Attitude) -> float:
    return hypot(one.x - other.x, one.y - other.y, remainder(one.heading - other.heading, tau))


def rows_of(*items: Attitude) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    return np.array([[item.x, item.y, item.heading] for item in items])


def length_between(start: Attitude, end: Attitude, robot: Robot) -> float:
    return float(shortest_between(rows_of(start), rows_of(end), robot)[0])


def driven_numerically(start: Attitude, segment: Segment, robot: Robot) -> Attitude:
    """The kinematic equations, integrated at unit speed over the segment."""
    if segment.turn:
        return Attitude(start.x, start.y, start.heading + segment.turn)
    speed = 1.0 if segment.length >= 0.0 else -1.0
    bend = tan(segment.steering_angle) / robot.wheelbase if segment.steering_angle else 0.0

    def rates(_: float, state: list[float]) -> list[float]:
        course = state[2] + segment.direction
        return [speed * cos(course), speed * sin(course), speed * bend]

    state = [start.x, start.y, start.heading]
    span = (0.0, abs(segment.length))
    result = solve_ivp(rates, span, state, rtol=1e-10, atol=1e-10)
    return Attitude(*(float(value) for value in result.y[:, -1]))


def test_there_is_a_robot_of_every_model() -> None:
    assert set(ROBOTS) == set(MODELS)
    assert [ROBOTS[name].steering for name in MODELS] == list(range(len(MODELS)))


@settings(deadline=None)
@given(robots, attitudes(), attitudes())
def test_every_word_of_every_model_ends_where_it_should(
    robot: Robot, start: Attitude, end: Attitude
) -> None:
    found = words_between(start, end, robot)
    assert found
    lengths = [sum(abs(segment.length) for segment in segments) for segments in found]
    assert lengths == sorted(lengths)
    assert lengths[0] == pytest.approx(length_between(start, end, robot), abs=1e-9)
    for segments in found:
        assert gap(integrate(start, segments, robot), end) < 2e-9


@settings(max_examples=40, deadline=None)
@given(robots, attitudes(), attitudes())
def test_the_shortest_word_obeys_the_equations_and_the_allowed_commands(
    robot: Robot, start: Attitude, end: Attitude
) -> None:
    here = start
    for segment in words_between(start, end, robot)[0]:
        allowed = {-0.5, 0.0, 0.5} if MODELS[robot.kind].steers else {0.0}
        assert segment.steering_angle in allowed
        assert segment.length > 0.0 or robot.kind in ('reverse_car', 'differential') or segment.turn
        assert not segment.turn or (MODELS[robot.kind].turns and segment.length == 0.0)
        assert not segment.direction or robot.kind == 'omnidirectional'
        here = driven_numerically(here, segment, robot)
    assert gap(here, end) < 1e-6


@pytest.mark.parametrize(
    ('kind', 'space'),
    [('car', base.DubinsStateSpace), ('reverse_car', base.ReedsSheppStateSpace)],
)
def test_lengths_are_those_of_ompl(kind: str, space: type[base.StateSpace]) -> None:
    robot = ROBOTS[kind]
    peer = space(robot.turning_radius)
    states = peer.allocState(), peer.allocState()
    rng = np.random.default_rng(7)
    for scale in (1e-3, 0.1, 1.0, 10.0, 30.0, 50.0, 500.0):
        rows = rng.uniform(-1.0, 1.0, (500, 2, 3)) * [scale, scale, pi]
        ours = shortest_between(rows[:, 0], rows[:, 1], robot)
        for pair, length in zip(rows, ours, strict=True):
            for state, (x, y, heading) in zip(states, pair, strict=True):
                state.setXY(x, y)
                state.setYaw(heading)
            assert length == pytest.approx(peer.distance(*states), abs=1e-6)


@settings(deadline=None)
@given(robots, attitudes(), attitudes(), headings, st.booleans())
def test_lengths_are_the_same_when_all_is_turned_or_mirrored(
    robot: Robot, start: Attitude, end: Attitude, turn: float, mirrored: bool
) -> None:
    side = -1.0 if mirrored else 1.0

    def moved(item: Attitude) -> Attitude:
        x, y = item.x, side * item.y
        return Attitude(
            x * cos(turn) - y * sin(turn) + 3.0,
            x * sin(turn) + y * cos(turn) - 4.0,
            remainder(side * item.heading + turn, tau),
        )

    expected = length_between(start, end, robot)
    # Rounding may cost a car that only drives forward a full circle, or save it one.
    circle = tau * robot.turning_radius if robot.kind == 'car' else inf
    difference = abs(length_between(moved(start), moved(end), robot) - expected)
    assert min(difference, abs(difference - circle)) < 1e-4


@settings(deadline=None)
@given(robots.filter(lambda robot: robot.kind != 'car'), attitudes(), attitudes())
def test_what_can_reverse_goes_back_as_far_as_it_came(
    robot: Robot, start: Attitude, end: Attitude
) -> None:
    there, back = length_between(start, end, robot), length_between(end, start, robot)
    assert there == pytest.approx(back, abs=1e-6)
    assert there <= length_between(start, end, ROBOTS['car']) + 1e-9


@settings(deadline=None)
@given(attitudes(), attitudes())
def test_turning_on_the_spot_makes_the_straight_line_the_shortest(
    start: Attitude, end: Attitude
) -> None:
    straight = hypot(end.x - start.x, end.y - start.y)
    for kind in ('differential', 'omnidirectional'):
        assert length_between(start, end, ROBOTS[kind]) == pytest.approx(straight, abs=1e-9)


@given(attitudes(), attitudes())
@settings(deadline=None)
def test_a_differential_drive_drives_the_way_that_turns_less(
    start: Attitude, end: Attitude
) -> None:
    first = words_between(start, end, ROBOTS['differential'])[0]
    turned = sum(abs(segment.turn) for segment in first)
    course = Attitude(0.0, 0.0, np.arctan2(end.y - start.y, end.x - start.x)).heading
    totals = [
        abs(remainder(course + back - start.heading, tau))
        + abs(remainder(end.heading - course - back, tau))
        for back in (0.0, pi)
    ]
    assert hypot(end.x - start.x, end.y - start.y) < 1e-9 or turned <= min(totals) + 1e-9


def test_the_shortest_word_is_the_first_of_the_shortest_and_no_word_is_negative() -> None:
    rng = np.random.default_rng(3)
    pieces, other = np.ones((MOST_PIECES, 4)), np.zeros((MOST_PIECES, 4))
    for robot in ROBOTS.values():
        frame = (robot.steering, robot.turning_radius)
        for _ in range(50):
            start, end = (tuple(row) for row in rng.uniform(-40.0, 40.0, (2, 3)).tolist())
            length, number = shortest_word(*frame, start, end, inf, pieces)
            lengths = [word(*frame, k, start, end, other) for k in range(words(robot.steering))]
            assert number == int(np.argmin(lengths))
            assert length == min(lengths) == pytest.approx(np.abs(pieces[:, 1]).sum())
            assert all(value >= 0.0 or not isfinite(value) for value in lengths)
            word(*frame, number, start, end, other)
            assert (other == pieces).all()


commands = st.one_of(
    st.builds(Segment, st.sampled_from([-0.5, 0.0, 0.5]), st.floats(-60.0, 60.0)),
    st.builds(Segment, st.just(0.0), st.just(0.0), st.just(0.0), st.floats(-7.0, 7.0)),
    st.builds(Segment, st.just(0.0), st.floats(0.0, 60.0), st.floats(-pi, pi)),
)


@settings(max_examples=60, deadline=None)
@given(attitudes(), st.lists(commands, max_size=4), st.floats(0.1, 50.0))
def test_samples_are_on_the_motion_and_close_enough(
    start: Attitude, driven: list[Segment], spacing: float
) -> None:
    robot = Robot('r', 8.0, 0.5, 1.0, 2.0, turning_speed=0.5)
    rows = sample(Motion('r', start, tuple(driven)), robot, spacing)
    steps = np.hypot(*np.diff(rows[:, :2], axis=0).T)
    assert (steps <= spacing + 1e-9).all()
    here = start
    joints = [start]
    for segment in driven:
        here = driven_numerically(here, segment, robot)
        joints.append(here)
    for joint in joints:
        assert min(gap(Attitude(*row), joint) for row in rows.tolist()) < 1e-6


def test_a_motion_takes_as_long_as_its_drives_and_turns() -> None:
    robot = ROBOTS['differential']
    segments = (Segment(0.0, 0.0, turn=-1.0), Segment(0.0, -6.0), Segment(0.0, 0.0, turn=0.5))
    motion = Motion('r', Attitude(0.0, 0.0, 0.0), segments)
    assert motion.length == 6.0
    assert robot.duration(motion) == pytest.approx(6.0 / 2.0 + 1.5 / 0.5)
    assert ROBOTS['car'].duration(Motion('r', motion.start)) == 0.0


@given(robots, st.lists(commands, max_size=5))
def test_segments_survive_the_kernels_form(robot: Robot, driven: list[Segment]) -> None:
    if not MODELS[robot.kind].steers:
        driven = [segment for segment in driven if segment.steering_angle == 0.0]
    once = robot.segments_of(robot.pieces_of(driven))
    assert robot.segments_of(robot.pieces_of(once)) == once
    start = Attitude(1.0, 2.0, 0.5)
    assert gap(integrate(start, once, robot), integrate(start, driven, robot)) < 1e-9
