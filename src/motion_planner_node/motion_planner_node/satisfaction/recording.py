"""A tape flattened to a table of primitive operations, which the compiled kernels carry out.

The library's functions are run once on numbers that write down what is done with them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import COMPONENTS
from motion_planner_node.functions.field import Field
from motion_planner_node.language.tape import Tape
from motion_planner_node.satisfaction.row import Row

#: Operation codes; the table holds them with the slots of their two operands.
NEGATE, ADD, SUBTRACT, MULTIPLY, DIVIDE, HYPOT, ARCTAN2, SINE, COSINE, ABSOLUTE, MINIMUM = range(11)
#: An angle of which it does not matter by how many full turns: `ARCTAN2`, or part of a `BEARING`.
_DIRECTION = -1
#: Keeps only some derivatives: the second operand is a set of bits, one for each component.
RESTRICT = 11
#: Several operations in one, from the agent to a place whose constant x and y are the operands:
#: distance, bearing, heading minus bearing, and that with the heading as its only derived code.
RANGE, BEARING, RELATIVE, RELATIVE_TURNED = range(12, 16)

_EPSILON = float(np.finfo(np.float64).eps)

_X, _Y, _HEADING = range(3)
_ONLY_HEADING = 1 << _HEADING


class Table(NamedTuple):
    """Operations that compute the functions f_i of a program.

    Slots 0 to 2 are x, y and heading, then come the constants, then the results in order.

    constants: (c,) numbers
    operations: (k, 3) operation code and the slots of its operands
    outputs: (m,) slots of which the differences of the sides of the constraints are made
    linear: (m, 3) factor, 1 or -1, and number: the difference is factor * slot + number, where the
        number may be off by the third column through rounding
    """

    constants: NDArray[np.float64]
    operations: NDArray[np.int64]
    outputs: NDArray[np.int64]
    linear: NDArray[np.float64]


class NotPrimitiveError(Exception):
    """A function does something that the table has no operation for."""


class _Recorder:
    """The operations written down so far; one that was done before is not done again."""

    def __init__(self) -> None:
        self.constants: list[float] = []
        self.operations: list[tuple[int, int, int]] = []
        #: The slots of operations.
        self._known: dict[tuple[int, int, int], int] = {}

    def constant(self, value: float) -> _Recorded:
        self.constants.append(value)
        return _Recorded(self, -len(self.constants))

    def operate(self, code: int, first: int, second: int) -> _Recorded:
        operation = self._merged(code, first, second)
        slot = self._known.setdefault(operation, len(COMPONENTS) + len(self.operations))
        if slot == len(COMPONENTS) + len(self.operations):
            self.operations.append(operation)
        return _Recorded(self, slot)

    def operation(self, slot: int) -> tuple[int, int, int] | None:
        """What computes ``slot``; None where it is a component or a constant."""
        return self.operations[slot - len(COMPONENTS)] if slot >= len(COMPONENTS) else None

    def _merged(self, code: int, first: int, second: int) -> tuple[int, int, int]:
        """The same operation, in one with those before it where there is a code for all."""
        if code == HYPOT:
            east, north = self._minus(first, _X), self._minus(second, _Y)
            if east and north:
                return RANGE, east, north
        elif code == _DIRECTION:
            east, north = self._minus(second, _X), self._minus(first, _Y)
            return (BEARING, east, north) if east and north else (ARCTAN2, first, second)
        elif code == SUBTRACT and first == _HEADING:
            bearing = self.operation(second)
            if bearing and bearing[0] == BEARING:
                return RELATIVE, *bearing[1:]
        elif code == RESTRICT:
            restricted = self.operation(first)
            if restricted and restricted[0] == RELATIVE and second == _ONLY_HEADING:
                return RELATIVE_TURNED, *restricted[1:]
            if restricted and restricted[0] in {ADD, SUBTRACT} and restricted[2] < 0:
                kept = self.operate(RESTRICT, restricted[1], second)
                return restricted[0], kept.slot, restricted[2]
        return code, first, second

    def _minus(self, slot: int, component: int) -> int:
        """The constant minus which the ``component`` is in ``slot``; 0 where there is none."""
        code, first, second = self.operation(slot) or (NEGATE, 0, 0)
        return first if code == SUBTRACT and first < 0 and second == component else 0

    def linear(self, slot: int) -> tuple[int, float, float, float]:
        """A slot, factor and number, so that ``slot`` is factor times that slot plus the number.

        The last is by how much the number may be off.
        """
        factor, number, error = 1.0, 0.0, 0.0
        while operation := self.operation(slot):
            code, first, second = operation
            term = 0.0
            if code == NEGATE:
                slot, factor = first, -factor
            elif code in {ADD, SUBTRACT} and second < 0:
                sign = factor if code == ADD else -factor
                slot, term = first, sign * self.constants[-1 - second]
            elif code == SUBTRACT and first < 0:
                slot, term = second, factor * self.constants[-1 - first]
                factor = -factor
            else:
                break
            total = number + term
            # Nothing is lost where one of the two is 0.
            error += _EPSILON * abs(total) if number and term else 0.0
            number = total
        return slot, factor, number, error


class _Recorded:
    """A number that is not known yet: a slot; constants count down from -1."""

    __slots__ = ('_recorder', 'slot')

    def __init__(self, recorder: _Recorder, slot: int) -> None:
        self._recorder = recorder
        self.slot = slot

    def _with(self, code: int, other: _Recorded) -> _Recorded:
        return self._recorder.operate(code, self.slot, other.slot)

    def _alone(self, code: int, bits: int = 0) -> _Recorded:
        return self._recorder.operate(code, self.slot, bits)

    def constant(self, value: float) -> _Recorded:
        return self._recorder.constant(value)

    def __neg__(self) -> _Recorded:
        return self._alone(NEGATE)

    def __add__(self, other: _Recorded) -> _Recorded:
        return self._with(ADD, other)

    def __sub__(self, other: _Recorded) -> _Recorded:
        return self._with(SUBTRACT, other)

    def __mul__(self, other: _Recorded) -> _Recorded:
        return self._with(MULTIPLY, other)

    def __truediv__(self, other: _Recorded) -> _Recorded:
        return self._with(DIVIDE, other)

    def __abs__(self) -> _Recorded:
        return self._alone(ABSOLUTE)

    def scaled(self, factor: float) -> _Recorded:
        return self._with(MULTIPLY, self.constant(factor))

    def hypot(self, other: _Recorded) -> _Recorded:
        return self._with(HYPOT, other)

    def arctan2(self, abscissa: _Recorded) -> _Recorded:
        return self._with(ARCTAN2, abscissa)

    def direction(self, abscissa: _Recorded) -> _Recorded:
        return self._with(_DIRECTION, abscissa)

    def sin(self) -> _Recorded:
        return self._alone(SINE)

    def cos(self) -> _Recorded:
        return self._alone(COSINE)

    def minimum(self, other: _Recorded) -> _Recorded:
        return self._with(MINIMUM, other)

    def maximum(self, other: _Recorded) -> _Recorded:
        return -((-self).minimum(-other))

    def restricted(self, kept: Sequence[bool]) -> _Recorded:
        return self._alone(RESTRICT, sum(1 << index for index, keeps in enumerate(kept) if keeps))

    def opaque(self, field: Field, *others: _Recorded) -> _Recorded:
        raise NotPrimitiveError(f'{field} of {len(others) + 1} numbers is not a primitive')


def record(tape: Tape, rows: Sequence[Row]) -> Table | None:
    """The table that computes the functions of ``rows``; None when a function is not primitive."""
    recorder = _Recorder()
    state = [_Recorded(recorder, index) for index in range(len(COMPONENTS))]
    try:
        values = tape.run(state, recorder.constant, truncated=True)
    except NotPrimitiveError:
        return None
    outputs, linear = [], []
    for row in rows:
        left, right = values[row.left], values[row.right]
        difference = right - left if row.is_reversed else left - right
        slot, *terms = recorder.linear(difference.slot)
        outputs.append(slot)
        linear.append(terms)
    used = _used(recorder.operations, outputs)
    return _numbered(recorder, used, outputs, linear)


def _used(operations: Sequence[tuple[int, int, int]], outputs: Sequence[int]) -> list[int]:
    """Indices of the operations that the outputs depend on, in order."""
    needed = set(outputs)
    for index in range(len(operations) - 1, -1, -1):
        if index + len(COMPONENTS) in needed:
            code, first, second = operations[index]
            needed |= {first} if code == RESTRICT else {first, second}
    return [index for index in range(len(operations)) if index + len(COMPONENTS) in needed]


def _numbered(
    recorder: _Recorder,
    used: Sequence[int],
    outputs: Sequence[int],
    linear: Sequence[Sequence[float]],
) -> Table:
    """The final slots: components, constants, then the results of the ``used`` operations."""
    base = len(COMPONENTS)
    final = {index: index for index in range(base)}
    final |= {-1 - index: base + index for index in range(len(recorder.constants))}
    first_result = base + len(recorder.constants)
    final |= {base + index: first_result + order for order, index in enumerate(used)}
    table = [
        (code, final[first], second if code == RESTRICT else final[second])
        for code, first, second in (recorder.operations[index] for index in used)
    ]
    return Table(
        np.array(recorder.constants, dtype=np.float64),
        np.array(table, dtype=np.int64).reshape(-1, 3),
        np.array([final[slot] for slot in outputs], dtype=np.int64),
        np.array(linear, dtype=np.float64).reshape(-1, 3),
    )
