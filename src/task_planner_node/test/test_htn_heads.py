"""Heads of definitions: arguments with lists in them are matched as the general matching says."""

from __future__ import annotations

from typing import Any

from hypothesis import example, given
from hypothesis import strategies as st

from task_planner_node.language.model import Atom, Dotted, Pattern, Variable
from task_planner_node.language.reader import ListNode
from task_planner_node.language.source import Source
from task_planner_node.search.heads import Head
from task_planner_node.search.terms import Slots, match

NODE = ListNode([], 0, 0)
variables = st.sampled_from([Variable('?a'), Variable('?b'), Variable('?c'), Variable('?d')])
words: st.SearchStrategy[Any] = st.sampled_from(['x', 'y', 1, 1.0])
patterns = st.builds(
    lambda items, tail: Pattern(tuple(items), tail),
    st.lists(variables | words, min_size=1, max_size=3),
    st.none() | variables,
).filter(lambda pattern: any(isinstance(item, Variable) for item in (*pattern.items, pattern.tail)))
arguments = st.lists(variables | words | patterns | st.just(()), max_size=3)
lists = st.lists(words, max_size=4).map(tuple)


@st.composite
def values(draw: st.DrawFn, term: Any) -> Any:
    """What nearly always has the shape of an argument."""
    if not isinstance(term, Pattern):
        return draw(words | lists if isinstance(term, Variable) else st.just(term) | words)
    count = len(term.items) + draw(st.sampled_from([-1, 0, 0, 0, 1]))
    items = tuple([draw(words) for _ in range(count)])
    return Dotted(items, draw(words)) if items and draw(st.integers(0, 3)) == 0 else items


@st.composite
def heads_and_tasks(draw: st.DrawFn) -> tuple[list[Any], list[Any]]:
    """Arguments of a head, and as many values."""
    terms = draw(arguments)
    return terms, [draw(values(term)) for term in terms]


@given(heads_and_tasks())
@example(([Pattern((Variable('?a'),), None)], [('x', 'y')]))
@example(([Pattern((Variable('?a'),), Variable('?b'))], [Dotted(('x',), 'y')]))
@example(([Variable('?a'), Pattern((Variable('?b'),), Variable('?a'))], [('y',), ('x', 'y')]))
def test_a_task_fits_a_head_where_all_arguments_match(drawn: tuple[list[Any], list[Any]]) -> None:
    args, given_values = drawn
    slots = Slots(Source('d.lisp', ''))
    head = Head(Atom('do', tuple(args), NODE), slots)
    task = ('do', *given_values)
    frame: list[Any] | None = slots.template.copy()
    for term, value in zip(head.terms, given_values, strict=True):
        if frame is not None and not match(term, value, frame, []):
            frame = None
    bind = head.binder()
    assert bind(task) == frame
    assert bind((*task, 'x')) is None
