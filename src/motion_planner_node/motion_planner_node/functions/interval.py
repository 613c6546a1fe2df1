"""Interval arithmetic with outward rounding: bounds that hold for every attitude of a box."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_RELATIVE = 4.0 * np.finfo(np.float64).eps

#: More than a product loses when it underflows.
_SMALLEST = float(np.finfo(np.float64).tiny)


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

    def hypot(self, other: Interval) -> Interval:
        """Length of the vector (self, other)."""
        return _outward(
            np.hypot(self._least_magnitude(), other._least_magnitude()),
            np.hypot(self._greatest_magnitude(), other._greatest_magnitude()),
            at_least=0.0,
        )

    def arctan2(self, abscissa: Interval) -> Interval:
        """Any direction [rad]: nothing is known of a box that the vector's origin may lie in."""
        shape = np.broadcast(self.low, abscissa.low).shape
        return Interval(np.full(shape, -np.pi), np.full(shape, np.pi))

    def _least_magnitude(self) -> Array:
        return np.maximum(np.maximum(self.low, -self.high), 0.0)

    def _greatest_magnitude(self) -> Array:
        return np.maximum(-self.low, self.high)


def _outward(low: Array, high: Array, at_least: float = -np.inf) -> Interval:
    """The interval widened by more than the rounding of one operation; NaN becomes any number."""
    low = low - np.abs(low) * _RELATIVE
    high = high + np.abs(high) * _RELATIVE
    unknown = np.isnan(low) | np.isnan(high)
    low = np.where(unknown, -np.inf, np.maximum(low, at_least))
    return Interval(low, np.where(unknown, np.inf, high))
