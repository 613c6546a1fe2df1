"""Conditions as text, with the values of the variables that are bound."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from task_planner_node.language.model import (
    And,
    Application,
    Assign,
    AssignEach,
    Atom,
    Collect,
    Condition,
    Enforce,
    Exists,
    First,
    Forall,
    Holds,
    Imply,
    Not,
    Or,
    Pattern,
    SortBy,
    Stated,
    Term,
    Variable,
    show,
)
from task_planner_node.search.terms import Frame, Slots

Values = Callable[[str], Any]


def describer(condition: Condition, slots: Slots) -> Callable[[Frame], str]:
    """How to show ``condition`` with the values in a frame."""
    places: dict[str, int] = {}

    def note(name: str) -> None:
        places[name] = slots.variable(name)

    _show(condition, note)
    return lambda frame: _show(condition, lambda name: frame[places[name]])


def _show(condition: Condition, values: Values) -> str:
    if isinstance(condition, Atom):
        return show((condition.name, *(_valued(arg, values) for arg in condition.args)))
    if isinstance(condition, Not):
        return f'(not {_show(condition.condition, values)})'
    if isinstance(condition, (And, Or)):
        word = 'and' if isinstance(condition, And) else 'or'
        return f'({" ".join([word, *(_show(part, values) for part in condition.conditions)])})'
    if isinstance(condition, Imply):
        return f'(imply {_show(condition.premise, values)} {_show(condition.conclusion, values)})'
    if isinstance(condition, (Forall, Exists)):
        word = 'forall' if isinstance(condition, Forall) else 'exists'
        own = {variable.name for variable in condition.variables}

        def outer(name: str) -> Any:
            return None if name in own else values(name)

        parts = f'{_show(condition.domain, outer)} {_show(condition.condition, outer)}'
        return f'({word} ({" ".join(v.name for v in condition.variables)}) {parts})'
    if isinstance(condition, (First, Enforce)):
        return _show(condition.condition, values)
    if isinstance(condition, SortBy):
        return f'(:sort-by {show(condition.key)} {_show(condition.condition, values)})'
    if isinstance(condition, (Assign, AssignEach)):
        word = 'assign' if isinstance(condition, Assign) else 'assign*'
        expression = show(_valued(condition.expression, values))
        return f'({word} {show(_valued(condition.variable, values))} {expression})'
    if isinstance(condition, Collect):
        inner = _show(condition.condition, values)
        word = 'setof' if condition.distinct else 'bagof'
        return f'({word} {show(condition.term)} {inner} {show(condition.variable)})'
    if isinstance(condition, Stated):
        return show(_valued(condition.variable, values))
    if isinstance(condition, Holds):
        return f'(eval {show(_valued(condition.expression, values))})'
    raise TypeError(f'not a condition: {condition!r}')


def _valued(term: Term, values: Values) -> Any:
    if isinstance(term, Variable):
        value = values(term.name)
        return term if value is None else value
    if isinstance(term, Pattern):
        tail = term.tail if term.tail is None else _valued(term.tail, values)
        items = tuple(_valued(item, values) for item in term.items)
        if isinstance(tail, tuple):
            return Pattern(items + tail)
        return Pattern(items, tail)
    if isinstance(term, Application):
        arguments = tuple(_valued(argument, values) for argument in term.arguments)
        return Application(term.function, arguments, term.node)
    return term
