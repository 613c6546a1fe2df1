"""Which numbers an expression can be, whatever its labels and properties stand for."""

from __future__ import annotations

from functools import lru_cache
from math import nan

import numpy as np

from motion_planner_node.functions import FUNCTIONS, Interval, Kind, Place, Surroundings
from motion_planner_node.language.linear import linear
from motion_planner_node.language.syntax import Call, Expression, Label, Negation, Operation
from motion_planner_node.language.tape import OPERATIONS

#: Least and greatest number that an argument can be; None for what is not a number.
_Ends = tuple[float, float] | None

_ANY = Interval.constant(nan)
_NOWHERE = Surroundings()

#: Functions of which it is kept what they can be, with numbers as arguments.
_KEPT = 1024


def range_of(expression: Expression) -> Interval:
    """Bounds of ``expression`` that hold in every world; it has to be free of errors."""
    if isinstance(expression, Call) and _names_labels(expression):
        return _range_of_call(expression)
    number = linear(expression).constant
    if number is not None:
        return Interval.constant(number)
    if isinstance(expression, Call):
        return _range_of_call(expression)
    with np.errstate(all='ignore'):
        if isinstance(expression, Negation):
            return -range_of(expression.operand)
        if isinstance(expression, Operation):
            left, right = range_of(expression.left), range_of(expression.right)
            result: Interval = OPERATIONS[expression.operator](left, right)
            return result
    return _ANY


def _names_labels(call: Call) -> bool:
    return any(isinstance(argument, Label) for argument in call.arguments)


def _range_of_call(call: Call) -> Interval:
    kinds = FUNCTIONS[call.name].kinds(len(call.arguments))
    assert kinds is not None
    return _range_of(call.name, tuple(map(_ends, kinds, call.arguments)))


def _ends(kind: Kind, argument: Expression) -> _Ends:
    if kind is not Kind.NUMBER and kind is not Kind.ANGLE:
        return None
    found = range_of(argument)
    return float(found.low), float(found.high)


@lru_cache(maxsize=_KEPT)
def _range_of(name: str, ends: tuple[_Ends, ...]) -> Interval:
    function = FUNCTIONS[name]
    kinds = function.kinds(len(ends))
    assert kinds is not None
    seen = (_NOWHERE,) if function.sees_world else ()
    with np.errstate(all='ignore'):
        result: Interval = function.value(*seen, *map(_unknown, kinds, ends))
    return result


def _unknown(kind: Kind, ends: _Ends) -> object:
    """An argument of which nothing is known but the ``ends`` of a number."""
    if ends is not None:
        return Interval(np.float64(ends[0]), np.float64(ends[1]))
    return _NOWHERE.region('') if kind is Kind.REGION else Place(_ANY, _ANY, _ANY)
