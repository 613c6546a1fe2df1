"""Expressions lowered to one list of steps, for a whole batch of attitudes at a time.

Equal sub-expressions share a slot and constants are folded, so a tape does no work twice.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import nan, pi
from operator import add, mul, neg, sub, truediv
from typing import Any, TypeVar

import numpy as np

from motion_planner_node.functions import COMPONENTS, FUNCTIONS, Dual, Kind, Place, Scalar
from motion_planner_node.language.syntax import (
    Call,
    Constant,
    Expression,
    Label,
    Negation,
    Number,
    Operation,
    Property,
)

_S = TypeVar('_S', bound=Scalar)

_OPERATIONS: dict[str, Callable[..., Any]] = {'+': add, '-': sub, '*': mul, '/': truediv}

#: Numbers that have a name.
CONSTANTS = {'pi': pi}


@dataclass(frozen=True, slots=True)
class _Step:
    """Apply ``operation`` to slots, a tuple of three slots being a place, and fill ``target``."""

    target: int
    operation: Callable[..., Any]
    truncated: Callable[..., Any]
    arguments: tuple[int | tuple[int, ...], ...]


class Tape:
    """Steps that compute expressions from the attitudes of the agent ``moving``.

    ``places`` holds the fields of everything else, by label; what is missing is NaN, an unknown
    number. Expressions have to be free of errors (``check``).
    """

    def __init__(self, moving: str, places: Mapping[str, Mapping[str, float]]) -> None:
        self._moving = moving
        self._places = places
        self._constants: list[float | None] = [None] * len(COMPONENTS)
        self._steps: list[_Step] = []
        self._slots: dict[Expression | float, int] = {}
        self._templates: dict[Callable[[float], Any], list[Any]] = {}

    def slot(self, expression: Expression) -> int:
        """The slot that holds ``expression`` after ``run``."""
        known = self._slots.get(expression)
        if known is None:
            known = self._slots[expression] = self._lowered(expression)
        return known

    def constant(self, slot: int) -> float | None:
        """The number in ``slot`` if it is the same for every attitude (NaN when unknown)."""
        return self._constants[slot]

    def run(
        self, state: Sequence[_S], constant: Callable[[float], _S], *, truncated: bool = False
    ) -> list[_S]:
        """Fill all slots for the components x, y [m], heading [rad] of ``state``.

        ``constant`` makes a number of the kind of ``state``; ``truncated`` keeps only the derivatives
        of the functions' derived codes.
        """
        values = list(self._template(constant))
        values[: len(COMPONENTS)] = state
        for step in self._steps:
            operation = step.truncated if truncated else step.operation
            values[step.target] = operation(
                *(
                    values[argument]
                    if isinstance(argument, int)
                    else Place(*(values[slot] for slot in argument))
                    for argument in step.arguments
                )
            )
        return values

    def _template(self, constant: Callable[[float], _S]) -> list[Any]:
        template = self._templates.get(constant)
        if template is None or len(template) != len(self._constants):
            template = [nan if value is None else constant(value) for value in self._constants]
            self._templates[constant] = template
        return template

    def _lowered(self, expression: Expression) -> int:
        if isinstance(expression, Number):
            return self._number(expression.value)
        if isinstance(expression, Constant):
            return self._number(CONSTANTS[expression.name])
        if isinstance(expression, Property):
            if expression.owner == self._moving:
                return COMPONENTS.index(expression.name)
            return self._number(self._places.get(expression.owner, {}).get(expression.name, nan))
        if isinstance(expression, Negation):
            return self._step(neg, neg, (self.slot(expression.operand),))
        if isinstance(expression, Operation):
            operation = _OPERATIONS[expression.operator]
            operands = self.slot(expression.left), self.slot(expression.right)
            return self._step(operation, operation, operands)
        assert isinstance(expression, Call)
        function = FUNCTIONS[expression.name]
        arguments = tuple(
            self.slot(argument) if kind in {Kind.NUMBER, Kind.ANGLE} else self._place(argument)
            for kind, argument in zip(function.arguments, expression.arguments, strict=True)
        )
        return self._step(function.value, function.truncated, arguments)

    def _place(self, expression: Expression) -> tuple[int, ...]:
        assert isinstance(expression, Label)
        return tuple(self.slot(Property(expression.name, name)) for name in COMPONENTS)

    def _number(self, value: float) -> int:
        self._constants.append(value)
        return len(self._constants) - 1

    def _step(
        self,
        operation: Callable[..., Any],
        truncated: Callable[..., Any],
        arguments: tuple[int | tuple[int, ...], ...],
    ) -> int:
        folded = self._folded(operation, arguments)
        if folded is not None:
            return self._number(folded)
        self._constants.append(None)
        target = len(self._constants) - 1
        self._steps.append(_Step(target, operation, truncated, arguments))
        return target

    def _folded(
        self, operation: Callable[..., Any], arguments: tuple[int | tuple[int, ...], ...]
    ) -> float | None:
        """The result if no argument moves and all that the operation needs is known."""
        known = []
        for argument in arguments:
            slots = (argument,) if isinstance(argument, int) else argument
            numbers = [self._constants[slot] for slot in slots]
            duals = [Dual.constant(number) for number in numbers if number is not None]
            if len(duals) < len(numbers):
                return None
            known.append(duals[0] if isinstance(argument, int) else Place(*duals))
        with np.errstate(all='ignore'):
            result = float(operation(*known).value)
        return None if np.isnan(result) else result
