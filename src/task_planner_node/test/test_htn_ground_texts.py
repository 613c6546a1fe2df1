"""Geometric texts: the text of the operator with values in the place of its variables."""

from __future__ import annotations

from typing import Any

from hypothesis import example, given
from hypothesis import strategies as st

from task_planner_node.language.model import GeometricText, show
from task_planner_node.language.operators import VARIABLE
from task_planner_node.language.reader import ListNode
from task_planner_node.language.source import Source
from task_planner_node.search.operators import ground_text
from task_planner_node.search.terms import Slots

pieces = st.sampled_from(
    ['((agent', ' >= 50%', '%s', '%%', '%(a)s', '  ', '\n', '?a', '?b', '?c-d', '))']
)
words = st.sampled_from(['rover0', '%s', '50%', 1, 2.5, ('a', 'b'), ()])


@given(st.lists(pieces), st.tuples(words, words, words))
@example(['?a', ' >= 50%', '?b'], ('%s', 1, ()))
def test_a_ground_text_has_values_for_its_variables(
    parts: list[str], found: tuple[Any, ...]
) -> None:
    text = ' '.join(parts)
    values = dict(zip(('?a', '?b', '?c-d'), found, strict=True))
    slots = Slots(Source('d.lisp', ''))
    ground = ground_text(GeometricText(text, ListNode([], 0, 0)), slots)
    frame = slots.template.copy()
    for name, value in values.items():
        slot = slots.variable(name)
        frame += [None] * (slot + 1 - len(frame))
        frame[slot] = value
    assert ground is not None
    expected = VARIABLE.sub(lambda name: show(values[name.group()]), ' '.join(text.split()))
    assert ground(frame) == expected
