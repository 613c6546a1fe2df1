"""What the search asks of a motion planner, and what it hears: the messages as far as the search opens them.

A geometric state is a token: hashable, equal when the attitudes are, and passed on unopened.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Protocol, runtime_checkable

from task_planner_node.errors import Diagnostic

Token = Hashable


class Status(IntEnum):
    """What an answer says about its request: the numbers of geohtn_msgs/GeometricAnswer."""

    FOUND = 0
    IMPOSSIBLE = 1
    UNKNOWN = 2
    ERROR = 3


class Scope(IntEnum):
    """The starts from which an IMPOSSIBLE holds."""

    THIS_START = 0
    CONNECTED_STARTS = 1
    ANY_START = 2


class Code(IntEnum):
    """The causes that the search tells apart; every other number is passed on as it is."""

    START_IN_OBSTACLE = 104
    INVALID_PRECONDITIONS = 300
    UNKNOWN_AGENT = 301
    UNKNOWN_OBJECT = 302
    UNKNOWN_FUNCTION = 303
    UNKNOWN_PROPERTY = 304
    NO_START = 306
    NO_WORLD = 307
    WORLD_CHANGED = 308
    UNSUPPORTED = 309


INVALID_CODES = frozenset(
    {
        Code.INVALID_PRECONDITIONS,
        Code.UNKNOWN_AGENT,
        Code.UNKNOWN_OBJECT,
        Code.UNKNOWN_FUNCTION,
        Code.UNKNOWN_PROPERTY,
        Code.UNSUPPORTED,
    }
)


@dataclass(frozen=True, slots=True)
class Query:
    """Can these ground preconditions be met from ``start``?  ``action`` is for people and logs.

    ``behaviour`` holds constraints on the motion itself.  ``preferred`` is an attitude of the agent to end at where
    that can be; otherwise, and for further alternatives, the answer is as without.
    """

    action: tuple[str, ...]
    preconditions: str
    start: Token
    alternative: int
    behaviour: str = ''
    preferred: Token | None = None


@dataclass(frozen=True, slots=True)
class Answer:
    """``end`` and ``length`` [m] hold when FOUND; ``payload`` is the message for the plan, unopened.

    ``attitude`` is that of the agent that moved, in ``end``; ``as_preferred`` tells that it is the one that the
    query preferred.
    """

    status: Status
    code: int = 0
    scope: Scope = Scope.THIS_START
    message: str = ''
    end: Token = ()
    assigned: bool = False
    length: float = 0.0
    objects: tuple[str, ...] = ()
    diagnostics: tuple[Diagnostic, ...] = ()
    time_spent: float = 0.0
    payload: object = field(default=None, compare=False)
    attitude: Token | None = None
    as_preferred: bool = False


class Purpose(IntEnum):
    """What the order of an advice is for: the numbers of geohtn_msgs/AdviceRequest."""

    NEAREST_FIRST = 0
    SHORTEST_TOUR = 1
    FIXED_ORDER = 2
    OPPORTUNITIES = 3


@dataclass(frozen=True, slots=True)
class AdviceQuery:
    """What is to be known of candidates, at most 1000 ground texts, from ``start``.

    ``precedences`` are pairs of indices, the first of which has to come before the second.  ``ends`` are known
    attitudes of the agent for the candidates, None where there is none, to improve on with growing ``effort``.
    ``motions`` are the FOUND answers of a plan whose motions are looked along, one after the other.
    So many ``places`` of each candidate, at most and with the ``ends`` among them, and what lies between are asked
    for too.
    """

    start: Token
    preconditions: tuple[str, ...]
    purpose: Purpose = Purpose.NEAREST_FIRST
    precedences: tuple[tuple[int, int], ...] = ()
    ends: tuple[Token | None, ...] = ()
    effort: int = 0
    motions: tuple[Answer, ...] = ()
    places: int = 0


@dataclass(frozen=True, slots=True)
class CandidateAdvice:
    """What is known of one candidate; ``code`` and ``message`` say why it is impossible.

    No motion that meets it is shorter than ``lower_bound`` [m].
    """

    impossible: bool = False
    scope: Scope = Scope.THIS_START
    code: int = 0
    message: str = ''
    objects: tuple[str, ...] = ()
    lower_bound: float = 0.0


@dataclass(frozen=True, slots=True)
class Opportunity:
    """The candidate of that index is met ``distance`` [m] along a motion, where the agent is at ``end``."""

    candidate: int
    motion: int
    distance: float
    end: Token


@dataclass(frozen=True, slots=True)
class Place:
    """An attitude at which the candidate of that index is met."""

    candidate: int
    attitude: Token


@dataclass(frozen=True, slots=True)
class Advice:
    """Advice on every candidate, and their indices in the order to try; empty when there is none.

    ``ends`` are the attitudes of a tour, in the order of the candidates, None where none is known; ``opportunities``
    are in the order in which they come up.  ``place_lengths`` [m] are what is expected from where the robots stand to
    each of n places, and then from each of these, (n + 1, n) row by row; infinite between those of different robots.
    """

    candidates: tuple[CandidateAdvice, ...]
    order: tuple[int, ...]
    time_spent: float = 0.0
    ends: tuple[Token | None, ...] = ()
    opportunities: tuple[Opportunity, ...] = ()
    places: tuple[Place, ...] = ()
    place_lengths: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class TextCheck:
    """What is wrong with geometric preconditions, and whether they set an attitude."""

    assigns: bool
    diagnostics: tuple[Diagnostic, ...] = ()


class Oracle(Protocol):
    """A motion planner.

    Every method raises GeometryUnavailable when it does not answer, and Cancelled or LimitReached when the
    mission ends while it waits.
    """

    def check(self, text: str, source: str, line: int, column: int) -> TextCheck:
        """Check a text, possibly with variables, that begins at ``line`` and ``column`` of ``source``."""

    def satisfy(self, query: Query) -> Answer:
        """Answer one request."""

    def advise(self, query: AdviceQuery) -> Advice:
        """Advise on candidates."""


@runtime_checkable
class BatchOracle(Protocol):
    """A motion planner that can work on several requests at once; it raises what an Oracle raises."""

    def satisfy_together(self, queries: Sequence[Query]) -> Sequence[Answer]:
        """Answer several requests, in their order."""
