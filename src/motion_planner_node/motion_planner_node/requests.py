"""What is asked of the motion planner, and what it answers: the messages without ROS."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf

from motion_planner_node.codes import AttemptResult, Code, Purpose, Scope, Status
from motion_planner_node.errors import Diagnostic
from motion_planner_node.robots.motion import Attitude, GeometricState, Motion

#: Label of a robot, and where it stands in the end.
End = tuple[str, Attitude]


@dataclass(frozen=True, slots=True)
class GeometricRequest:
    """Can these preconditions be met from this state, and how does the robot get there?

    ``mode`` is how destinations are computed and ``planner`` how paths are planned, as the
    parameters of these names; empty for their values.  ``preferred_end`` is where the robot that
    moves ends when that meets the preconditions and can be driven to; empty for no wish.
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
    preferred_end: GeometricState = field(default_factory=dict)


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

    With ``pairwise`` also what each would cost after each other one, and with ``places`` at which
    attitudes it is met, so many at most and ``ends`` among them, and what lies between.  For tours, candidate
    ``before[k]`` has to come before candidate ``after[k]``, ``ends`` are attitudes to improve on,
    one for each candidate or none at all, and ``effort`` is how much is tried.  Opportunities are
    looked for along ``motions``, which are driven one after the other.
    """

    preconditions: tuple[str, ...]
    start: GeometricState
    world_revision: str = ''
    seed: int = 0
    request_id: str = ''
    pairwise: bool = False
    purpose: int = Purpose.NEAREST_FIRST
    before: tuple[int, ...] = ()
    after: tuple[int, ...] = ()
    ends: tuple[End | None, ...] = ()
    effort: int = 0
    motions: tuple[Motion, ...] = ()
    places: int = 0


@dataclass(frozen=True, slots=True)
class Opportunity:
    """A ``candidate`` is met at ``end``, ``distance`` [m] along the motion number ``motion``."""

    candidate: int
    motion: int
    distance: float
    end: End


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
class Place:
    """An ``attitude`` of the robot ``agent`` at which it meets ``candidate``."""

    candidate: int
    agent: str
    attitude: Attitude


@dataclass(frozen=True, slots=True)
class AdviceAnswer:
    """Advice on every candidate, and the order in which to try them, impossible ones last.

    The pairwise costs [m] are matrices row by row, empty unless asked for; see `advice.pairwise`.
    Tours tell an end for each candidate, None where nothing is known, and the length [m] expected
    of the whole tour, infinite where no way is known.  The lengths of places [m] are a matrix
    (n + 1, n) row by row, from where the robots stand now and then from each place; empty unless
    asked for; see `advice.places`.
    """

    candidates: tuple[CandidateAdvice, ...]
    order: tuple[int, ...]
    world_revision: str = ''
    pairwise_lower_bounds: tuple[float, ...] = ()
    pairwise_estimates: tuple[float, ...] = ()
    ends: tuple[End | None, ...] = ()
    tour_length: float = 0.0
    opportunities: tuple[Opportunity, ...] = ()
    places: tuple[Place, ...] = ()
    place_lengths: tuple[float, ...] = ()
