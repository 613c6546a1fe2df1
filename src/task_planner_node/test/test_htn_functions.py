"""The functions that domains may call: as in Lisp, checked against Python, and never out of bounds."""

from __future__ import annotations

import math
from fractions import Fraction
from functools import cmp_to_key
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.errors import MissionError
from task_planner_node.language.functions import (
    FUNCTIONS,
    Function,
    FunctionFailed,
    comparison_of,
    compile_term,
)
from task_planner_node.language.functions.evaluation import FORMS, HIGHER
from task_planner_node.language.functions.plugins import fault_of, guarded
from task_planner_node.language.model import Application, Dotted, Pattern, Term, Variable
from task_planner_node.language.reader import Symbol
from task_planner_node.language.source import Source

SOURCE = Source('d.lisp', 'one\n  two three')
NODE = Symbol('two', 6, 9)

INTEGERS = st.integers(-50, 50)
ATOMS = st.one_of(INTEGERS, st.sampled_from(['a', 'b', 't', '"text"']), st.floats(-9, 9))
TERMS = st.recursive(
    ATOMS,
    lambda inner: st.one_of(
        st.lists(inner, max_size=4).map(tuple),
        st.builds(Dotted, st.lists(inner, min_size=1, max_size=3).map(tuple), ATOMS),
    ),
    max_leaves=12,
)


def call(function: str, *arguments: Term) -> Application:
    return Application(function, arguments, NODE)


def value_of(term: Term, **values: object) -> Any:
    def read(name: str) -> Any:
        return lambda frame: frame.get(name[1:])

    return compile_term(term, read, SOURCE)(values)


@given(st.lists(INTEGERS, min_size=1, max_size=5), INTEGERS)
def test_numbers_are_exact(numbers: list[int], divisor: int) -> None:
    assert value_of(call('+', *numbers)) == sum(numbers)
    assert value_of(call('*', *numbers)) == math.prod(numbers)
    assert value_of(call('-', divisor, *numbers)) == divisor - sum(numbers)
    assert value_of(call('max', *numbers)) == max(numbers)
    assert value_of(call('min', *numbers)) == min(numbers)
    if divisor:
        exact = Fraction(numbers[0], divisor)
        assert value_of(call('/', numbers[0], divisor)) == pytest.approx(float(exact))
        assert isinstance(value_of(call('/', numbers[0], divisor)), int) == (exact.denominator == 1)
        for name, rounded in (('floor', math.floor), ('ceiling', math.ceil), ('round', round)):
            assert value_of(call(name, numbers[0], divisor)) == rounded(exact)
            assert value_of(call(name, numbers[0] / divisor)) == rounded(numbers[0] / divisor)
        assert value_of(call('truncate', numbers[0], divisor)) == math.trunc(exact)
        quotient, rest = (value_of(call(f, numbers[0], divisor)) for f in ('truncate', 'rem'))
        assert quotient * divisor + rest == numbers[0]
        assert value_of(call('mod', numbers[0], divisor)) == numbers[0] % divisor


@given(st.lists(INTEGERS, min_size=1, max_size=4))
def test_comparisons_hold_along_the_whole_chain(numbers: list[int]) -> None:
    rising = value_of(call('<', *numbers)) == 't'
    assert rising == (numbers == sorted(set(numbers)))
    assert (value_of(call('>=', *numbers)) == 't') == (numbers == sorted(numbers, reverse=True))
    assert (value_of(call('/=', *numbers)) == 't') == (len(set(numbers)) == len(numbers))
    assert (value_of(call('=', *numbers)) == 't') == (len(set(numbers)) == 1)


@given(st.lists(TERMS, max_size=5).map(tuple), TERMS)
def test_lists_come_apart_as_they_were_put_together(items: tuple[Any, ...], item: Any) -> None:
    whole = value_of(call('cons', item, items))
    assert value_of(call('car', whole)) == item
    assert value_of(call('cdr', whole)) == items
    assert value_of(call('length', whole)) == len(items) + 1
    assert value_of(call('member', item, whole)) == whole
    assert value_of(call('position', item, whole)) == 0
    assert value_of(call('append', items, whole)) == items + whole
    assert value_of(call('reverse', call('reverse', items))) == items
    assert value_of(call('nth', len(items), call('append', items, (item,)))) == item
    left = value_of(call('remove', item, whole))
    assert item not in left
    assert set(value_of(call('union', left, (item,)))) == set(whole)
    assert value_of(call('intersection', left, (item,))) == ()
    assert value_of(call('subsetp', left, whole)) == 't'
    pair = value_of(call('cons', item, 'tail'))
    assert pair == Dotted((item,), 'tail')
    assert value_of(call('cons', 'head', pair)) == Dotted(('head', item), 'tail')
    assert value_of(call('cdr', pair)) == 'tail'


def test_forms_compute_what_they_need_only() -> None:
    never = call('/', 1, 0)
    assert value_of(call('if', 't', 1, never)) == 1
    assert value_of(call('if', (), never)) == ()
    assert value_of(call('or', (), 2, never)) == 2
    assert value_of(call('and', 1, (), never)) == ()
    assert value_of(call('and', 1, 2)) == 2
    assert value_of(call('when', (), never)) == ()
    assert value_of(call('unless', (), 1, 2)) == 2
    assert value_of(call('progn', 1, 2)) == 2
    assert value_of(call('variablep', Variable('?x'))) == 't'
    assert value_of(call('variablep', Variable('?x')), x=1) == ()


def test_functions_of_functions() -> None:
    assert value_of(call('apply', '+', 1, (2, 3))) == 6
    assert value_of(call('mapcar', '1+', (1, 2))) == (2, 3)
    assert value_of(call('mapcar', '+', (1, 2), (10, 20, 30))) == (11, 22)
    assert value_of(call('reduce', 'max', (1, 3, 2))) == 3
    assert value_of(call('reduce', '+', ())) == 0
    assert value_of(call('sort', '>', (1, 3, 2, 3))) == (3, 3, 2, 1)
    with pytest.raises(MissionError, match='car with 2 arguments: it takes 1 argument'):
        value_of(call('apply', 'car', 1, (2,)))


def test_variables_and_patterns() -> None:
    pattern = Pattern((Variable('?x'), call('+', Variable('?x'), 1)), Variable('?rest'))
    assert value_of(pattern, x=1, rest=('a',)) == (1, 2, 'a')
    assert value_of(pattern, x=1, rest='end') == Dotted((1, 2), 'end')
    assert value_of(call('length', Pattern((Variable('?x'),))), x=()) == 1


@given(st.lists(TERMS, max_size=3))
def test_every_function_gives_a_term_or_says_why_not(arguments: list[Any]) -> None:
    for function in FUNCTIONS.values():
        if not function.takes(len(arguments)):
            continue
        try:
            value = function.value(*arguments)
        except FunctionFailed:
            continue
        assert not isinstance(value, (bool, list, complex))
        assert isinstance(value, (str, int, float, tuple, Dotted))
        assert not isinstance(value, float) or math.isfinite(value)
        assert function.value(*arguments) == value


@pytest.mark.parametrize(
    ('term', 'message'),
    [
        (call('+', 'a', 1), r'\(\+ a 1\) expects numbers'),
        (call('/', 1, 0), r'\(/ 1 0\) divides by 0'),
        (call('car', 'a'), r'\(car a\) expects a list'),
        (call('expt', 10, 10**9), 'more than 1000 bits'),
        (call('*', *[2**500] * 3), 'more than 1000 bits'),
        (call('*', 1e300, 1e300), 'no finite value'),
        (call('/', 1e300, 1e-300), 'no finite value'),
        (call('+', 2**999, 2**999, 2**999), 'more than 1000 bits'),
        (call('-', 1e308, -1e308), 'no finite value'),
        (call('expt', 10.0, 400), 'no finite value'),
        (call('sqrt', -1), 'no real value'),
        (call('error', '"no camera"', 'a'), r'is called with "no camera" a'),
        (call('length', Variable('?x')), r'\?x has no value here'),
    ],
)
def test_what_has_no_value_is_told_with_its_place(term: Term, message: str) -> None:
    with pytest.raises(MissionError, match=message) as caught:
        value_of(term)
    assert str(caught.value).startswith('d.lisp:2:3: ')


def test_lists_do_not_nest_without_end() -> None:
    value: Any = ()
    for _ in range(199):
        value = FUNCTIONS['list'].value(value)
    with pytest.raises(FunctionFailed, match='200 levels'):
        FUNCTIONS['list'].value(value, (value,))


@given(st.lists(INTEGERS))
def test_a_comparison_sorts(numbers: list[int]) -> None:
    assert sorted(numbers, key=cmp_to_key(comparison_of('>'))) == sorted(numbers, reverse=True)


def test_functions_of_packages_are_guarded() -> None:
    function = guarded(Function('f', lambda value: [value > 0, None, {value}][value], 1, 1))
    assert function.value(0) == ()
    assert function.value(1) == ()
    assert guarded(Function('f', lambda: [1, [True]], 0, 0)).value() == (1, ('t',))
    with pytest.raises(FunctionFailed, match='the type set'):
        function.value(2)
    with pytest.raises(FunctionFailed, match='IndexError'):
        function.value(3)
    with pytest.raises(FunctionFailed, match='no finite value'):
        guarded(Function('f', lambda: math.nan, 0, 0)).value()


@pytest.mark.parametrize('name', ['F', 'a b', '?x', '', 'if', 'sort', ':key'])
def test_names_that_cannot_be_used(name: str) -> None:
    assert fault_of(Function(name, lambda: 1, 0, 0))


def test_the_library_has_no_faults() -> None:
    assert not FUNCTIONS.keys() & (FORMS.keys() | HIGHER.keys())
    for name, function in FUNCTIONS.items():
        assert function.name == name
        assert not fault_of(function)
        assert function.description


def test_every_function_is_in_the_documents() -> None:
    text = (Path(__file__).parents[3] / 'docs' / 'htn.md').read_text()
    for name in (*FUNCTIONS, *FORMS):
        assert f'`{name}`' in text, name
    for name in HIGHER:
        assert f'`({name} ' in text, name
