"""How the best plan of a mission became shorter while it was searched for."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isfinite


@dataclass(frozen=True, slots=True)
class Improvement:
    """The best plan was ``length`` [m] long ``elapsed`` [s] after the mission had begun."""

    elapsed: float
    length: float


@dataclass
class History:
    """The best plans as they are told, in any order and perhaps more than once."""

    _by_cost: dict[float, Improvement] = field(default_factory=dict)

    def note(self, elapsed: float, length: float, cost: float) -> bool:
        """Note the best plan, of infinite cost before the first; whether it was not noted before."""
        told = Improvement(elapsed, length)
        return isfinite(cost) and self._by_cost.setdefault(cost, told) is told

    @property
    def improvements(self) -> tuple[Improvement, ...]:
        """The plans in the order in which they were found: each costs less than the one before."""
        return tuple(self._by_cost[cost] for cost in sorted(self._by_cost, reverse=True))
