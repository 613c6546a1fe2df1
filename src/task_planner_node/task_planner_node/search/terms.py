"""Compiled terms: variables and constants are slots of a frame, so that grounding is one look-up in C."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from task_planner_node.errors import TermRefused
from task_planner_node.language.model import Pattern, Term, Variable, shorten, show

Frame = list[Any]
MAX_NESTING = 200


@dataclass(frozen=True, slots=True)
class ListPattern:
    """A list with variables in it; ``tail`` is the slot behind the dot."""

    items: tuple[Compiled, ...]
    tail: int | None


Compiled = int | ListPattern


class Slots:
    """The variables and constants of one definition, each with its place in the frame."""

    def __init__(self) -> None:
        self.template: Frame = []
        self._variables: dict[str, int] = {}
        self._constants: dict[Any, int] = {}

    def constant(self, value: object) -> int:
        """The slot that always holds ``value``."""
        if value not in self._constants:
            self._constants[value] = len(self.template)
            self.template.append(value)
        return self._constants[value]

    def variable(self, name: str) -> int:
        """The slot of a variable, None in the frame until it is bound."""
        if name not in self._variables:
            self._variables[name] = len(self.template)
            self.template.append(None)
        return self._variables[name]

    def constants(self) -> frozenset[int]:
        """The slots that are never unbound."""
        return frozenset(self._constants.values())

    def compile(self, term: Term) -> Compiled:
        """The slot of a variable or a constant, or a list pattern of such."""
        if isinstance(term, Variable):
            return self.variable(term.name)
        if isinstance(term, Pattern):
            tail = self.variable(term.tail.name) if term.tail else None
            return ListPattern(tuple(self.compile(item) for item in term.items), tail)
        return self.constant(term)


def slots_of(term: Compiled) -> set[int]:
    """All slots in a compiled term."""
    if isinstance(term, int):
        return {term}
    slots = set().union(*(slots_of(item) for item in term.items))
    return slots | {term.tail} if term.tail is not None else slots


def match(term: Compiled, value: object, frame: Frame, bound: list[int]) -> bool:
    """Match ``value``, binding unbound slots; each is noted in ``bound``, also when it fails."""
    if isinstance(term, int):
        current = frame[term]
        if current is None:
            frame[term] = value
            bound.append(term)
            return True
        return bool(current == value)
    count = len(term.items)
    if not isinstance(value, tuple) or len(value) < count:
        return False
    if term.tail is None and len(value) != count:
        return False
    for item, part in zip(term.items, value, strict=False):
        if not match(item, part, frame, bound):
            return False
    return term.tail is None or match(term.tail, value[count:], frame, bound)


def build(term: Compiled, frame: Frame) -> Any:
    """The ground term; a list that nests deeper than MAX_NESTING raises TermRefused."""
    if isinstance(term, int):
        return frame[term]
    value = tuple(build(item, frame) for item in term.items)
    if term.tail is not None:
        tail = frame[term.tail]
        if not isinstance(tail, tuple):
            raise TermRefused(f'{show(tail)} stands behind a dot but is no list')
        value += tail
    _refuse_deep(value)
    return value


def _refuse_deep(value: tuple[Any, ...]) -> None:
    layer: list[tuple[Any, ...]] = [value]
    for _ in range(MAX_NESTING):
        layer = [part for whole in layer for part in whole if isinstance(part, tuple)]
        if not layer:
            return
    raise TermRefused(f'a list nests deeper than {MAX_NESTING}: {shorten(_outline(value))}')


def _outline(value: object) -> str:
    text = ''
    while isinstance(value, tuple) and value and len(text) < 100:
        text += '(' + (f'{value[0]} ' if isinstance(value[0], str) else '')
        value = next((part for part in value if isinstance(part, tuple)), None)
    return text + ' ...'


def builder(terms: Sequence[Compiled]) -> Callable[[Frame], tuple[Any, ...]]:
    """How to get the tuple of ground ``terms`` from a frame: in C when all are slots."""
    parts = tuple(terms)
    slots = [part for part in parts if isinstance(part, int)]
    if len(slots) == len(parts) and len(slots) >= 2:
        return itemgetter(*slots)
    return lambda frame: tuple([build(part, frame) for part in parts])


def key_builder(terms: Sequence[Compiled]) -> Callable[[Frame], Any]:
    """Like builder, but a single term is not wrapped: the keys of IndexPlan."""
    if len(terms) != 1:
        return builder(terms)
    only = terms[0]
    if isinstance(only, int):
        return itemgetter(only)
    return lambda frame: build(only, frame)


def matcher(terms: Iterable[Compiled], slots: Slots) -> Callable[[Frame, tuple[Any, ...]], bool]:
    """How to match the arguments of a head (from position 1) to a ground task, in a fresh frame."""
    assigned: set[int] = set(slots.constants())
    assigns: list[tuple[int, int]] = []
    tests: list[tuple[int, int]] = []
    patterns: list[tuple[int, ListPattern]] = []
    for position, term in enumerate(terms, start=1):
        if isinstance(term, ListPattern):
            patterns.append((position, term))
        elif term in assigned:
            tests.append((position, term))
        else:
            assigned.add(term)
            assigns.append((position, term))
    length = len(assigns) + len(tests) + len(patterns) + 1

    def match_head(frame: Frame, task: tuple[Any, ...]) -> bool:
        if len(task) != length:
            return False
        for position, slot in assigns:
            frame[slot] = task[position]
        for position, slot in tests:
            if frame[slot] != task[position]:
                return False
        return all(match(pattern, task[position], frame, []) for position, pattern in patterns)

    return match_head
