"""Errors of meaning: all at once, each with its place, its code and words that help."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import check, parse
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Circle, World, WorldObject

WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 800.0, 600.0),
    objects={
        label: WorldObject(label, {'x': 1.0, 'y': 2.0, 'height': 3.0})
        for label in ('location0', 'location1')
    },
    obstacles=(),
    robots={label: Robot(label, 8.0, 0.5, 5.0, 2.0) for label in ('rover0', 'rover1')},
    regions={'dock': Circle('dock', (50.0, 50.0), 20.0)},
)
STATED = '(agent rover0)(object location1)'
IN_DOCK = STATED + '(region dock)'
VARIABLE = '(agent ?r)(object ?o)'


@pytest.mark.parametrize(
    ('text', 'code', 'words'),
    [
        ('(agent rover2)', Code.UNKNOWN_AGENT, "did you mean 'rover1'"),
        ('(agent location1)', Code.UNKNOWN_AGENT, 'location1'),
        ('(object location9)', Code.UNKNOWN_OBJECT, "unknown object 'location9'"),
        ('(robot rover0)', Code.INVALID_PRECONDITIONS, 'known: agent, object'),
        ('(object pi)', Code.INVALID_PRECONDITIONS, 'a number, not a label'),
        ('(agent ?a)(object ?a)', Code.INVALID_PRECONDITIONS, 'an agent and an object'),
        ('(object location1)(1 = 1)', Code.INVALID_PRECONDITIONS, '(agent ...)'),
        ('(region dok)', Code.UNKNOWN_OBJECT, "unknown region 'dok' (did you mean 'dock'?)"),
        ('(object ?a)(region ?a)', Code.INVALID_PRECONDITIONS, 'to be an object and a region'),
        (IN_DOCK + '(inside(rover0, location1))', Code.INVALID_PRECONDITIONS, 'wants a region'),
        (IN_DOCK + '(inside(dock, dock))', Code.INVALID_PRECONDITIONS, 'wants an agent'),
        (IN_DOCK + '(distance(rover0, dock) = 1)', Code.INVALID_PRECONDITIONS, 'is a region'),
        (IN_DOCK + '(dock.x = 1)', Code.UNKNOWN_PROPERTY, "property of 'dock'"),
        (IN_DOCK + '(dock = 1)', Code.INVALID_PRECONDITIONS, 'not a number'),
        (IN_DOCK + '(inside(rover0, dock) = 1)', Code.INVALID_PRECONDITIONS, 'stands alone'),
        (IN_DOCK + '(1 + inside(rover0, dock) = 1)', Code.INVALID_PRECONDITIONS, 'a condition'),
        (IN_DOCK + '(not(inside(rover0, dock)) = 1)', Code.INVALID_PRECONDITIONS, 'stands alone'),
        (IN_DOCK + '(not(rover0.x))', Code.INVALID_PRECONDITIONS, 'takes one condition'),
        (STATED + '(insid(rover0, location1))', Code.INVALID_PRECONDITIONS, "'inside'"),
        (
            STATED + '(not(facing(rover0, location1)))',
            Code.INVALID_PRECONDITIONS,
            'would exclude a single value',
        ),
        (STATED + '(rover0 != location1)', Code.INVALID_PRECONDITIONS, 'not a number'),
        (STATED + '(min(rover0.x) < 5)', Code.INVALID_PRECONDITIONS, 'at least 2 arguments, not 1'),
        (STATED + '(abs(1, 2) < 5)', Code.INVALID_PRECONDITIONS, '1 argument, not 2'),
        (STATED + '(distanc(rover0, location1) = 5)', Code.UNKNOWN_FUNCTION, "'distance'"),
        (STATED + '(setPropety(rover0.x, 5))', Code.INVALID_PRECONDITIONS, "'setProperty'"),
        (STATED + '(rover0.z = 5)', Code.UNKNOWN_PROPERTY, 'known: heading, x, y'),
        (STATED + '(location1.widht = 5)', Code.UNKNOWN_PROPERTY, "of 'location1'"),
        (STATED + '(location0.x = 5)', Code.INVALID_PRECONDITIONS, 'not stated'),
        (STATED + '(distance(rover0) = 5)', Code.INVALID_PRECONDITIONS, '2 arguments, not 1'),
        (STATED + '(rover0.x => 5)', Code.INVALID_PRECONDITIONS, "unknown comparator '=>'"),
        (STATED + '(rover0.x ~= 5)', Code.INVALID_PRECONDITIONS, 'known: < <= > >= ='),
        (STATED + '(rover0.x == 5)', Code.INVALID_PRECONDITIONS, "unknown comparator '=='"),
        (STATED + '(rover0 = 5)', Code.INVALID_PRECONDITIONS, 'not a number'),
        (STATED + '(rover0 + 1 = 5)', Code.INVALID_PRECONDITIONS, 'expected a number'),
        (STATED + '(rel_angle(rover0, location1) = 1)', Code.INVALID_PRECONDITIONS, '-sin(1)'),
        (
            STATED + '(rel_angle(rover0, location1) < cos-and-sin(1))',
            Code.INVALID_PRECONDITIONS,
            "only with '='",
        ),
        (
            STATED + '(rel_angle(location1, rover0) = cos-and-sin(1))',
            Code.INVALID_PRECONDITIONS,
            'wants an agent',
        ),
        (STATED + '(distance(rover0, 5) = 5)', Code.INVALID_PRECONDITIONS, 'is a number'),
        (STATED + '(setProperty(location1.x, 5))', Code.INVALID_PRECONDITIONS, 'is an object'),
        (STATED + '(setProperty(5, 5))', Code.INVALID_PRECONDITIONS, 'sets a component'),
        (STATED + '(setProperty(rover0.x))', Code.INVALID_PRECONDITIONS, '2 arguments, not 1'),
        (STATED + '(setProperty(rover0.x, 5) = 5)', Code.INVALID_PRECONDITIONS, 'a command'),
        (STATED + '(distance(rover0, location1))', Code.INVALID_PRECONDITIONS, 'a comparator'),
        (STATED + '(rover0.x = 1 / (2 - 2))', Code.INVALID_PRECONDITIONS, 'division by zero'),
        (STATED + '(rover0.x = 1e308 * 10)', Code.INVALID_PRECONDITIONS, 'too large'),
        (STATED + '(rover0.x = rover0-1.x)', Code.INVALID_PRECONDITIONS, ''),
    ],
)
def test_each_error_has_its_code_and_words(text: str, code: Code, words: str) -> None:
    try:
        found = check(parse(text), WORLD)
    except MotionPlannerError as error:
        found = error.diagnostics
    assert [diagnostic.code for diagnostic in found] == [code]
    assert words in found[0].message
    assert found[0].line == 1
    assert found[0].column > 0
    assert found[0].text


def test_all_errors_are_found_at_once_in_the_order_of_the_text() -> None:
    text = '(agent rover9)\n(object location9)\n(distanc(rover9, location9) => 1)\n(rover9.z = 2)'
    found = check(parse(text), WORLD)
    assert [(diagnostic.line, diagnostic.code) for diagnostic in found] == [
        (1, Code.UNKNOWN_AGENT),
        (2, Code.UNKNOWN_OBJECT),
        (3, Code.UNKNOWN_FUNCTION),
        (3, Code.INVALID_PRECONDITIONS),
        (4, Code.UNKNOWN_PROPERTY),
    ]


def test_variables_and_a_missing_world_leave_labels_open() -> None:
    text = '(distance({r}, {o}) >= 50)({o}.height < 3)(rel_angle({r},{o}) = cos-and-sin(deg(90)))'
    assert not check(parse(VARIABLE + text.format(r='?r', o='?o')), WORLD)
    assert not check(parse('(agent a)(object b)' + text.format(r='a', o='b')), None)


@pytest.mark.parametrize(
    'constraints',
    [
        '(distance(?r, ?o) >= 60)(distance(?r, ?o) <= 50)',
        '(60 <= distance(?r, ?o))(distance(?o, ?r) < 50)',
        '(distance(?r, ?o) = 60)(distance(?r, ?o) = 50)',
        '(distance(?r, ?o) > 50)(distance(?r, ?o) <= 50)',
        '(distance(?r, ?o) = 50)(distance(?r, ?o) < 50)',
        '(2 * distance(?r, ?o) - 20 >= 100)(distance(?r, ?o) <= 50)',
        '(-distance(?r, ?o) >= -50)(distance(?r, ?o) / 2 > 25)',
        '(?r.x >= ?o.x + 10)(?r.x - ?o.x <= 0)',
        '(rel_angle(?r, ?o) = cos-and-sin(pi/2))(rel_angle(?r, ?o) = cos-and-sin(deg(-90)))',
        '(?r.heading = 0)(?r.heading = pi)',
        '(distance(?r, ?o) < 0)',
        '(-1 = distance(?r, ?o))',
        '(distance(?r, ?o) + distance(?r, ?o) * distance(?r, ?o) <= -3)',
        '(50 <= 10)',
        '(?r.x < ?r.x)',
        '(?r.x = 5)(?r.x != 5)',
        '(?r.x != ?o.x)(2 * ?o.x - 2 * ?r.x = 0)',
        '(?r.x != 5)(?r.x >= 5)(?r.x <= 5)',
        '(?r.x >= 5)(?r.x != 5)(?r.x <= 5 + 1e-10)',
        '(?r.x = 5)(?r.x + 3 > 8)',
        '(?r.x = 5)(5 > ?r.x)',
        '(?r.x >= 0)(?r.x = 5)(?r.x <= 9)(?r.x < 5)',
        '(?r.heading = 1)(?r.heading != 1)',
        '(?r.heading != pi)(?r.heading = -pi)',
        '(rel_angle(?r, ?o) = cos-and-sin(pi/2))(rel_angle(?r, ?o) != cos-and-sin(pi/2))',
        '(?r.x != ?r.x)',
        '(5 != 5)',
    ],
)
def test_contradictions_show_without_any_world(constraints: str) -> None:
    found = check(parse(VARIABLE + constraints), None)
    assert [diagnostic.code for diagnostic in found] == [Code.CONTRADICTION]


def test_a_contradiction_names_both_constraints() -> None:
    text = VARIABLE + '\n(distance(?r, ?o) >= 60)\n (distance(?r, ?o) <= 50)'
    (found,) = check(parse(text), None)
    assert (found.line, found.column) == (3, 3)
    assert found.message == ('distance(?r, ?o) >= 60 and distance(?r, ?o) <= 50 exclude each other')


@pytest.mark.parametrize(
    ('constraints', 'words'),
    [
        (
            '(2 * distance(?r, ?o) - 20 >= 100)(distance(?r, ?o) <= 50)',
            'distance(?o, ?r) cannot be at least 60 and at most 50',
        ),
        ('(?r.x + 1 = 6)(?r.x != 5)', '?r.x cannot be equal to 5 and other than 5'),
        (
            '(?r.x >= 5)(?r.x * 2 <= 10)(?r.x != 5)',
            'exclude each other: ?r.x cannot be at least 5, at most 5 and other than 5',
        ),
        (
            '(?r.heading = deg(90))(?r.heading = 0)',
            '?r.heading cannot be equal to 1.570796327 and equal to 0',
        ),
    ],
)
def test_a_contradiction_tells_the_numbers_that_are_not_in_the_text(
    constraints: str, words: str
) -> None:
    (found,) = check(parse(VARIABLE + constraints), None)
    assert words in found.message


@pytest.mark.parametrize(
    'constraints',
    [
        '(?r.x = 5)(?r.x != 6)',
        '(?r.x != 5)(?r.x != 5)',
        '(?r.x >= 5)(?r.x <= 5.00001)(?r.x != 5)',
        '(?r.heading = 1)(?r.heading != 2)',
        '(?r.heading > 1)(?r.heading != 1)',
        '(?r.heading = 0)(?r.heading >= -pi)(?r.heading <= pi)',
        '(?r.x = 5)(?r.y != 5)',
        '(distance(?r, ?o) >= 50)(distance(?r, ?o) <= 50)',
        '(distance(?r, ?o) >= 50)(distance(?r, ?o) <= 60)(distance(?r, ?o) = 55)',
        '(?r.heading = pi)(?r.heading = -pi)',
        '(?r.heading = 3 * pi / 2)(?r.heading < 0)',
        '(rel_angle(?r, ?o) = cos-and-sin(0))(rel_angle(?r, ?o) = cos-and-sin(2 * pi))',
        '(0.1 + 0.2 + ?r.x = 0.3)(?r.x >= 0)',
        '(?r.x <= ?r.x)',
        '(cos-and-sin(0) = cos-and-sin(4 * pi))',
        '(distance(?r, ?o) >= 0)',
        '(cos-and-sin(1e308) = cos-and-sin(-1e308))',
        '(?r.x / 1e300 >= 1e300)(?r.x <= 3)',
        '(rel_angle(?r, ?o) = cos-and-sin(1))(rel_angle(?r, ?o) = cos-and-sin(1e20))',
        '(?r.x * ?r.y >= 7)(?r.y * ?r.x <= 3)',
    ],
)
def test_what_may_hold_is_no_contradiction(constraints: str) -> None:
    assert check(parse(VARIABLE + constraints), None) == ()


LEAVES = st.sampled_from(
    ['0', '2', '1e308', 'pi', 'rover0', 'location1', '?o', 'rover0.x', 'rover0.heading', '?o.y']
)
EXPRESSIONS = st.recursive(
    LEAVES,
    lambda inner: (
        st.builds('({} {} {})'.format, inner, st.sampled_from('+-*/'), inner)
        | st.builds('-{}'.format, inner)
        | st.builds('{}({})'.format, st.sampled_from(['deg', 'cos-and-sin', 'nothing']), inner)
        | st.builds('{}({}, {})'.format, st.sampled_from(['distance', 'rel_angle']), inner, inner)
    ),
    max_leaves=6,
)
ITEMS = st.builds(
    '({} {} {})'.format, EXPRESSIONS, st.sampled_from(['<', '>=', '=', '=>']), EXPRESSIONS
) | st.builds('(setProperty({}, {}))'.format, LEAVES, EXPRESSIONS)


@settings(max_examples=150, deadline=None)
@given(st.lists(ITEMS, max_size=4))
def test_any_text_can_be_checked(items: list[str]) -> None:
    parsed = parse('(agent rover0)(object location1)(object ?o)' + ''.join(items))
    for diagnostic in (*check(parsed, WORLD), *check(parsed, None)):
        assert diagnostic.message
        assert diagnostic.line == 1
        assert 'nan' not in diagnostic.message
