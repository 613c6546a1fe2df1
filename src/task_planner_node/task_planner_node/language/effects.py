"""Effects of operators: from nodes to the model."""

from __future__ import annotations

from task_planner_node.language.conditions import read_condition, read_variables
from task_planner_node.language.model import (
    Atom,
    Condition,
    Effect,
    ForEach,
    Protection,
    Spread,
    Variable,
)
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, elements, is_nil, is_variable
from task_planner_node.language.terms import read_atom


def read_effects(reading: Reading, node: Node, what: str) -> tuple[Effect, ...]:
    """Read an add or a delete list: of effects, or a variable that stands for the whole list."""
    if isinstance(node, Symbol) and is_variable(node):
        return (Spread(reading.variable(node.text), node),)
    if first_word(node) and not is_variable(_first(node)):
        return (_read_effect(reading, node),)
    return tuple(_read_effect(reading, child) for child in elements(reading, node, what))


def read_signed_effects(
    reading: Reading, node: Node, what: str
) -> tuple[tuple[Effect, ...], tuple[Effect, ...]]:
    """Read the paper's list of effects, in which ``(not ...)`` deletes: deletions and additions."""
    deletes: list[Effect] = []
    adds: list[Effect] = []
    for effect in elements(reading, node, what):
        for part, positive in _signed(reading, effect):
            (adds if positive else deletes).append(part)
    return tuple(deletes), tuple(adds)


def _signed(reading: Reading, node: Node) -> list[tuple[Effect, bool]]:
    """The additions (True) and deletions (False) of one effect of the paper's list."""
    word = first_word(node)
    if word == 'not' and isinstance(node, ListNode):
        if len(node.children) != 2:
            raise reading.refuse(node, '(not ...) takes exactly one literal')
        return [(_read_effect(reading, node.children[1]), False)]
    if word not in ('forall', 'when') or not isinstance(node, ListNode):
        return [(_read_effect(reading, node), True)]
    variables, condition, last = _read_quantifier(reading, node)
    signed: tuple[list[Effect], list[Effect]] = ([], [])
    for child in _consequences(last):
        for effect, positive in _signed(reading, child):
            signed[positive].append(effect)
    return [
        (ForEach(variables, condition, tuple(effects), node), bool(positive))
        for positive, effects in enumerate(signed)
        if effects
    ]


def _first(node: Node) -> Node:
    return node.children[0] if isinstance(node, ListNode) else node


def _read_effect(reading: Reading, node: Node) -> Effect:
    word = first_word(node)
    if isinstance(node, Symbol) and is_variable(node):
        return reading.variable(node.text)
    if isinstance(node, ListNode):
        if word in ('forall', 'shop-forall', 'when'):
            variables, condition, last = _read_quantifier(reading, node)
            effects = tuple(_read_effect(reading, child) for child in _consequences(last))
            return ForEach(variables, condition, effects, node)
        if word == ':protection':
            return _read_protection(reading, node)
        if word == 'not':
            raise reading.refuse(node, 'what an operator makes false belongs into its delete list')
    return read_atom(reading, node, 'a literal')


def _read_quantifier(
    reading: Reading, node: ListNode
) -> tuple[tuple[Variable, ...], Condition, Node]:
    parts = node.children[1:]
    variables: tuple[Variable, ...] = ()
    if first_word(node) == 'when':
        if len(parts) != 2:
            raise reading.refuse(node, 'expected (when condition (effect ...))')
    else:
        if len(parts) != 3:
            message = 'expected (forall (?variable ...) condition (effect ...))'
            raise reading.refuse(node, message)
        variables = read_variables(reading, parts[0])
    return variables, read_condition(reading, parts[-2]), parts[-1]


def _consequences(node: Node) -> list[Node]:
    """The effects of a quantifier: a list of them, ``(and ...)``, or one."""
    word = first_word(node)
    if is_nil(node):
        return []
    if isinstance(node, ListNode) and word == 'and':
        return node.children[1:]
    if isinstance(node, Symbol) or (word and not is_variable(node.children[0])):
        return [node]
    return node.children


def _read_protection(reading: Reading, node: ListNode) -> Protection:
    if len(node.children) != 2:
        raise reading.refuse(node, '(:protection ...) takes exactly one literal')
    literal = node.children[1]
    positive = first_word(literal) != 'not'
    if not positive and isinstance(literal, ListNode):
        if len(literal.children) != 2:
            raise reading.refuse(literal, '(not ...) takes exactly one literal')
        literal = literal.children[1]
    protected: Atom | Variable
    if isinstance(literal, Symbol) and is_variable(literal):
        protected = reading.variable(literal.text)
    else:
        protected = read_atom(reading, literal, 'a literal')
    return Protection(protected, positive, node)
