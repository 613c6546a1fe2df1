"""A constraint rewritten as a function that must not be positive."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan, pi

import numpy as np

from motion_planner_node.functions import Array, Dual, Interval
from motion_planner_node.language.syntax import Constraint
from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.kernel import kernel

_NEVER_ZERO = float(np.nextafter(0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Row:
    """One constraint: the slots of its sides on the tape, and whether it equates angles.

    ``text`` is what was written, ``constraint`` the comparison that it stands for.
    """

    text: str
    constraint: Constraint
    comparator: str
    left: int
    right: int
    periodic: bool

    @property
    def is_equality(self) -> bool:
        """Whether both signs of the function are penalised (equation 3)."""
        return self.comparator == '='

    @property
    def is_strict(self) -> bool:
        """Whether equality of the sides does not do."""
        return self.comparator in {'<', '>'}

    @property
    def is_reversed(self) -> bool:
        """Whether the function is the right minus the left side."""
        return self.comparator in {'>', '>='}

    def function(self, left: Dual, right: Dual) -> Dual:
        """The paper's f: left minus right side, reversed for >=; angles wrapped to [-pi, pi]."""
        function = right - left if self.is_reversed else left - right
        if self.periodic:
            turns = np.round(function.value / (2.0 * pi))
            return Dual(function.value - 2.0 * pi * turns, function.gradient)
        return function

    def missed(self, values: Array) -> Array:
        """By how much the function's ``values`` miss the constraint: 0 where it holds."""
        if self.is_equality:
            missed = np.abs(values)
        else:
            missed = np.maximum(values, _NEVER_ZERO if self.is_strict else 0.0)
            missed = np.where(values < 0.0, 0.0, missed)
        return np.asarray(np.where(np.isnan(values), pi if self.periodic else np.inf, missed))

    def shown(self, side: Dual) -> str:
        """The value of one side at the first state, for people."""
        value = float(np.ravel(side.value)[0])
        if isnan(value):
            return 'undefined'
        return f'{wrap_angle(value) if self.periodic else value:.6g}'

    def bounds(self, left: Interval, right: Interval) -> Interval:
        """Bounds of ``function``; those of angles may go on beyond pi, but lie round zero."""
        function = right - left if self.is_reversed else left - right
        if not self.periodic:
            return function
        narrow = function.high - function.low < 2.0 * pi
        turns = np.where(narrow, np.round((function.low + function.high) / (4.0 * pi)), 0.0)
        shifted = function - Interval.constant(2.0 * pi) * Interval(turns, turns)
        return Interval(np.where(narrow, shifted.low, -pi), np.where(narrow, shifted.high, pi))


def wrap(angles: Array) -> Array:
    """The same angles [rad] in (-pi, pi], each as ``wrap_angle`` has it."""
    result = np.array(angles, dtype=np.float64)
    _wrap_each(result.reshape(-1))
    return result


@kernel
def _wrap_each(angles: Array) -> None:
    for index in range(len(angles)):
        angles[index] = wrap_angle(angles[index])
