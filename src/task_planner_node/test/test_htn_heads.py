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


def lists_of(items: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Patterns with a variable in them."""
    patterns = st.builds(
        lambda items, tail: Pattern(tuple(items), tail),
        st.lists(items, min_size=1, max_size=3),
        st.none() | variables | words,
    )
    return patterns.filter(lambda p: any(not isinstance(i, str | int | float) for i in p.items))


terms = variables | words | st.just(()) | lists_of(variables | words | lists_of(variables | words))
lists = st.lists(words, max_size=4).map(tuple)


@st.composite
def values(draw: st.DrawFn, term: Any) -> Any:
    """What nearly always has the shape of an argument."""
    if not isinstance(term, Pattern):
        return draw(words | lists if isinstance(term, Variable) else st.just(term) | words)
    items = tuple([draw(values(item)) for item in term.items])
    more = draw(st.sampled_from(['', '', '', 'less', 'more']))
    items = items[1:] if more == 'less' else (*items, 'x') if more == 'more' else items
    return Dotted(items, draw(words)) if items and draw(st.integers(0, 2)) == 0 else items


@st.composite
def heads_and_tasks(draw: st.DrawFn) -> list[tuple[Any, Any, bool]]:
    """Arguments of a head, each with a value and whether tasks have one there."""
    args = draw(st.lists(terms, max_size=3))
    return [(term, draw(values(term)), draw(st.integers(0, 4)) > 0) for term in args]


@given(heads_and_tasks())
@example([(Pattern((Variable('?a'),), None), ('x', 'y'), True)])
@example([(Pattern((Variable('?a'),), Variable('?b')), Dotted(('x',), 'y'), True)])
@example(
    [
        (Variable('?a'), ('y',), True),
        (Pattern((Variable('?b'),), Variable('?a')), ('x', 'y'), True),
    ]
)
def test_a_task_fits_a_head_where_all_arguments_match(drawn: list[tuple[Any, Any, bool]]) -> None:
    slots = Slots(Source('d.lisp', ''))
    args, given_values, known = zip(*drawn, strict=True) if drawn else ((), (), ())
    head = Head(Atom('do', args, NODE), slots, known)
    slots.constant('of the rest')
    frame: list[Any] | None = slots.template.copy()
    for term, value, is_known in zip(head.terms, given_values, known, strict=True):
        if is_known and frame is not None and not match(term, value, frame, []):
            frame = None
    bind = head.binder()
    bound = bind(('do', *given_values))
    tested = sorted(head.bound)
    if frame is None or bound is None:
        assert bound == frame
    else:
        assert [bound[slot] for slot in tested] == [frame[slot] for slot in tested]
    assert bind(('do', *given_values, 'x')) is None
