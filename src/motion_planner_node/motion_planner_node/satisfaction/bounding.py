"""Bounds of the functions of a program over boxes of attitudes, by compiled kernels.

The same interval arithmetic as `functions.Interval`, carried out on the table of a program: each
operation rounds outward, so that what is excluded is excluded for every attitude of a box.
"""

from __future__ import annotations

from math import atan2, ceil, cos, floor, hypot, inf, isnan, pi, sin

import numpy as np
from numpy.typing import NDArray

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
    SINE,
    SUBTRACT,
    Table,
)

#: Numbers from the first one to the second.
_Range = tuple[float, float]

#: Of a result and more than the rounding of one operation.
_RELATIVE = 4.0 * float(np.finfo(np.float64).eps)
#: More than a product loses when it underflows.
_SMALLEST = float(np.finfo(np.float64).tiny)
#: Columns of the limits (m, 3) of a program: the least and the greatest that a function may be, and
#: whether, by 1, it is an angle modulo 2 pi.
LEAST, GREATEST, PERIODIC = range(3)

#: Beyond this [rad] nothing is said of the sine and cosine of an angle.
_LARGEST_ANGLE = 1e9


@kernel
def _outward(low: float, high: float) -> _Range:
    """Both ends widened by more than the rounding of one operation; NaN becomes any number."""
    low, high = low - abs(low) * _RELATIVE, high + abs(high) * _RELATIVE
    return (-inf, inf) if isnan(low) or isnan(high) else (low, high)


@kernel
def _plus(a: _Range, b: _Range) -> _Range:
    return _outward(a[0] + b[0], a[1] + b[1])


@kernel
def _minus(a: _Range, b: _Range) -> _Range:
    return _outward(a[0] - b[1], a[1] - b[0])


@kernel
def _times(a: _Range, b: _Range) -> _Range:
    """Products; an infinite factor is no number, so that zero times it is zero."""
    low, high = inf, -inf
    for one in a:
        for other in b:
            product = one * other
            product = 0.0 if isnan(product) else product
            low, high = min(low, product), max(high, product)
    return _outward(low - _SMALLEST, high + _SMALLEST)


@kernel
def _magnitude(a: _Range) -> _Range:
    return max(a[0], -a[1], 0.0), max(-a[0], a[1])


@kernel
def _length(a: _Range, b: _Range) -> _Range:
    """Lengths of vectors with these components."""
    one, other = _magnitude(a), _magnitude(b)
    low, high = _outward(hypot(one[0], other[0]), hypot(one[1], other[1]))
    return max(low, 0.0), high


@kernel
def _direction(north: _Range, east: _Range) -> _Range:
    """Directions [rad] of vectors modulo 2 pi, beyond pi where need be.

    The extremes are at corners of the box of vectors, unless the origin is inside it.
    """
    south, top = north[0] + 0.0, north[1] + 0.0
    across = south < 0.0 and top >= 0.0 and east[0] < 0.0
    if across and east[1] >= 0.0:
        return -pi, pi
    low, high = inf, -inf
    for y in (south, top):
        for x in east:
            angle = atan2(y, x)
            if across and angle < 0.0:
                angle += 2.0 * pi
            low, high = min(low, angle), max(high, angle)
    low, high = _outward(low, high)
    return max(low, -pi), min(high, 2.0 * pi if across else pi)


@kernel
def _wave(a: _Range, is_sine: bool) -> _Range:
    """Sines or cosines of angles [rad]."""
    if not max(abs(a[0]), abs(a[1])) < _LARGEST_ANGLE:
        return -1.0, 1.0
    first, last = (sin(a[0]), sin(a[1])) if is_sine else (cos(a[0]), cos(a[1]))
    low, high = _outward(min(first, last), max(first, last))
    crest = 0.5 * pi if is_sine else 0.0
    begin, end = (a[0] - crest) / (2.0 * pi), (a[1] - crest) / (2.0 * pi)
    slack = 1e-15 * (1.0 + abs(begin) + abs(end))
    begin, end = begin - slack, end + slack
    if ceil(begin) <= floor(end):
        high = 1.0
    if ceil(begin - 0.5) <= floor(end - 0.5):
        low = -1.0
    return max(low, -1.0), min(high, 1.0)


@kernel
def _of_one(code: int, a: _Range) -> _Range:
    """What an operation on one number gives; one that keeps only derivatives keeps the number."""
    if code == NEGATE:
        return -a[1], -a[0]
    if code in (SINE, COSINE):
        return _wave(a, code == SINE)
    if code == ABSOLUTE:
        return _magnitude(a)
    return a


@kernel
def _of_two(code: int, a: _Range, b: _Range) -> _Range:
    """What an operation on two numbers gives."""
    if code == ADD:
        return _plus(a, b)
    if code == SUBTRACT:
        return _minus(a, b)
    if code == MULTIPLY:
        return _times(a, b)
    if code == MINIMUM:
        return min(a[0], b[0]), min(a[1], b[1])
    if code == HYPOT:
        return _length(a, b)
    if code == ARCTAN2:
        low, high = _direction(a, b)
        return (-pi, pi) if high > pi else (low, high)
    # A quotient.
    through_zero = b[0] <= 0.0 <= b[1]
    return (-inf, inf) if through_zero else _times(a, _outward(1.0 / b[1], 1.0 / b[0]))


@kernel
def _of_place(code: int, x: _Range, y: _Range, heading: _Range, a: _Range, b: _Range) -> _Range:
    """Distance and directions from the agent to the place (a, b)."""
    east, north = _minus(a, x), _minus(b, y)
    if code == RANGE:
        return _length(east, north)
    bearing = _direction(north, east)
    return bearing if code == BEARING else _minus(heading, bearing)


@kernel
def _wrapped(a: _Range) -> _Range:
    """Angles [rad] turned so that they lie round zero; those of a full turn or more are any."""
    if not a[1] - a[0] < 2.0 * pi:
        return -pi, pi
    turns = float(floor((a[0] + a[1]) / (4.0 * pi) + 0.5))
    return _minus(a, _times((2.0 * pi, 2.0 * pi), (turns, turns)))


@kernel
def slot_ranges(table: Table) -> tuple[Array, Array]:
    """Least and greatest numbers (s,) of all slots, with those of the constants filled in."""
    count = 3 + len(table.constants) + len(table.operations)
    least, most = np.empty(count), np.empty(count)
    for index in range(len(table.constants)):
        constant = table.constants[index]
        least[3 + index] = -inf if isnan(constant) else constant
        most[3 + index] = inf if isnan(constant) else constant
    return least, most


@part
def _fill(table: Table, step: int, least: Array, most: Array) -> None:
    """Carry out operation number ``step``; what it needs has been filled in before."""
    code, i, j = table.operations[step, 0], table.operations[step, 1], table.operations[step, 2]
    a = (least[i], most[i])
    if code >= RANGE:
        x, y, heading = (least[0], most[0]), (least[1], most[1]), (least[2], most[2])
        found = _of_place(code, x, y, heading, a, (least[j], most[j]))
    elif code in (ADD, SUBTRACT, MULTIPLY, DIVIDE, HYPOT, ARCTAN2, MINIMUM):
        found = _of_two(code, a, (least[j], most[j]))
    else:
        found = _of_one(code, a)
    target = 3 + len(table.constants) + step
    least[target], most[target] = found


@part
def _bounds_of(table: Table, row: int, is_periodic: bool, least: Array, most: Array) -> _Range:
    """Bounds of function number ``row``, when its slot has been filled in."""
    slot, factor = table.outputs[row], table.linear[row, 0]
    number, error = table.linear[row, 1], table.linear[row, 2]
    value = (least[slot], most[slot]) if factor > 0.0 else (-most[slot], -least[slot])
    value = _plus(value, (number - error, number + error))
    return _wrapped(value) if is_periodic else value


@kernel
def bounds_at(table: Table, limits: Array, low: Array, high: Array) -> tuple[Array, Array]:
    """Bounds, both (m, n), of the m functions of ``table`` over boxes from ``low`` to ``high`` (n, 3).

    Angles are turned so that their bounds lie round zero; ``limits`` (m, 3) tell which are angles.
    """
    least, most = slot_ranges(table)
    count = len(table.outputs)
    lows, highs = np.empty((count, len(low))), np.empty((count, len(low)))
    for box in range(len(low)):
        for axis in range(3):
            least[axis], most[axis] = low[box, axis], high[box, axis]
        for step in range(len(table.operations)):
            _fill(table, step, least, most)
        for row in range(count):
            found = _bounds_of(table, row, limits[row, PERIODIC] != 0.0, least, most)
            lows[row, box], highs[row, box] = found
    return lows, highs


@part
def is_possible(table: Table, limits: Array, least: Array, most: Array) -> bool:
    """Whether a box may hold an attitude within ``limits`` (m, 3).

    Its ends are the first three of ``least`` and ``most``, which are of `slot_ranges`.
    """
    first = 3 + len(table.constants)
    step, result = 0, True
    for row in range(len(table.outputs)):
        # Operations are in the order of the rows that need them first.
        while result and step <= table.outputs[row] - first:
            _fill(table, step, least, most)
            step += 1
        if result:
            low, high = _bounds_of(table, row, limits[row, PERIODIC] != 0.0, least, most)
            result = low <= limits[row, GREATEST] and high >= limits[row, LEAST]
    return result


@kernel
def possible_at(table: Table, limits: Array, low: Array, high: Array) -> NDArray[np.bool_]:
    """Which boxes from ``low`` to ``high`` (n, 3) may hold an attitude within ``limits`` (m, 3)."""
    least, most = slot_ranges(table)
    result = np.empty(len(low), np.bool_)
    for box in range(len(low)):
        for axis in range(3):
            least[axis], most[axis] = low[box, axis], high[box, axis]
        result[box] = is_possible(table, limits, least, most)
    return result
