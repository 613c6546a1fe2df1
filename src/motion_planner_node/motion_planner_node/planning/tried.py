"""A tally of the destinations that were looked at on the way to an answer."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace

from motion_planner_node.codes import AttemptResult
from motion_planner_node.requests import Attempt
from motion_planner_node.robots.motion import Attitude

#: Attempts that are kept with their reasons; the others are only counted.
ATTEMPTS_KEPT = 16


@dataclass(slots=True)
class Tried:
    """What was looked at for ``agent`` and what was wrong with it, in order."""

    agent: str
    attempts: list[Attempt] = field(default_factory=list)
    counts: Counter[AttemptResult] = field(default_factory=Counter)
    examples: dict[AttemptResult, str] = field(default_factory=dict)

    def add(self, destination: Attitude, result: AttemptResult, reason: str) -> None:
        """Note one destination."""
        self.counts[result] += 1
        self.examples.setdefault(result, reason)
        if len(self.attempts) < ATTEMPTS_KEPT:
            self.attempts.append(Attempt(self.agent, destination, result, reason))

    def taken(self) -> Tried:
        """What was noted, which is no longer noted here."""
        taken = replace(self)
        self.forget()
        return taken

    def forget(self) -> None:
        """Begin anew."""
        self.attempts, self.counts, self.examples = [], Counter(), {}

    @property
    def total(self) -> int:
        """How many destinations were looked at in vain."""
        return sum(self.counts.values())
