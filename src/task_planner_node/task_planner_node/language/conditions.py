"""Logical expressions: from nodes to the model."""

from __future__ import annotations

from collections.abc import Callable

from task_planner_node.language.functions.library import FUNCTIONS
from task_planner_node.language.model import (
    And,
    Assign,
    AssignEach,
    Collect,
    Condition,
    Enforce,
    Exists,
    First,
    Forall,
    Holds,
    Imply,
    Not,
    Or,
    SortBy,
    Stated,
    Variable,
)
from task_planner_node.language.pddl.types import OBJECT, Types, read_typed
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, children_of, is_nil, is_variable
from task_planner_node.language.terms import read_atom, read_expression, read_function, read_term


def read_condition(reading: Reading, node: Node) -> Condition:
    """Read a logical expression; a list of expressions means all of them."""
    if is_nil(node):
        return And(())
    if isinstance(node, Symbol):
        if is_variable(node):
            return Stated(reading.variable(node.text), node)
        raise reading.refuse(
            node, f'expected preconditions, a list, and not the symbol {node.text}'
        )
    word = first_word(node)
    if not word or is_variable(node.children[0]):
        return And(tuple(read_condition(reading, child) for child in node.children))
    if word in FORMS:
        return FORMS[word](reading, node)
    return read_atom(reading, node, 'a literal')


def _all(reading: Reading, node: ListNode) -> tuple[Condition, ...]:
    return tuple(read_condition(reading, child) for child in node.children[1:])


def _and(reading: Reading, node: ListNode) -> Condition:
    return And(_all(reading, node))


def _or(reading: Reading, node: ListNode) -> Condition:
    return Or(_all(reading, node))


def _first(reading: Reading, node: ListNode) -> Condition:
    parts = _all(reading, node)
    return First(parts[0] if len(parts) == 1 else And(parts))


def _quoted(reading: Reading, node: ListNode) -> Condition:
    _check(reading, node, 1, '(quote condition)')
    return read_condition(reading, node.children[1])


def _not(reading: Reading, node: ListNode) -> Condition:
    if len(node.children) != 2:
        raise reading.refuse(node, '(not ...) takes exactly one expression')
    return Not(read_condition(reading, node.children[1]), node)


def _imply(reading: Reading, node: ListNode) -> Condition:
    _check(reading, node, 2, '(imply premise conclusion)')
    premise, conclusion = _all(reading, node)
    return Imply(premise, conclusion, node)


def _forall(reading: Reading, node: ListNode) -> Condition:
    variables, domain, condition = _quantified(reading, node)
    return Forall(variables, domain, condition, node)


def _exists(reading: Reading, node: ListNode) -> Condition:
    if len(node.children) == 3 and all(is_variable(n) for n in children_of(node.children[1])):
        variables = read_variables(reading, node.children[1])
        return Exists(variables, read_condition(reading, node.children[2]), And(()), node)
    variables, domain, condition = _quantified(reading, node)
    return Exists(variables, domain, condition, node)


def _quantified(
    reading: Reading, node: ListNode
) -> tuple[tuple[Variable, ...], Condition, Condition]:
    """SHOP's ``(?x ...) domain condition``, or PDDL's ``(?x - type ...) condition``."""
    if len(node.children) == 3:
        typed = read_typed(reading, children_of(node.children[1]), variables=True)
        if typed and all(each.type != (OBJECT,) for each in typed):
            types = Types()
            domain = And(tuple(types.condition(each) for each in typed))
            variables = tuple(each.variable for each in typed)
            return variables, domain, read_condition(reading, node.children[2])
    _check(reading, node, 3, f'({first_word(node)} (?variable ...) domain condition)')
    variables = read_variables(reading, node.children[1])
    parts = [read_condition(reading, child) for child in node.children[2:]]
    return variables, parts[0], parts[1]


def read_variables(reading: Reading, node: Node) -> tuple[Variable, ...]:
    """Read the variables of a quantifier: a list of them, one alone, or nil."""
    nodes = [node] if is_variable(node) else node.children if isinstance(node, ListNode) else []
    variables = tuple(_variable(reading, child, 'a variable') for child in nodes)
    if not variables and not is_nil(node):
        raise reading.refuse(node, 'expected the variables of the quantifier, a list')
    return variables


def _variable(reading: Reading, node: Node, what: str) -> Variable:
    if isinstance(node, Symbol) and is_variable(node):
        return reading.variable(node.text)
    text = reading.source.excerpt(node.start, node.end)
    raise reading.refuse(node, f'expected {what}, such as ?x, and not {text}')


def _assign(reading: Reading, node: ListNode) -> Condition:
    each = first_word(node) == 'assign*'
    _check(reading, node, 2, f'({first_word(node)} ?variable expression)')
    variable = _variable(reading, node.children[1], 'the variable to assign to')
    expression = read_expression(reading, node.children[2])
    return (AssignEach if each else Assign)(variable, expression, node)


def _holds(reading: Reading, node: ListNode) -> Condition:
    return Holds(read_expression(reading, node), node)


def _collect(reading: Reading, node: ListNode) -> Condition:
    word = first_word(node)
    _check(reading, node, 3, f'({word} term condition ?variable)')
    term = read_term(reading, node.children[1])
    condition = read_condition(reading, node.children[2])
    variable = _variable(reading, node.children[3], 'the variable for the list')
    return Collect(term, condition, variable, word == 'setof', node)


def _enforce(reading: Reading, node: ListNode) -> Condition:
    if len(node.children) < 2:
        raise reading.refuse(node, '(enforce condition message ...) lacks a condition')
    message = tuple(read_expression(reading, child) for child in node.children[2:])
    return Enforce(read_condition(reading, node.children[1]), message, node)


def _sort_by(reading: Reading, node: ListNode) -> Condition:
    if len(node.children) not in (3, 4):
        shape = "(:sort-by key [#'comparison] condition)"
        raise reading.refuse(node, f'sorting is written {shape}')
    key = read_expression(reading, node.children[1])
    comparison = '<'
    if len(node.children) == 4:
        comparison = read_function(reading, node.children[2])
        if comparison not in FUNCTIONS or not FUNCTIONS[comparison].takes(2):
            raise reading.refuse(node.children[2], f'{comparison} does not compare two values')
    return SortBy(key, comparison, read_condition(reading, node.children[-1]), node)


def _check(reading: Reading, node: ListNode, count: int, shape: str) -> None:
    if len(node.children) != count + 1:
        found = len(node.children) - 1
        raise reading.refuse(node, f'expected {shape}, and not {found} parts')


FORMS: dict[str, Callable[[Reading, ListNode], Condition]] = {
    'and': _and,
    ':external': _and,
    'or': _or,
    'not': _not,
    'imply': _imply,
    'forall': _forall,
    'shop-forall': _forall,
    'exists': _exists,
    'assign': _assign,
    'assign*': _assign,
    'eval': _holds,
    'call': _holds,
    'setof': _collect,
    'bagof': _collect,
    'enforce': _enforce,
    ':first': _first,
    ':sort-by': _sort_by,
    'quote': _quoted,
    'backquote': _quoted,
}
