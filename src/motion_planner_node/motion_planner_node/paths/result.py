"""What a search for a path hands back."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

from motion_planner_node.robots.motion import Motion


class PathOutcome(IntEnum):
    """What came of a search; only NO_PATH leaves open whether there is a path."""

    FOUND = 0
    START_IN_OBSTACLE = 1
    GOAL_IN_OBSTACLE = 2
    UNREACHABLE = 3
    NO_PATH = 4


@dataclass(frozen=True, slots=True)
class PathResult:
    """The ``motion`` to goal number ``goal_index``; else None, -1 and a ``reason`` with numbers.

    ``goal_index`` is -1 too when the motion ends at a destination that the region has given.
    ``shut_in`` says that a close look at all that the start leads to has found no way to any goal.
    """

    outcome: PathOutcome
    motion: Motion | None = None
    goal_index: int = -1
    reason: str = ''
    shut_in: bool = False


@dataclass(frozen=True, slots=True)
class PathBudget:
    """How much is tried: counts, so that the same is tried on every machine.

    attitudes: of the lattice search at most; four times as many in its finer second try.
    improving: attitudes that the lattice search goes on for once it has a path.
    iterations: of a sampling planner.
    refinements: times that better destinations are looked for along a path.
    good_enough: nothing shorter is looked for below this multiple of the estimated length.
    """

    attitudes: int = 20000
    improving: int = 75
    iterations: int = 2000
    refinements: int = 1
    good_enough: float = 1.005
