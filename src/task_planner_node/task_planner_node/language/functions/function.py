"""What a function of the planning language is, and the ground terms that it takes and gives."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from task_planner_node.language.model import Dotted, Ground

TRUE = 't'
FALSE: Ground = ()
#: Beyond these a value is refused: nothing in a domain should grow without end, and every integer be a float as well.
MAX_BITS = 1000
MAX_ITEMS = 1_000_000
MAX_NESTING = 200


class FunctionFailed(Exception):
    """A function that has no value for its arguments; the message is a half-sentence about them."""


@dataclass(frozen=True, slots=True)
class Function:
    """A function by the name that domains call it by, in lower case.

    ``value`` gets ground terms (see language/model.py) and returns one; True, False, None and lists are taken for
    t, nil, nil and tuples.  It must depend on its arguments only, and raises FunctionFailed where it has no value.
    """

    name: str
    value: Callable[..., Any]
    least: int
    most: int | None
    description: str = ''

    def takes(self, count: int) -> bool:
        """Whether it can be called with ``count`` arguments."""
        return count >= self.least and (self.most is None or count <= self.most)

    @property
    def arity(self) -> str:
        """How many arguments it takes, in words."""
        if self.most is None:
            return f'at least {self.least} argument{"" if self.least == 1 else "s"}'
        if self.least == self.most:
            return f'{self.least} argument{"" if self.least == 1 else "s"}'
        return f'{self.least} to {self.most} arguments'


def truth(value: object) -> Ground:
    """T or nil."""
    return TRUE if value else FALSE


def number(value: object) -> int | float:
    """The number itself, or FunctionFailed."""
    if isinstance(value, (int, float)):
        return value
    raise FunctionFailed('expects numbers')


def integer(value: object) -> int:
    """The integer itself, or FunctionFailed."""
    if isinstance(value, int):
        return value
    raise FunctionFailed('expects integers')


def sequence(value: object) -> tuple[Any, ...]:
    """The proper list itself, or FunctionFailed."""
    if isinstance(value, tuple):
        return value
    raise FunctionFailed('expects a list')


def bounded(value: int | float) -> int | float:
    """The number itself if it is finite and not too large, or FunctionFailed."""
    if isinstance(value, int):
        if value.bit_length() > MAX_BITS:
            raise FunctionFailed(f'has a value of more than {MAX_BITS} bits')
        return value
    if math.isfinite(value):
        return value
    raise FunctionFailed('has no finite value')


def ground(value: object, depth: int = 0) -> Ground:
    """The ground term for what a function of another package returned, or FunctionFailed."""
    if isinstance(value, bool) or value is None:
        return truth(value)
    if isinstance(value, (int, float)):
        return bounded(value)
    if isinstance(value, (str, Dotted)):
        return value
    if isinstance(value, (tuple, list)) and depth < MAX_NESTING and len(value) <= MAX_ITEMS:
        return tuple(ground(part, depth + 1) for part in value)
    raise FunctionFailed(f'gives no term but a value of the type {type(value).__name__}')
