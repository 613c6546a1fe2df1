"""A mission as it was written: operators, methods, axioms, facts and tasks, each with its place in the text.

Ground terms are plain Python: a symbol is a ``str``, a list is a ``tuple``, ``nil`` is ``()``.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from task_planner_node.language.reader import ListNode, Node
from task_planner_node.language.source import Source

# mypy has no recursive alias for tuples of itself in the versions supported: Any is a ground term.
Ground = str | tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class Variable:
    """A name that begins with a question mark."""

    name: str


@dataclass(frozen=True, slots=True)
class Pattern:
    """A list with variables in it; ``tail`` stands behind a dot, as in ``(?first . ?others)``."""

    items: tuple[Term, ...]
    tail: Variable | None = None


Term = str | tuple[Any, ...] | Variable | Pattern


@dataclass(frozen=True, slots=True, eq=False)
class Atom:
    """A literal, a task or a head: a name and its arguments."""

    name: str
    args: tuple[Term, ...]
    node: ListNode


@dataclass(frozen=True, slots=True, eq=False)
class Not:
    """Holds when ``condition`` cannot be satisfied (negation as failure)."""

    condition: Condition
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class And:
    """Holds when all conditions do, tested from left to right; trivially when there are none."""

    conditions: tuple[Condition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Or:
    """Holds when one of the conditions does; each that does is a choice."""

    conditions: tuple[Condition, ...]


Condition = Atom | Not | And | Or


@dataclass(frozen=True, slots=True, eq=False)
class Ordered:
    """Tasks that are done one after the other."""

    items: tuple[TaskNetwork, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Unordered:
    """Tasks that may be interleaved in any way."""

    items: tuple[TaskNetwork, ...]


TaskNetwork = Atom | Ordered | Unordered


@dataclass(frozen=True, slots=True, eq=False)
class GeometricText:
    """Geometric preconditions as raw text of the same length as in the source, comments blanked out."""

    text: str
    node: ListNode


@dataclass(frozen=True, slots=True, eq=False)
class Operator:
    """An augmented planning operator (Definition 1); without ``geometric`` it is SHOP2's."""

    head: Atom
    condition: Condition
    geometric: GeometricText | None
    deletes: tuple[Atom, ...]
    adds: tuple[Atom, ...]
    cost: float = 1.0

    @property
    def internal(self) -> bool:
        """Whether it changes the state without being an action of the plan (``!!``)."""
        return self.head.name.startswith('!!')


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """One way of a method; its name may be empty."""

    name: str
    condition: Condition
    tasks: TaskNetwork


@dataclass(frozen=True, slots=True, eq=False)
class Method:
    """How a task is decomposed: by the first branch whose condition can be satisfied."""

    head: Atom
    branches: tuple[Branch, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Axiom:
    """The head holds when a body does; the first body that can be satisfied counts."""

    head: Atom
    bodies: tuple[Condition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Domain:
    """All definitions of a domain in the order of the text; the name is empty for bare forms."""

    source: Source
    name: str = ''
    operators: tuple[Operator, ...] = ()
    methods: tuple[Method, ...] = ()
    axioms: tuple[Axiom, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """The initial state and the tasks; ``domain_node`` is where the domain is named, if it is."""

    source: Source
    name: str
    domain_name: str
    domain_node: Node | None
    facts: tuple[Atom, ...]
    tasks: TaskNetwork
    tasks_node: Node
    goals: tuple[Atom, ...] = field(default=())


def show(term: object) -> str:
    """A term or a ground task as it is written in a mission."""
    if isinstance(term, str):
        return term
    if isinstance(term, Variable):
        return term.name
    if isinstance(term, Pattern):
        tail = f' . {term.tail.name}' if term.tail else ''
        return f'({" ".join(show(item) for item in term.items)}{tail})'
    if isinstance(term, Atom):
        return f'({" ".join([term.name, *(show(argument) for argument in term.args)])})'
    if isinstance(term, tuple):
        return f'({" ".join(show(item) for item in term)})' if term else 'nil'
    return str(term)


def shorten(text: str, limit: int = 100) -> str:
    """At most ``limit`` characters of ``text``."""
    return text if len(text) <= limit else text[: limit - 4] + ' ...'
