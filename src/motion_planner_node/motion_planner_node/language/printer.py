"""Writing geometric preconditions: what ``parse`` reads back as the same nodes."""

from __future__ import annotations

from motion_planner_node.language.syntax import (
    Call,
    Command,
    Condition,
    Constant,
    Constraint,
    Expression,
    Item,
    Label,
    Negation,
    Number,
    Operation,
    Preconditions,
    Property,
)

_PRECEDENCE = {'+': 1, '-': 1, '*': 2, '/': 2}
_NEGATION = 3


def to_text(node: Preconditions | Item | Expression) -> str:
    """The text of ``node`` with no more parentheses than it needs."""
    # The most frequent ones come first.
    if isinstance(node, (Label, Constant)):
        return node.name
    if isinstance(node, (Call, Command)):
        return f'{node.name}({", ".join(map(to_text, node.arguments))})'
    if isinstance(node, Number):
        return number_to_text(node.value)
    if isinstance(node, Constraint):
        return f'{to_text(node.left)} {node.comparator} {to_text(node.right)}'
    if isinstance(node, Condition):
        return to_text(node.call)
    if isinstance(node, Property):
        return f'{node.owner}.{node.name}'
    if isinstance(node, Operation):
        level = _PRECEDENCE[node.operator]
        left = _operand(node.left, level)
        right = _operand(node.right, level + 1)
        return f'{left} {node.operator} {right}'
    if isinstance(node, Negation):
        return f'-{_operand(node.operand, _NEGATION)}'
    statements = [f'({statement.concept} {statement.label})' for statement in node.statements]
    items = [f'({to_text(item)})' for item in node.items]
    return f'({" ".join(statements + items)})'


def number_to_text(value: float) -> str:
    """The shortest decimal that reads back as ``value``: ``50`` for 50.0."""
    return repr(float(value)).removesuffix('.0')


def _operand(node: Expression, least: int) -> str:
    text = to_text(node)
    level = _PRECEDENCE[node.operator] if isinstance(node, Operation) else _NEGATION
    return text if level >= least else f'({text})'
