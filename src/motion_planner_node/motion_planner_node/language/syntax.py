"""What a text of geometric preconditions says: Table 1 of the paper as immutable nodes.

Nodes know where they stand in the text (``line`` and ``column`` from 1, 0 for nowhere), but two
nodes that say the same are equal wherever they stand.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True, kw_only=True)
class Node:
    """Anything that has a place in the text."""

    line: int = field(default=0, compare=False, repr=False)
    column: int = field(default=0, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Number(Node):
    """A finite number that is not negative."""

    value: float


@dataclass(frozen=True, slots=True)
class Constant(Node):
    """A number that has a name: pi."""

    name: str


@dataclass(frozen=True, slots=True)
class Label(Node):
    """An agent, an object or a region, or a variable (``?o``) that stands for one."""

    name: str


@dataclass(frozen=True, slots=True)
class Property(Node):
    """A field of an object or a component of an agent's state vector: ``?o.x``."""

    owner: str
    name: str


@dataclass(frozen=True, slots=True)
class Call(Node):
    """A function of the library applied to arguments."""

    name: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Negation(Node):
    """The operand with the other sign."""

    operand: Expression


@dataclass(frozen=True, slots=True)
class Operation(Node):
    """Two operands joined by ``+``, ``-``, ``*`` or ``/``."""

    operator: str
    left: Expression
    right: Expression


#: Commands; the second is how the paper spells the first in its text.
COMMANDS = ('setProperty', 'setProprety')

Expression = Number | Constant | Label | Property | Call | Negation | Operation


@dataclass(frozen=True, slots=True)
class Statement(Node):
    """``(agent ?r)``, ``(object ?o)`` or ``(region ?z)``: what kind of thing a label is."""

    concept: str
    label: str


@dataclass(frozen=True, slots=True)
class Command(Node):
    """A direct assignment: ``setProperty(?r.x, ?o.x)``."""

    name: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Constraint(Node):
    """Two expressions and the comparator that has to hold between them."""

    left: Expression
    comparator: str
    right: Expression


@dataclass(frozen=True, slots=True)
class Condition(Node):
    """A call that stands alone and has to hold: ``visible(?r, ?o)``, ``not(inside(?r, ?z))``."""

    call: Call


Item = Command | Constraint | Condition


@dataclass(frozen=True, slots=True)
class Preconditions:
    """A whole text: its statements and its commands and constraints, each in their order."""

    statements: tuple[Statement, ...] = ()
    items: tuple[Item, ...] = ()

    @property
    def agents(self) -> tuple[str, ...]:
        """Labels that statements call agents, without repetition."""
        return self._labels('agent')

    @property
    def objects(self) -> tuple[str, ...]:
        """Labels that statements call objects, without repetition."""
        return self._labels('object')

    @property
    def regions(self) -> tuple[str, ...]:
        """Labels that statements call regions, without repetition."""
        return self._labels('region')

    @property
    def commands(self) -> tuple[Command, ...]:
        """The commands, in order."""
        return tuple(item for item in self.items if isinstance(item, Command))

    @property
    def constraints(self) -> tuple[Constraint | Condition, ...]:
        """The constraints, in order."""
        return tuple(item for item in self.items if not isinstance(item, Command))

    @property
    def assigns(self) -> bool:
        """Whether there are commands."""
        return any(isinstance(item, Command) for item in self.items)

    @property
    def variables(self) -> frozenset[str]:
        """Names that begin with ``?``: the text is ground when there are none."""
        named = {statement.label for statement in self.statements}
        for item in self.items:
            for node in descendants(item):
                if isinstance(node, Label):
                    named.add(node.name)
                elif isinstance(node, Property):
                    named.add(node.owner)
        return frozenset(name for name in named if name.startswith('?'))

    def _labels(self, concept: str) -> tuple[str, ...]:
        return tuple(dict.fromkeys(s.label for s in self.statements if s.concept == concept))


def children(node: Expression | Item) -> tuple[Expression, ...]:
    """The expressions directly below ``node``, from left to right."""
    if isinstance(node, (Call, Command)):
        return node.arguments
    if isinstance(node, (Operation, Constraint)):
        return node.left, node.right
    if isinstance(node, Negation):
        return (node.operand,)
    if isinstance(node, Condition):
        return (node.call,)
    return ()


def descendants(node: Expression | Item) -> Iterator[Expression]:
    """All expressions below ``node``, without recursion."""
    waiting = list(children(node))
    while waiting:
        expression = waiting.pop()
        yield expression
        waiting.extend(children(expression))


def depth(node: Expression | Item) -> int:
    """How many levels of expressions there are below ``node``, without recursion."""
    levels = 0
    level = list(children(node))
    while level:
        levels += 1
        level = [child for parent in level for child in children(parent)]
    return levels
