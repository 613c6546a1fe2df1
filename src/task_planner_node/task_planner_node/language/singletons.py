"""Warnings about variables that occur only once in a definition: often misspelt."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.language.model import Atom, Domain, Operator
from task_planner_node.language.operators import geometric_fields, variables_in
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.walk import (
    tasks_of,
    variables_in_condition,
    variables_in_effects,
    variables_of,
)


def check_singletons(domain: Domain) -> Iterator[Diagnostic]:
    """One warning for each variable that a definition, or a branch of it, has once; ``?_`` variables may be."""
    if domain.typed:
        return
    source = domain.source
    for operator in domain.operators:
        yield from _once(source, operator.head, [_of_operator(operator)])
    for method in domain.methods:
        branches = []
        for branch in method.branches:
            names = list(variables_in_condition(branch.condition))
            names += [name for task in tasks_of(branch.tasks) for name in variables_of(task)]
            branches.append(names)
        yield from _once(source, method.head, branches)
    for axiom in domain.axioms:
        yield from _once(
            source, axiom.head, [list(variables_in_condition(b)) for b in axiom.bodies]
        )


def _of_operator(operator: Operator) -> list[str]:
    names = list(variables_in_condition(operator.condition))
    names += variables_in_effects((*operator.deletes, *operator.adds))
    names += variables_of(operator.cost)
    for field, _ in geometric_fields(operator):
        names += [name for name, _ in variables_in(field.text)]
    return names


def _once(source: Source, head: Atom, branches: Iterable[list[str]]) -> Iterator[Diagnostic]:
    in_head = Counter(variables_of(head))
    elsewhere: Counter[str] = Counter()
    once: dict[str, None] = {}
    for names in branches:
        elsewhere.update(names)
        counts = Counter(names)
        once.update((n, None) for n, count in counts.items() if count == 1 and n not in in_head)
    once.update((n, None) for n, count in in_head.items() if count + elsewhere[n] == 1)
    known = {name for name in (*in_head, *elsewhere) if name not in once}
    for name in once:
        if not name.startswith('?_'):
            start = _place(source, head, name)
            message = f'{name} occurs only once in {head.name}{did_you_mean(name, known)}'
            yield source.diagnostic(start, start + len(name), message, Severity.WARNING)


def _place(source: Source, head: Atom, name: str) -> int:
    word = re.compile(re.escape(name) + r'(?![^\s()"\';`,])', re.IGNORECASE)
    found = word.search(source.text, head.node.start)
    return found.start() if found else head.node.start
