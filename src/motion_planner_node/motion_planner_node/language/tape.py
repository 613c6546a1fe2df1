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

from motion_planner_node.functions import (
    COMPONENTS,
    FUNCTIONS,
    Dual,
    Field,
    Kind,
    Place,
    Scalar,
    Surroundings,
)
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

#: What the operators of an `Operation` do with numbers of any kind.
OPERATIONS: dict[str, Callable[..., Any]] = {'+': add, '-': sub, '*': mul, '/': truediv}

#: A slot, a tuple of slots that is a place, or what is the same for every attitude.
_Argument = int | tuple[int, ...] | Field | Surroundings

#: Numbers that have a name.
CONSTANTS = {'pi': pi}


@dataclass(frozen=True, slots=True)
class _Step:
    """Apply ``operation`` to ``arguments`` and fill slot ``target``."""

    target: int
    operation: Callable[..., Any]
    truncated: Callable[..., Any]
    arguments: tuple[_Argument, ...]


class Tape:
    """Steps that compute expressions from the attitudes of the agent ``moving``.

    ``places`` holds the fields of everything else, by label; what is missing is NaN, an unknown
    number. ``surroundings`` are what functions see of the world. Expressions have to be free of
    errors (``check``).
    """

    def __init__(
        self,
        moving: str,
        places: Mapping[str, Mapping[str, float]],
        surroundings: Surroundings,
    ) -> None:
        self._surroundings = surroundings
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
            values[step.target] = operation(*(_value(item, values) for item in step.arguments))
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
            operation = OPERATIONS[expression.operator]
            operands = self.slot(expression.left), self.slot(expression.right)
            return self._step(operation, operation, operands)
        assert isinstance(expression, Call)
        function = FUNCTIONS[expression.name]
        kinds = function.kinds(len(expression.arguments))
        assert kinds is not None
        arguments = map(self._argument, kinds, expression.arguments)
        seen = (self._surroundings,) if function.sees_world else ()
        return self._step(function.value, function.truncated, (*seen, *arguments))

    def _argument(self, kind: Kind, expression: Expression) -> _Argument:
        if kind in {Kind.NUMBER, Kind.ANGLE}:
            return self.slot(expression)
        assert isinstance(expression, Label)
        if kind is Kind.REGION:
            return self._surroundings.region(expression.name)
        return tuple(self.slot(Property(expression.name, name)) for name in COMPONENTS)

    def _number(self, value: float) -> int:
        self._constants.append(value)
        return len(self._constants) - 1

    def _step(
        self,
        operation: Callable[..., Any],
        truncated: Callable[..., Any],
        arguments: tuple[_Argument, ...],
    ) -> int:
        folded = self._folded(operation, arguments)
        if folded is not None:
            return self._number(folded)
        self._constants.append(None)
        target = len(self._constants) - 1
        self._steps.append(_Step(target, operation, truncated, arguments))
        return target

    def _folded(
        self, operation: Callable[..., Any], arguments: tuple[_Argument, ...]
    ) -> float | None:
        """The result if no argument moves and all that the operation needs is known."""
        numbers: dict[int, Dual] = {}
        for argument in arguments:
            for slot in argument if isinstance(argument, tuple) else (argument,):
                if isinstance(slot, int):
                    value = self._constants[slot]
                    if value is None:
                        return None
                    numbers[slot] = Dual.constant(value)
        with np.errstate(all='ignore'):
            result = float(operation(*(_value(item, numbers) for item in arguments)).value)
        return None if np.isnan(result) else result


def _value(argument: _Argument, values: Sequence[Any] | Mapping[int, Any]) -> Any:
    """What the operation of a step is given for ``argument``."""
    if isinstance(argument, int):
        return values[argument]
    if isinstance(argument, tuple):
        return Place(*(values[slot] for slot in argument))
    return argument
