"""Texts that are filled into a form that is known say what the grammar itself reads in them."""

from __future__ import annotations

import re
from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.language import Preconditions, forms, to_text
from motion_planner_node.language.forms import parsed_by_form
from motion_planner_node.language.grammar import parsed
from motion_planner_node.language.syntax import Node, descendants

VOCABULARY = (
    '( ) agent object ?r r.x pi pi2 setProperty distance( , 1.5 < <= = - + * . a-b a-1 1e999 é # ;'
)
FRAGMENTS = st.lists(
    st.sampled_from(VOCABULARY.split()) | st.sampled_from([' ', '\n', '; no\n']), max_size=24
).map(''.join)


def said(read: Callable[[str], Preconditions], text: str) -> object:
    """What is read with the place of each node, or what is complained of."""
    try:
        found = read(text)
    except MotionPlannerError as error:
        return error.diagnostics
    below = [node for item in found.items for node in descendants(item)]
    nodes: list[Node] = [*found.statements, *found.items, *below]
    return found, [(node, node.line, node.column) for node in nodes]


@settings(max_examples=400, deadline=None)
@given(FRAGMENTS)
def test_any_text_is_read_as_by_the_grammar(text: str) -> None:
    assert said(parsed_by_form, text) == said(parsed, text)


@settings(max_examples=200, deadline=None)
@given(st.data())
def test_labels_numbers_and_white_space_may_differ(data: st.DataObject) -> None:
    text = data.draw(
        st.sampled_from(
            [
                '((agent ?r)(object ?o)(distance(?r, ?o) <= 5)(rel_angle(?r, ?o) = cos-and-sin(pi/2)))',
                '(agent a)(region z)(not(inside(a, z)))(a.x * (2 + a.y) > -3)',
                '(agent a)(setProperty(a.x, 2.5))(visible(a, a))(abs(min(1, a.x)) != -(1 - a.heading) / 7)',
            ]
        )
    )
    names = st.sampled_from(['b', 'long-name', 'x1', '_'])
    new = {
        r'\?[a-z]\b': names.map('?{}'.format),
        r'\b[a-z]\b(?=[.,) ])': names,
        r'\b\d+(?:\.\d+)?': st.floats(0.0, 1e6).map(repr)
        | st.sampled_from(['3', '.5', '4.', '1e999']),
        ' ': st.sampled_from([' ', '\n', ' ; (why) 1\n\t', '  ']),
    }
    for pattern, others in new.items():
        first, *rest = re.split(pattern, text)
        text = first + ''.join(data.draw(others) + part for part in rest)
    assert said(parsed_by_form, text) == said(parsed, text)


def test_each_form_is_parsed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []

    def counted(text: str) -> Preconditions:
        read.append(text)
        return parsed(text)

    monkeypatch.setattr(forms, 'parsed', counted)
    for number in range(20):
        text = f'(agent once{number})(near-to-once(once{number}, o{number}) <= {number}.5)'
        (constraint,) = parsed_by_form(text).constraints
        assert to_text(constraint) == f'near-to-once(once{number}, o{number}) <= {number}.5'
    assert len(read) == 1


def test_a_number_that_is_too_large_is_found_in_a_known_form() -> None:
    parsed_by_form('(agent r)(r.x > 1)')
    with pytest.raises(MotionPlannerError) as caught:
        parsed_by_form('(agent r)\n(r.x > 1e400)')
    (diagnostic,) = caught.value.diagnostics
    assert isinstance(diagnostic, Diagnostic)
    assert (diagnostic.line, diagnostic.column, diagnostic.text) == (2, 8, '1e400')
