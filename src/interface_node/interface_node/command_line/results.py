"""What the interface node says about a mission, without messages."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from interface_node.plan import Plan


@dataclass(frozen=True, slots=True)
class Progress:
    """Where a search stands; ``best_length`` in [m], ``elapsed`` in [s], ``best_cost`` of the best plan so far."""

    phase: str = 'starting'
    goals_reached: int = 0
    goals_total: int = 0
    requests: int = 0
    backtracks: int = 0
    best_length: float = inf
    elapsed: float = 0.0
    best_cost: float = inf


@dataclass(frozen=True, slots=True)
class MissionResult:
    """The plan, or why there is none, and the files that were written."""

    plan: Plan
    files: tuple[str, ...] = ()
