"""A text is checked as a whole: an error in one element does not hide those in others."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language import Preconditions, parse, read
from motion_planner_node.language.parts import elements, in_place
from motion_planner_node.planning.check import check_text

STATED = '(agent ?r)(object ?o)(region ?z)'
GOOD = (
    '(distance(?r, ?o) >= 5)',
    'inside(?r, ?z)',
    '(?r.x * (?o.x + 1) = (2 - 1) * 3)',
    '(setProperty(?r.x, 5)) ; not (',
    'not (visible(?r, ?o))',
)
#: Broken elements, with the column of what is wrong.
BROKEN = (
    ('(distance(?r, ?o) >= )', 22),
    ('(distance(?r ?o) = 5)', 14),
    ('(?r.x = $)', 9),
    ('(?r.x = 1 2)', 11),
    ('(object)', 2),
    ('(inside(?r, ?z) inside)', 17),
    ('(distanc(?r, ?o) = 5)', 2),
    ('(rel_angle(?r, ?o) = 1)', 22),
    ('(visible(?r, ?o) = 1)', 2),
    ('(setProperty(?o.x, 5))', 14),
)


def places(text: str) -> list[tuple[int, int]]:
    return [(remark.line, remark.column) for remark in check_text(text, None).diagnostics]


@settings(max_examples=100, deadline=None)
@given(st.lists(st.sampled_from(GOOD) | st.sampled_from(BROKEN), max_size=8), st.booleans())
def test_each_broken_element_is_told_in_its_place(
    chosen: list[str | tuple[str, int]], outer: bool
) -> None:
    lines = [item if isinstance(item, str) else item[0] for item in chosen]
    text = '\n'.join([f'({STATED}' if outer else STATED, *lines, ')' if outer else ''])
    wanted = [(line, item[1]) for line, item in enumerate(chosen, 2) if not isinstance(item, str)]
    assert places(text) == wanted


def test_what_can_be_read_is_read() -> None:
    preconditions, errors = read(f'({STATED}(?r.x = )(?r.y = 1)(visible(?r ?o))(inside(?r, ?z)))')
    assert len(errors) == 2
    assert preconditions == parse(f'{STATED}(?r.y = 1) inside(?r, ?z)')
    with pytest.raises(MotionPlannerError) as caught:
        parse('(1 = )(2 = )')
    assert len(caught.value.diagnostics) == 2


@pytest.mark.parametrize(
    'text',
    ['((agent ?r)(?r.x = )(?r.y = )', '(?r.x = )(?r.y = ))', '(1 = )' * 300, '(' * 200, '1 ='],
)
def test_where_elements_are_in_doubt_the_first_error_is_told_alone(text: str) -> None:
    preconditions, errors = read(text)
    assert len(errors) == 1
    assert preconditions == Preconditions()


@settings(max_examples=200, deadline=None)
@given(st.text(alphabet='(); \na?.=1+,f', max_size=40))
def test_elements_are_parts_of_the_text_in_order(text: str) -> None:
    end_before = 0
    for start, end in elements(text):
        assert end_before <= start < end <= len(text)
        end_before = end
        placed = in_place(text, start, end)
        assert placed.endswith(text[start:end])
        assert placed.count('\n') == text.count('\n', 0, end)
    _, errors = read(text)
    assert all(error.line >= 1 and error.column >= 1 for error in errors)
