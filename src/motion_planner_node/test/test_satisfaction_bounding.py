"""Bounds by the compiled kernel hold for every attitude of a box, and are those of the functions."""

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
from motion_planner_node.satisfaction import Program, compile_program, possible_cells
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
CONSTRAINTS = (
    '(distance(r, a) >= 50)',
    '(rel_angle(r, a) = cos-and-sin(pi/2))',
    '(bearing(r, b) = cos-and-sin(r.heading / 2))',
    '(field_of_view(r, a, 2))',
    '(angle_between(bearing(r, a), bearing(r, b)) < 0.4)',
    '(equidistant(r, a, b))',
    '(distance_to_segment(r, a, b) <= 20)',
    '(cross_track(r, a, b) > 3)',
    '(5 - (r.y - 2.1) + 0.3 > -(distance(r, b) + 1) + 3)',
    '(distance(r, b) / 3 = r.y + r.heading)',
    '(1 / (r.x - a.x) > 2)',
    '(r.x * r.y != 300)',
    '(min(r.x, r.y) < max(r.heading, abs(r.y - 7)))',
)
#: Sides of boxes, from points to the whole map; corners lie on objects and round numbers, too.
corners = st.tuples(
    st.sampled_from([0.0, 67.0, 206.0]) | st.floats(-900.0, 900.0),
    st.sampled_from([0.0, 171.0, 542.0]) | st.floats(-900.0, 900.0),
    st.sampled_from([-math.pi, 0.0]) | st.floats(-math.pi, math.pi),
)
sizes = st.tuples(*[st.sampled_from([0.0, 1e-9, 0.1, 3.0, 60.0, 900.0])] * 3)


def program(text: str) -> Program:
    return compile_program(
        parse(f'((agent r)(object a)(object b){text})'), WORLD, {'r': Attitude(20.0, 100.0, 0.0)}
    )


def box_of(corner: tuple[float, ...], size: tuple[float, ...]) -> tuple[Array, Array]:
    low = np.array([corner])
    high = low + size
    high[:, 2] = np.minimum(high[:, 2], math.pi)
    return low, high


@pytest.mark.parametrize('text', CONSTRAINTS)
@settings(max_examples=60, deadline=None)
@given(corners, sizes, st.integers(0, 2**32))
def test_bounds_hold_at_every_attitude_of_the_box(
    text: str, corner: tuple[float, ...], size: tuple[float, ...], seed: int
) -> None:
    compiled = program(text)
    assert compiled.table is not None
    low, high = box_of(corner, size)
    (bounds,) = compiled.bounds(low, high)
    shares = np.random.default_rng(seed).random((20, 3)).round(1)
    states = np.minimum(low + shares * (high - low), high)
    for function in compiled.functions(states):
        for value in function.value[~np.isnan(function.value)]:
            turns = np.array([0.0])
            if compiled.rows[0].periodic:
                turns = 2.0 * math.pi * np.arange(-2, 3)
            slack = 1e-12 * (1.0 + abs(value))
            inside = (bounds.low[0] - slack <= value + turns) & (
                value + turns <= bounds.high[0] + slack
            )
            assert inside.any()


@pytest.mark.parametrize('text', CONSTRAINTS)
@settings(max_examples=30, deadline=None)
@given(corners, sizes)
def test_bounds_are_as_tight_as_those_of_the_functions(
    text: str, corner: tuple[float, ...], size: tuple[float, ...]
) -> None:
    compiled, opaque = program(text), program(text)
    opaque.__dict__['table'] = None
    low, high = box_of(corner, size)
    (ours,), (theirs,) = compiled.bounds(low, high), opaque.bounds(low, high)
    for one, other in ((ours.low, theirs.low), (ours.high, theirs.high)):
        if compiled.rows[0].periodic:
            # Half a turn to the left is half a turn to the right.
            other = one - np.remainder(one - other + math.pi, 2.0 * math.pi) + math.pi
        assert one == pytest.approx(other, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize('text', CONSTRAINTS)
def test_cells_are_those_that_the_functions_leave(text: str) -> None:
    compiled, opaque = program(text), program(text)
    opaque.__dict__['table'] = None
    cells = possible_cells(compiled, WORLD.bounds, most=256)
    assert cells.tolist() == possible_cells(opaque, WORLD.bounds, most=256).tolist()
    assert 0 < len(cells) <= 512


def test_a_cell_is_left_out_for_any_constraint_that_is_asked_for() -> None:
    both = program('(distance(r, a) <= 30)(r.x < 60)')
    few = possible_cells(both, WORLD.bounds)
    more = possible_cells(both, WORLD.bounds, [0])
    assert few[:, 0].max() < 60.0 < more[:, 0].max()
    assert set(map(tuple, few.tolist())) <= set(map(tuple, more.tolist()))
    assert possible_cells(both, WORLD.bounds, [])[:, 2].max() == 800.0


def test_a_bound_that_is_exact_stays_exact() -> None:
    beyond = program('(r.x > 800)')
    (bounds,) = beyond.bounds(np.zeros((1, 3)), np.array([[800.0, 600.0, 0.0]]))
    assert bounds.low[0] == 0.0
