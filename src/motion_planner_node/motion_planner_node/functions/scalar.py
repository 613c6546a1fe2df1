"""What the library's functions compute with: numbers whose arithmetic may carry more than a value.

A function of the library is written once, over ``Scalar``. Evaluated with ``Dual`` it yields values
and derivatives of a batch of attitudes, with ``Interval`` bounds over boxes of attitudes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

S = TypeVar('S', bound='Scalar')


class Scalar(Protocol):
    """Arithmetic that every kind of number here knows."""

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
        """Direction [rad] of the vector (abscissa, self); undefined for (0, 0)."""
        ...


@dataclass(frozen=True, slots=True)
class Place(Generic[S]):
    """Where an agent or an object is: x, y [m] and, of an agent, heading [rad]."""

    x: S
    y: S
    heading: S
