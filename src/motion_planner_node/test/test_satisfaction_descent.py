"""The descent: the paper's worked example, exact feasibility, coupled sets, no false success."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import (
    DescentOptions,
    Program,
    compile_program,
    descend,
    destinations,
    from_start,
    restarts,
)
from motion_planner_node.world.model import Bounds, World, WorldObject

PLACES = {'a': (67.0, 171.0), 'b': (206.0, 542.0), 'c': (362.0, 350.0), 'o': (50.0, 50.0)}
BOUNDS = Bounds(0.0, 0.0, 800.0, 600.0)
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={label: WorldObject(label, {'x': x, 'y': y}) for label, (x, y) in PLACES.items()},
    obstacles=(),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
START = Attitude(20.0, 100.0, 0.0)
TAKE_PHOTO = '(distance(r, a) >= 50)(distance(r, a) <= 100)(rel_angle(r, a) = cos-and-sin(pi/2))'


def program(text: str) -> Program:
    stated = '(agent r)' + ''.join(f'(object {label})' for label in PLACES)
    return compile_program(parse(stated + text), WORLD, {'r': START})


def off(heading: float, x: float, y: float, place: str, angle: float) -> float:
    """How far [rad] the heading is from ``angle`` relative to the bearing of ``place``."""
    px, py = PLACES[place]
    return abs(math.remainder(heading - math.atan2(py - y, px - x) - angle, 2.0 * math.pi))


def test_the_worked_example_of_the_paper() -> None:
    descent = from_start(program('(distance(r, o) >= 10)(distance(r, o) <= 20)'), START)
    assert descent.states[0] == pytest.approx([39.7101, 67.1499, 0.0], abs=1e-4)
    assert descent.iterations.tolist() == [1]
    assert descent.satisfied.all()
    x, y, _ = descent.states[0]
    assert 10.0 <= math.hypot(50.0 - x, 50.0 - y) <= 20.0


def test_the_paper_s_step_turns_the_robot_without_moving_it() -> None:
    descent = from_start(program(TAKE_PHOTO), START)
    assert descent.states[0][:2].tolist() == [20.0, 100.0]
    assert off(float(descent.states[0][2]), 20.0, 100.0, 'a', math.pi / 2.0) < 1e-9


@settings(max_examples=60, deadline=None)
@given(st.integers(min_value=0, max_value=2**32 - 1))
def test_every_destination_of_take_photo_passes_an_independent_check(seed: int) -> None:
    rng = np.random.default_rng(seed)
    start = Attitude(*rng.uniform([0.0, 0.0, -3.0], [800.0, 600.0, 3.0]))
    found = destinations(program(TAKE_PHOTO), start, BOUNDS, rng, 16)
    assert len(found) == 16
    for x, y, heading in found.tolist():
        assert 50.0 <= math.hypot(67.0 - x, 171.0 - y) <= 100.0
        assert off(heading, x, y, 'a', math.pi / 2.0) <= 1e-9
        assert 0.0 <= x <= 800.0
        assert 0.0 <= y <= 600.0
        assert -math.pi < heading <= math.pi


def coupled_sets() -> dict[str, str]:
    """Sets that one attitude, chosen here, satisfies."""
    x, y, heading = 250.0, 260.0, 0.7
    angle = {
        label: f'(rel_angle(r, {label}) = cos-and-sin({heading - math.atan2(py - y, px - x)!r}))'
        for label, (px, py) in PLACES.items()
    }
    length = {label: math.hypot(px - x, py - y) for label, (px, py) in PLACES.items()}
    exact = {label: f'(distance(r, {label}) = {value!r})' for label, value in length.items()}
    return {
        'photo with a heading': TAKE_PHOTO + '(r.heading = 0)',
        'two angles': angle['a'] + angle['b'],
        'three angles': angle['a'] + angle['b'] + angle['c'],
        'angle, distance, heading': angle['a'] + exact['a'] + f'(r.heading = {heading})',
        'three distances': exact['a'] + exact['b'] + exact['c'],
        'two distances, one angle': exact['a'] + exact['b'] + angle['c'],
        'two angles and a heading': angle['a'] + angle['b'] + f'(r.heading = {heading})',
        'sum of distances': f'(distance(r, a) + distance(r, b) = {length["a"] + length["b"]!r})',
        'difference': f'(distance(r, a) - distance(r, b) = {length["a"] - length["b"]!r})',
        'product': '((r.x - a.x) * (r.y - a.y) = 900)(distance(r, a) <= 90)' + angle['a'],
        'line and ring': f'(r.x = 250)(distance(r, a) < {length["a"] + 1!r})' + angle['b'],
        'pose': '(r.x = 10)(r.y = 20)(r.heading = 3)',
        'equality as two inequalities': '(distance(r, a) >= 80)(distance(r, a) <= 80)',
    }


@pytest.mark.parametrize('name', coupled_sets())
def test_all_starts_satisfy_coupled_sets(name: str) -> None:
    compiled = program(coupled_sets()[name])
    rng = np.random.default_rng(8)
    starts = rng.uniform([0.0, 0.0, -math.pi], [800.0, 600.0, math.pi], (200, 3))
    descent = descend(compiled, starts)
    assert descent.satisfied.mean() >= 0.995
    for batch in range(0, 192, 64):
        assert descent.satisfied[batch : batch + 64].any()


def test_near_collinear_trilateration_is_solved_from_anywhere() -> None:
    x, y = 300.0, 140.0
    places = {'p': (100.0, 100.0), 'q': (300.0, 101.0), 's': (500.0, 100.0)}
    objects = {label: WorldObject(label, {'x': u, 'y': v}) for label, (u, v) in places.items()}
    world = World('', '', BOUNDS, objects, (), WORLD.robots)
    text = '(agent r)' + ''.join(f'(object {label})' for label in places)
    for label, (u, v) in places.items():
        text += f'(distance(r, {label}) = {math.hypot(u - x, v - y)!r})'
    compiled = compile_program(parse(text), world, {'r': START})
    starts = np.random.default_rng(0).uniform([0.0, 0.0, -3.0], [800.0, 600.0, 3.0], (256, 3))
    descent = descend(compiled, starts)
    assert descent.satisfied.mean() > 0.98
    assert descent.states[descent.satisfied][:, :2] == pytest.approx(
        np.array([[x, y]] * int(descent.satisfied.sum())), abs=1e-4
    )
    once = descend(compiled, starts, DescentOptions(retries=0))
    assert once.satisfied.mean() < 0.95
    assert (descent.states[once.satisfied] == once.states[once.satisfied]).all()


@pytest.mark.parametrize('name', coupled_sets())
def test_nine_of_ten_descents_need_no_retry(name: str) -> None:
    compiled = program(coupled_sets()[name])
    rng = np.random.default_rng(7)
    starts = rng.uniform([0.0, 0.0, -math.pi], [800.0, 600.0, math.pi], (200, 3))
    descent = descend(compiled, starts, DescentOptions(retries=0))
    assert descent.satisfied.mean() >= 0.9
    assert (compiled.violations(descent.states)[descent.satisfied] <= 1.1e-9).all()


@pytest.mark.parametrize(
    'text',
    [
        '(distance(r, a) >= 60)(distance(r, a) <= 50)',
        '(distance(r, a) <= 100)(distance(r, b) <= 100)',
        '(distance(r, a) < 0)',
        '(r.heading = 1)(r.heading = 2)',
        '(rel_angle(r, a) = cos-and-sin(1))(rel_angle(r, a) = cos-and-sin(-2))',
        '(distance(r, a) > 50)(distance(r, a) < 50)',
        '(a.x = 1)',
        '(r.x * r.x < 0)',
    ],
)
def test_what_cannot_be_satisfied_never_is(text: str) -> None:
    compiled = program(text)
    rng = np.random.default_rng(1)
    assert not from_start(compiled, START).satisfied.any()
    assert not restarts(compiled, BOUNDS, rng, 100).satisfied.any()
    assert destinations(compiled, START, BOUNDS, rng, 20).shape == (0, 3)


def test_the_best_of_what_cannot_be_satisfied_is_a_compromise() -> None:
    compiled = program('(distance(r, a) >= 60)(distance(r, a) <= 50)')
    descent = restarts(compiled, BOUNDS, np.random.default_rng(1), 50)
    assert descent.violations[descent.best] == pytest.approx([5.0, 5.0], abs=1e-3)


@pytest.mark.parametrize('text', [TAKE_PHOTO, '(distance(r, a) >= 50)', '(distance(r, a) > 0)'])
def test_a_robot_that_stands_on_the_object_gets_away(text: str) -> None:
    found = destinations(
        program(text), Attitude(67.0, 171.0, 0.0), BOUNDS, np.random.default_rng(0), 4
    )
    assert len(found) == 4


def test_coordinates_far_from_the_origin_are_no_obstacle() -> None:
    far = 5e6
    world = World(
        '',
        '',
        Bounds(far, far, far + 800.0, far + 600.0),
        {'a': WorldObject('a', {'x': far + 67.0, 'y': far + 171.0})},
        (),
        WORLD.robots,
    )
    start = Attitude(far + 300.0, far + 300.0, 0.0)
    text = '(agent r)(object a)(distance(r, a) = 60)(rel_angle(r, a) = cos-and-sin(1))'
    compiled = compile_program(parse(text), world, {'r': start})
    rng = np.random.default_rng(0)
    assert len(destinations(compiled, start, world.bounds, rng, 8)) == 8
