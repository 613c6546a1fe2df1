"""The functions of a program and their derivatives at one attitude, by compiled kernels."""

from __future__ import annotations

from math import atan2, cos, floor, hypot, isnan, nan, pi, sin, sqrt

import numpy as np

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import kernel, part
from motion_planner_node.satisfaction.recording import (
    ABSOLUTE,
    ADD,
    ARCTAN2,
    BEARING,
    COSINE,
    DIVIDE,
    HYPOT,
    MINIMUM,
    MULTIPLY,
    NEGATE,
    RANGE,
    RELATIVE_TURNED,
    RESTRICT,
    SINE,
    SUBTRACT,
    Table,
)

#: Stands for a function value that is undefined or too large to be squared.
HUGE = 1e150
#: Steepest slope that is told apart, so that products with values stay finite.
STEEPEST = 1e100

#: Squares of lengths between these are neither lost nor infinite.
_LEAST_SQUARE, _LARGEST_SQUARE = 1e-280, 1e280

#: Columns of the conditions (m, 4) of a program: whether a constraint is an equality, periodic,
#: strict, and the residual with which a descent can stop.
EQUALITY, PERIODIC, STRICT, ALLOWED = range(4)


@kernel
def workspace(table: Table) -> tuple[Array, Array]:
    """Values (s,) and gradients (s, 3) of all slots, with what never changes filled in."""
    count = 3 + len(table.constants) + len(table.operations)
    values, gradients = np.zeros(count), np.zeros((count, 3))
    for index in range(3):
        gradients[index, index] = 1.0
    values[3 : 3 + len(table.constants)] = table.constants
    return values, gradients


@part
def _combine(gradients: Array, target: int, u: float, first: int, v: float, second: int) -> None:
    """Gradient of ``target`` = u times that of ``first`` + v times that of ``second``.

    A gradient of zero stays zero whatever its factor.
    """
    for axis in range(3):
        a, b = gradients[first, axis], gradients[second, axis]
        gradients[target, axis] = (u * a if a != 0.0 else 0.0) + (v * b if b != 0.0 else 0.0)


@part
def _length(east: float, north: float) -> float:
    square = east * east + north * north
    return sqrt(square) if _LEAST_SQUARE < square < _LARGEST_SQUARE else hypot(east, north)


@part
def evaluate(
    table: Table, state: Array, first: int, is_truncated: bool, values: Array, gradients: Array
) -> None:
    """Fill the ``values`` and ``gradients`` of a `workspace` at ``state[first : first + 3]``.

    ``is_truncated`` keeps only the derived codes of the functions, as in Table 2 of the paper.
    """
    for axis in range(3):
        values[axis] = state[first + axis]
    operations = table.operations
    x, y, heading = values[0], values[1], values[2]
    target = 3 + len(table.constants)
    for step in range(len(operations)):
        code, i, j = operations[step, 0], operations[step, 1], operations[step, 2]
        a = values[i]
        b = values[j] if code != RESTRICT else 0.0
        if code >= RANGE:
            east, north = a - x, b - y
            length = _length(east, north)
            if code == RANGE:
                values[target] = length
                gradients[target, 0] = -east / length if length != 0.0 else -1.0
                gradients[target, 1] = -north / length if length != 0.0 else 0.0
            else:
                reciprocal = 1.0 / length if length != 0.0 else 0.0
                bearing = atan2(north + 0.0, east) if length != 0.0 else nan
                sign = 1.0
                if code != BEARING:
                    bearing = heading - bearing
                    sign = 0.0 if is_truncated and code == RELATIVE_TURNED else -1.0
                values[target] = bearing
                gradients[target, 0] = sign * north * reciprocal * reciprocal
                gradients[target, 1] = -sign * east * reciprocal * reciprocal
                gradients[target, 2] = 0.0 if code == BEARING else 1.0
        elif code == ADD:
            values[target] = a + b
            _combine(gradients, target, 1.0, i, 1.0, j)
        elif code == SUBTRACT:
            values[target] = a - b
            _combine(gradients, target, 1.0, i, -1.0, j)
        elif code == MULTIPLY:
            values[target] = a * b
            _combine(gradients, target, b, i, a, j)
        elif code == HYPOT:
            length = hypot(a, b)
            values[target] = length
            if length == 0.0:
                _combine(gradients, target, 1.0, i, 0.0, j)
            else:
                _combine(gradients, target, a / length, i, b / length, j)
        elif code == ARCTAN2:
            length = hypot(a, b)
            if length == 0.0:
                values[target] = nan
                _combine(gradients, target, 0.0, i, 0.0, j)
            else:
                values[target] = atan2(a + 0.0, b)
                _combine(gradients, target, b / length / length, i, -a / length / length, j)
        elif code == DIVIDE:
            quotient = a / b
            values[target] = quotient
            _combine(gradients, target, 1.0 / b, i, -quotient / b, j)
        elif code == NEGATE:
            values[target] = -a
            _combine(gradients, target, -1.0, i, 0.0, i)
        elif code == SINE:
            values[target] = sin(a)
            _combine(gradients, target, cos(a), i, 0.0, i)
        elif code == COSINE:
            values[target] = cos(a)
            _combine(gradients, target, -sin(a), i, 0.0, i)
        elif code == ABSOLUTE:
            values[target] = abs(a)
            _combine(gradients, target, -1.0 if a < 0.0 else 1.0, i, 0.0, i)
        elif code == MINIMUM:
            is_first = a <= b or isnan(a)
            values[target] = a if is_first else b
            _combine(gradients, target, 1.0 if is_first else 0.0, i, 0.0 if is_first else 1.0, j)
        else:
            values[target] = a
            for axis in range(3):
                kept = not is_truncated or (j >> axis) & 1
                gradients[target, axis] = gradients[i, axis] if kept else 0.0
        target += 1


@part
def difference(table: Table, row: int, values: Array) -> float:
    """The difference of the sides of constraint number ``row``, from the values of a `workspace`."""
    return float(table.linear[row, 0] * values[table.outputs[row]] + table.linear[row, 1])


@part
def tell(table: Table, values: Array, gradients: Array, told: Array) -> None:
    """Fill ``told`` (m or more, 4) with the differences of a `workspace`, and with their slopes."""
    for row in range(len(table.outputs)):
        slot, factor = table.outputs[row], table.linear[row, 0]
        told[row, 0] = difference(table, row, values)
        for axis in range(3):
            told[row, 1 + axis] = factor * gradients[slot, axis]


@part
def penalise(conditions: Array, margin: float, told: Array) -> None:
    """Turn differences of sides into the functions where they are penalised, 0 elsewhere.

    ``told`` (m or more, 4) are the differences and their slopes, which are made finite. An equality
    is penalised on both sides (equation 3 of the paper); an inequality where it does not hold with
    a ``margin`` to spare (equation 4).
    """
    for row in range(len(conditions)):
        value = told[row, 0]
        if conditions[row, PERIODIC]:
            value -= 2.0 * pi * floor(value * (0.5 / pi) + 0.5)
        if not conditions[row, EQUALITY]:
            value = value + margin if value + margin > 0.0 or isnan(value) else 0.0
        if isnan(value):
            value = pi if conditions[row, PERIODIC] else HUGE
        told[row, 0] = min(max(value, -HUGE), HUGE)
        for axis in range(1, 4):
            slope = told[row, axis]
            told[row, axis] = 0.0 if isnan(slope) else min(max(slope, -STEEPEST), STEEPEST)


@part
def violation(conditions: Array, row: int, difference: float) -> float:
    """By how much a constraint is missed whose sides have this ``difference``; 0 if it holds."""
    if isnan(difference):
        return pi if conditions[row, PERIODIC] else np.inf
    if conditions[row, PERIODIC]:
        return abs(difference - 2.0 * pi * floor(difference / (2.0 * pi) + 0.5))
    if conditions[row, EQUALITY]:
        return abs(difference)
    if difference < 0.0:
        return 0.0
    return max(difference, 5e-324) if conditions[row, STRICT] else difference


@kernel
def violations_at(table: Table, conditions: Array, states: Array) -> Array:
    """By how much ``states`` (n, 3) miss each of the m constraints: (n, m), 0 where it holds."""
    is_truncated = False
    values, gradients = workspace(table)
    result = np.empty((len(states), len(conditions)))
    for lane in range(len(states)):
        evaluate(table, states[lane], 0, is_truncated, values, gradients)
        for row in range(len(conditions)):
            result[lane, row] = violation(conditions, row, difference(table, row, values))
    return result
