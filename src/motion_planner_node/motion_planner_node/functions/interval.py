"""Interval arithmetic with outward rounding: bounds that hold for every attitude of a box."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions.field import Field

Array = NDArray[np.float64]

_RELATIVE = 4.0 * np.finfo(np.float64).eps

#: More than a product loses when it underflows.
_SMALLEST = float(np.finfo(np.float64).tiny)

#: Beyond this [rad] nothing is said of the sine and cosine of an angle.
_LARGEST_ANGLE = 1e9


class Interval:
    """Numbers between ``low`` and ``high``, arrays (n,) or scalars, infinite where unbounded."""

    __slots__ = ('high', 'low')

    def __init__(self, low: Any, high: Any) -> None:
        self.low: Array = low
        self.high: Array = high

    @classmethod
    def constant(cls, value: float) -> Interval:
        """The number ``value``, or any number when it is NaN."""
        if np.isnan(value):
            return cls(np.float64(-np.inf), np.float64(np.inf))
        return cls(np.float64(value), np.float64(value))

    def __neg__(self) -> Interval:
        return Interval(-self.high, -self.low)

    def __add__(self, other: Interval) -> Interval:
        return _outward(self.low + other.low, self.high + other.high)

    def __sub__(self, other: Interval) -> Interval:
        return _outward(self.low - other.high, self.high - other.low)

    def __mul__(self, other: Interval) -> Interval:
        products = [
            np.where(np.isnan(product), 0.0, product)
            for product in (
                self.low * other.low,
                self.low * other.high,
                self.high * other.low,
                self.high * other.high,
            )
        ]
        return _outward(
            np.minimum.reduce(products) - _SMALLEST, np.maximum.reduce(products) + _SMALLEST
        )

    def __truediv__(self, other: Interval) -> Interval:
        through_zero = (other.low <= 0.0) & (other.high >= 0.0)
        low = np.where(through_zero, np.nan, 1.0 / other.high)
        high = np.where(through_zero, np.nan, 1.0 / other.low)
        return self * _outward(low, high)

    def scaled(self, factor: float) -> Interval:
        """``factor`` times the number."""
        return self * Interval.constant(factor)

    def restricted(self, _kept: Sequence[bool]) -> Interval:
        """The same bounds: intervals carry no derivatives."""
        return self

    def hypot(self, other: Interval) -> Interval:
        """Length of the vector (self, other)."""
        return _outward(
            np.hypot(self._least_magnitude(), other._least_magnitude()),
            np.hypot(self._greatest_magnitude(), other._greatest_magnitude()),
            at_least=0.0,
        )

    def arctan2(self, abscissa: Interval) -> Interval:
        """Direction [rad] of the vector (abscissa, self) in [-pi, pi]."""
        found = self.direction(abscissa)
        beyond = found.high > np.pi
        return Interval(
            np.where(beyond, -np.pi, np.maximum(found.low, -np.pi)),
            np.where(beyond, np.pi, found.high),
        )

    def direction(self, abscissa: Interval) -> Interval:
        """Direction [rad] of the vector (abscissa, self) modulo 2 pi, beyond pi where need be.

        The extremes are at corners of the box of vectors, unless the origin is inside it.
        """
        left, right = abscissa.low, abscissa.high
        low, high = self.low + 0.0, self.high + 0.0
        corners = [np.arctan2(y, x) for y in (low, high) for x in (left, right)]
        across = (low < 0.0) & (high >= 0.0) & (left < 0.0)
        turned = [np.where(across & (c < 0.0), c + 2.0 * np.pi, c) for c in corners]
        result = _outward(np.minimum.reduce(turned), np.maximum.reduce(turned))
        whole = across & (right >= 0.0)
        limit = np.where(across, 2.0 * np.pi, np.pi)
        return Interval(
            np.where(whole, -np.pi, np.maximum(result.low, -np.pi)),
            np.where(whole, np.pi, np.minimum(result.high, limit)),
        )

    def sin(self) -> Interval:
        """Sine of an angle [rad]."""
        return self._wave(np.sin, 0.5 * np.pi)

    def cos(self) -> Interval:
        """Cosine of an angle [rad]."""
        return self._wave(np.cos, 0.0)

    def __abs__(self) -> Interval:
        return Interval(self._least_magnitude(), self._greatest_magnitude())

    def minimum(self, other: Interval) -> Interval:
        """The smaller number."""
        return Interval(np.minimum(self.low, other.low), np.minimum(self.high, other.high))

    def maximum(self, other: Interval) -> Interval:
        """The larger number."""
        return Interval(np.maximum(self.low, other.low), np.maximum(self.high, other.high))

    def opaque(self, field: Field, *others: Interval) -> Interval:
        """``field`` of this number and ``others``."""
        arguments = (self, *others)
        lows = np.broadcast_arrays(*(a.low for a in arguments), *(a.high for a in arguments))
        flat = [np.ascontiguousarray(bound, dtype=np.float64).ravel() for bound in lows]
        low, high = field.bounds(*zip(flat[: len(arguments)], flat[len(arguments) :], strict=True))
        shape = lows[0].shape
        return _outward(low.reshape(shape), high.reshape(shape))

    def _wave(self, function: np.ufunc, crest: float) -> Interval:
        """A wave of period 2 pi between -1 and 1 that is 1 at ``crest``, and -1 half a turn on."""
        ends = function(self.low), function(self.high)
        low, high = np.minimum(*ends), np.maximum(*ends)
        turns = [(end - crest) / (2.0 * np.pi) for end in (self.low, self.high)]
        slack = 1e-15 * (1.0 + np.abs(turns[0]) + np.abs(turns[1]))
        first, last = turns[0] - slack, turns[1] + slack
        unknown = ~(np.maximum(np.abs(self.low), np.abs(self.high)) < _LARGEST_ANGLE)
        high = np.where(unknown | (np.ceil(first) <= np.floor(last)), 1.0, high)
        trough = np.ceil(first - 0.5) <= np.floor(last - 0.5)
        low = np.where(unknown | trough, -1.0, low)
        result = _outward(low, high, at_least=-1.0)
        return Interval(result.low, np.minimum(result.high, 1.0))

    def _least_magnitude(self) -> Array:
        return np.asarray(np.maximum(np.maximum(self.low, -self.high), 0.0))

    def _greatest_magnitude(self) -> Array:
        return np.maximum(-self.low, self.high)


def _outward(low: Array, high: Array, at_least: float = -np.inf) -> Interval:
    """The interval widened by more than the rounding of one operation; NaN becomes any number."""
    low = low - np.abs(low) * _RELATIVE
    high = high + np.abs(high) * _RELATIVE
    unknown = np.isnan(low) | np.isnan(high)
    low = np.where(unknown, -np.inf, np.maximum(low, at_least))
    return Interval(low, np.where(unknown, np.inf, high))
