"""Batched forward-mode differentiation: a value and its derivatives by x, y and heading."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions.field import Field

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

    def restricted(self, kept: Sequence[bool]) -> Dual:
        """The same values with only the derivatives by the components that are ``kept``."""
        if self.gradient is None:
            return self
        return Dual(self.value, np.where(np.array(kept)[:, None], self.gradient, 0.0))

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
        """Direction [rad] in (-pi, pi] of (abscissa, self); NaN without slope for (0, 0)."""
        length = np.hypot(self.value, abscissa.value)
        at_origin = length == 0.0
        direction = np.where(at_origin, np.nan, np.arctan2(self.value + 0.0, abscissa.value))
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

    def direction(self, abscissa: Dual) -> Dual:
        """The same as ``arctan2``."""
        return self.arctan2(abscissa)

    def sin(self) -> Dual:
        """Sine of an angle [rad]."""
        return Dual(np.sin(self.value), _combined(np.cos(self.value), self.gradient))

    def cos(self) -> Dual:
        """Cosine of an angle [rad]."""
        return Dual(np.cos(self.value), _combined(-np.sin(self.value), self.gradient))

    def __abs__(self) -> Dual:
        sign = np.where(self.value < 0.0, -1.0, 1.0)
        return Dual(np.abs(self.value), _combined(sign, self.gradient))

    def minimum(self, other: Dual) -> Dual:
        """The smaller number, this one where they are equal."""
        first = np.where(self.value <= other.value, 1.0, 0.0)
        value = np.minimum(self.value, other.value)
        return Dual(value, _combined(first, self.gradient, 1.0 - first, other.gradient))

    def maximum(self, other: Dual) -> Dual:
        """The larger number, this one where they are equal."""
        return -((-self).minimum(-other))

    def opaque(self, field: Field, *others: Dual) -> Dual:
        """``field`` of this number and ``others``."""
        arguments = (self, *others)
        values = np.broadcast_arrays(*(argument.value for argument in arguments))
        flat = [np.ascontiguousarray(value, dtype=np.float64).ravel() for value in values]
        result = field.values(*flat).reshape(values[0].shape)
        gradient = None
        if any(argument.gradient is not None for argument in arguments):
            slopes = field.slopes(*flat)
            for slope, argument in zip(slopes, arguments, strict=True):
                term = _combined(slope.reshape(values[0].shape), argument.gradient)
                if term is not None:
                    gradient = term if gradient is None else gradient + term
        return Dual(result, gradient)


def _combined(
    left_factor: Array,
    left: Array | None,
    right_factor: Array | float = 0.0,
    right: Array | None = None,
) -> Array | None:
    """``left_factor * left + right_factor * right``, where None is a gradient of zero."""
    if left is None:
        return None if right is None else right_factor * right
    if right is None:
        return left_factor * left
    return left_factor * left + right_factor * right
