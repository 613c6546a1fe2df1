"""The geometric half of the search: requests, their cache, what they prove, and advice."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from task_planner_node.language.model import show
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    BatchOracle,
    Code,
    Oracle,
    Query,
    Scope,
    Status,
    Token,
)
from task_planner_node.search.network import Task
from task_planner_node.search.statistics import Statistics

# Requests that are in flight at the same time.
MOST_TOGETHER = 8


@dataclass(frozen=True, slots=True)
class Nogood:
    """Ground preconditions that can never be met, for the starts that its key says."""

    reason: str
    objects: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Request:
    """What the motion planner is asked: the ground texts of an operator, from where the robots stand.

    ``lineage`` is the attitude that was last assigned, ``preferred`` the one to end at where that can be.
    """

    task: Task
    text: str
    behaviour: str
    start: Token
    lineage: Token
    preferred: Token | None = None

    @property
    def key(self) -> str:
        """The texts as one; no text has a line break in it."""
        return f'{self.text}\n{self.behaviour}' if self.behaviour else self.text


def _query(request: Request, alternative: int) -> Query:
    action = tuple(map(show, request.task))
    return Query(
        action, request.text, request.start, alternative, request.behaviour, request.preferred
    )


class RequestRefused(Exception):
    """The motion planner answered a request for ``task`` with an error.

    ``column`` of ``text``, the ground preconditions, is where it found the error, from 1; 0 is nowhere.
    """

    def __init__(self, request: Request, answer: Answer) -> None:
        super().__init__(answer.message)
        self.task = request.task
        self.code = answer.code
        self.message = answer.message
        self.text = request.text
        self.column = 0
        if answer.diagnostics:
            first = answer.diagnostics[0]
            self.message = first.message
            self.column = first.column if first.line == 1 else 0


class Geometry:
    """Asks the oracle, remembers every answer within one search, and learns from what is impossible.

    ``version`` grows with every new nogood.
    """

    def __init__(
        self,
        oracle: Oracle,
        statistics: Statistics,
        max_alternatives: int,
        check_limits: Callable[[], None],
    ) -> None:
        self.version = 0
        self._oracle = oracle
        self._statistics = statistics
        self._max_alternatives = max_alternatives
        self._check_limits = check_limits
        self._answers: dict[tuple[str, Token, int, Token | None], Answer] = {}
        self._nogoods: dict[tuple[Scope, Token, str], Nogood] = {}
        self._bounds: dict[Token, dict[str, float]] = {}

    def nogood(self, request: Request) -> Nogood | None:
        """Why a request cannot be met, when that is proven already."""
        for text in {request.text: None, request.key: None}:
            found = self.lasting_nogood(text, request.lineage) or self._nogoods.get(
                (Scope.THIS_START, request.start, text)
            )
            if found is not None:
                return found
        return None

    def lasting_nogood(self, text: str, lineage: Token | None) -> Nogood | None:
        """Why ``text`` cannot be met, now and after any drive.

        ``lineage`` is the attitude that was last assigned; with None only what holds everywhere counts.
        """
        everywhere = self._nogoods.get((Scope.ANY_START, (), text))
        if everywhere is not None or lineage is None:
            return everywhere
        return self._nogoods.get((Scope.CONNECTED_STARTS, lineage, text))

    def alternatives(self, request: Request) -> Iterator[Answer]:
        """One answer after the other: FOUND ones, ended by the first of another status.

        An assigned attitude is the only one.  The generator also ends at the limit of alternatives.  After the one
        that ends as preferred come all those that there are without a preference.
        """
        if request.preferred is not None:
            answer = self._ask(request, 0)
            if answer.status == Status.FOUND and answer.as_preferred:
                yield answer
            request = replace(request, preferred=None)
        for alternative in range(self._max_alternatives):
            answer = self._ask(request, alternative)
            yield answer
            if answer.status != Status.FOUND or answer.assigned:
                return

    def _ask(self, request: Request, alternative: int) -> Answer:
        key = (request.key, request.start, alternative, request.preferred)
        cached = self._answers.get(key)
        if cached is not None:
            return cached
        self._check_limits()
        self._statistics.requests += 1
        if alternative:
            self._statistics.geometric_backtracks += 1
        began = time.monotonic()
        answer = self._oracle.satisfy(_query(request, alternative))
        self._statistics.exchanged(time.monotonic() - began, answer.time_spent)
        self._statistics.answers += 1
        self._take(request, alternative, answer)
        return answer

    def ask_together(self, requests: Sequence[Request]) -> None:
        """Ask for the first destinations of several requests at once; the answers are there when they are needed.

        Nothing is asked of a motion planner that works on one request at a time.
        """
        if not isinstance(self._oracle, BatchOracle):
            return
        wanted = {(r.key, r.start, 0, None): r for r in requests if self.nogood(r) is None}
        missing = [key for key in wanted if key not in self._answers][:MOST_TOGETHER]
        if len(missing) < 2:
            return
        self._check_limits()
        began = time.monotonic()
        answers = self._oracle.satisfy_together([_query(wanted[key], 0) for key in missing])
        round_trip = time.monotonic() - began
        self._statistics.requests += len(missing)
        self._statistics.exchanged(round_trip, sum(answer.time_spent for answer in answers))
        for key, answer in zip(missing, answers, strict=True):
            self._statistics.answers += 1
            self._take(wanted[key], 0, answer)

    def _take(self, request: Request, alternative: int, answer: Answer) -> None:
        """Count and remember an answer, and learn from it."""
        if answer.status == Status.ERROR and answer.code != Code.NO_START:
            raise RequestRefused(request, answer)
        if answer.status == Status.FOUND:
            self._statistics.found += 1
        elif answer.status == Status.UNKNOWN:
            self._statistics.unknown += 1
        else:
            self._statistics.impossible += 1
            if alternative == 0:
                self._learn(request, answer.scope, answer.message, answer.objects)
        key, start, preferred = request.key, request.start, request.preferred
        self._answers[key, start, alternative, preferred] = answer
        if preferred is not None and not answer.as_preferred:
            # As without a preference.
            self._answers.setdefault((key, start, alternative, None), answer)
        elif answer.attitude is not None and not answer.assigned:
            # Whoever prefers to end there has the motion already.
            there = replace(answer, as_preferred=True)
            self._answers.setdefault((key, start, 0, answer.attitude), there)

    def _learn(self, request: Request, scope: Scope, reason: str, objects: tuple[str, ...]) -> None:
        place = {
            Scope.THIS_START: request.start,
            Scope.CONNECTED_STARTS: request.lineage,
            Scope.ANY_START: (),
        }
        self._nogoods[(scope, place[scope], request.key)] = Nogood(reason, objects)
        if scope != Scope.THIS_START:
            self.version += 1

    def lower_bounds(self, start: Token) -> Mapping[str, float]:
        """What advice said that motions from ``start`` cost at least [m], by ground text."""
        return self._bounds.get(start, {})

    def advise(self, query: AdviceQuery, lineage: Token) -> Advice:
        """Advice of any purpose; what it says to be impossible is learnt, and its lower bounds are kept."""
        self._check_limits()
        began = time.monotonic()
        advice = self._oracle.advise(query)
        self._statistics.exchanged(time.monotonic() - began, advice.time_spent)
        self._statistics.advices += 1
        bounds = self._bounds.setdefault(query.start, {})
        for text, candidate in zip(query.preconditions, advice.candidates, strict=False):
            bounds[text] = candidate.lower_bound
            request = Request((), text, '', query.start, lineage)
            if candidate.impossible and self.nogood(request) is None:
                self._learn(request, candidate.scope, candidate.message, candidate.objects)
        return advice
