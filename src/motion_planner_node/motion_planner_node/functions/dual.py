"""Batched forward-mode differentiation: a value and its derivatives by x, y and heading."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Dual:
    """Values (n,) of n attitudes and their gradients (3, n) by x, y [1/m] and heading [1/rad].

    ``gradient`` is None for a constant, whose value may also be a scalar. What is undefined is NaN
    and has no slope. At a kink the gradient is one of the one-sided ones, never NaN.
    """

    __slots__ = ('gradient', 'value')

    def __init__(self, value: Any, gradient: Array | None = None) -> None:
        self.value: Array = value
        self.gradient = gradient

    @classmethod
    def constant(cls, value: float) -> Dual:
        """A number that is the same for every attitude."""
        return cls(np.float64(value))

    def __neg__(self) -> Dual:
        return Dual(-self.value, None if self.gradient is None else -self.gradient)

    def __add__(self, other: Dual) -> Dual:
        value = self.value + other.value
        if other.gradient is None:
            return Dual(value, self.gradient)
        return Dual(
            value, other.gradient if self.gradient is None else self.gradient + other.gradient
        )

    def __sub__(self, other: Dual) -> Dual:
        value = self.value - other.value
        if other.gradient is None:
            return Dual(value, self.gradient)
        return Dual(
            value, -other.gradient if self.gradient is None else self.gradient - other.gradient
        )

    def __mul__(self, other: Dual) -> Dual:
        return Dual(
            self.value * other.value,
            _combined(other.value, self.gradient, self.value, other.gradient),
        )

    def __truediv__(self, other: Dual) -> Dual:
        quotient = self.value / other.value
        return Dual(
            quotient,
            _combined(1.0 / other.value, self.gradient, -quotient / other.value, other.gradient),
        )

    def scaled(self, factor: float) -> Dual:
        """``factor`` times the number."""
        return Dual(factor * self.value, None if self.gradient is None else factor * self.gradient)

    def hypot(self, other: Dual) -> Dual:
        """Length of the vector (self, other); at (0, 0) it grows like ``self``."""
        length = np.hypot(self.value, other.value)
        if self.gradient is None and other.gradient is None:
            return Dual(length)
        at_origin = length == 0.0
        divisor = np.where(at_origin, 1.0, length)
        along = np.where(at_origin, 1.0, self.value / divisor)
        return Dual(length, _combined(along, self.gradient, other.value / divisor, other.gradient))

    def arctan2(self, abscissa: Dual) -> Dual:
        """Direction [rad] of the vector (abscissa, self); NaN without slope for (0, 0)."""
        length = np.hypot(self.value, abscissa.value)
        at_origin = length == 0.0
        direction = np.where(at_origin, np.nan, np.arctan2(self.value, abscissa.value))
        if self.gradient is None and abscissa.gradient is None:
            return Dual(direction)
        divisor = np.where(at_origin, np.inf, length)
        return Dual(
            direction,
            _combined(
                abscissa.value / divisor / divisor,
                self.gradient,
                -self.value / divisor / divisor,
                abscissa.gradient,
            ),
        )


def _combined(
    left_factor: Array, left: Array | None, right_factor: Array, right: Array | None
) -> Array | None:
    """``left_factor * left + right_factor * right``, where None is a gradient of zero."""
    if left is None:
        return None if right is None else right_factor * right
    if right is None:
        return left_factor * left
    return left_factor * left + right_factor * right
