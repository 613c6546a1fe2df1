"""Constraints that exclude each other, or can never hold, whatever the attitude.

The sides of a constraint are brought to a sum of terms and a number; constraints over the same
terms bound the same quantity, and their bounds are compared. This works on texts with variables.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, nan, pi, remainder

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic
from motion_planner_node.functions import Interval
from motion_planner_node.language.linear import Linear, linear
from motion_planner_node.language.printer import number_to_text, to_text
from motion_planner_node.language.syntax import Condition, Constraint
from motion_planner_node.language.tape import Tape

_TOLERANCE = 1e-9

#: Beyond this [rad] doubles no longer tell what an angle is modulo 2 pi.
_LARGEST_ANGLE = 1e6

_FLIPPED = {'<': '>', '<=': '>=', '>': '<', '>=': '<=', '=': '='}


@dataclass(frozen=True, slots=True)
class _Bound:
    """``quantity`` compared with ``value``: one constraint with its terms on the left."""

    quantity: tuple[tuple[str, float], ...]
    comparator: str
    value: float
    periodic: bool
    item: Constraint | Condition


def contradictions(
    items: Iterable[tuple[Constraint | Condition, Constraint, bool]],
) -> tuple[Diagnostic, ...]:
    """Errors with both places and numbers.

    Each item comes with the comparison that it asks for, and whether that is an equality modulo
    2 pi. The items have to be free of other errors.
    """
    found: list[Diagnostic] = []
    bounds: dict[tuple[tuple[str, float], ...], list[_Bound]] = {}
    for item, constraint, modulo in items:
        form = linear(constraint.left).plus(linear(constraint.right), -1.0)
        reason = _never_holds(constraint, form, modulo)
        if reason:
            found.append(_diagnostic(item, f'{to_text(item)} never holds: {reason}'))
            continue
        bound = _bound(item, constraint, form, modulo) if form.terms else None
        if bound is None:
            continue
        others = bounds.setdefault(bound.quantity, [])
        for other in others:
            if _exclude(other, bound):
                found.append(_diagnostic(item, _sentence(other, bound)))
                break
        others.append(bound)
    return tuple(found)


def _diagnostic(item: Constraint | Condition, message: str) -> Diagnostic:
    return Diagnostic(message, item.line, item.column, to_text(item), code=Code.CONTRADICTION)


def _sentence(first: _Bound, second: _Bound) -> str:
    return f'{to_text(first.item)} and {to_text(second.item)} exclude each other'


def _never_holds(constraint: Constraint, form: Linear, periodic: bool) -> str:
    """Why no attitude at all meets the constraint; empty if that is not certain."""
    number = form.number
    if periodic and (form.terms or abs(number) > _LARGEST_ANGLE):
        return ''
    if not form.terms:
        off = abs(remainder(number, 2.0 * pi)) if periodic else number
        slack = _TOLERANCE * max(1.0, abs(number))
        if _holds(constraint.comparator, off, slack):
            return ''
        return f'the left side minus the right side is {number_to_text(number)}'
    tape = Tape('', {})
    left, right = tape.slot(constraint.left), tape.slot(constraint.right)
    whole = Interval.constant(nan)
    with np.errstate(all='ignore'):
        values = tape.run((whole, whole, whole), Interval.constant)
        difference = values[left] - values[right]
    comparator = constraint.comparator
    lower = (comparator in {'<=', '='} and difference.low > 0.0) or (
        comparator == '<' and difference.low >= 0.0
    )
    upper = (comparator in {'>=', '='} and difference.high < 0.0) or (
        comparator == '>' and difference.high <= 0.0
    )
    if not lower and not upper:
        return ''
    for side, slot, is_low in ((constraint.left, left, lower), (constraint.right, right, upper)):
        limit = values[slot].low if is_low else values[slot].high
        if tape.constant(slot) is None and np.isfinite(limit):
            return f'{to_text(side)} is at {"least" if is_low else "most"} {_rounded(limit)}'
    return 'the two sides cannot come together'


def _rounded(value: np.float64 | NDArray[np.float64]) -> str:
    return number_to_text(round(float(value), 9) + 0.0)


def _holds(comparator: str, difference: float, slack: float) -> bool:
    """Whether ``difference`` compared with 0 holds, in doubt yes; strict ones in doubt not."""
    return {
        '<': difference < 0.0,
        '<=': difference <= slack,
        '>': difference > 0.0,
        '>=': difference >= -slack,
        '=': abs(difference) <= slack,
    }[comparator]


def _exclude(first: _Bound, second: _Bound) -> bool:
    if first.periodic or second.periodic:
        both = first.periodic and second.periodic
        return both and abs(remainder(first.value - second.value, 2.0 * pi)) > _TOLERANCE
    (low, low_strict), (high, high_strict) = _range((first, second))
    slack = _TOLERANCE * max(1.0, abs(first.value))
    return low > high + slack or (low >= high and (low_strict or high_strict))


def _range(bounds: Sequence[_Bound]) -> tuple[tuple[float, bool], tuple[float, bool]]:
    """The highest lower and the lowest upper bound, each with whether it is strict."""
    lower = [(b.value, b.comparator == '>') for b in bounds if b.comparator in {'>', '>=', '='}]
    upper = [(b.value, b.comparator != '<') for b in bounds if b.comparator in {'<', '<=', '='}]
    low = max(lower, default=(-inf, False))
    high, not_strict = min(upper, default=(inf, True))
    return low, (high, not not_strict)


def _bound(
    item: Constraint | Condition, constraint: Constraint, form: Linear, periodic: bool
) -> _Bound | None:
    first = min(form.terms)
    factor = form.terms[first]
    value = -form.number / factor
    if not isfinite(value) or (periodic and (abs(factor) != 1.0 or abs(value) > _LARGEST_ANGLE)):
        return None
    quantity = tuple((name, form.terms[name] / factor) for name in sorted(form.terms))
    comparator = constraint.comparator if factor > 0.0 else _FLIPPED[constraint.comparator]
    return _Bound(quantity, comparator, value, periodic, item)
