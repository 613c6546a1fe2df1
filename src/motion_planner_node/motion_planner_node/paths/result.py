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
    """The ``motion`` to goal number ``goal_index``; else None, -1 and a ``reason`` with numbers."""

    outcome: PathOutcome
    motion: Motion | None = None
    goal_index: int = -1
    reason: str = ''


@dataclass(frozen=True, slots=True)
class PathBudget:
    """How much is tried: counts, so that the same is tried on every machine.

    iterations: of the sampling planner, in one attempt.
    attempts: of the sampling planner to find different ways round obstacles to one goal.
    goals: that the sampling planner is run for, the most promising ones.
    good_enough: no shorter motion is looked for below this multiple of the estimated length.
    """

    iterations: int = 2000
    attempts: int = 6
    goals: int = 2
    good_enough: float = 1.02
