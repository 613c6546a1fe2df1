"""Tasks with arguments that are not bound yet: place-holders, and giving them their values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from task_planner_node.language.model import Dotted, chain
from task_planner_node.search.network import (
    Immediate,
    Network,
    Parallel,
    Task,
    cell,
    constrained,
    parallel,
)


class Unbound:
    """An argument that some task or operator will bind."""

    __slots__ = ('name',)

    def __init__(self, name: str) -> None:
        self.name = name

    def __str__(self) -> str:
        return self.name


Values = dict[Unbound, Any]


def ground(term: Any) -> bool:
    """Whether there is no place-holder in a term or a task."""
    if isinstance(term, tuple):
        return all(ground(part) for part in term)
    if isinstance(term, Dotted):
        return all(ground(part) for part in term.items)
    return not isinstance(term, Unbound)


def known(task: Task) -> tuple[bool, ...]:
    """For each argument of a task whether it is bound."""
    return tuple([ground(argument) for argument in task[1:]])


def unify(one: Any, other: Any, values: Values) -> bool:
    """Make two terms equal by giving values to place-holders, which are added to ``values``."""
    one, other = resolved(one, values), resolved(other, values)
    if isinstance(one, Unbound):
        if one is not other:
            values[one] = other
        return True
    if isinstance(other, Unbound):
        values[other] = one
        return True
    if isinstance(one, tuple) and isinstance(other, tuple) and len(one) == len(other):
        return all(unify(a, b, values) for a, b in zip(one, other, strict=True))
    return bool(one == other)


def resolved(term: Any, values: Values) -> Any:
    """The term with the values of its place-holders."""
    if not values:
        return term
    while isinstance(term, Unbound) and term in values:
        term = values[term]
    if isinstance(term, tuple) and not ground(term):
        parts = [resolved(part, values) for part in term]
        return Immediate(parts) if isinstance(term, Immediate) else tuple(parts)
    if isinstance(term, Dotted) and not ground(term):
        return chain(tuple([resolved(part, values) for part in term.items]), term.tail)
    return term


def substitute(network: Network, values: Values) -> Network:
    """The network with the values of place-holders."""
    cells: list[Any] = []
    while network is not None:
        cells.append(network)
        network = network[1]
    rest: Network = None
    for first, after, parent, place, key in reversed(cells):
        if not isinstance(first, Parallel):
            changed = resolved(first, values)
            kept = changed is first and rest is after
            rest = (
                (first, after, parent, place, key) if kept else cell(changed, rest, parent, place)
            )
            continue
        branches: Sequence[Network] = [substitute(branch, values) for branch in first.branches]
        if rest is after and all(a is b for a, b in zip(branches, first.branches, strict=True)):
            rest = (first, after, parent, place, key)
        elif first.before is None:
            rest = parallel(branches, rest)
        else:
            rest = constrained(branches, first.labels, first.before, rest)
    return rest
