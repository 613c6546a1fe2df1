"""Terms and literals, and how they are written."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from task_planner_node.language.reader import ListNode, Node


@dataclass(frozen=True, slots=True)
class Dotted:
    """A ground list that does not end in nil: ``(a b . c)``.

    There is at least one item, and the tail is a symbol or a number: chain() makes lists of this form.
    """

    items: tuple[Any, ...]
    tail: str | int | float


# mypy has no recursive alias for tuples of itself in the versions supported: Any is a ground term.
Ground = str | int | float | tuple[Any, ...] | Dotted


@dataclass(frozen=True, slots=True)
class Variable:
    """A name that begins with a question mark.

    Readers give every anonymous variable (``?_``, ``?_name``) a name of its own, ``?_#1`` and so on.
    """

    name: str

    @property
    def anonymous(self) -> bool:
        """Whether nothing else may refer to it."""
        return self.name.startswith('?_') and '#' in self.name


@dataclass(frozen=True, slots=True)
class Pattern:
    """A list with variables or applications in it; ``tail`` stands behind a dot, as in ``(?first . ?others)``.

    The tail is None (nil), a variable, an application, or a symbol or number, as in ``(?x . last)``.
    """

    items: tuple[Term, ...]
    tail: Variable | Application | str | int | float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Application:
    """A function applied to arguments: ``(call + ?x 1)``, or a part of what is in an ``eval``.

    ``function`` is the name in lower case; language/functions.py has all of them and evaluates.  Arguments are
    terms: their values are passed, a Pattern's as the list it builds.  As a term an application stands
    for its value and needs all its variables bound; the heads of operators, methods and axioms have none.
    """

    function: str
    arguments: tuple[Term, ...]
    node: Node


Term = str | int | float | tuple[Any, ...] | Dotted | Variable | Pattern | Application


def chain(items: tuple[Any, ...], tail: Ground) -> Ground:
    """The ground list of ``items`` before ``tail``: a tuple when the tail is a list, else Dotted."""
    if isinstance(tail, tuple):
        return items + tail
    if not items:
        return tail
    if isinstance(tail, Dotted):
        return Dotted(items + tail.items, tail.tail)
    return Dotted(items, tail)


@dataclass(frozen=True, slots=True, eq=False)
class Atom:
    """A literal, a task or a head: a name and its arguments."""

    name: str
    args: tuple[Term, ...]
    node: ListNode


def show(term: object) -> str:
    """A term or a ground task as it is written in a mission."""
    if isinstance(term, str):
        return term
    if isinstance(term, Variable):
        return '?_' if term.anonymous else term.name
    if isinstance(term, Atom):
        return f'({" ".join([term.name, *(show(argument) for argument in term.args)])})'
    if isinstance(term, Application):
        words = ['call', term.function, *(show(argument) for argument in term.arguments)]
        return f'({" ".join(words)})'
    if isinstance(term, (Pattern, Dotted)):
        tail = f' . {show(term.tail)}' if term.tail is not None else ''
        return f'({" ".join(show(item) for item in term.items)}{tail})'
    if isinstance(term, tuple):
        return f'({" ".join(show(item) for item in term)})' if term else 'nil'
    return str(term)


def shorten(text: str, limit: int = 100) -> str:
    """At most ``limit`` characters of ``text``."""
    return text if len(text) <= limit else text[: limit - 4] + ' ...'
