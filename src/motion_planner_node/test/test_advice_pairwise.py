"""Pairwise costs against the motions that they are about."""

from __future__ import annotations

from math import inf, pi
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Status
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

MISSIONS = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions'
TEXT = (MISSIONS / 'rover' / 'world.yaml').read_text(encoding='utf-8')
PLANNER = MotionPlanner(read_world(TEXT, 'world.yaml'))
START = {'rover0': Attitude(20.0, 20.0, 0.0)}
NEAR = '((agent rover0)(object {0})(distance(rover0, {0}) <= 60))'
TEXTS = (
    *(NEAR.format(f'location{number}') for number in range(1, 9)),
    '((agent rover0)(object location4)(distance(rover0, location4) = 75)(rover0.heading = pi/2))',
)
COUNT = len(TEXTS)


def matrices(answer: AdviceAnswer) -> tuple[np.ndarray, np.ndarray]:
    count = len(answer.candidates)
    return (
        np.array(answer.pairwise_lower_bounds).reshape(count, count),
        np.array(answer.pairwise_estimates).reshape(count, count),
    )


ADVICE = PLANNER.advise(AdviceRequest(TEXTS, START, pairwise=True))
BOUNDS, ESTIMATES = matrices(ADVICE)
numbers = st.integers(0, COUNT - 1)


@settings(max_examples=20, deadline=None)
@given(numbers, numbers, st.integers(0, 2), st.floats(-pi, pi, exclude_min=True))
def test_no_motion_from_candidate_to_candidate_is_shorter_than_its_bound(
    one: int, other: int, alternative: int, heading: float
) -> None:
    start = {'rover0': Attitude(20.0, 20.0, heading)}
    first = PLANNER.satisfy(GeometricRequest(TEXTS[one], start, alternative=alternative))
    if first.status is Status.FOUND:
        second = PLANNER.satisfy(GeometricRequest(TEXTS[other], first.end))
        if second.status is Status.FOUND:
            assert BOUNDS[one, other] <= second.length
            assert ESTIMATES[one, other] < inf


def test_bounds_are_symmetric_and_below_estimates() -> None:
    assert np.array_equal(BOUNDS, BOUNDS.T)
    assert (BOUNDS <= ESTIMATES).all()
    assert (np.diag(ESTIMATES) == 0.0).all()
    assert BOUNDS[0, 4] > 400.0


@settings(max_examples=20, deadline=None)
@given(st.floats(5.0, 40.0), st.floats(60.0, 300.0), st.floats(0.0, 60.0))
def test_nothing_separates_a_candidate_from_one_that_holds_it(
    near: float, far: float, least: float
) -> None:
    place = '((agent rover0)(object location4)'
    texts = (
        f'{place}(distance(rover0, location4) <= {near}))',
        f'{place}(distance(rover0, location4) <= {far}))',
        f'{place}(distance(rover0, location4) >= {least})(distance(rover0, location4) <= {far}))',
    )
    bounds, _ = matrices(PLANNER.advise(AdviceRequest(texts, START, pairwise=True)))
    assert bounds[0, 1] == bounds[1, 0] == bounds[1, 2] == bounds[2, 1] == 0.0
    assert bounds[0, 2] <= max(least - near, 0.0)


def test_pairwise_costs_do_not_depend_on_what_was_asked_before_nor_on_the_start() -> None:
    request = AdviceRequest(TEXTS, {'rover0': Attitude(700.0, 560.0, 1.0)}, pairwise=True)
    again = PLANNER.advise(request)
    assert again == MotionPlanner(PLANNER.world).advise(request)
    assert again.pairwise_lower_bounds == ADVICE.pairwise_lower_bounds
    assert again.pairwise_estimates == ADVICE.pairwise_estimates
    assert PLANNER.advise(AdviceRequest(TEXTS, START)).pairwise_estimates == ()


def test_nothing_leads_to_what_is_impossible_or_wrong_and_commands_cost_nothing() -> None:
    here = (
        '((agent rover0)(setProperty(rover0.x, 20))(setProperty(rover0.y, 20))'
        '(setProperty(rover0.heading, 0)))'
    )
    impossible = '((agent rover0)(object location1)(distance(rover0, location1) <= -1))'
    texts = (TEXTS[0], impossible, '((', here, TEXTS[4])
    answer = PLANNER.advise(AdviceRequest(texts, START, pairwise=True))
    bounds, estimates = matrices(answer)
    for matrix in (bounds, estimates):
        assert (matrix[[1, 2], :] == inf).all()
        assert (matrix[:, [1, 2]] == inf).all()
        assert (matrix[[0, 3, 4], 3] == 0.0).all()
    assert (bounds[3, [0, 4]] == 0.0).all()
    assert estimates[3, 4] == answer.candidates[4].estimate


def test_pairwise_costs_are_bounded_in_work_and_can_be_stopped() -> None:
    assert PLANNER.advise(AdviceRequest((), START, pairwise=True)).pairwise_estimates == ()
    with pytest.raises(MotionPlannerError, match='1001 candidates are too many'):
        PLANNER.advise(AdviceRequest((TEXTS[0],) * 1001, START, pairwise=True))
    questions = 0

    def late() -> bool:
        nonlocal questions
        questions += 1
        return questions > 2 * COUNT

    with pytest.raises(Stopped):
        PLANNER.advise(AdviceRequest(TEXTS, START, pairwise=True), late)


def test_two_robots_do_not_start_where_the_other_one_ends() -> None:
    text = TEXT.replace(
        'robots:\n',
        'robots:\n  scout: {wheelbase: 8, max_steering_angle: 0.7, radius: 8, speed: 2, model: car,'
        ' start: {x: 700, y: 560, heading: 0}}\n',
    )
    planner = MotionPlanner(read_world(text, 'two.yaml'))
    meeting = '((agent scout)(agent rover0)(object location8)(distance(scout, rover0) <= 100))'
    texts = (TEXTS[0], TEXTS[0].replace('rover0', 'scout'), meeting)
    answer = planner.advise(AdviceRequest(texts, START, pairwise=True))
    bounds, estimates = matrices(answer)
    assert bounds[0, 1] == answer.candidates[1].lower_bound > 0.0
    assert estimates[1, 0] == answer.candidates[0].estimate
    assert answer.candidates[2].lower_bound > 0.0
    assert bounds[0, 2] == 0.0


def test_of_many_candidates_each_costs_what_it_costs_among_few() -> None:
    texts = TEXTS * 40
    bounds, estimates = matrices(PLANNER.advise(AdviceRequest(texts, START, pairwise=True)))
    assert np.array_equal(bounds[:COUNT, :COUNT], BOUNDS)
    assert np.array_equal(bounds, np.tile(BOUNDS, (40, 40)))
    # Fewer destinations stand for the others: both ends may be others in rings 150 m wide.
    assert (np.abs(estimates[:COUNT, :COUNT] - ESTIMATES) <= 300.0).all()
    assert (estimates >= bounds).all()
