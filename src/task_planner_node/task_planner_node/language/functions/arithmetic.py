"""Functions of numbers, as in Lisp; integers stay exact, and a quotient is an integer where it can be."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import reduce
from itertools import pairwise
from typing import Any

from task_planner_node.language.functions.function import (
    MAX_BITS,
    Function,
    FunctionFailed,
    bounded,
    integer,
    number,
    truth,
)

Number = int | float


def _add(*values: object) -> Number:
    return bounded(sum(number(value) for value in values))


def _subtract(first: object, *others: object) -> Number:
    if not others:
        return -number(first)
    return bounded(number(first) - sum(number(other) for other in others))


def _multiply(*values: object) -> Number:
    product: Number = 1
    for value in values:
        product = bounded(product * number(value))
    return product


def _divide(first: object, *others: object) -> Number:
    if not others:
        return _quotient(1, number(first))
    return reduce(lambda left, right: _quotient(left, number(right)), others, number(first))


def _quotient(left: Number, right: Number) -> Number:
    if right == 0:
        raise FunctionFailed('divides by 0')
    if isinstance(left, int) and isinstance(right, int) and left % right == 0:
        return left // right
    return bounded(left / right)


def _expt(base: object, exponent: object) -> Number:
    left, right = number(base), number(exponent)
    if isinstance(left, int) and isinstance(right, int) and right >= 0:
        if left.bit_length() * right > MAX_BITS + right:
            raise FunctionFailed(f'has a value of more than {MAX_BITS} bits')
        return bounded(left**right)
    if left == 0 and right < 0:
        raise FunctionFailed('divides by 0')
    try:
        power = float(left) ** float(right)
    except OverflowError:
        raise FunctionFailed('has no finite value') from None
    if isinstance(power, complex):
        raise FunctionFailed('has no real value')
    return bounded(power)


def _sqrt(value: object) -> Number:
    argument = number(value)
    if argument < 0:
        raise FunctionFailed('has no real value')
    root = math.sqrt(argument)
    return int(root) if isinstance(argument, int) and int(root) ** 2 == argument else root


def _rounding(rounded: Callable[[float], int]) -> Callable[..., int]:
    def value(dividend: object, divisor: object = 1) -> int:
        left, right = number(dividend), number(divisor)
        if right == 0:
            raise FunctionFailed('divides by 0')
        if isinstance(left, int) and isinstance(right, int):
            return rounded_exactly(left, right)
        return rounded(_quotient(left, right))

    def rounded_exactly(left: int, right: int) -> int:
        floor, rest = divmod(left, right)
        if rest == 0 or rounded is math.floor:
            return floor
        if rounded is math.ceil:
            return floor + 1
        if rounded is math.trunc:
            return floor + (1 if floor < 0 else 0)
        twice = 2 * abs(rest) - abs(right)
        return floor + (1 if twice > 0 or (twice == 0 and floor % 2) else 0)

    return value


def _mod(dividend: object, divisor: object) -> Number:
    left, right = number(dividend), number(divisor)
    if right == 0:
        raise FunctionFailed('divides by 0')
    return left % right


def _rem(dividend: object, divisor: object) -> Number:
    left, right = number(dividend), number(divisor)
    if right == 0:
        raise FunctionFailed('divides by 0')
    rest = abs(left) % abs(right)
    return -rest if left < 0 else rest


def _chain(holds: Callable[[Number, Number], bool]) -> Callable[..., Any]:
    def value(*values: object) -> Any:
        return truth(all(holds(left, right) for left, right in pairwise(map(number, values))))

    return value


def _all_different(*values: object) -> Any:
    numbers = [number(value) for value in values]
    return truth(len(set(numbers)) == len(numbers))


def _test(holds: Callable[[Number], bool]) -> Callable[[object], Any]:
    return lambda value: truth(holds(number(value)))


ARITHMETIC = (
    Function('+', _add, 0, None, 'the sum'),
    Function('-', _subtract, 1, None, 'the first minus the others; alone its opposite'),
    Function('*', _multiply, 0, None, 'the product'),
    Function('/', _divide, 1, None, 'the quotient; an integer if that is exact'),
    Function('1+', lambda value: _add(value, 1), 1, 1, 'one more'),
    Function('1-', lambda value: _subtract(value, 1), 1, 1, 'one less'),
    Function('mod', _mod, 2, 2, 'the remainder with the sign of the divisor'),
    Function('rem', _rem, 2, 2, 'the remainder with the sign of the dividend'),
    Function('min', lambda *values: min(map(number, values)), 1, None, 'the smallest'),
    Function('max', lambda *values: max(map(number, values)), 1, None, 'the largest'),
    Function('abs', lambda value: abs(number(value)), 1, 1, 'without its sign'),
    Function('floor', _rounding(math.floor), 1, 2, 'the quotient, rounded down'),
    Function('ceiling', _rounding(math.ceil), 1, 2, 'the quotient, rounded up'),
    Function('truncate', _rounding(math.trunc), 1, 2, 'the quotient, rounded towards 0'),
    Function(
        'round', _rounding(round), 1, 2, 'the quotient, rounded to the nearest (even) integer'
    ),
    Function('float', lambda value: float(number(value)), 1, 1, 'the number as a float'),
    Function('sqrt', _sqrt, 1, 1, 'the square root; an integer if that is exact'),
    Function('expt', _expt, 2, 2, 'the first to the power of the second'),
    Function('/=', _all_different, 1, None, 'whether all numbers differ'),
    Function('<', _chain(lambda a, b: a < b), 1, None, 'whether the numbers rise'),
    Function('<=', _chain(lambda a, b: a <= b), 1, None, 'whether the numbers never fall'),
    Function('>', _chain(lambda a, b: a > b), 1, None, 'whether the numbers fall'),
    Function('>=', _chain(lambda a, b: a >= b), 1, None, 'whether the numbers never rise'),
    Function('zerop', _test(lambda value: value == 0), 1, 1, 'whether it is 0'),
    Function('plusp', _test(lambda value: value > 0), 1, 1, 'whether it is above 0'),
    Function('minusp', _test(lambda value: value < 0), 1, 1, 'whether it is below 0'),
    Function('evenp', lambda value: truth(integer(value) % 2 == 0), 1, 1, 'whether it is even'),
    Function('oddp', lambda value: truth(integer(value) % 2), 1, 1, 'whether it is odd'),
)
