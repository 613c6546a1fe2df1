"""What conditions, ``!=`` and the functions of the world mean for destinations."""

from __future__ import annotations

import math

import numpy as np
import pytest

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import check, parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program, compile_program, destinations
from motion_planner_node.world.model import (
    Bounds,
    Circle,
    Polygon,
    World,
    WorldObject,
)

BOUNDS = Bounds(0.0, 0.0, 100.0, 100.0)
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={
        'tree': WorldObject('tree', {'x': 50.0, 'y': 50.0, 'height': 3.0}),
        'rock': WorldObject('rock', {'x': 80.0, 'y': 50.0}),
    },
    obstacles=(Polygon('wall', ((60.0, 30.0), (64.0, 30.0), (64.0, 70.0), (60.0, 70.0))),),
    robots={label: Robot(label, 2.0, 0.5, 1.0, 2.0) for label in ('r', 's')},
    regions={
        'dock': Polygon('dock', ((10.0, 10.0), (40.0, 10.0), (40.0, 40.0), (10.0, 40.0))),
        'pond': Circle('pond', (20.0, 80.0), 10.0),
    },
)
STATED = '(agent r)(agent s)(object tree)(object rock)(region dock)(region pond)'
START = {'r': Attitude(30.0, 50.0, 0.0), 's': Attitude(70.0, 80.0, 2.0)}
HALF = math.pi / 2.0


def program(text: str) -> Program:
    return compile_program(parse(STATED + text), WORLD, START)


@pytest.mark.parametrize(
    ('text', 'good', 'bad'),
    [
        ('inside(r, dock)', (20, 20, 0), (50, 20, 0)),
        ('(inside(r, pond))', (20, 89, 0), (20, 91, 0)),
        ('outside(r, dock)', (50, 20, 0), (39, 39, 0)),
        ('(not(inside(r, dock)))', (50, 20, 0), (10, 20, 0)),
        ('(not (outside(r, dock)))', (20, 20, 0), (10, 20, 0)),
        ('(not(not(inside(r, dock))))', (20, 20, 0), (50, 20, 0)),
        ('(distance_to_boundary(r, dock) <= 2)', (41, 20, 0), (25, 25, 0)),
        ('visible(r, rock)', (80, 20, 0), (40, 50, 0)),
        ('not(visible(r, rock))', (40, 50, 0), (80, 20, 0)),
        ('clearance(r) >= 5', (50, 50, 0), (56, 50, 0)),
        ('clearance(r) >= 5', (50, 50, 0), (50, 4, 0)),
        ('facing(r, tree)', (30, 50, 0), (30, 50, 0.1)),
        ('object_on_left(r, tree)', (50, 30, 0), (50, 70, 0)),
        ('object_on_right(r, tree)', (50, 70, 0), (50, 30, 0)),
        ('object_behind(r, tree)', (30, 50, math.pi), (30, 50, 0)),
        ('field_of_view(r, tree, deg(60))', (30, 50, 0.5), (30, 50, 0.6)),
        ('not(field_of_view(r, tree, deg(60)))', (30, 50, 3.0), (30, 50, 0.5)),
        ('same_heading(r, s)', (1, 2, 2.0), (1, 2, 1.9)),
        ('equidistant(r, tree, rock)', (65, 80, 0), (60, 80, 0)),
        ('distance_to_segment(r, tree, rock) <= 3', (70, 53, 0), (90, 50, 0)),
        ('cross_track(r, tree, rock) >= 5', (0, 60, 0), (0, 40, 0)),
        ('along_track(r, tree, rock) >= 5', (60, 0, 0), (40, 0, 0)),
        ('heading(r) = cos-and-sin(pi/2)', (1, 1, HALF), (1, 1, 0)),
        ('bearing(r, tree) = cos-and-sin(pi)', (70, 50, 0), (30, 50, 0)),
        ('angle_between(heading(r), pi) <= deg(10)', (1, 1, -3.1), (1, 1, 0)),
        ('(angle_between(rel_angle(r, tree), 0) < 0.2)', (30, 50, 0.1), (30, 50, 3)),
        ('r.x != 5', (6, 0, 0), (5, 0, 0)),
        ('r.heading != -pi', (6, 0, 0), (5, 0, math.pi)),
        ('rel_angle(r, tree) != cos-and-sin(0)', (30, 50, 1), (30, 50, 0)),
        ('min(distance(r, tree), distance(r, rock)) <= 5', (80, 46, 0), (65, 50, 0)),
        ('max(distance(r, tree), distance(r, rock), r.x) <= 66', (65, 50, 0), (67, 50, 0)),
        ('abs(r.x - tree.x) <= tree.height', (47, 0, 0), (46, 0, 0)),
        ('distance(r, s) <= 10', (70, 72, 0), (70, 60, 0)),
    ],
)
def test_a_constraint_holds_where_it_says(
    text: str, good: tuple[float, ...], bad: tuple[float, ...]
) -> None:
    assert program(text).satisfied(np.array([good, bad], dtype=np.float64)).tolist() == [
        True,
        False,
    ]


@pytest.mark.parametrize(
    'text',
    [
        'inside(r, dock) visible(r, tree) facing(r, tree)',
        'inside(r, pond) object_on_left(r, tree)',
        'not(visible(r, rock)) distance(r, rock) <= 40',
        'visible(r, rock) distance(r, rock) >= 50 field_of_view(r, rock, deg(30))',
        'equidistant(r, tree, rock) cross_track(r, tree, rock) = 12 same_heading(r, s)',
        'distance_to_segment(r, tree, rock) = 7 along_track(r, tree, rock) <= -2',
        'clearance(r) >= 15 inside(r, dock) r.heading != 0',
        'distance_to_boundary(r, dock) = 2 not(inside(r, dock))',
        'min(distance(r, tree), distance(r, rock)) = 20 max(r.x, r.y) <= 60',
        'distance(r, tree) = distance(r, s) angle_between(heading(r), bearing(r, s)) <= 0.1',
    ],
)
def test_destinations_are_found(text: str) -> None:
    asked = program(text)
    found = destinations(asked, START['r'], BOUNDS, np.random.default_rng(1), 8)
    assert len(found)
    assert asked.satisfied(found).all()


@pytest.mark.parametrize(
    'text',
    [
        'inside(r, dock) inside(r, pond)',
        'inside(r, dock) distance(r, rock) <= 20',
        'inside(r, pond) clearance(r) >= 40',
        'outside(r, dock) distance_to_segment(r, tree, rock) <= -1',
        '(distance(r, rock) <= 15) (r.x <= 58)',
        'not(inside(r, dock)) r.x >= 12 r.x <= 38 r.y >= 12 r.y <= 38',
        'inside(r, dock) visible(r, rock) facing(r, rock)',
        '(visible(r, rock)) r.x >= 40 r.x <= 50 r.y >= 48 r.y <= 52',
        'angle_between(heading(r), heading(s)) > 4',
    ],
)
def test_what_cannot_be_is_proven(text: str) -> None:
    assert program(text).contradiction(BOUNDS) is not None


@pytest.mark.parametrize('first', ['inside(?r, ?z)', 'outside(?r, ?z)', 'not(inside(?r, ?z))'])
def test_a_condition_and_its_opposite_exclude_each_other(first: str) -> None:
    opposite = 'inside(?r, ?z)' if first.startswith('not') else f'not({first})'
    (found,) = check(parse(f'(agent ?r)(region ?z)({first})({opposite})'))
    assert found.message == f'{first} and {opposite} exclude each other'


def test_residuals_repeat_the_text_of_a_condition() -> None:
    asked = program('not(inside(r, dock)) r.x != 1')
    texts = [residual.constraint for residual in asked.residuals(START['r'])]
    assert texts == ['not(inside(r, dock))', 'r.x != 1']


def test_commands_take_expressions_with_functions() -> None:
    asked = program('setProperty(r.x, min(tree.x, rock.x) - clearance(s)) setProperty(r.y, 1)')
    state = asked.apply_commands(START)
    assert state['r'].x == pytest.approx(50.0 - math.hypot(6.0, 10.0))
    assert asked.assigns


def test_all_errors_of_meaning_are_told_at_once() -> None:
    text = 'insid(r, dock) (not(facing(r, tree))) (r.z != 1) (setProperty(tree.x, 1)) (tree = dock)'
    with pytest.raises(MotionPlannerError) as caught:
        program(text)
    assert len(caught.value.diagnostics) == 5
