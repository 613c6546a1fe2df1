"""The compiled table computes what the functions compute, and both ways of descending agree."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.functions import Array
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program, compile_program, descend
from motion_planner_node.satisfaction.evaluation import evaluate, tell, workspace
from motion_planner_node.world.model import Bounds, World, WorldObject

WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 800.0, 600.0),
    objects={
        'a': WorldObject('a', {'x': 67.0, 'y': 171.0}),
        'b': WorldObject('b', {'x': 206.0, 'y': 542.0}),
    },
    obstacles=(),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
TAKE_PHOTO = '(distance(r, a) >= 50)(distance(r, a) <= 100)(rel_angle(r, a) = cos-and-sin(pi/2))'
EVERYTHING = TAKE_PHOTO + (
    '(object_on_left(r, b))(field_of_view(r, a, 2))(bearing(r, b) = cos-and-sin(r.heading / 2))'
    '(distance(b, r) <= 7)(equidistant(r, a, b))(5 - (r.y - 2) > -(distance(r, b) + 1) + 3)'
    '(r.x * 2 >= 900)(distance(r, b) / 3 = r.y + r.heading)(-r.x / r.y < deg(r.heading))'
    '(rel_angle(r, a) = rel_angle(r, b))(1 / (r.x - a.x) > 2)'
)


def program(text: str) -> Program:
    preconditions = parse('(agent r)(object a)(object b)' + text)
    return compile_program(preconditions, WORLD, {'r': Attitude(20.0, 100.0, 0.0)})


def from_table(compiled: Program, states: Array, *, is_truncated: bool) -> tuple[Array, Array]:
    """Differences of sides (n, m) and their slopes (n, m, 3)."""
    table = compiled.table
    assert table is not None
    values, gradients = workspace(table)
    told = np.empty((len(states), len(compiled.rows), 4))
    for state, row in zip(states, told, strict=True):
        evaluate(table, state, 0, is_truncated, values, gradients)
        tell(table, values, gradients, row)
    return told[:, :, 0], told[:, :, 1:]


@settings(max_examples=100, deadline=None)
@given(
    st.floats(-1e4, 1e4) | st.sampled_from([67.0, 206.0]),
    st.floats(-1e4, 1e4) | st.sampled_from([171.0, 542.0, 0.0]),
    st.floats(-10.0, 10.0),
    st.booleans(),
)
def test_the_table_computes_the_functions(
    x: float, y: float, heading: float, is_truncated: bool
) -> None:
    compiled = program(EVERYTHING)
    state = np.array([[x, y, heading]])
    told = np.zeros((1, len(compiled.rows), 4))
    compiled.differences(state, told, is_truncated=is_truncated)
    values, slopes = from_table(compiled, state, is_truncated=is_truncated)
    for row, value, expected in zip(compiled.rows, values[0], told[0, :, 0], strict=True):
        if row.periodic and not np.isnan(expected):
            assert abs(math.remainder(value - expected, 2.0 * math.pi)) < 1e-9
        else:
            assert value == pytest.approx(expected, rel=1e-12, abs=1e-12, nan_ok=True)
    finite = np.isfinite(told[0, :, 1:])
    expected_slopes = told[0, :, 1:][finite]
    assert slopes[0][finite] == pytest.approx(expected_slopes, rel=1e-9, abs=1e-9)


@settings(max_examples=60, deadline=None)
@given(st.floats(100.0, 700.0), st.floats(0.0, 500.0), st.floats(-3.0, 3.0))
def test_the_slopes_are_those_of_the_values(x: float, y: float, heading: float) -> None:
    compiled = program('(distance(r, a) >= 50)(rel_angle(r, b) = cos-and-sin(1))(r.x * r.y >= 9)')
    state = np.array([[x, y, heading]])
    slopes = from_table(compiled, state, is_truncated=False)[1][0]
    for axis in range(3):
        step = np.zeros((1, 3))
        step[0, axis] = 1e-5
        above = from_table(compiled, state + step, is_truncated=False)[0][0]
        below = from_table(compiled, state - step, is_truncated=False)[0][0]
        apart = np.array([above[0] - below[0], math.remainder(above[1] - below[1], 2.0 * math.pi)])
        assert slopes[:2, axis] == pytest.approx(apart / 2e-5, abs=1e-5)
        assert slopes[2, axis] == pytest.approx((above[2] - below[2]) / 2e-5, rel=1e-4, abs=1e-3)


def test_only_derived_codes_are_kept_when_truncated() -> None:
    compiled = program('(rel_angle(r, a) = cos-and-sin(1))')
    state = np.array([[20.0, 100.0, 0.5]])
    assert from_table(compiled, state, is_truncated=True)[1][0].tolist() == [[0.0, 0.0, 1.0]]
    assert (from_table(compiled, state, is_truncated=False)[1][0] != 0.0).all()


@pytest.mark.parametrize(
    'text',
    [
        TAKE_PHOTO,
        TAKE_PHOTO + '(r.heading = 0)',
        '(rel_angle(r, a) = cos-and-sin(1))(rel_angle(r, b) = cos-and-sin(-1))',
        '(distance(r, a) + distance(r, b) = 500)(r.x < 100)',
        '(distance(r, a) >= 60)(distance(r, a) <= 50)',
    ],
)
def test_programs_with_and_without_a_table_descend_alike(text: str) -> None:
    fast, slow = program(text), program(text)
    vars(slow)['table'] = None
    rng = np.random.default_rng(5)
    starts = rng.uniform([0.0, 0.0, -math.pi], [800.0, 600.0, math.pi], (50, 3))
    one, other = descend(fast, starts), descend(slow, starts)
    assert (one.satisfied == other.satisfied).all()
    solved = one.satisfied
    steps = other.iterations[solved].tolist()
    assert one.iterations[solved].tolist() == pytest.approx(steps, abs=2)
    alike = np.abs(one.states - other.states).max(axis=1) < 1e-5
    assert alike.mean() > 0.9


@pytest.mark.parametrize(
    ('text', 'operations'),
    [
        ('(distance(r, a) >= 50)(distance(r, a) <= 100)', 1),
        ('(distance(r, a) <= 5)(r.x + 3 = 1)(7 - r.y <= -2)(r.heading = 1)', 1),
        ('(rel_angle(r, a) = cos-and-sin(1))(object_on_left(r, b))(facing(r, b))', 2),
        ('(rel_angle(r, a) = cos-and-sin(1))(bearing(r, a) = cos-and-sin(2))', 2),
        ('(r.x * r.y + 1 >= r.x * r.y + r.heading)', 4),
    ],
)
def test_a_table_holds_no_operation_twice_and_none_in_vain(text: str, operations: int) -> None:
    table = program(text).table
    assert table is not None
    assert len({tuple(operation) for operation in table.operations.tolist()}) == operations
    assert len(table.operations) == operations
