"""The symbolic state: a set of facts, indexed per binding pattern, with an undo trail."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from math import inf
from operator import itemgetter
from typing import Any

Fact = tuple[Any, ...]
Bucket = tuple[Fact, ...]
# Goals tried between two looks at the limits of the search: well below 0.1 s.
LOOK_INTERVAL = 4096


class TooMuchWork(Exception):
    """An enumeration took more work than it is worth."""


class IndexPlan:
    """The binding patterns that a compiled domain looks facts up by."""

    def __init__(self) -> None:
        self._numbers: dict[tuple[str, int, tuple[int, ...]], int] = {}

    def number(self, name: str, arity: int, positions: tuple[int, ...]) -> int:
        """The index of facts ``name`` with ``arity`` arguments by those at ``positions``, from 1."""
        return self._numbers.setdefault((name, arity, positions), len(self._numbers))

    def by_predicate(self) -> dict[tuple[str, int], list[tuple[int, Callable[[Fact], Any]]]]:
        """For each predicate and length of its facts: the indices, each with how to get its key."""
        table: dict[tuple[str, int], list[tuple[int, Callable[[Fact], Any]]]] = {}
        for (name, arity, positions), number in self._numbers.items():
            key = itemgetter(*positions) if positions else _no_key
            table.setdefault((name, arity + 1), []).append((number, key))
        return table

    def __len__(self) -> int:
        return len(self._numbers)


def _no_key(_: Fact) -> tuple[()]:
    return ()


class State:
    """Facts that can be added, removed, looked up, and put back exactly as they were at a mark.

    Buckets are immutable tuples, so an enumeration survives changes that are undone before it goes on.
    With ``relaxed`` set, negative preconditions count as satisfied and every branch is open: an
    over-approximation of what can become true.  ``changed`` holds the facts that differ from the initial ones.

    ``work`` counts the goals tried by whoever enumerates; beyond ``next_look`` it calls look(), which calls
    ``watch`` and raises TooMuchWork beyond ``most_work``.
    """

    def __init__(
        self, plan: IndexPlan, facts: Iterable[Fact], watch: Callable[[], None] = lambda: None
    ) -> None:
        self.work = 0
        self.next_look = LOOK_INTERVAL
        self.most_work = inf
        self._watch = watch
        ordered = dict.fromkeys(facts)
        self.facts: set[Fact] = set(ordered)
        self.relaxed = False
        self.changed: set[Fact] = set()
        self._by_predicate = plan.by_predicate()
        self._trail: list[tuple[Fact, bool, list[tuple[dict[Any, Bucket], Any, Bucket]]]] = []
        initial: list[dict[Any, list[Fact]]] = [{} for _ in range(len(plan))]
        for fact in ordered:
            for number, key_of in self._by_predicate.get((fact[0], len(fact)), ()):
                initial[number].setdefault(key_of(fact), []).append(fact)
        self.buckets: list[dict[Any, Bucket]] = [
            {key: tuple(bucket) for key, bucket in buckets.items()} for buckets in initial
        ]

    def add(self, fact: Fact) -> bool:
        """Make ``fact`` true; False when it already was."""
        if fact in self.facts:
            return False
        self.facts.add(fact)
        self.changed ^= {fact}
        changes = []
        for number, key_of in self._by_predicate.get((fact[0], len(fact)), ()):
            buckets = self.buckets[number]
            key = key_of(fact)
            old = buckets.get(key, ())
            buckets[key] = (*old, fact)
            changes.append((buckets, key, old))
        self._trail.append((fact, True, changes))
        return True

    def remove(self, fact: Fact) -> bool:
        """Make ``fact`` false; False when it already was."""
        if fact not in self.facts:
            return False
        self.facts.remove(fact)
        self.changed ^= {fact}
        changes = []
        for number, key_of in self._by_predicate.get((fact[0], len(fact)), ()):
            buckets = self.buckets[number]
            key = key_of(fact)
            old = buckets[key]
            left = tuple(other for other in old if other != fact)
            if left:
                buckets[key] = left
            else:
                del buckets[key]
            changes.append((buckets, key, old))
        self._trail.append((fact, False, changes))
        return True

    def worked(self, amount: int) -> None:
        """Count work that is no enumeration of goals."""
        self.work += amount
        if self.work > self.next_look:
            self.look()

    def look(self) -> None:
        """Raise what the limits of the search raise, and TooMuchWork."""
        if self.work > self.most_work:
            raise TooMuchWork
        self._watch()
        self.next_look = self.work + LOOK_INTERVAL

    def mark(self) -> int:
        """A point to undo to."""
        return len(self._trail)

    def undo(self, mark: int) -> None:
        """Put everything back as it was at ``mark``."""
        trail = self._trail
        while len(trail) > mark:
            fact, added, changes = trail.pop()
            self.changed ^= {fact}
            if added:
                self.facts.remove(fact)
            else:
                self.facts.add(fact)
            for buckets, key, old in changes:
                if old:
                    buckets[key] = old
                else:
                    del buckets[key]
