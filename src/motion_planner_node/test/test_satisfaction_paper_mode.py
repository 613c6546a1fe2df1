"""Mode paper: the equations and Algorithm 1, against the worked example and independent formulas."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Status
from motion_planner_node.functions import Array
from motion_planner_node.language import parse
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import compile_program
from motion_planner_node.satisfaction.paper_mode import (
    Iterate,
    PaperCriterion,
    PaperLimits,
    algorithm_1,
    random_states,
)
from motion_planner_node.world.model import Bounds, Circle, World, WorldObject

WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 200.0, 200.0),
    objects={'o': WorldObject('o', {'x': 50.0, 'y': 50.0})},
    obstacles=(Circle('pond', (75.0, 50.0), 8.0),),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
START = np.array([20.0, 100.0, 0.0])
RING = '(distance(r, o) >= 10)(distance(r, o) <= 20)'
PHOTO = '(distance(r, o) >= 30)(distance(r, o) <= 50)(rel_angle(r, o) = cos-and-sin(pi/2))'


def criterion(text: str) -> PaperCriterion:
    preconditions = parse('(agent r)(object o)' + text)
    return PaperCriterion(compile_program(preconditions, WORLD, {'r': Attitude(*START.tolist())}))


def run(
    text: str,
    count: int,
    limits: PaperLimits | None = None,
    trace: Callable[[Iterate], None] | None = None,
) -> list[Array]:
    states = algorithm_1(
        criterion(text),
        START,
        random_states(np.random.default_rng(0), (0.0, 0.0), (200.0, 200.0)),
        lambda _: True,
        lambda state: state,
        limits or PaperLimits(),
        trace,
    )
    return list(itertools.islice(states, count))


def test_the_worked_example() -> None:
    trace: list[Iterate] = []
    (state,) = run(RING, 1, trace=trace.append)
    assert state == pytest.approx([39.7101, 67.1499, 0.0], abs=1e-4)
    assert [iterate.k for iterate in trace] == [0, 1]
    assert trace[0].criterion == pytest.approx(0.5 * (math.hypot(30.0, 50.0) - 20.0) ** 2)
    assert trace[1].step_length == 1.0
    assert trace[1].criterion < 1e-18


@settings(max_examples=60, deadline=None)
@given(st.floats(0.0, 200.0), st.floats(100.0, 200.0), st.floats(-3.0, 3.0))
def test_functions_and_derived_codes_are_those_of_table_2(x: float, y: float, t: float) -> None:
    dx, dy = 50.0 - x, 50.0 - y
    d = math.hypot(dx, dy)
    (_, least, by_least), (_, most, by_most), (_, f1, by_f1), (_, f2, by_f2) = criterion(
        PHOTO
    ).functions(np.array([x, y, t]))
    assert least == pytest.approx(30.0 - d)
    assert most == pytest.approx(d - 50.0)
    assert by_most == pytest.approx([-dx / d, -dy / d, 0.0])
    assert by_least == pytest.approx([dx / d, dy / d, 0.0])
    assert f1 == pytest.approx((dx * math.cos(t) + dy * math.sin(t)) / d, abs=1e-12)
    assert f2 + 1.0 == pytest.approx((dx * math.sin(t) - dy * math.cos(t)) / d, abs=1e-12)
    assert by_f1 == pytest.approx([0.0, 0.0, (-dx * math.sin(t) + dy * math.cos(t)) / d])
    assert by_f2 == pytest.approx([0.0, 0.0, (dx * math.cos(t) + dy * math.sin(t)) / d])


def test_the_criterion_counts_what_is_missed_and_nothing_else() -> None:
    at = criterion(RING)
    assert at.value(np.array([65.0, 50.0, 0.0])) == 0.0
    assert at.gradient(np.array([65.0, 50.0, 0.0])).tolist() == [0.0, 0.0, 0.0]
    assert at.value(np.array([55.0, 50.0, 0.0])) == pytest.approx(12.5)
    assert at.gradient(np.array([55.0, 50.0, 0.0])) == pytest.approx([-5.0, 0.0, 0.0])


@settings(max_examples=40, deadline=None)
@given(st.floats(0.0, 200.0), st.floats(0.0, 200.0), st.floats(-3.0, 3.0))
def test_every_step_makes_the_criterion_smaller(x: float, y: float, heading: float) -> None:
    trace: list[Iterate] = []
    list(
        algorithm_1(
            criterion(PHOTO + '(r.x >= 60)'),
            np.array([x, y, heading]),
            lambda: np.array([0.0, 0.0, 0.0]),
            lambda _: True,
            lambda state: state,
            PaperLimits(max_tries=1),
            trace.append,
        )
    )
    values = [iterate.criterion for iterate in trace]
    assert all(after < before for before, after in itertools.pairwise(values))


def test_restarts_follow_a_saddle() -> None:
    trace: list[Iterate] = []
    behind = '(rel_angle(r, o) = cos-and-sin(0))'
    opposite = math.atan2(-50.0, 30.0) + math.pi
    states = algorithm_1(
        criterion(behind),
        np.array([20.0, 100.0, opposite]),
        lambda: np.array([20.0, 100.0, 0.0]),
        lambda _: True,
        lambda state: state,
        trace=trace.append,
    )
    first = next(states)
    assert math.remainder(first[2] - math.atan2(-50.0, 30.0), math.tau) == pytest.approx(
        0.0, abs=1e-8
    )


def test_it_ends_after_its_tries_when_nothing_satisfies() -> None:
    trace: list[Iterate] = []
    text = '(distance(r, o) >= 60)(distance(r, o) <= 50)'
    assert run(text, 1, PaperLimits(max_tries=5, max_steps=7), trace.append) == []
    assert {iterate.attempt for iterate in trace} == set(range(5))
    assert max(iterate.k for iterate in trace) <= 7


def ask(text: str, mode: str) -> GeometricRequest:
    state = {'r': Attitude(20.0, 100.0, 0.0)}
    return GeometricRequest(f'(agent r)(object o){text}', state, mode=mode)


def test_the_planner_answers_in_mode_paper_by_request_or_by_parameter() -> None:
    by_request = MotionPlanner(WORLD).satisfy(ask(PHOTO, 'paper'))
    by_parameter = MotionPlanner(WORLD, Parameters(mode='paper')).satisfy(ask(PHOTO, ''))
    assert by_request.status is Status.FOUND
    assert by_request == by_parameter
    end = by_request.end['r']
    assert 30.0 - 1e-6 <= math.hypot(end.x - 50.0, end.y - 50.0) <= 50.0 + 1e-6
    default = MotionPlanner(WORLD, Parameters(mode='paper')).satisfy(ask(PHOTO, 'default'))
    assert default == MotionPlanner(WORLD).satisfy(ask(PHOTO, ''))


def test_mode_paper_gives_alternatives_and_knows_its_limits() -> None:
    planner = MotionPlanner(WORLD, Parameters(mode='paper', paper_tries=12))
    state = {'r': Attitude(20.0, 100.0, 0.0)}
    request = GeometricRequest(f'(agent r)(object o){PHOTO}', state, alternative=1)
    assert planner.satisfy(request).status is Status.FOUND
    assert planner.satisfy(request) == MotionPlanner(
        WORLD, Parameters(mode='paper', paper_tries=12)
    ).satisfy(request)
    nothing = planner.satisfy(ask('(distance(r, o) <= 2)(r.heading > 4)', ''))
    assert nothing.status in {Status.UNKNOWN, Status.IMPOSSIBLE}


def test_an_unknown_mode_is_refused() -> None:
    answer = MotionPlanner(WORLD).satisfy(ask(PHOTO, 'fast'))
    assert answer.code is Code.UNSUPPORTED
    assert 'default, paper' in answer.message
