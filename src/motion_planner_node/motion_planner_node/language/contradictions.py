"""Constraints that exclude each other, or can never hold, whatever the attitude.

The sides of a constraint are brought to a sum of terms and a number; constraints over the same
terms bound the same quantity, and their bounds are compared. This works on texts with variables.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import isfinite, pi, remainder

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic
from motion_planner_node.language.conditions import APART
from motion_planner_node.language.linear import Linear, linear
from motion_planner_node.language.printer import number_to_text, to_text
from motion_planner_node.language.ranges import range_of
from motion_planner_node.language.syntax import Call, Condition, Constraint, Number

_TOLERANCE = 1e-9

#: Beyond this [rad] doubles no longer tell what an angle is modulo 2 pi.
_LARGEST_ANGLE = 1e6

_FLIPPED = {'<': '>', '<=': '>=', '>': '<', '>=': '<=', '=': '=', '!=': '!='}

_WORDS = {
    '<': 'less than',
    '<=': 'at most',
    '>': 'more than',
    '>=': 'at least',
    '=': 'equal to',
    '!=': 'other than',
}


@dataclass(frozen=True, slots=True)
class _Bound:
    """``quantity`` compared with ``value``: one constraint with its terms on the left.

    ``apart`` is by how much ``!=`` keeps the quantity away from the value.
    """

    quantity: tuple[tuple[str, float], ...]
    comparator: str
    value: float
    periodic: bool
    apart: float
    item: Constraint | Condition

    @property
    def is_plain(self) -> bool:
        """Whether the text says what the value is, or whether there is none to tell."""
        if isinstance(self.item, Condition):
            return True
        return Number(self.value) in {self.item.left, self.item.right}

    @property
    def name(self) -> str:
        """The quantity as a sum."""
        terms = [
            name if factor == 1.0 else f'{number_to_text(factor)} * {name}'
            for name, factor in self.quantity
        ]
        return ' + '.join(terms)


@dataclass(slots=True)
class _Known:
    """What constraints that can hold together say of one quantity."""

    low: _Bound | None = None
    high: _Bound | None = None
    angle: _Bound | None = None
    excluded: list[_Bound] = field(default_factory=list)

    def add(self, bound: _Bound) -> tuple[_Bound, ...]:
        """Take note of ``bound``; or else the bounds with which it cannot hold together."""
        if bound.periodic:
            return self._add_angle(bound)
        low, high = self.low, self.high
        if bound.comparator in {'>', '>=', '='} and (low is None or _is_tighter(bound, low, 1.0)):
            low = bound
        if bound.comparator in {'<', '<=', '='} and (
            high is None or _is_tighter(bound, high, -1.0)
        ):
            high = bound
        others: tuple[_Bound | None, ...] = ()
        if low is not None and high is not None:
            if _exclude(low, high):
                others = low, high
            for apart in (bound,) if bound.comparator == '!=' else self.excluded:
                if not others and _pinned(low, high, apart):
                    others = low, high, apart
        found = tuple(dict.fromkeys(item for item in others if item and item is not bound))
        if not found:
            self.low, self.high = low, high
            if bound.comparator == '!=':
                self.excluded.append(bound)
        return found

    def _add_angle(self, bound: _Bound) -> tuple[_Bound, ...]:
        if bound.comparator == '!=':
            if self.angle and _is_same_angle(self.angle, bound):
                return (self.angle,)
            self.excluded.append(bound)
            return ()
        if self.angle and not _is_same_angle(self.angle, bound):
            return (self.angle,)
        for other in self.excluded:
            if _is_same_angle(bound, other):
                return (other,)
        self.angle = self.angle or bound
        return ()


def contradictions(
    items: Iterable[tuple[Constraint | Condition, Constraint, bool]],
) -> tuple[Diagnostic, ...]:
    """Errors with both places and numbers.

    Each item comes with the comparison that it asks for, and whether that is an equality modulo
    2 pi. The items have to be free of other errors.
    """
    found: list[Diagnostic] = []
    known: dict[tuple[bool, tuple[tuple[str, float], ...]], _Known] = {}
    for item, constraint, modulo in items:
        form = _form(constraint)
        reason = _never_holds(constraint, form, modulo)
        if reason:
            found.append(_diagnostic(item, f'{to_text(item)} never holds: {reason}'))
            continue
        bound = _bound(item, constraint, form, modulo)
        if bound is not None:
            others = known.setdefault((bound.periodic, bound.quantity), _Known()).add(bound)
            if others:
                found.append(_diagnostic(item, _sentence((*others, bound))))
    return tuple(found)


def _diagnostic(item: Constraint | Condition, message: str) -> Diagnostic:
    return Diagnostic(message, item.line, item.column, to_text(item), code=Code.CONTRADICTION)


def _sentence(bounds: tuple[_Bound, ...]) -> str:
    """Who excludes whom; and the numbers, where they do not stand in the text like that."""
    *first, last = (to_text(bound.item) for bound in bounds)
    sentence = f'{", ".join(first)} and {last} exclude each other'
    if all(bound.is_plain for bound in bounds):
        return sentence
    *least, most = (f'{_WORDS[bound.comparator]} {_rounded(bound.value)}' for bound in bounds)
    return f'{sentence}: {bounds[0].name} cannot be {", ".join(least)} and {most}'


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
    left, right = range_of(constraint.left), range_of(constraint.right)
    comparator = constraint.comparator
    too_high = (comparator in {'<=', '='} and left.low > right.high) or (
        comparator == '<' and left.low >= right.high
    )
    too_low = (comparator in {'>=', '='} and left.high < right.low) or (
        comparator == '>' and left.high <= right.low
    )
    if not too_high and not too_low:
        return ''
    sides = (constraint.left, left, too_high), (constraint.right, right, too_low)
    for side, numbers, is_least in sides:
        limit = float(numbers.low if is_least else numbers.high)
        if linear(side).constant is None and isfinite(limit):
            return f'{to_text(side)} is at {"least" if is_least else "most"} {_rounded(limit)}'
    return 'the two sides cannot come together'


def _rounded(value: float) -> str:
    return number_to_text(round(value, 9) + 0.0)


def _holds(comparator: str, difference: float, slack: float) -> bool:
    """Whether ``difference`` compared with 0 holds, in doubt yes; strict ones in doubt not."""
    return {
        '<': difference < 0.0,
        '<=': difference <= slack,
        '>': difference > 0.0,
        '>=': difference >= -slack,
        '=': abs(difference) <= slack,
    }[comparator]


def _is_tighter(one: _Bound, other: _Bound, sign: float) -> bool:
    """Whether a lower (sign 1) or upper bound (-1) allows less than the other."""
    first, second = sign * one.value, sign * other.value
    is_strict = one.comparator in {'<', '>'} and other.comparator not in {'<', '>'}
    return first > second or (first == second and is_strict)


def _exclude(low: _Bound, high: _Bound) -> bool:
    slack = _TOLERANCE * max(1.0, abs(low.value))
    is_strict = low.comparator == '>' or high.comparator == '<'
    return low.value > high.value + slack or (low.value >= high.value and is_strict)


def _pinned(low: _Bound, high: _Bound, excluded: _Bound) -> bool:
    """Whether all between two bounds is too near to a value that is excluded."""
    gap = max(excluded.value - low.value, high.value - excluded.value)
    return gap <= excluded.apart


def _is_same_angle(one: _Bound, other: _Bound) -> bool:
    return abs(remainder(one.value - other.value, 2.0 * pi)) <= _TOLERANCE


def _form(constraint: Constraint) -> Linear:
    """The left minus the right side."""
    return linear(constraint.left).plus(linear(constraint.right), -1.0)


def _bound(
    item: Constraint | Condition, constraint: Constraint, form: Linear, modulo: bool
) -> _Bound | None:
    """The bound that a constraint is; None where nothing is known of its sides.

    ``form`` is its left minus its right side.
    """
    periodic = modulo
    if isinstance(item, Constraint) and item.comparator == '!=':
        # Solved as abs(...) or angle_between(...): what is apart are its own sides.
        periodic = isinstance(constraint.left, Call) and constraint.left.name == 'angle_between'
        constraint, form = item, _form(item)
    if not form.terms:
        return None
    first = min(form.terms)
    factor = form.terms[first]
    value = -form.number / factor
    if not isfinite(value) or (periodic and (abs(factor) != 1.0 or abs(value) > _LARGEST_ANGLE)):
        return None
    quantity = tuple((name, form.terms[name] / factor) for name in sorted(form.terms))
    comparator = constraint.comparator if factor > 0.0 else _FLIPPED[constraint.comparator]
    return _Bound(quantity, comparator, value, periodic, APART / abs(factor), item)
