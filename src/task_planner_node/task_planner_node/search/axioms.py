"""Axioms: the predicates that they define, compiled anew for every binding pattern that is asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from task_planner_node.errors import MissionError
from task_planner_node.language.model import Axiom, show
from task_planner_node.language.source import Source
from task_planner_node.search.compilation import Compiler
from task_planner_node.search.conditions import Begin, Conjunction
from task_planner_node.search.heads import Bind, Head
from task_planner_node.search.state import Fact, Index, State
from task_planner_node.search.terms import (
    Compiled,
    Frame,
    Slots,
    build,
    builder,
    match,
    slots_of,
)

Known = tuple[bool, ...]


@dataclass(frozen=True, slots=True, eq=False)
class _CompiledAxiom:
    """One axiom for one binding pattern."""

    bind: Bind
    bodies: tuple[Conjunction, ...]
    terms: tuple[Compiled, ...]
    slots: tuple[int, ...]
    axiom: Axiom


@dataclass(frozen=True, slots=True)
class _Variant:
    """What defines a predicate for one binding pattern: an index of facts, and axioms."""

    number: int
    positions: tuple[int, ...]
    axioms: tuple[_CompiledAxiom, ...]


class Proofs:
    """Ground literals that are being derived, and what became of others meanwhile.

    What could not be derived may have lacked a literal that was open: it is settled when that one cannot be derived
    either, and is tried again when something can.
    """

    def __init__(self) -> None:
        self.open: set[Fact] = set()
        self.derived: set[Fact] = set()
        self.failed: set[Fact] = set()

    def settle(self, fact: Fact, derived: bool) -> None:
        """An open literal was derived, or could not be."""
        self.open.discard(fact)
        if not self.open:
            self.derived.clear()
            self.failed.clear()
        elif derived:
            self.derived.add(fact)
            self.failed.clear()
        else:
            self.failed.add(fact)


class DerivedPredicate:
    """A predicate that holds for facts and where an axiom says so."""

    def __init__(
        self,
        name: str,
        arity: int,
        axioms: Sequence[Axiom],
        source: Source,
        compiler: Compiler,
        proofs: Proofs,
    ) -> None:
        self._name = name
        self._arity = arity
        self._axioms = axioms
        self._source = source
        self._compiler = compiler
        self._proofs = proofs
        self._variants: dict[Known, _Variant] = {}
        self._everything = (True,) * arity

    def goal(self, terms: Sequence[Compiled], bound: set[int]) -> Begin:
        """The solutions of a literal; ``bound`` slots surely have a value."""
        wanted = [(term, tuple(slots_of(term))) for term in terms]
        if all(bound.issuperset(slots) for _, slots in wanted):
            arguments, name = builder(terms), self._name
            return lambda state, frame: self.holds(state, (name, *arguments(frame)))

        def solutions(state: State, frame: Frame) -> Iterator[None]:
            given = [
                None if any(frame[slot] is None for slot in slots) else build(term, frame)
                for term, slots in wanted
            ]
            if None not in given:
                if self.holds(state, (self._name, *given)):
                    yield
                return
            for fact in self._instances(state, given):
                state.work += 1
                newly: list[int] = []
                if all(
                    match(term, part, frame, newly)
                    for term, part in zip(terms, fact[1:], strict=True)
                ):
                    yield
                for slot in newly:
                    frame[slot] = None

        return solutions

    def holds(self, state: State, fact: Fact) -> bool:
        """Whether a ground literal holds; one that comes up below itself is no reason for itself."""
        if fact in state.facts:
            return True
        proofs = self._proofs
        if fact in proofs.derived:
            return True
        if fact in proofs.open or fact in proofs.failed:
            return False
        proofs.open.add(fact)
        found = False
        try:
            found = self._derivable(state, fact)
        finally:
            proofs.settle(fact, found)
        return found

    def _derivable(self, state: State, fact: Fact) -> bool:
        variant = self._variants.get(self._everything) or self._variant(self._everything)
        for axiom in variant.axioms:
            frame = axiom.bind(fact)
            if frame is not None:
                for body in axiom.bodies:
                    if body.holds(state, frame):
                        return True
        return False

    def _instances(self, state: State, given: list[Any]) -> Iterator[Fact]:
        """The true instances of a literal, whose unbound arguments are None."""
        known = tuple([value is not None for value in given])
        variant = self._variants.get(known) or self._variant(known)
        wanted = [given[i - 1] for i in variant.positions]
        key = wanted[0] if len(wanted) == 1 else tuple(wanted)
        bucket = state.buckets[variant.number].get(key)
        if bucket is not None:
            yield from state.living(bucket)
        task = (self._name, *given)
        for axiom in variant.axioms:
            frame = axiom.bind(task)
            if frame is not None:
                yield from self._derived(axiom, state, frame)

    def _derived(self, axiom: _CompiledAxiom, state: State, frame: Frame) -> Iterator[Fact]:
        for body in axiom.bodies:
            found = False
            trial = frame.copy()
            for _ in body.solutions(state, trial):
                found = True
                if any(trial[slot] is None for slot in axiom.slots):
                    node, head = axiom.axiom.head.node, show(axiom.axiom.head)
                    message = f'{head} is asked for with arguments that it does not bind'
                    raise MissionError([self._source.diagnostic(node.start, node.end, message)])
                yield (self._name, *(build(term, trial) for term in axiom.terms))
            if found and not state.relaxed:
                return

    def _variant(self, known: Known) -> _Variant:
        positions = tuple([i + 1 for i, is_known in enumerate(known) if is_known])
        paths = tuple([(position,) for position in positions])
        number = self._compiler.plan.number(Index(self._name, self._arity, paths))
        axioms = tuple([self._compile(axiom, known) for axiom in self._axioms])
        variant = self._variants[known] = _Variant(number, positions, axioms)
        return variant

    def _compile(self, axiom: Axiom, known: Known) -> _CompiledAxiom:
        slots = Slots(self._source)
        head = Head(axiom.head, slots, known)
        bodies = tuple(
            [self._compiler.condition(body, slots, set(head.bound)) for body in axiom.bodies]
        )
        everything = set().union(*(slots_of(term) for term in head.terms))
        return _CompiledAxiom(
            head.binder(), bodies, tuple(head.terms), tuple(sorted(everything)), axiom
        )
