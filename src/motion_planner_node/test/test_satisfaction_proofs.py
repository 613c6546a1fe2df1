"""Proofs by branch and prune: sound, complete enough, minimal, and with numbers."""

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
    Room,
    branch_and_prune,
    compile_program,
    conflicts,
    descend,
    destinations,
    unsolved,
)
from motion_planner_node.world.clearance import clearances
from motion_planner_node.world.model import Bounds, Circle, Polygon, World, WorldObject
from motion_planner_node.world.shapes import shapes_of

PLACES = {'a': (200.0, 200.0), 'b': (235.0, 200.0), 'c': (350.0, 400.0)}
BOUNDS = Bounds(0.0, 0.0, 800.0, 600.0)
WALL = Polygon('wall', ((150.0, 210.0), (260.0, 210.0), (260.0, 420.0), (150.0, 420.0)))
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={label: WorldObject(label, {'x': x, 'y': y}) for label, (x, y) in PLACES.items()},
    obstacles=(WALL, Circle('tree', (400.0, 100.0), 30.0)),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
START = Attitude(20.0, 100.0, 0.0)
ROOM = Room(shapes_of(WORLD)[0], 5.0)


def program(*constraints: str) -> Program:
    stated = '(agent r)' + ''.join(f'(object {label})' for label in PLACES)
    texts = ''.join(f'({constraint})' for constraint in constraints)
    return compile_program(parse(stated + texts), WORLD, {'r': START})


IMPOSSIBLE = {
    'discs apart': ('distance(r, a) <= 10', 'distance(r, b) <= 10', 'r.x > 5'),
    'facing what is behind': (
        'rel_angle(r, a) = cos-and-sin(0)',
        'r.heading = 0',
        'r.x >= a.x + 10',
        'r.y <= 500',
    ),
    'between but too far': (
        'rel_angle(r, a) = cos-and-sin(0)',
        'rel_angle(r, c) = cos-and-sin(pi)',
        'distance(r, a) >= 251',
    ),
    'three circles': ('distance(r, a) = 100', 'distance(r, b) = 100', 'distance(r, c) = 100'),
    'headings': ('rel_angle(r, a) = cos-and-sin(0)', 'r.heading > 0.5', 'r.x > 250', 'r.y > 250'),
    'product': ('r.x * r.y >= 480001',),
}


@pytest.mark.parametrize('name', IMPOSSIBLE)
def test_what_is_impossible_is_proven(name: str) -> None:
    sentence = program(*IMPOSSIBLE[name]).contradiction(BOUNDS)
    assert sentence is not None
    assert 'proven by' in sentence


@pytest.mark.parametrize('name', IMPOSSIBLE)
def test_no_constraint_of_a_conflict_can_be_left_out(name: str) -> None:
    compiled = program(*IMPOSSIBLE[name])
    sentence = compiled.contradiction(BOUNDS)
    assert sentence is not None
    conflict = [text for text in IMPOSSIBLE[name] if text in sentence]
    assert conflict
    for left_out in conflict:
        others = [text for text in conflict if text != left_out]
        assert program(*others).contradiction(BOUNDS) is None
        assert len(destinations(program(*others), START, BOUNDS, np.random.default_rng(0), 4))


@pytest.mark.parametrize('name', IMPOSSIBLE)
def test_boxes_before_descents_change_no_explanation(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    sentence = program(*IMPOSSIBLE[name]).contradiction(BOUNDS)
    monkeypatch.setattr(conflicts, '_FEW', 0)
    assert sentence is not None
    assert program(*IMPOSSIBLE[name]).contradiction(BOUNDS) == sentence


def test_a_conflict_of_distances_says_how_far_apart_the_places_are() -> None:
    sentence = program(*IMPOSSIBLE['discs apart']).contradiction(BOUNDS)
    expected = 'distance(r, a) <= 10 and distance(r, b) <= 10, but a and b are 35.0 apart'
    assert sentence is not None
    assert sentence.startswith(expected)
    assert 'branch and prune' in sentence


def test_another_conflict_says_by_how_much_it_is_missed() -> None:
    sentence = program('r.x >= 100', 'r.y >= 590', 'distance(r, a) <= 380').contradiction(BOUNDS)
    assert sentence is not None
    assert 'where r.y >= 590 holds, distance(r, a) <= 380 is missed by' in sentence
    missed = float(sentence.split('missed by ')[1].split()[0])
    assert 0.0 < missed <= 10.0


@settings(max_examples=40, deadline=None)
@given(
    st.floats(0.0, 800.0),
    st.floats(0.0, 600.0),
    st.floats(-3.1, 3.1),
    st.sets(st.integers(0, 5), min_size=1),
)
def test_no_proof_against_an_attitude_that_will_do(
    x: float, y: float, heading: float, chosen: set[int]
) -> None:
    bearing = {label: math.atan2(v - y, u - x) for label, (u, v) in PLACES.items()}
    length = {label: math.hypot(v - y, u - x) for label, (u, v) in PLACES.items()}
    true = [
        f'distance(r, a) = {length["a"]!r}',
        f'distance(r, b) - distance(r, c) = {length["b"] - length["c"]!r}',
        f'rel_angle(r, b) = cos-and-sin({heading - bearing["b"]!r})',
        f'rel_angle(r, c) = cos-and-sin({heading - bearing["c"]!r})',
        f'r.heading = {heading!r}',
        f'r.x + r.y <= {x + y!r}',
    ]
    compiled = program(*(true[index] for index in chosen))
    if not compiled.satisfied(np.array([[x, y, heading]]))[0]:
        return  # a relative angle to where the robot stands
    left = branch_and_prune(compiled, BOUNDS, budget=4000)
    state = np.array([x, y, heading])
    assert ((left.low <= state) & (state <= left.high)).all(axis=1).any()
    if clearances(ROOM.shapes, state[None, :])[0] >= ROOM.clearance:
        assert not branch_and_prune(compiled, BOUNDS, room=ROOM, budget=4000).is_empty


def test_obstacles_count_in_a_proof() -> None:
    compiled = program('distance(r, a) <= 90', 'rel_angle(r, a) = cos-and-sin(0)', 'r.heading < -1')
    assert not branch_and_prune(compiled, BOUNDS).is_empty
    beside = program(
        'distance(r, a) <= 90',
        'distance(r, a) >= 20',
        'rel_angle(r, a) = cos-and-sin(0)',
        'r.heading <= -1.3',
        'r.heading >= -1.8',
    )
    assert not branch_and_prune(beside, BOUNDS).is_empty
    assert branch_and_prune(beside, BOUNDS, room=ROOM).is_empty


def test_a_proof_is_given_up_when_its_budget_is_spent() -> None:
    compiled = program(*IMPOSSIBLE['three circles'])
    left = branch_and_prune(compiled, BOUNDS, budget=20)
    assert not left.is_empty
    assert left.examined <= 20
    again = branch_and_prune(compiled, BOUNDS, budget=20)
    assert left.low.tobytes() == again.low.tobytes()


def test_what_no_descent_meets_is_narrowed_down() -> None:
    compiled = program(*IMPOSSIBLE['discs apart'])
    assert unsolved(compiled, BOUNDS) == (0, 1)
    assert unsolved(program('distance(r, a) <= 10', 'r.x > 5'), BOUNDS) == ()


def test_descents_leave_obstacles() -> None:
    compiled = program('distance(r, a) <= 90', 'rel_angle(r, a) = cos-and-sin(pi/2)')
    rng = np.random.default_rng(2)
    starts = rng.uniform([160.0, 215.0, -3.0], [250.0, 280.0, 3.0], (200, 3))
    blocked = descend(compiled, starts)
    assert blocked.satisfied.all()
    assert (clearances(ROOM.shapes, blocked.states) < 5.0).mean() > 0.8
    free = descend(compiled, blocked.states, DescentOptions(retries=0), ROOM)
    assert free.satisfied.mean() > 0.9
    assert (clearances(ROOM.shapes, free.states[free.satisfied]) >= 5.0).all()
    assert (compiled.violations(free.states[free.satisfied]) <= 1.1e-9).all()


def test_destinations_are_free_where_some_are() -> None:
    compiled = program('distance(r, a) <= 90', 'rel_angle(r, a) = cos-and-sin(pi/2)')
    start = Attitude(205.0, 230.0, 0.0)
    found = destinations(compiled, start, BOUNDS, np.random.default_rng(0), 32, ROOM)
    assert len(found) == 32
    assert (clearances(ROOM.shapes, found) >= 5.0).all()
    inside = program('r.x = 200', 'r.y = 300')
    blocked = destinations(inside, start, BOUNDS, np.random.default_rng(0), 4, ROOM)
    assert blocked[:, :2] == pytest.approx(np.array([[200.0, 300.0]] * len(blocked)))
    assert len(blocked)
