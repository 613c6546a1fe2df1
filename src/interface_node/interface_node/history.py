"""How the best plan of a mission became shorter while it was searched for."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import isclose, isfinite


@dataclass(frozen=True, slots=True)
class Improvement:
    """The best plan was ``length`` [m] long ``elapsed`` [s] after the mission had begun."""

    elapsed: float
    length: float


@dataclass
class History:
    """The lengths of the best plans, as they were told."""

    improvements: list[Improvement] = field(default_factory=list)

    def note(self, elapsed: float, length: float) -> bool:
        """Note the length [m] of the best plan, infinite before the first; whether that is another one."""
        known = self.improvements
        if not isfinite(length) or (known and isclose(known[-1].length, length, rel_tol=1e-9)):
            return False
        known.append(Improvement(elapsed, length))
        return True
