"""Variables that nothing can have bound where they are needed."""

from __future__ import annotations

from collections.abc import Iterator

from task_planner_node.errors import Diagnostic
from task_planner_node.language.model import (
    And,
    Application,
    Assign,
    AssignEach,
    Atom,
    Collect,
    Condition,
    Domain,
    Effect,
    Enforce,
    Exists,
    First,
    Forall,
    ForEach,
    Holds,
    Imply,
    Not,
    Or,
    Pattern,
    Protection,
    SortBy,
    Spread,
    Variable,
)
from task_planner_node.language.operators import geometric_fields, variables_in
from task_planner_node.language.reader import Node
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.walk import (
    parts_of,
    tasks_of,
    variables_in_condition,
    variables_of,
)


def check_bindings(domain: Domain) -> Iterator[Diagnostic]:
    """Errors: computed heads, effects, costs and geometric fields with unbound variables, and what is computed from such."""
    source = domain.source
    for operator in domain.operators:
        head = set(variables_of(operator.head))
        yield from _computed(source, operator.head)
        yield from _unset(source, operator.condition, head)
        bound = head | bound_by(operator.condition)
        for effect in (*operator.deletes, *operator.adds):
            yield from _effect(source, effect, bound, operator.head.node)
        for application in _applications(operator.cost):
            yield from _missing(source, application, bound, 'the cost', application.node)
        if isinstance(operator.cost, Variable):
            yield from _missing(source, operator.cost, bound, 'the cost', operator.head.node)
        for field, what in geometric_fields(operator):
            for name, offset in variables_in(field.text):
                if name not in bound:
                    start = field.node.start + offset
                    message = (
                        f'{name} in {what} is bound by neither the head nor the '
                        f'symbolic preconditions{did_you_mean(name, bound)}'
                    )
                    yield source.diagnostic(start, start + len(name), message)
    for method in domain.methods:
        head = set(variables_of(method.head))
        yield from _computed(source, method.head)
        for branch in method.branches:
            yield from _unset(source, branch.condition, head)
            known = head | set(variables_in_condition(branch.condition))
            for task in tasks_of(branch.tasks):
                for argument in task.args:
                    for application in _applications(argument):
                        yield from _missing(source, application, known, 'a call', task.node)
    for axiom in domain.axioms:
        yield from _computed(source, axiom.head)
        for body in axiom.bodies:
            yield from _unset(source, body, set(variables_of(axiom.head)))


def bound_by(condition: Condition) -> set[str]:
    """The variables that every solution of ``condition`` binds."""
    if isinstance(condition, Atom):
        return set(variables_of(condition))
    if isinstance(condition, (Assign, AssignEach, Collect)):
        return {condition.variable.name}
    if isinstance(condition, (And, First, SortBy, Enforce)):
        return set().union(*(bound_by(part) for part in parts_of(condition)))
    if isinstance(condition, Or):
        bound = [bound_by(part) for part in condition.conditions]
        return set.intersection(*bound) if bound else set()
    return set()


def _missing(
    source: Source, term: object, bound: set[str], what: str, node: Node
) -> Iterator[Diagnostic]:
    for name in dict.fromkeys(variables_of(term)):
        if name not in bound:
            shown = '?_' if name.startswith('?_') else name
            message = f'{shown} in {what} is bound by neither the head nor the preconditions'
            text = message + did_you_mean(name, bound)
            yield source.diagnostic(node.start, node.end, text)


def _effect(source: Source, effect: Effect, bound: set[str], head: Node) -> Iterator[Diagnostic]:
    if isinstance(effect, ForEach):
        yield from _unset(source, effect.condition, bound)
        inner = bound | bound_by(effect.condition)
        for part in effect.effects:
            yield from _effect(source, part, inner, effect.node)
    elif isinstance(effect, Spread):
        yield from _missing(source, effect.variable, bound, 'an effect', effect.node)
    elif isinstance(effect, Protection):
        yield from _missing(source, effect.literal, bound, 'a protection', effect.node)
    else:
        node = effect.node if isinstance(effect, Atom) else head
        yield from _missing(source, effect, bound, 'an effect', node)


def _applications(term: object) -> Iterator[Application]:
    if isinstance(term, Application):
        yield term
    elif isinstance(term, Pattern):
        for item in (*term.items, term.tail):
            yield from _applications(item)
    elif isinstance(term, Atom):
        for argument in term.args:
            yield from _applications(argument)


def _computed(source: Source, head: Atom) -> Iterator[Diagnostic]:
    for application in _applications(head):
        node = application.node
        message = 'a head is matched, not computed: assign the value in the preconditions'
        yield source.diagnostic(node.start, node.end, message)


def _unset(source: Source, condition: Condition, known: set[str]) -> Iterator[Diagnostic]:
    """Applications with variables that nothing before them mentions, from left to right."""
    known = set(known)
    agenda = [condition]
    while agenda:
        part = agenda.pop()
        if isinstance(part, Atom):
            for application in _applications(part):
                yield from _missing(source, application, known, 'a call', application.node)
        elif isinstance(part, (Assign, AssignEach, Holds)) and not _about_unbound(part.expression):
            yield from _missing(source, part.expression, known, 'a call', part.node)
        if isinstance(part, (Or, Not, Imply, Forall, Exists, Collect, SortBy)):
            before = known
            for inner in parts_of(part):
                yield from _unset(source, inner, before)
                if isinstance(part, (Forall, Exists)):
                    before = before | set(variables_in_condition(inner))
            known |= set(variables_in_condition(part))
        elif not isinstance(part, (Assign, AssignEach, Holds)):
            agenda.extend(reversed(parts_of(part)))
        if isinstance(part, (Atom, Assign, AssignEach)):
            known |= set(variables_in_condition(part))


def _about_unbound(term: object) -> bool:
    """Whether a test for unbound variables is in an expression."""
    return any(
        application.function == 'variablep' or any(map(_about_unbound, application.arguments))
        for application in _applications(term)
    )
