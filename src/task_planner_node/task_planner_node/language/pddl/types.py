"""HDDL's types: a hierarchy, and lists of names or variables with their types."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from task_planner_node.language.model import Atom, Condition, Or, Variable
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_name

OBJECT = 'object'
Type = tuple[str, ...]
#: For each task, named as in the model, and each position: the types of all that is passed there.
Passed = dict[str, list[set[Type]]]


@dataclass(frozen=True, slots=True)
class Typed:
    """A name or a variable and its type: the names of which it has at least one (``either``)."""

    name: str
    type: Type
    node: Node

    @property
    def variable(self) -> Variable:
        """The variable of that name."""
        return Variable(self.name)


class Types:
    """A hierarchy of types below ``object``, each of which becomes a predicate of the same name.

    A predicate that has the name of a type already gives the type's predicate another name.
    """

    def __init__(self) -> None:
        self._parents: dict[str, set[str]] = {OBJECT: set()}
        self._above: dict[str, frozenset[str]] = {}
        self.taken: set[str] = set()

    def add(self, typed: Iterable[Typed]) -> None:
        """Add types with their supertypes, which need not be known before."""
        for each in typed:
            for parent in each.type:
                self._parents.setdefault(parent, set())
            above = set(each.type) - {each.name}
            self._parents.setdefault(each.name, set()).update(above)
        self._above.clear()

    def check(self, reading: Reading, typed: Iterable[Typed]) -> None:
        """Raise Refused for a type that is not declared."""
        for each in typed:
            for name in each.type:
                if name not in self._parents:
                    hint = did_you_mean(name, self._parents)
                    raise reading.refuse(
                        each.node, f'{each.name} has the unknown type {name}{hint}'
                    )

    def above(self, name: str) -> frozenset[str]:
        """The type and all its supertypes."""
        if name not in self._above:
            found = {name, OBJECT}
            agenda = [name]
            while agenda:
                new = self._parents.get(agenda.pop(), set()) - found
                found |= new
                agenda.extend(new)
            self._above[name] = frozenset(found)
        return self._above[name]

    def covers(self, wide: Type, narrow: Type) -> bool:
        """Whether all that is of the type ``narrow`` is of the type ``wide``."""
        return all(not self.above(name).isdisjoint(wide) for name in narrow)

    def follows(self, typed: Typed, passed: Sequence[set[Type]]) -> bool:
        """Whether a parameter has its type anyway, given the types of all that callers pass there."""
        if typed.type == (OBJECT,):
            return True
        return bool(passed) and all(self.covers(typed.type, kind) for kind in passed[0])

    def predicate(self, name: str) -> str:
        """The predicate that says of an object that it has the type."""
        return f'type-{name}' if name in self.taken else name

    def condition(self, typed: Typed) -> Condition:
        """That a variable has its type."""
        node = ListNode([], typed.node.start, typed.node.end)
        atoms = [Atom(self.predicate(name), (typed.variable,), node) for name in typed.type]
        return atoms[0] if len(atoms) == 1 else Or(tuple(atoms))

    def facts(self, typed: Typed) -> list[Atom]:
        """That an object has its type and all supertypes."""
        node = ListNode([], typed.node.start, typed.node.end)
        names = sorted(set().union(*(self.above(name) for name in typed.type)))
        return [Atom(self.predicate(name), (typed.name,), node) for name in names]


def read_typed(reading: Reading, nodes: Sequence[Node], variables: bool) -> list[Typed]:
    """Read ``a b - type c - (either type type) d``; what has no type is an ``object``."""
    typed: list[Typed] = []
    group: list[Symbol] = []
    place = 0
    while place < len(nodes):
        node = nodes[place]
        if not isinstance(node, Symbol):
            raise reading.refuse(node, 'expected names, perhaps with "- type" behind them')
        if node.text == '-':
            if place + 1 == len(nodes) or not group:
                raise reading.refuse(node, "a '-' stands between names and their type")
            kind = _read_type(reading, nodes[place + 1])
            typed += [_typed(reading, each, kind, variables) for each in group]
            group = []
            place += 2
        else:
            group.append(node)
            place += 1
    return typed + [_typed(reading, each, (OBJECT,), variables) for each in group]


def _read_type(reading: Reading, node: Node) -> Type:
    if isinstance(node, Symbol):
        return (read_name(reading, node),)
    names = [child for child in node.children[1:] if isinstance(child, Symbol)]
    if first_word(node) != 'either' or not names or len(names) != len(node.children) - 1:
        raise reading.refuse(node, 'expected a type: a name or (either name ...)')
    return tuple(dict.fromkeys(read_name(reading, name) for name in names))


def _typed(reading: Reading, node: Symbol, kind: Type, variable: bool) -> Typed:
    if variable != node.text.startswith('?'):
        wanted = 'a variable' if variable else 'a name'
        raise reading.refuse(node, f'expected {wanted}, and not {node.text}')
    name = reading.variable(node.text).name if variable else read_name(reading, node)
    return Typed(name, kind, node)
