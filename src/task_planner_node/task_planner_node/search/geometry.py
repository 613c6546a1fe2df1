"""The geometric half of the search: requests, their cache, what they prove, and advice."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from task_planner_node.language.model import show
from task_planner_node.oracle import (
    INVALID_CODES,
    Answer,
    Code,
    Oracle,
    Query,
    Scope,
    Status,
    Token,
)
from task_planner_node.search.network import Task
from task_planner_node.search.statistics import Statistics

MOST_ADVISED = 1000


@dataclass(frozen=True, slots=True)
class Nogood:
    """Ground preconditions that can never be met, for the starts that its key says."""

    reason: str
    objects: tuple[str, ...]


class RequestRefused(Exception):
    """The motion planner answered a request for ``task`` with an error.

    ``column`` of ``text``, the ground preconditions, is where it found the error, from 1; 0 is nowhere.
    """

    def __init__(self, task: Task, text: str, answer: Answer) -> None:
        super().__init__(answer.message)
        self.task = task
        self.code = answer.code
        self.message = answer.message
        self.text = text
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
        self._answers: dict[tuple[str, Token, int], Answer] = {}
        self._nogoods: dict[tuple[Scope, Token, str], Nogood] = {}
        self._ranks: dict[Token, dict[str, int]] = {}

    def nogood(self, text: str, start: Token, lineage: Token) -> Nogood | None:
        """Why ``text`` cannot be met from ``start``, when that is proven already."""
        return self.lasting_nogood(text, lineage) or self._nogoods.get(
            (Scope.THIS_START, start, text)
        )

    def lasting_nogood(self, text: str, lineage: Token | None) -> Nogood | None:
        """Why ``text`` cannot be met, now and after any drive.

        ``lineage`` is the attitude that was last assigned; with None only what holds everywhere counts.
        """
        everywhere = self._nogoods.get((Scope.ANY_START, (), text))
        if everywhere is not None or lineage is None:
            return everywhere
        return self._nogoods.get((Scope.CONNECTED_STARTS, lineage, text))

    def alternatives(self, task: Task, text: str, start: Token, lineage: Token) -> Iterator[Answer]:
        """One answer after the other: FOUND ones, ended by the first of another status.

        An assigned attitude is the only one.  The generator also ends at the limit of alternatives.
        """
        for alternative in range(self._max_alternatives):
            answer = self._ask(task, text, start, lineage, alternative)
            yield answer
            if answer.status != Status.FOUND or answer.assigned:
                return

    def _ask(self, task: Task, text: str, start: Token, lineage: Token, alternative: int) -> Answer:
        key = (text, start, alternative)
        cached = self._answers.get(key)
        if cached is not None:
            return cached
        self._check_limits()
        action = tuple(show(part) for part in task)
        self._statistics.requests += 1
        if alternative:
            self._statistics.geometric_backtracks += 1
        began = time.monotonic()
        answer = self._oracle.satisfy(Query(action, text, start, alternative))
        self._statistics.exchanged(time.monotonic() - began, answer.time_spent)
        self._statistics.answers += 1
        if answer.status == Status.ERROR and answer.code != Code.NO_START:
            raise RequestRefused(task, text, answer)
        if answer.status == Status.FOUND:
            self._statistics.found += 1
        elif answer.status == Status.UNKNOWN:
            self._statistics.unknown += 1
        else:
            self._statistics.impossible += 1
            if alternative == 0:
                self._learn(text, answer.scope, start, lineage, answer.message, answer.objects)
        self._answers[key] = answer
        return answer

    def _learn(
        self,
        text: str,
        scope: Scope,
        start: Token,
        lineage: Token,
        reason: str,
        objects: tuple[str, ...],
    ) -> None:
        place = {Scope.THIS_START: start, Scope.CONNECTED_STARTS: lineage, Scope.ANY_START: ()}
        self._nogoods[(scope, place[scope], text)] = Nogood(reason, objects)
        if scope != Scope.THIS_START:
            self.version += 1

    def ranks(
        self, start: Token, lineage: Token, texts: Sequence[str], ask: bool
    ) -> dict[str, int]:
        """Advised places of ground texts, the lowest to try first; asked for where one is not known.

        With ``ask`` False only what is known already counts.  Texts that the motion planner cannot work on come
        first of all, so that their fault is told at once.
        """
        known = self._ranks.setdefault(start, {})
        wanted = list(dict.fromkeys(texts))[:MOST_ADVISED]
        if not ask or len(wanted) < 2 or all(text in known for text in wanted):
            return known
        self._check_limits()
        began = time.monotonic()
        advice = self._oracle.advise(start, wanted)
        self._statistics.exchanged(time.monotonic() - began, advice.time_spent)
        self._statistics.advices += 1
        for text, candidate in zip(wanted, advice.candidates, strict=False):
            if candidate.impossible and self.nogood(text, start, lineage) is None:
                self._learn(
                    text, candidate.scope, start, lineage, candidate.message, candidate.objects
                )
        order = [index for index in advice.order if 0 <= index < len(wanted)]
        known.clear()
        known.update({text: len(wanted) for text in wanted})
        known.update({wanted[index]: place for place, index in enumerate(order)})
        faulty = [
            t for t, c in zip(wanted, advice.candidates, strict=False) if c.code in INVALID_CODES
        ]
        known.update(dict.fromkeys(faulty, -1))
        return known
