"""Compiled preconditions: commands, exact residuals, what is missing, and proofs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program, compile_program
from motion_planner_node.world.model import Bounds, World, WorldObject

CAR = Robot('rover0', 8.0, 0.5, 5.0, 2.0)
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 800.0, 600.0),
    objects={
        label: WorldObject(label, {'x': x, 'y': y})
        for label, x, y in (('location0', 20.0, 20.0), ('location1', 67.0, 171.0))
    },
    obstacles=(),
    robots={'rover0': CAR, 'rover1': CAR},
)
START: GeometricState = {'rover0': Attitude(20.0, 100.0, 0.0)}
STATED = '(agent rover0)(object location0)(object location1)'
TAKE_PHOTO = """(distance(rover0, location1) >= 50) (distance(rover0, location1) <= 100)
(rel_angle(rover0, location1) = cos-and-sin(pi/2))"""


def program(text: str, start: GeometricState = START, agent: str = '') -> Program:
    return compile_program(parse(STATED + text), WORLD, start, agent)


def code_of(text: str, start: GeometricState = START, agent: str = '') -> Code:
    with pytest.raises(MotionPlannerError) as caught:
        compile_program(parse(text), WORLD, start, agent)
    assert caught.value.message
    return caught.value.code


@settings(max_examples=40, deadline=None)
@given(st.floats(-1e6, 1e6), st.floats(-1e6, 1e6), st.floats(-3.0, 3.0), st.booleans())
def test_a_program_from_another_start_is_as_if_compiled_there(
    x: float, y: float, heading: float, has_table: bool
) -> None:
    text = '(agent rover1)' + TAKE_PHOTO + '(rover0.x + rover1.x != rover1.heading)'
    text += '' if has_table else '(clearance(rover0) >= 1)'
    here = {**START, 'rover1': Attitude(1.0, 2.0, 3.0)}
    there = {**here, 'rover0': Attitude(x, y, heading)}
    moved, compiled = program(text, here).starting_at(there), program(text, there)
    assert moved is not None
    assert (moved.table is None) == (not has_table)
    assert (moved.start, moved.tolerance) == (compiled.start, compiled.tolerance)
    assert (moved.conditions == compiled.conditions).all()
    states = np.random.default_rng(0).uniform(-300.0, 300.0, (50, 3))
    assert (moved.violations(states) == compiled.violations(states)).all()


def test_another_program_is_compiled_anew() -> None:
    text = '(agent rover1)(distance(rover0, rover1) >= 5)'
    here = {**START, 'rover1': Attitude(1.0, 2.0, 3.0)}
    compiled = program(text, here)
    assert compiled.starting_at(here) is not None
    assert compiled.starting_at({**here, 'rover1': Attitude(1.0, 2.0, 4.0)}) is None
    assert compiled.starting_at({'rover1': here['rover1']}) is None
    assert compiled.starting_at(START) is None
    assert program('(setProperty(rover0.y, 7))').starting_at(START) is None


def test_commands_are_carried_out_in_their_order() -> None:
    text = """(setProperty(rover0.x, location0.x)) (setProperty(rover0.y, rover0.x + 5))
              (setProperty(rover0.x, -1)) (setProperty(rover0.heading, 3 * pi / 2))"""
    placed = program(text, {}).start['rover0']
    assert (placed.x, placed.y) == (-1.0, 25.0)
    assert placed.heading == pytest.approx(-math.pi / 2.0)


def test_commands_leave_other_agents_and_components() -> None:
    start = {**START, 'rover1': Attitude(1.0, 2.0, 3.0)}
    state = program('(setProperty(rover0.y, 7))', start).apply_commands(start)
    assert state == {'rover0': Attitude(20.0, 7.0, 0.0), 'rover1': Attitude(1.0, 2.0, 3.0)}
    assert start['rover0'].y == 100.0


def test_constraints_hold_for_the_state_after_the_commands() -> None:
    text = '(agent rover0)(agent rover1)(distance(rover0, rover1) <= 5)(setProperty(rover1.x, 90))'
    start = {**START, 'rover1': Attitude(0.0, 100.0, 0.0)}
    compiled = compile_program(parse(text), WORLD, start)
    assert compiled.agent == 'rover0'
    (residual,) = compiled.residuals(Attitude(92.0, 100.0, 0.0))
    assert residual.satisfied


@pytest.mark.parametrize(
    ('text', 'start', 'agent', 'code'),
    [
        ('(agent ?r)(?r.x = 1)', START, '', Code.INVALID_PRECONDITIONS),
        ('', START, '', Code.INVALID_PRECONDITIONS),
        ('(agent rover9)(rover9.x = 1)', START, '', Code.UNKNOWN_AGENT),
        ('(agent rover0)(rover0.x = 1)', START, 'rover1', Code.UNKNOWN_AGENT),
        ('(agent rover0)(object l)(rover0.x = 1)', START, '', Code.UNKNOWN_OBJECT),
        ('(agent rover0)(f(rover0) = 1)', START, '', Code.UNKNOWN_FUNCTION),
        ('(agent rover0)(rover0.z = 1)', START, '', Code.UNKNOWN_PROPERTY),
        ('(agent rover0)(rover0.x => 1)', START, '', Code.INVALID_PRECONDITIONS),
        ('(agent rover0)(rover0.x = 1)', {}, '', Code.NO_START),
        ('(agent rover0)(setProperty(rover0.x, 1))', {}, '', Code.NO_START),
        ('(agent rover0)(setProperty(rover0.x, rover0.y))', {}, '', Code.NO_START),
        (
            '(agent rover0)(setProperty(rover0.x, 1 / (rover0.y - 100)))',
            START,
            '',
            Code.INVALID_PRECONDITIONS,
        ),
    ],
)
def test_what_cannot_be_compiled(text: str, start: GeometricState, agent: str, code: Code) -> None:
    assert code_of(text, start, agent) is code


def test_the_agent_of_the_request_is_the_one_that_moves() -> None:
    text = '(agent rover0)(agent rover1)(distance(rover0, rover1) = 5)'
    start = {**START, 'rover1': Attitude(0.0, 0.0, 0.0)}
    compiled = compile_program(parse(text), WORLD, start, 'rover1')
    assert compiled.agent == 'rover1'
    assert compiled.residuals(Attitude(20.0, 105.0, 0.0))[0].satisfied


@settings(max_examples=100, deadline=None)
@given(
    st.floats(min_value=0.0, max_value=800.0),
    st.floats(min_value=0.0, max_value=600.0),
    st.floats(min_value=-3.14, max_value=3.14),
)
def test_residuals_are_the_distances_from_the_constraints(
    x: float, y: float, heading: float
) -> None:
    distance = math.hypot(67.0 - x, 171.0 - y)
    far, near, side = program(TAKE_PHOTO).residuals(Attitude(x, y, heading))
    assert far.violation == pytest.approx(max(50.0 - distance, 0.0))
    assert near.violation == pytest.approx(max(distance - 100.0, 0.0))
    off = math.remainder(heading - math.atan2(171.0 - y, 67.0 - x) - math.pi / 2.0, 2.0 * math.pi)
    if distance:
        assert side.violation == pytest.approx(abs(off))
    assert far.constraint == 'distance(rover0, location1) >= 50'


def test_what_is_missed_is_told_with_its_value() -> None:
    assert program(TAKE_PHOTO).unmet(Attitude(67.0, 126.0, 0.0)) == (
        'distance(rover0, location1) >= 50 not met: 45',
        'rel_angle(rover0, location1) = cos-and-sin(pi / 2) not met: -1.5708',
    )


def test_undefined_values_are_never_met() -> None:
    on_it = Attitude(67.0, 171.0, 0.0)
    side = program(TAKE_PHOTO).residuals(on_it)[2]
    assert (side.violation, side.satisfied) == (math.pi, False)
    (quotient,) = program('(1 / (rover0.x - 67) = 3)').residuals(on_it)
    assert (quotient.violation, quotient.satisfied) == (math.inf, False)
    assert 'undefined' in program(TAKE_PHOTO).unmet(on_it)[1]


def test_strict_comparators_are_not_met_on_the_boundary() -> None:
    on_boundary = Attitude(20.0, 70.0, 0.0)
    strict, loose = program(
        '(distance(rover0, location0) < 50)(distance(rover0, location0) <= 50)'
    ).residuals(on_boundary)
    assert not strict.satisfied
    assert strict.violation > 0.0
    assert loose.satisfied
    assert loose.violation == 0.0


def test_heading_is_equal_modulo_a_turn() -> None:
    turned = Attitude(0.0, 0.0, -math.pi / 2.0)
    for text in ('(rover0.heading = 3 * pi / 2)', '(rover0.heading = cos-and-sin(-pi / 2))'):
        assert program(text).residuals(turned)[0].satisfied


def test_constraints_about_constants_are_evaluated() -> None:
    held, missed = program('(location0.x = 20)(location0.y > location1.y)').residuals(
        START['rover0']
    )
    assert held.satisfied
    assert missed.violation == 151.0


@pytest.mark.parametrize(
    ('text', 'words'),
    [
        (
            '(distance(rover0, location0) >= 60)(distance(rover0, location0) <= 50)',
            'exclude each other',
        ),
        ('(distance(rover0, location0) >= 5000)', 'nowhere on the map: missed by 40'),
        (
            '(rover0.x > 0)(distance(rover0, location0) < 9)(distance(location1, rover0) < 9)',
            (
                'distance(rover0, location0) < 9 and distance(location1, rover0) < 9, '
                'but location0 and location1 are 158.1 apart'
            ),
        ),
        ('(rover0.x > 800)', 'nowhere'),
        ('(location0.x = 21)', 'nowhere'),
        ('(rover0.heading > 4)', 'nowhere'),
    ],
)
def test_contradictions_are_proven_with_a_reason(text: str, words: str) -> None:
    reason = program(text).contradiction(WORLD.bounds)
    assert reason is not None
    assert words in reason


@pytest.mark.parametrize(
    'text', ['', TAKE_PHOTO, '(rover0.x >= 800)', '(rover0.x = 0)', '(location0.x = 20)']
)
def test_what_can_be_met_is_not_proven_contradictory(text: str) -> None:
    assert program(text).contradiction(WORLD.bounds) is None


@settings(max_examples=60, deadline=None)
@given(st.integers(min_value=0, max_value=2**32 - 1))
def test_no_box_with_a_satisfying_attitude_is_given_up(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x, y = rng.uniform([0.0, 0.0], [800.0, 600.0]).tolist()
    distance = math.hypot(67.0 - x, 171.0 - y)
    heading = math.atan2(171.0 - y, 67.0 - x)
    compiled = program(
        f"""(distance(rover0, location1) = {distance!r}) (rover0.x * 2 - rover0.y >= {2 * x - y!r})
        (rel_angle(rover0, location1) = cos-and-sin(0)) (rover0.heading >= {heading!r} - 1e-9)"""
    )
    grow = rng.uniform(0.0, 50.0, (4, 20))
    boxes = compiled.position_cells(x - grow[0], x + grow[1], y - grow[2], y + grow[3])
    assert boxes.all()


def test_boxes_without_a_satisfying_attitude_are_given_up() -> None:
    lows, highs = np.array([0.0, 300.0, 60.0, 67.0]), np.array([10.0, 310.0, 70.0, 150.0])
    boxes = program(TAKE_PHOTO).position_cells(lows, highs, lows + 100.0, highs + 100.0)
    assert boxes.tolist() == [True, False, False, True]
