"""Every way in which a request can end is provoked once."""

from __future__ import annotations

from itertools import chain, repeat
from math import inf, nan, pi
from typing import Any

import pytest

from motion_planner_node.codes import AttemptResult, Code, Scope, Status
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning.ways import Ways
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

WORLD = """
bounds: [0, 0, 200, 200]
objects:
  tree: {x: 100, y: 100}
  vault: {x: 160, y: 40}
  buried: {x: 40, y: 160}
  pocket: {x: 160, y: 160}
obstacles:
  - {name: vault_west, polygon: [[130, 10], [134, 10], [134, 70], [130, 70]]}
  - {name: vault_east, polygon: [[186, 10], [190, 10], [190, 70], [186, 70]]}
  - {name: vault_south, polygon: [[130, 8], [190, 8], [190, 12], [130, 12]]}
  - {name: vault_north, polygon: [[130, 68], [190, 68], [190, 72], [130, 72]]}
  - {name: boulder, circle: {center: [40, 160], radius: 20}}
  - {name: pocket_west, polygon: [[150, 150], [152, 150], [152, 170], [150, 170]]}
  - {name: pocket_east, polygon: [[168, 150], [170, 150], [170, 170], [168, 170]]}
  - {name: pocket_north, polygon: [[150, 168], [170, 168], [170, 170], [150, 170]]}
robots:
  rover0: {model: car, wheelbase: 8.0, max_steering_angle: 0.5, radius: 5.0, speed: 2.0}
  rover1: {model: car, wheelbase: 8.0, max_steering_angle: 0.5, radius: 5.0, speed: 2.0}
"""
PLANNER = MotionPlanner(read_world(WORLD, 'test.yaml'))
START = {'rover0': Attitude(20.0, 20.0, 0.0)}


def near(label: str, distance: float, agent: str = 'rover0') -> str:
    return f'((agent {agent})(object {label})(distance({agent}, {label}) <= {distance:g}))'


def ask(preconditions: str, **more: Any) -> GeometricAnswer:
    fields: dict[str, Any] = {'start': START} | more
    return PLANNER.satisfy(GeometricRequest(preconditions, **fields))


def test_a_request_that_holds_at_the_start_needs_no_motion() -> None:
    answer = ask('((agent rover0)(object tree)(distance(rover0, tree) >= 10))')
    assert answer.status is Status.FOUND
    assert answer.motion is not None
    assert answer.motion.segments == ()
    assert answer.length == 0.0
    assert answer.end == START


def test_a_robot_stays_even_in_a_dead_end_when_nothing_asks_it_to_move() -> None:
    start = {'rover0': Attitude(160.0, 160.0, pi / 2)}
    answer = ask(near('pocket', 30.0), start=start)
    assert answer.status is Status.FOUND
    assert answer.end == start


def test_a_place_with_room_to_turn_is_preferred() -> None:
    answer = ask(near('pocket', 18.0), start={'rover0': Attitude(160.0, 60.0 + 40.0, pi / 2)})
    assert answer.status is Status.FOUND
    end = answer.end['rover0']
    assert end.y < 150.0 or abs(end.x - 160.0) > 10.0


def test_no_constraints_at_all_hold_where_the_robot_is() -> None:
    answer = ask('((agent rover0))')
    assert answer.status is Status.FOUND
    assert answer.end == START
    assert ask('((agent rover0))', alternative=1).code is Code.NO_MORE_ALTERNATIVES


def test_a_destination_is_found_and_says_what_was_met() -> None:
    answer = ask(near('tree', 30.0))
    assert answer.status is Status.FOUND
    assert answer.message == ''
    assert answer.length > 50.0
    assert [residual.constraint for residual in answer.residuals] == [
        'distance(rover0, tree) <= 30'
    ]
    assert answer.residuals[0].satisfied
    assert answer.objects == ('tree',)
    assert answer.agent == 'rover0'
    assert answer.world_revision == PLANNER.world.revision


def test_commands_set_the_attitude_and_leave_the_others_alone() -> None:
    start = {'rover1': Attitude(60.0, 60.0, 1.0)}
    text = (
        '((agent rover0)(object tree)(setProperty(rover0.x, tree.x))'
        '(setProperty(rover0.y, tree.y))(setProperty(rover0.heading, pi/2)))'
    )
    answer = ask(text, start=start)
    assert answer.status is Status.FOUND
    assert answer.assigned
    assert answer.length == 0.0
    assert answer.end == {**start, 'rover0': Attitude(100.0, 100.0, pi / 2)}
    assert ask(text, start=start, alternative=1).code is Code.NO_MORE_ALTERNATIVES


def test_a_set_attitude_in_an_obstacle_is_impossible_from_anywhere() -> None:
    answer = ask(
        '((agent rover0)(object buried)(setProperty(rover0.x, buried.x))'
        '(setProperty(rover0.y, buried.y))(setProperty(rover0.heading, 0)))'
    )
    assert (answer.code, answer.scope) == (Code.STATE_IN_OBSTACLE, Scope.ANY_START)
    assert '20 m inside boulder' in answer.message


def test_a_set_attitude_that_depends_on_the_start_is_impossible_from_there_alone() -> None:
    answer = ask('((agent rover0)(setProperty(rover0.x, rover0.x - 100)))')
    assert (answer.code, answer.scope) == (Code.STATE_IN_OBSTACLE, Scope.THIS_START)
    assert 'outside the map' in answer.message


def test_constraints_beside_commands_are_checked_where_the_commands_lead() -> None:
    text = (
        '((agent rover0)(object tree)(setProperty(rover0.x, 50))(setProperty(rover0.y, 50))'
        '(setProperty(rover0.heading, 0))(distance(rover0, tree) <= {}))'
    )
    assert ask(text.format(80)).status is Status.FOUND
    answer = ask(text.format(60))
    assert (answer.code, answer.scope) == (Code.CONTRADICTION, Scope.ANY_START)
    assert 'distance(rover0, tree) <= 60 not met: 70.7107' in answer.message


@pytest.mark.parametrize(
    'constraints',
    [
        '(distance(rover0, tree) >= 60)(distance(rover0, tree) <= 50)',
        '(distance(rover0, tree) < 50)(distance(rover0, tree) > 50)',
        '(distance(rover0, tree) = 50)(distance(rover0, tree) = 51)',
        '(distance(rover0, tree) >= 1000)',
        '(distance(rover0, tree) <= 10)(distance(rover0, vault) <= 10)',
        '(1 = 2)',
    ],
)
def test_contradictions_are_impossible_from_anywhere(constraints: str) -> None:
    answer = ask(f'((agent rover0)(object tree)(object vault){constraints})')
    assert (answer.code, answer.scope) == (Code.CONTRADICTION, Scope.ANY_START)
    assert answer.message


def test_a_start_in_an_obstacle_is_named() -> None:
    answer = ask(near('tree', 20.0), start={'rover0': Attitude(40.0, 182.0, 0.0)})
    assert (answer.code, answer.scope) == (Code.START_IN_OBSTACLE, Scope.THIS_START)
    assert '2 m from boulder' in answer.message
    assert 'less than its radius of 5 m' in answer.message


@pytest.mark.parametrize('x', [1e300, -1e300, 200.5])
def test_a_start_outside_the_map_is_no_start(x: float) -> None:
    answer = ask(near('tree', 20.0), start={'rover0': Attitude(x, 20.0, 0.0)})
    assert answer.code is Code.START_IN_OBSTACLE
    assert 'outside the map' in answer.message


def test_a_blocked_objective_is_impossible_from_anywhere() -> None:
    answer = ask(near('buried', 15.0))
    assert (answer.code, answer.scope) == (Code.NO_FREE_DESTINATION, Scope.ANY_START)
    assert 'boulder' in answer.message
    assert 'boulder' in answer.advice


def test_a_walled_in_objective_is_explained() -> None:
    answer = ask(near('vault', 15.0))
    assert (answer.code, answer.scope) == (Code.UNREACHABLE, Scope.CONNECTED_STARTS)
    assert 'vault is walled in' in answer.message
    assert 'm2 bounded by' in answer.message
    for wall in ('vault_west', 'vault_east', 'vault_south', 'vault_north'):
        assert wall in answer.message


def test_a_walled_in_robot_is_explained() -> None:
    answer = ask(near('tree', 15.0), start={'rover0': Attitude(160.0, 40.0, 0.0)})
    assert (answer.code, answer.scope) == (Code.UNREACHABLE, Scope.CONNECTED_STARTS)
    assert 'rover0 is walled in' in answer.message


def test_what_is_in_the_way_is_named_for_margins_and_footprints_too() -> None:
    text = WORLD.replace('radius: 5.0, speed', 'radius: 1.0, safety_margin: 5.0, speed', 1)
    text = text.replace(
        'radius: 5.0, speed', 'footprint: [[-2, -2], [9, -2], [9, 2], [-2, 2]], speed'
    )
    planner = MotionPlanner(read_world(text, 'test.yaml'))
    wide = '((agent rover0)(object {0})(distance(rover0, {0}) <= 4))'
    answer = planner.satisfy(GeometricRequest(wide.format('vault'), START))
    assert answer.code is Code.UNREACHABLE
    assert 'bounded by vault_' in answer.message
    assert answer.advice.startswith('open a passage wider than 12 m through vault_')
    answer = planner.satisfy(GeometricRequest(wide.format('buried'), START))
    assert answer.code is Code.NO_FREE_DESTINATION
    assert answer.message.endswith(
        'is blocked by boulder for rover0 with its radius of 1 m and its safety margin of 5 m'
    )
    near = {'rover0': Attitude(145.0, 40.0, 0.0), 'rover1': Attitude(121.0, 40.0, 0.0)}
    answer = planner.satisfy(GeometricRequest('((agent rover1))', near))
    assert answer.code is Code.START_IN_OBSTACLE
    assert answer.message.endswith(
        'is 9 m from vault_west, where there is no room for its footprint of 4 corners'
    )


#: To stand in a pocket that is too small to turn in, facing its mouth.
IN_POCKET = (
    '((agent rover0)(object pocket)(distance(rover0, pocket) <= 2)'
    '(rover0.heading >= -1.7)(rover0.heading <= -1.4))'
)


def test_a_pocket_too_small_to_turn_in_is_out_of_reach() -> None:
    answer = ask(IN_POCKET)
    assert (answer.code, answer.scope) == (Code.UNREACHABLE, Scope.THIS_START)
    assert 'there is no room to turn into it with a radius of' in answer.message


def test_without_a_proof_a_pocket_is_unknown_and_not_impossible(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(Ways, '_prove_after_all', lambda _: None)
    answer = MotionPlanner(PLANNER.world).satisfy(GeometricRequest(IN_POCKET, START))
    assert answer.code is Code.NO_PATH
    assert answer.attempts
    assert {attempt.result for attempt in answer.attempts} <= {
        AttemptResult.NO_PATH,
        AttemptResult.IN_OBSTACLE,
    }
    assert all(attempt.reason for attempt in answer.attempts)


def test_where_another_agent_matters_a_proof_holds_for_now() -> None:
    start = {**START, 'rover1': Attitude(160.0, 40.0, 0.0)}
    answer = ask('((agent rover0)(agent rover1)(distance(rover0, rover1) <= 10))', start=start)
    assert (answer.code, answer.scope) == (Code.UNREACHABLE, Scope.THIS_START)


def test_an_assignment_that_another_agent_is_in_the_way_of_is_impossible_for_now() -> None:
    text = (
        '((agent rover0)(agent rover1)(object tree)'
        '(setProperty(rover0.x, tree.x))(setProperty(rover0.y, tree.y))'
        '(setProperty(rover0.heading, 0))(distance(rover0, rover1) >= 30))'
    )
    near_by, far_off = Attitude(110.0, 100.0, 0.0), Attitude(20.0, 100.0, 0.0)
    answer = ask(text, start={'rover1': near_by})
    assert (answer.code, answer.scope) == (Code.CONTRADICTION, Scope.THIS_START)
    assert ask(text, start={'rover1': far_off}).status is Status.FOUND


def test_the_request_says_which_of_several_agents_moves() -> None:
    start = {**START, 'rover1': Attitude(180.0, 100.0, 0.0)}
    text = '((agent rover0)(agent rover1)(distance(rover0, rover1) <= 60))'
    for agent in ('rover0', 'rover1'):
        answer = ask(text, start=start, agent=agent)
        assert answer.status is Status.FOUND
        assert [label for label in start if answer.end[label] != start[label]] == [agent]


def test_constraints_that_no_descent_meets_are_unknown() -> None:
    answer = ask('((agent rover0)(rover0.heading > pi))')
    assert answer.status in {Status.UNKNOWN, Status.IMPOSSIBLE}
    assert 'rover0.heading > pi' in answer.message


def test_a_deadline_leaves_the_answer_open_and_nothing_behind() -> None:
    planner = MotionPlanner(PLANNER.world)
    request = GeometricRequest(near('tree', 30.0), START)
    for polls in range(6):
        left = chain([False] * polls, repeat(object=True))
        answer = planner.satisfy(request, left.__next__)
        assert answer.code in {Code.OUT_OF_TIME, Code.NONE}
    assert planner.satisfy(request, lambda: True).code in {Code.OUT_OF_TIME, Code.NONE}
    assert planner.satisfy(request) == MotionPlanner(PLANNER.world).satisfy(request)


@pytest.mark.parametrize(
    ('text', 'code'),
    [
        ('', Code.INVALID_PRECONDITIONS),
        ('((agent rover0)', Code.INVALID_PRECONDITIONS),
        ('((agent ?r))', Code.INVALID_PRECONDITIONS),
        ('\x00\xff', Code.INVALID_PRECONDITIONS),
        ('(' * 100_000, Code.INVALID_PRECONDITIONS),
        (' ' * 70_000, Code.INVALID_PRECONDITIONS),
        ('((agent ghost))', Code.UNKNOWN_AGENT),
        ('((agent rover0)(object ghost)(distance(rover0, ghost) <= 5))', Code.UNKNOWN_OBJECT),
        ('((agent rover0)(object tree)(nearness(rover0, tree) <= 5))', Code.UNKNOWN_FUNCTION),
        ('((agent rover0)(object tree)(rover0.x <= tree.height))', Code.UNKNOWN_PROPERTY),
        (near('tree', 5.0, 'rover1'), Code.NO_START),
    ],
)
def test_a_text_that_cannot_be_used_is_refused(text: str, code: Code) -> None:
    answer = ask(text)
    assert (answer.status, answer.code) == (Status.ERROR, code)
    assert answer.message


@pytest.mark.parametrize(
    ('fields', 'code'),
    [
        ({'world_revision': 'other'}, Code.WORLD_CHANGED),
        ({'behaviour': '(speed <= 1)'}, Code.UNSUPPORTED),
        ({'time_budget': nan}, Code.UNSUPPORTED),
        ({'time_budget': -1.0}, Code.UNSUPPORTED),
        ({'agent': 'rover1'}, Code.UNKNOWN_AGENT),
        ({'start': {'ghost': Attitude(0.0, 0.0, 0.0)}}, Code.UNKNOWN_AGENT),
        ({'start': {'rover0': Attitude(nan, 0.0, 0.0)}}, Code.INVALID_START),
        ({'start': {'rover0': Attitude(0.0, 0.0, inf)}}, Code.INVALID_START),
        ({'start': {}}, Code.NO_START),
    ],
)
def test_a_request_that_cannot_be_answered_is_refused(
    fields: dict[str, object], code: Code
) -> None:
    answer = ask(near('tree', 5.0), **fields)
    assert (answer.status, answer.code) == (Status.ERROR, code)
    assert answer.message


def test_a_changed_world_is_named_by_both_revisions() -> None:
    answer = ask(near('tree', 5.0), world_revision='other')
    assert 'other' in answer.message
    assert PLANNER.world.revision in answer.message


def test_a_start_in_the_world_file_serves_where_the_request_has_none() -> None:
    text = WORLD.replace('speed: 2.0}', 'speed: 2.0, start: {x: 20, y: 30, heading: 0}}', 1)
    planner = MotionPlanner(read_world(text, 'test.yaml'), Parameters(rounds=1))
    answer = planner.satisfy(GeometricRequest(near('tree', 30.0)))
    assert answer.motion is not None
    assert answer.motion.start == Attitude(20.0, 30.0, 0.0)
