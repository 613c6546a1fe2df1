"""Expressions as sums: a number and terms with factors, so that equal quantities are recognised."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import nan

import numpy as np

from motion_planner_node.functions import FUNCTIONS, Dual
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    Call,
    Constant,
    Expression,
    Label,
    Negation,
    Number,
    Operation,
)
from motion_planner_node.language.tape import CONSTANTS


@dataclass(frozen=True, slots=True)
class Linear:
    """``number`` plus each term, named by its text, times its factor."""

    number: float = 0.0
    terms: Mapping[str, float] = field(default_factory=dict)

    @property
    def constant(self) -> float | None:
        """The number if there is nothing else; NaN where it is undefined."""
        return None if self.terms else self.number

    def plus(self, other: Linear, factor: float = 1.0) -> Linear:
        """The sum of this and ``factor`` times ``other``, without terms that cancel out."""
        terms = dict(self.terms)
        for name, value in other.terms.items():
            terms[name] = terms.get(name, 0.0) + factor * value
        return Linear(
            self.number + factor * other.number,
            {name: value for name, value in terms.items() if value != 0.0},
        )

    def times(self, factor: float) -> Linear:
        """This, ``factor`` times."""
        return Linear().plus(self, factor)


def linear(expression: Expression) -> Linear:
    """The sum that ``expression`` is; products and functions of what may vary are terms."""
    if isinstance(expression, Number):
        return Linear(expression.value)
    if isinstance(expression, Constant):
        return Linear(CONSTANTS[expression.name])
    if isinstance(expression, Negation):
        return linear(expression.operand).times(-1.0)
    if isinstance(expression, Operation):
        left, right = linear(expression.left), linear(expression.right)
        if expression.operator in {'+', '-'}:
            return left.plus(right, 1.0 if expression.operator == '+' else -1.0)
        if expression.operator == '*' and left.constant is not None:
            return right.times(left.constant)
        if right.constant is not None:
            if expression.operator == '*':
                return left.times(right.constant)
            return left.times(1.0 / right.constant if right.constant else nan)
    if isinstance(expression, Call):
        known = _known(expression)
        if known is not None:
            return known
    return Linear(0.0, {_name(expression): 1.0})


def _known(call: Call) -> Linear | None:
    """The sum that a call is if it does not depend on any label, or only repeats its argument."""
    if any(isinstance(argument, Label) for argument in call.arguments):
        return None
    arguments = [linear(argument) for argument in call.arguments]
    if call.name == 'cos-and-sin':
        return arguments[0]
    if any(argument.terms for argument in arguments):
        return None
    with np.errstate(all='ignore'):
        value = FUNCTIONS[call.name].value(*(Dual.constant(a.number) for a in arguments)).value
    return Linear(float(value))


def _name(expression: Expression) -> str:
    """The text of a term, equal for ``distance(a, b)`` and ``distance(b, a)``."""
    if isinstance(expression, Call) and FUNCTIONS[expression.name].symmetric:
        arguments = tuple(sorted(expression.arguments, key=to_text))
        return to_text(Call(expression.name, arguments))
    return to_text(expression)
