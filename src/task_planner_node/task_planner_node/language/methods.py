"""Methods and axioms: from nodes to the model."""

from __future__ import annotations

from task_planner_node.language.conditions import read_condition
from task_planner_node.language.model import Axiom, Branch, Condition, Method
from task_planner_node.language.operators import read_head
from task_planner_node.language.reader import ListNode, Node, Symbol
from task_planner_node.language.reading import Reading, is_nil, is_variable
from task_planner_node.language.tasks import read_tasks
from task_planner_node.language.terms import read_name


def read_method(reading: Reading, node: ListNode) -> Method:
    """Read ``(:method [name] head ([name] condition tasks)+)``."""
    fields = node.children[1:]
    name = ''
    if len(fields) > 1 and _is_name(fields[0]):
        name, fields = _name(reading, fields[0]), fields[1:]
    if not fields:
        raise reading.refuse(
            node, 'a method is written (:method head [name] preconditions tasks ...)'
        )
    head = read_head(reading, fields[0], operator=False)
    branches: list[Branch] = []
    rest = fields[1:]
    while rest:
        label = ''
        first = rest[0]
        if _is_name(first):
            label, rest = _name(reading, first), rest[1:]
        if len(rest) < 2:
            place = rest[0] if rest else first
            raise reading.refuse(place, 'a branch has preconditions and tasks')
        condition = read_condition(reading, rest[0])
        branches.append(Branch(label, condition, read_tasks(reading, rest[1])))
        rest = rest[2:]
    if not branches:
        raise reading.refuse(node, 'a method needs preconditions and tasks: () () for none')
    return Method(head, tuple(branches), name)


def read_axiom(reading: Reading, node: ListNode) -> Axiom:
    """Read ``(:- head ([name] condition)+)``."""
    fields = node.children[1:]
    if not fields:
        raise reading.refuse(node, 'an axiom is written (:- head body ...)')
    head = read_head(reading, fields[0], operator=False)
    bodies: list[Condition] = []
    names: list[str] = []
    rest = fields[1:]
    while rest:
        name = ''
        if _is_name(rest[0]):
            name, rest = _name(reading, rest[0]), rest[1:]
            if not rest:
                raise reading.refuse(node, f'the body {name} of the axiom is missing')
        names.append(name)
        bodies.append(read_condition(reading, rest[0]))
        rest = rest[1:]
    if not bodies:
        raise reading.refuse(node, 'an axiom needs a body: () when it always holds')
    return Axiom(head, tuple(bodies), tuple(names))


def _is_name(node: Node) -> bool:
    return isinstance(node, Symbol) and not is_nil(node) and not is_variable(node)


def _name(reading: Reading, node: Node) -> str:
    if not isinstance(node, Symbol):
        raise reading.refuse(node, 'expected a name')
    return read_name(reading, node)
