"""Conditions and ``!=`` as comparisons of numbers, which is what is solved."""

from __future__ import annotations

from motion_planner_node.functions import FUNCTIONS
from motion_planner_node.language.syntax import (
    Call,
    Condition,
    Constraint,
    Expression,
    Number,
    Operation,
)

#: What excludes a comparison with zero. An equality's opposite excludes a single number.
OPPOSITE = {'<=': '>', '>=': '<', '=': '!='}

#: Numbers that differ by no more than this count as equal, for ``=`` as for ``!=``.
APART = 1e-9

NOT = 'not'


def comparison(item: Constraint | Condition, is_angular: bool) -> Constraint:
    """What ``item`` asks for with one of ``<``, ``<=``, ``>``, ``>=`` and ``=``.

    A condition compares its function with zero, and ``a != b`` asks for ``abs(a - b) > 1e-9``, or
    for ``angle_between(a, b) > 1e-9`` where it ``is_angular``. ``item`` has to be free of errors.
    """
    if isinstance(item, Constraint):
        if item.comparator != '!=':
            return item
        return _apart(item.left, item.right, is_angular, item)
    call, negated = unwrapped(item.call)
    comparator = FUNCTIONS[call.name].condition
    return Constraint(
        call,
        OPPOSITE[comparator] if negated else comparator,
        Number(0.0),
        line=item.line,
        column=item.column,
    )


def unwrapped(call: Call) -> tuple[Call, bool]:
    """The call inside any number of ``not(...)``, and whether they turn it round."""
    negated = False
    while call.name == NOT and len(call.arguments) == 1 and isinstance(call.arguments[0], Call):
        call, negated = call.arguments[0], not negated
    return call, negated


def _apart(left: Expression, right: Expression, is_angular: bool, at: Constraint) -> Constraint:
    if is_angular:
        difference: Expression = Call('angle_between', (left, right))
    else:
        difference = Call('abs', (Operation('-', left, right),))
    return Constraint(difference, '>', Number(APART), line=at.line, column=at.column)
