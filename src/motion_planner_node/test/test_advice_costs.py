"""Advice against the answers that it is about."""

from __future__ import annotations

from math import hypot, inf, pi
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.advice.costs import nearest_of_each
from motion_planner_node.codes import Code, Scope, Status
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

MISSIONS = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions'
TEXT = (MISSIONS / 'rover' / 'world.yaml').read_text(encoding='utf-8')
BOX = """
  - {name: box_west, polygon: [[500, 0], [510, 0], [510, 140], [500, 140]]}
  - {name: box_east, polygon: [[710, 0], [720, 0], [720, 125], [710, 125]]}
  - {name: box_north, polygon: [[500, 125], [720, 110], [720, 125], [500, 140]]}
"""
PLANNER = MotionPlanner(read_world(TEXT, 'world.yaml'))
BOXED = MotionPlanner(read_world(TEXT.replace('obstacles:\n', 'obstacles:' + BOX), 'boxed.yaml'))
LOCATIONS = tuple(f'location{number}' for number in range(1, 9))
START = {'rover0': Attitude(20.0, 20.0, 0.0)}
PHOTO = (
    '((agent rover0)(object {0})(distance(rover0, {0}) >= 50)(distance(rover0, {0}) <= 100)'
    '(rel_angle(rover0, {0}) = cos-and-sin(pi/2)))'
)
TEXTS = (
    PHOTO,
    '((agent rover0)(object {0})(distance(rover0, {0}) <= 60))',
    '((agent rover0)(object {0})(distance(rover0, {0}) = 75)(rover0.heading = pi/2))',
    '((agent rover0)(object {0})(rover0.x >= {0}.x - 40)(distance(rover0, {0}) < 90))',
)

attitudes = st.builds(
    Attitude, st.floats(10, 790), st.floats(10, 590), st.floats(-pi, pi, exclude_min=True)
)


@settings(max_examples=30, deadline=None)
@given(attitudes, st.sampled_from(TEXTS), st.sampled_from(LOCATIONS))
def test_no_motion_is_shorter_than_its_lower_bound(start: Attitude, text: str, label: str) -> None:
    preconditions, state = text.format(label), {'rover0': start}
    answer = PLANNER.satisfy(GeometricRequest(preconditions, state))
    (candidate,) = PLANNER.advise(AdviceRequest((preconditions,), state)).candidates
    assert 0.0 <= candidate.lower_bound <= candidate.estimate
    if answer.status is Status.FOUND:
        assert not candidate.impossible
        assert candidate.lower_bound <= answer.length
        assert candidate.estimate < inf
    if answer.status is Status.IMPOSSIBLE:
        assert candidate.impossible
        assert (candidate.code, candidate.scope) == (answer.code, answer.scope)


def test_the_lower_bound_is_close_to_the_straight_way() -> None:
    text = '((agent rover0)(object location5)(distance(rover0, location5) <= 60))'
    (candidate,) = PLANNER.advise(AdviceRequest((text,), START)).candidates
    straight = hypot(772 - 20, 301 - 20) - 60.0
    assert straight - 5.0 <= candidate.lower_bound <= straight


def test_the_lower_bound_goes_round_a_wall() -> None:
    text = """
bounds: [0, 0, 100, 60]
objects: {goal: {x: 60, y: 5}}
obstacles: [{polygon: [[48, 0], [50, 0], [50, 50], [48, 50]]}]
robots: {car: {model: differential, radius: 1, speed: 1, turning_speed: 1}}
"""
    planner = MotionPlanner(read_world(text, 'wall.yaml'))
    near = '((agent car)(object goal)(distance(car, goal) <= 2))'
    start = {'car': Attitude(40.0, 5.0, 0.0)}
    (candidate,) = planner.advise(AdviceRequest((near,), start)).candidates
    answer = planner.satisfy(GeometricRequest(near, start))
    # Up to the gap, which begins at 51, and down again to the disc of 2 m round the goal.
    assert 46.0 + 44.0 - 2.0 <= candidate.lower_bound <= answer.length


@settings(max_examples=100, deadline=None)
@given(
    st.lists(st.lists(st.sampled_from([0.0, 1.0, 1.5, 2.0, inf]), max_size=6), min_size=1),
    st.integers(1, 4),
)
def test_the_nearest_of_each_group(groups: list[list[float]], most: int) -> None:
    values = np.array([value for group in groups for value in group])
    counts = np.array([len(group) for group in groups])
    wanted, first = [], 0
    for group in groups:
        order = sorted(range(len(group)), key=lambda index: (group[index], index))
        wanted += [first + index for index in order[:most]]
        first += len(group)
    assert nearest_of_each(values, counts, most).tolist() == wanted


def test_the_order_is_nearest_first_with_impossible_ones_last() -> None:
    texts = tuple(TEXTS[0].format(label) for label in LOCATIONS)
    advice = BOXED.advise(AdviceRequest(texts, START))
    seven = LOCATIONS.index('location7')
    assert sorted(advice.order) == list(range(8))
    assert advice.order[-1] == seven
    estimates = [advice.candidates[index].estimate for index in advice.order]
    assert estimates == sorted(estimates)
    assert advice.candidates[0].objects == ('location1',)
    assert advice.candidates[seven].lower_bound == inf


def test_a_walled_in_objective_is_impossible_in_the_words_of_the_answer() -> None:
    text = TEXTS[0].format('location7')
    answer = BOXED.satisfy(GeometricRequest(text, START))
    (candidate,) = BOXED.advise(AdviceRequest((text,), START)).candidates
    assert candidate.impossible
    assert candidate.code is answer.code is Code.UNREACHABLE
    assert candidate.scope is answer.scope is Scope.CONNECTED_STARTS
    assert candidate.message == answer.message
    assert 'location7 is walled in' in answer.message
    assert 'box_west' in answer.message


def test_what_holds_already_costs_nothing() -> None:
    text = '((agent rover0)(object location0)(distance(rover0, location0) <= 5))'
    (candidate,) = PLANNER.advise(AdviceRequest((text,), START)).candidates
    assert (candidate.lower_bound, candidate.estimate) == (0.0, 0.0)


def test_commands_cost_nothing_unless_they_lead_into_an_obstacle() -> None:
    text = (
        '((agent rover0)(setProperty(rover0.x, {}))(setProperty(rover0.y, 20))'
        '(setProperty(rover0.heading, 0)))'
    )
    fine, blocked = PLANNER.advise(
        AdviceRequest((text.format(20), text.format(175)), {})
    ).candidates
    assert (fine.lower_bound, fine.estimate, fine.impossible) == (0.0, 0.0, False)
    assert blocked.impossible
    assert blocked.code is Code.STATE_IN_OBSTACLE


def test_a_bad_candidate_spoils_only_itself() -> None:
    texts = ('((agent', TEXTS[1].format('location1'), TEXTS[1].format('nowhere'))
    advice = PLANNER.advise(AdviceRequest(texts, START))
    codes = [candidate.code for candidate in advice.candidates]
    assert codes == [Code.INVALID_PRECONDITIONS, Code.NONE, Code.UNKNOWN_OBJECT]
    assert advice.order[0] == 1
    assert all(candidate.message for candidate in advice.candidates if candidate.code)


def test_advice_does_not_depend_on_what_was_asked_before() -> None:
    texts = tuple(TEXTS[index % 4].format(label) for index, label in enumerate(LOCATIONS))
    planner = MotionPlanner(PLANNER.world, Parameters(cache_size=2))
    for x in (700.0, 20.0):
        request = AdviceRequest(texts, {'rover0': Attitude(x, 560.0, 1.0)})
        advice = planner.advise(request)
        assert advice == MotionPlanner(PLANNER.world).advise(request)
        assert advice == PLANNER.advise(request)


def test_a_whole_request_can_be_refused_or_stopped() -> None:
    with pytest.raises(MotionPlannerError, match='1001'):
        PLANNER.advise(AdviceRequest(('((agent rover0))',) * 1001, START))
    with pytest.raises(MotionPlannerError) as changed:
        PLANNER.advise(AdviceRequest((), START, world_revision='other'))
    assert changed.value.code is Code.WORLD_CHANGED
    with pytest.raises(Stopped):
        PLANNER.advise(AdviceRequest((TEXTS[0].format('location1'),), START), lambda: True)
    assert PLANNER.advise(AdviceRequest((), START)).order == ()
