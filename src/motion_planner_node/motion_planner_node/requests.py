"""What is asked of the motion planner, and what it answers: the messages without ROS."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from motion_planner_node.codes import AttemptResult, Code, Scope, Status
from motion_planner_node.errors import Diagnostic
from motion_planner_node.robots.motion import Attitude, GeometricState, Motion


@dataclass(frozen=True, slots=True)
class GeometricRequest:
    """Can these preconditions be met from this state, and how does the robot get there?

    ``mode`` is how destinations are computed and ``planner`` how paths are planned, as the
    parameters of these names; empty for their values.
    """

    preconditions: str
    start: GeometricState = field(default_factory=dict)
    agent: str = ''
    behaviour: str = ''
    alternative: int = 0
    world_revision: str = ''
    seed: int = 0
    time_budget: float = 0.0
    request_id: str = ''
    mode: str = ''
    planner: str = ''


@dataclass(frozen=True, slots=True)
class Residual:
    """How well a constraint is met: ``violation`` is 0 when it is, in the function's own unit."""

    constraint: str
    violation: float
    satisfied: bool


@dataclass(frozen=True, slots=True)
class Attempt:
    """One destination that was looked at, and what came of it."""

    agent: str
    destination: Attitude
    result: AttemptResult
    reason: str


@dataclass(frozen=True, slots=True)
class GeometricAnswer:
    """What was found out; ``end``, ``motion`` and what is said of it hold when FOUND.

    ``duration`` [s] is that of the motion at the robot's speeds, ``clearance`` [m] the least distance
    that its body has from obstacles and the edge of the map on the way.
    """

    code: Code
    message: str = ''
    scope: Scope = Scope.THIS_START
    agent: str = ''
    objects: tuple[str, ...] = ()
    world_revision: str = ''
    end: GeometricState = field(default_factory=dict)
    assigned: bool = False
    motion: Motion | None = None
    duration: float = 0.0
    clearance: float = 0.0
    residuals: tuple[Residual, ...] = ()
    attempts: tuple[Attempt, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    advice: str = ''

    @property
    def status(self) -> Status:
        """FOUND, IMPOSSIBLE, UNKNOWN or ERROR, by the code."""
        return self.code.status

    @property
    def length(self) -> float:
        """Length [m] of the motion; 0 without one."""
        return self.motion.length if self.motion else 0.0


@dataclass(frozen=True, slots=True)
class AdviceRequest:
    """What would each of these ground precondition texts cost from ``start``?

    With ``pairwise`` also what each would cost after each other one.
    """

    preconditions: tuple[str, ...]
    start: GeometricState
    world_revision: str = ''
    seed: int = 0
    request_id: str = ''
    pairwise: bool = False


@dataclass(frozen=True, slots=True)
class CandidateAdvice:
    """Costs [m] of one candidate: no motion is shorter than ``lower_bound``."""

    lower_bound: float = 0.0
    estimate: float = inf
    impossible: bool = False
    scope: Scope = Scope.THIS_START
    code: Code = Code.NONE
    message: str = ''
    objects: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class AdviceAnswer:
    """Advice on every candidate, and the order in which to try them, impossible ones last.

    The pairwise costs [m] are matrices row by row, empty unless asked for; see `advice.pairwise`.
    """

    candidates: tuple[CandidateAdvice, ...]
    order: tuple[int, ...]
    world_revision: str = ''
    pairwise_lower_bounds: tuple[float, ...] = ()
    pairwise_estimates: tuple[float, ...] = ()
