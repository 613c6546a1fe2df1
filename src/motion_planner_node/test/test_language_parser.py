"""Reading and writing: the paper's forms, the printer as the parser's inverse, and errors."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import (
    MAXIMUM_DEPTH,
    MAXIMUM_ITEMS,
    MAXIMUM_SIZE,
    Command,
    Condition,
    Constraint,
    Preconditions,
    Statement,
    parse,
    to_text,
)
from motion_planner_node.language.syntax import (
    Call,
    Constant,
    Label,
    Negation,
    Number,
    Operation,
    Property,
)

FIGURE_2 = """((agent ?r)(object ?o)
(setProperty(?r.x,?o.x))
(setProperty(?r.y,?o.y))
(setProperty(?r.heading,0)))"""

FIGURE_3 = """((agent ?r)(object ?o)
(distance(?r, ?o) >= 50)
(distance(?r, ?o) <= 100)
(rel_angle(?r,?o) = cos-and-sin(pi/2)))"""

NAMES = st.from_regex(r'[a-z_][a-z0-9_]{0,5}(-[a-z][a-z0-9]{0,3})?', fullmatch=True).filter(
    lambda name: name != 'pi'
)
FIELDS = st.from_regex(r'[a-z][a-z0-9_]{0,5}', fullmatch=True)
LABELS = NAMES | NAMES.map('?{}'.format)
LEAVES = (
    st.floats(min_value=0.0, allow_infinity=False, allow_nan=False).map(Number)
    | st.just(Constant('pi'))
    | st.builds(Property, LABELS, FIELDS)
    | LABELS.map(Label)
)
EXPRESSIONS = st.recursive(
    LEAVES,
    lambda inner: (
        st.builds(Negation, inner)
        | st.builds(Operation, st.sampled_from('+-*/'), inner, inner)
        | st.builds(Call, NAMES, st.lists(inner, max_size=3).map(tuple))
    ),
    max_leaves=12,
)
CONSTRAINTS = st.builds(
    Constraint, EXPRESSIONS, st.sampled_from(('<', '<=', '>', '>=', '=', '!=')), EXPRESSIONS
)
ARGUMENTS = st.lists(EXPRESSIONS, max_size=3).map(tuple)
COMMANDS = st.builds(Command, st.sampled_from(('setProperty', 'setProprety')), ARGUMENTS)
CONDITIONS = st.builds(Condition, st.builds(Call, NAMES, ARGUMENTS))
PRECONDITIONS = st.builds(
    Preconditions,
    st.lists(st.builds(Statement, NAMES, LABELS), max_size=3).map(tuple),
    st.lists(CONSTRAINTS | COMMANDS | CONDITIONS, max_size=4).map(tuple),
)


def error_of(text: str) -> tuple[int, int, str]:
    with pytest.raises(MotionPlannerError) as caught:
        parse(text)
    (diagnostic,) = caught.value.diagnostics
    assert caught.value.code is diagnostic.code is Code.INVALID_PRECONDITIONS
    return diagnostic.line, diagnostic.column, diagnostic.message


@settings(max_examples=100, deadline=None)
@given(PRECONDITIONS)
def test_what_is_written_reads_back_as_the_same(preconditions: Preconditions) -> None:
    assert parse(to_text(preconditions)) == preconditions


@settings(max_examples=100, deadline=None)
@given(CONSTRAINTS)
def test_a_constraint_needs_no_parentheses(constraint: Constraint) -> None:
    assert parse(to_text(constraint)).items == (constraint,)


def test_figure_2_is_read_as_printed() -> None:
    preconditions = parse(FIGURE_2)
    assert preconditions.agents == ('?r',)
    assert preconditions.objects == ('?o',)
    assert preconditions.variables == {'?r', '?o'}
    assert preconditions.assigns
    assert preconditions.items[0] == Command(
        'setProperty', (Property('?r', 'x'), Property('?o', 'x'))
    )
    assert preconditions.items[2] == Command('setProperty', (Property('?r', 'heading'), Number(0)))


def test_figure_3_is_read_as_printed() -> None:
    preconditions = parse(FIGURE_3)
    assert not preconditions.assigns
    far, near, side = preconditions.constraints
    distance = Call('distance', (Label('?r'), Label('?o')))
    assert far == Constraint(distance, '>=', Number(50))
    assert near == Constraint(distance, '<=', Number(100))
    right_angle = Operation('/', Constant('pi'), Number(2))
    assert side == Constraint(
        Call('rel_angle', (Label('?r'), Label('?o'))),
        '=',
        Call('cos-and-sin', (right_angle,)),
    )
    assert (near.line, near.column) == (3, 2)


def test_the_form_of_table_1_without_inner_parentheses_is_the_same() -> None:
    table_1 = """((agent ?r)(object ?o) distance(?r, ?o) >= 50 distance(?r, ?o) <= 100
                 rel_angle(?r,?o) = cos-and-sin(pi/2))"""
    assert parse(table_1) == parse(FIGURE_3)
    assert parse(FIGURE_3[1:-1]) == parse(FIGURE_3)
    bare = '(agent ?r)(object ?o) setProperty(?r.x,?o.x) setProperty(?r.y,?o.y)'
    assert parse(bare + 'setProperty(?r.heading,0)') == parse(FIGURE_2)


@pytest.mark.parametrize(
    ('text', 'same'),
    [
        ('1 - 2 - 3 = 0', '(1 - 2) - 3 = 0'),
        ('1 + 2 * 3 = 0', '1 + (2 * 3) = 0'),
        ('-2 * 3 = 0', '(-2) * 3 = 0'),
        ('location1-5 = a.x-b.x', 'location1 - 5 = a.x - b.x'),
        ('8 / 2 / 2 = .5e1', '(8 / 2) / 2 = 5.'),
        ('( a.x = 1 ) ; a comment (', '(a.x=1)'),
        ('((1 + 2) * 3 = 4)', '(1 + 2) * 3 = 4'),
        ('distance (a, b) = 1', 'distance(a,b)=1'),
        ('()', ''),
    ],
)
def test_texts_that_mean_the_same(text: str, same: str) -> None:
    assert parse(text) == parse(same)


def test_a_hyphen_before_a_letter_belongs_to_the_name() -> None:
    (constraint,) = parse('f(base-camp) = pi').constraints
    assert isinstance(constraint, Constraint)
    assert constraint.left == Call('f', (Label('base-camp'),))


def test_the_misprint_of_the_paper_is_a_command() -> None:
    assert parse('(setProprety(?r.x,?o.x))').assigns


@pytest.mark.parametrize(
    ('text', 'line', 'column', 'words'),
    [
        ('((agent r)\n(distance(r,o) >= 50 (distance(r,o) <= 60))', 2, 1, 'not closed'),
        ('((agent r)(object o)', 1, 1, 'not closed'),
        ('(agent r))', 1, 10, 'closes nothing'),
        ('distance(r, o) 50', 1, 16, 'expected a comparator'),
        ('(distance(r, o) >= )', 1, 20, 'a number, a property or a function'),
        ('(distance(r o) >= 1)', 1, 13, "or ','"),
        ('a.x = 1\n  $', 2, 3, "unexpected '$'"),
        ('a.x = \x00', 1, 7, 'unexpected'),
        ('a.x = 1e999', 1, 7, 'too large'),
        ('a.x =', 1, 6, 'ends too early'),
        ('a.x', 1, 1, 'expected a comparator'),
        ('(' * 200, 1, MAXIMUM_DEPTH + 1, 'nested deeper'),
        ('-' * 200 + '1 = 1', 1, 1, 'levels'),
        ('1 = 1' + ' + 1' * 5000, 1, 1, 'levels'),
        ('1' + ' + 1' * 5000, 1, 1, 'levels'),
        ('a.x = 1\n' * (MAXIMUM_ITEMS + 1), MAXIMUM_ITEMS + 1, 1, 'more than'),
        (' ' * (MAXIMUM_SIZE + 1), 1, 1, 'longer than'),
        ('é' * (MAXIMUM_SIZE // 2 + 1), 1, 1, 'longer than'),
    ],
)
def test_an_error_says_where_and_what(text: str, line: int, column: int, words: str) -> None:
    at_line, at_column, message = error_of(text)
    assert (at_line, at_column) == (line, column)
    assert words in message


def test_an_error_speaks_no_grammar() -> None:
    for text in ('(a.x = 1', 'a.x = )', 'f(a', 'f(1 2) = 3', '1 = 2)', '(agent'):
        message = error_of(text)[2]
        assert not any(name in message for name in ('RPAR', 'LPAR', 'NAME', 'NUMBER', '$END'))


VOCABULARY = (
    '( ) agent r ?o .x , >= => 50 1e - * / pi distance( rel_angle cos-and-sin( setProperty( ;'
    ' ≥ $ \ud800 \x00'
)
FRAGMENTS = st.lists(st.sampled_from(VOCABULARY.split()) | st.sampled_from(' \n'), max_size=30).map(
    ''.join
)


@settings(max_examples=200, deadline=None)
@given(st.text(max_size=60) | FRAGMENTS)
def test_any_text_is_read_or_refused_with_a_place(text: str) -> None:
    try:
        parsed = parse(text)
    except MotionPlannerError as error:
        for diagnostic in error.diagnostics:
            assert diagnostic.line >= 1
            assert diagnostic.column >= 1
            assert diagnostic.message.isprintable()
            assert diagnostic.text.isprintable()
    else:
        assert parse(to_text(parsed)) == parsed
