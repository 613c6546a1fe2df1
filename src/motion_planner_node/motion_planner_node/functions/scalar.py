"""What the library's functions compute with: numbers whose arithmetic may carry more than a value.

A function of the library is written once, over ``Scalar``. Evaluated with ``Dual`` it yields values
and derivatives of a batch of attitudes, with ``Interval`` bounds over boxes of attitudes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from motion_planner_node.functions.field import Field

S = TypeVar('S', bound='Scalar')


class Scalar(Protocol):
    """Arithmetic that every kind of number here knows."""

    def constant(self: S, value: float, /) -> S:
        """The number ``value``, of the same kind as this one."""
        ...

    def __neg__(self: S) -> S: ...
    def __add__(self: S, other: S, /) -> S: ...
    def __sub__(self: S, other: S, /) -> S: ...
    def __mul__(self: S, other: S, /) -> S: ...
    def __truediv__(self: S, other: S, /) -> S: ...

    def scaled(self: S, factor: float, /) -> S:
        """``factor`` times the number."""
        ...

    def hypot(self: S, other: S, /) -> S:
        """Length of the vector (self, other)."""
        ...

    def arctan2(self: S, abscissa: S, /) -> S:
        """Direction [rad] in (-pi, pi] of the vector (abscissa, self); undefined for (0, 0)."""
        ...

    def direction(self: S, abscissa: S, /) -> S:
        """``arctan2`` as an angle modulo 2 pi: for what is only compared modulo 2 pi.

        Bounds of it may go on beyond pi, and so are narrow for every vector that is not (0, 0).
        """
        ...

    def sin(self: S) -> S:
        """Sine of an angle [rad]."""
        ...

    def cos(self: S) -> S:
        """Cosine of an angle [rad]."""
        ...

    def __abs__(self: S) -> S: ...

    def minimum(self: S, other: S, /) -> S:
        """The smaller number."""
        ...

    def maximum(self: S, other: S, /) -> S:
        """The larger number."""
        ...

    def opaque(self: S, field: Field, /, *others: S) -> S:
        """``field`` of this number and ``others``: what arithmetic cannot express."""
        ...

    def restricted(self: S, kept: Sequence[bool], /) -> S:
        """The same number, with only the derivatives by the components that are ``kept``."""
        ...


@dataclass(frozen=True, slots=True)
class Place(Generic[S]):
    """Where an agent or an object is: x, y [m] and, of an agent, heading [rad]."""

    x: S
    y: S
    heading: S
