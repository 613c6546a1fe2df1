"""How a mission ended, without ROS."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from math import inf

from task_planner_node.errors import Diagnostic
from task_planner_node.parameters import Guidance
from task_planner_node.search.plans import Plan, Step
from task_planner_node.search.statistics import Statistics


class Outcome(IntEnum):
    """The numbers of geohtn_msgs/Outcome."""

    SOLVED = 0
    NO_PLAN = 1
    LIMIT = 2
    CANCELLED = 3
    INVALID = 4
    UNAVAILABLE = 5
    FAILED = 6


@dataclass(frozen=True, slots=True)
class Options:
    """How a mission is searched; ``time_budget`` in seconds, ``plans`` is how many are wanted.

    ``guidance`` is the order of tasks that advice is asked for.
    ``memory_limit`` [MiB] is what the search may take beyond what the process holds at its beginning.
    With ``linear_matching`` no fact is looked up in an index (search/linear.py): for measuring what that costs.
    """

    time_budget: float = 60.0
    max_alternatives: int = 4
    max_depth: int = 1_000_000
    optimise: bool = False
    use_advice: bool = True
    plans: int = 1
    memory_limit: int = 4096
    guidance: Guidance = 'tour'
    linear_matching: bool = False


@dataclass(frozen=True, slots=True)
class Progress:
    """Where a search stands; lengths in metres, ``elapsed`` in seconds.

    ``best_cost`` is that of the best plan so far; ``improved`` is this plan when it is new.
    """

    phase: str
    goals_reached: int = 0
    goals_total: int = 0
    requests: int = 0
    backtracks: int = 0
    depth: int = 0
    current_length: float = 0.0
    best_length: float = inf
    elapsed: float = 0.0
    best_cost: float = inf
    improved: Plan | None = None


@dataclass(frozen=True, slots=True)
class Result:
    """The outcome with its explanation; ``details`` is for explain.

    ``plans`` holds the plan when SOLVED, or several if so many were wanted, the best one first; ``improvements``
    what was told of each plan that was better than all before.
    """

    outcome: Outcome
    explanation: str
    diagnostics: tuple[Diagnostic, ...] = ()
    plans: tuple[Plan, ...] = ()
    statistics: Statistics = field(default_factory=Statistics)
    details: str = ''
    improvements: tuple[Progress, ...] = ()

    @property
    def steps(self) -> tuple[Step, ...]:
        """The actions of the best plan; empty without one."""
        return self.plans[0].steps if self.plans else ()
