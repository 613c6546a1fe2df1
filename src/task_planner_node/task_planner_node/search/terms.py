"""Compiled terms: variables and constants are slots of a frame, so that grounding is one look-up in C."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from operator import itemgetter
from typing import Any

from task_planner_node.errors import TermRefused
from task_planner_node.language.functions import compile_term
from task_planner_node.language.model import (
    Application,
    Dotted,
    Pattern,
    Term,
    Variable,
    chain,
    shorten,
)
from task_planner_node.language.source import Source

Frame = list[Any]
MAX_NESTING = 200


@dataclass(frozen=True, slots=True)
class ListPattern:
    """A list with variables or computed parts in it; ``tail`` stands behind the dot."""

    items: tuple[Compiled, ...]
    tail: Compiled | None


@dataclass(frozen=True, slots=True, eq=False)
class Computed:
    """The value of a function; ``slots`` are those that it reads."""

    value: Callable[[Frame], Any]
    slots: frozenset[int]


Compiled = int | ListPattern | Computed


class Slots:
    """The variables and constants of one definition, each with its place in the frame."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.template: Frame = []
        self._variables: dict[str, int] = {}
        self._constants: dict[tuple[type, Any], int] = {}

    def constant(self, value: object) -> int:
        """The slot that always holds ``value``."""
        key = (type(value), value)
        if key not in self._constants:
            self._constants[key] = len(self.template)
            self.template.append(value)
        return self._constants[key]

    def variable(self, name: str) -> int:
        """The slot of a variable, None in the frame until it is bound."""
        if name not in self._variables:
            self._variables[name] = len(self.template)
            self.template.append(None)
        return self._variables[name]

    def local(self, name: str) -> int | None:
        """Begin a scope in which ``name`` is another variable; what it was before is for end_local()."""
        before = self._variables.pop(name, None)
        self.variable(name)
        return before

    def end_local(self, name: str, before: int | None) -> None:
        """End the scope that local() began."""
        del self._variables[name]
        if before is not None:
            self._variables[name] = before

    def constants(self) -> frozenset[int]:
        """The slots that are never unbound."""
        return frozenset(self._constants.values())

    def reader(self, name: str) -> Callable[[Frame], Any]:
        """How to read a variable's value."""
        return itemgetter(self.variable(name))

    def compile(self, term: Term) -> Compiled:
        """The slot of a variable or a constant, a list pattern of such, or a computed value."""
        if isinstance(term, Variable):
            return self.variable(term.name)
        if isinstance(term, Pattern):
            tail = None if term.tail is None else self.compile(term.tail)
            return ListPattern(tuple(self.compile(item) for item in term.items), tail)
        if isinstance(term, Application):
            read: set[int] = set()

            def variable(name: str) -> Callable[[Frame], Any]:
                read.add(self.variable(name))
                return self.reader(name)

            value = compile_term(term, variable, self.source)
            return Computed(value, frozenset(read))
        return self.constant(term)


def slots_of(term: Compiled) -> set[int]:
    """All slots in a compiled term."""
    if isinstance(term, int):
        return {term}
    if isinstance(term, Computed):
        return set(term.slots)
    slots = set().union(*(slots_of(item) for item in term.items))
    return slots | slots_of(term.tail) if term.tail is not None else slots


def match(term: Compiled, value: Any, frame: Frame, bound: list[int]) -> bool:
    """Match ``value``, binding unbound slots; each is noted in ``bound``, also when it fails."""
    if isinstance(term, int):
        current = frame[term]
        if current is None:
            frame[term] = value
            bound.append(term)
            return True
        return bool(current == value)
    if isinstance(term, Computed):
        return bool(term.value(frame) == value)
    count = len(term.items)
    if isinstance(value, tuple):
        parts: tuple[Any, ...] = value
        rest: Any = value[count:]
    elif isinstance(value, Dotted):
        parts = value.items
        rest = chain(parts[count:], value.tail)
    else:
        return False
    if len(parts) < count or (term.tail is None and rest != ()):
        return False
    for item, part in zip(term.items, parts, strict=False):
        if not match(item, part, frame, bound):
            return False
    return term.tail is None or match(term.tail, rest, frame, bound)


def build(term: Compiled, frame: Frame) -> Any:
    """The ground term; a list that nests deeper than MAX_NESTING raises TermRefused."""
    if isinstance(term, int):
        return frame[term]
    if isinstance(term, Computed):
        return term.value(frame)
    value = tuple([build(item, frame) for item in term.items])
    _refuse_deep(value)
    return value if term.tail is None else chain(value, build(term.tail, frame))


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
    """How to get a fresh tuple of ground ``terms`` from a frame: in C when all are slots."""
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
