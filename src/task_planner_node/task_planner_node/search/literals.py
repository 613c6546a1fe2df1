"""Literals of predicates that no axiom defines: membership tests and look-ups in an index."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

from task_planner_node.search.conditions import Begin, Found
from task_planner_node.search.state import Fact, Index, IndexPlan, Path, State, at
from task_planner_node.search.terms import (
    Compiled,
    Frame,
    ListPattern,
    key_builder,
    match,
    slots_of,
)

# The free parts of a literal, each with how to get it from a fact.
Free = Sequence[tuple[Callable[[Fact], Any], Compiled]]


def membership(fact: Callable[[Frame], Fact]) -> Begin:
    """Whether a ground fact holds."""
    return lambda state, frame: fact(frame) in state.facts


class Look:
    """How a literal is looked up: by the parts that are bound, also those inside of lists."""

    def __init__(
        self, name: str, terms: Sequence[Compiled], bound: set[int], maybe: set[int]
    ) -> None:
        self._name = name
        self._arity = len(terms)
        self._bound = bound
        self._paths: list[Path] = []
        self._known: list[Compiled] = []
        self._shapes: list[tuple[Path, int]] = []
        self._free: list[tuple[Path, Compiled]] = []
        for position, term in enumerate(terms, start=1):
            self._place((position,), term)
        if not self._known:
            # An index by nothing has no shapes: all facts of a predicate are in one bucket.
            self._shapes = []
            self._free = [((i,), term) for i, term in enumerate(terms, start=1)]
        slots = [term for _, term in self._free if isinstance(term, int)]
        self._plain = len(slots) == len(self._free) == len(set(slots)) and maybe.isdisjoint(slots)
        self._pairs = [(path, term) for path, term in self._free if isinstance(term, int)]

    def _place(self, path: Path, term: Compiled) -> None:
        if slots_of(term) <= self._bound:
            self._paths.append(path)
            self._known.append(term)
        elif isinstance(term, ListPattern) and term.tail is None and self._holds_known(term):
            self._shapes.append((path, len(term.items)))
            for index, item in enumerate(term.items):
                self._place((*path, index), item)
        else:
            self._free.append((path, term))

    def _holds_known(self, term: ListPattern) -> bool:
        return any(
            slots_of(item) <= self._bound
            or (isinstance(item, ListPattern) and item.tail is None and self._holds_known(item))
            for item in term.items
        )

    def index(self) -> Index:
        """The index to look in."""
        return Index(self._name, self._arity, tuple(self._paths), tuple(self._shapes))

    def key(self) -> Callable[[Frame], Any]:
        """The key to look for."""
        return key_builder(self._known)

    def absence(self, plan: IndexPlan) -> Begin | None:
        """Whether no fact fits, when that can be told by the index alone; else None."""
        if not self._plain:
            return None
        number, key = plan.number(self.index()), self.key()

        def begin(state: State, frame: Frame) -> bool:
            if state.relaxed:
                return True
            bucket = state.buckets[number].get(key(frame))
            return bucket is None or len(bucket) == bucket.dead

        return begin

    def assign(self) -> Callable[[Frame, Fact], None] | None:
        """How to bind the free parts to those of a fact, when each is another, unbound variable."""
        if not self._plain:
            return None
        if all(len(path) == 1 for path, _ in self._pairs):
            places = [(path[0], slot) for path, slot in self._pairs]
            if len(places) == 1:
                ((only, target),) = places

                def assign_one(frame: Frame, fact: Fact) -> None:
                    frame[target] = fact[only]

                return assign_one

            def assign_many(frame: Frame, fact: Fact) -> None:
                for place, slot in places:
                    frame[slot] = fact[place]

            return assign_many
        parts = [(at(path), slot) for path, slot in self._pairs]

        def assign_parts(frame: Frame, fact: Fact) -> None:
            for part, slot in parts:
                frame[slot] = part(fact)

        return assign_parts

    def free(self) -> Free:
        """The parts that are matched, with how to get them from a fact."""
        return [(at(path), term) for path, term in self._free]


def enumerating(look: Look, plan: IndexPlan) -> Begin:
    """The facts that fit, one after the other."""
    number, key = plan.number(look.index()), look.key()
    assign = look.assign()
    if assign is None:
        return _matching(number, key, look.free())
    return _assigning(number, key, assign)


def _assigning(
    number: int, key: Callable[[Frame], Any], assign: Callable[[Frame, Fact], None]
) -> Begin:
    """Look-up for the usual case: every free part is another variable, surely unbound."""

    def begin(state: State, frame: Frame) -> Found:
        bucket = state.buckets[number].get(key(frame))
        if bucket is None:
            return False
        dead = bucket.dead
        count = len(bucket) - dead
        if count == 1:
            assign(frame, state.only(bucket) if dead else bucket[0])
            return True
        if not count:
            return False
        return assigned(assign, frame, state.living(bucket) if dead else iter(bucket))

    return begin


def _matching(number: int, key: Callable[[Frame], Any], free: Free) -> Begin:
    """Look-up with patterns, repeated variables, or variables that may be bound."""

    def begin(state: State, frame: Frame) -> Found:
        bucket = state.buckets[number].get(key(frame))
        if bucket is None or len(bucket) == bucket.dead:
            return False
        return matched(free, state, frame, state.living(bucket))

    return begin


def assigned(
    assign: Callable[[Frame, Fact], None], frame: Frame, facts: Iterable[Fact]
) -> Iterator[None]:
    """Bind the free parts to those of one fact after the other."""
    for fact in facts:
        assign(frame, fact)
        yield


def matched(free: Free, state: State, frame: Frame, facts: Iterable[Fact]) -> Iterator[None]:
    """Match the free parts with those of one fact after the other."""
    for fact in facts:
        state.work += 1
        bound: list[int] = []
        if all(match(term, part(fact), frame, bound) for part, term in free):
            yield
        for slot in bound:
            frame[slot] = None
