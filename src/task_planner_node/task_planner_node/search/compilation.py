"""Compiling conditions: literals become membership tests, index look-ups or calls of axioms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

from task_planner_node.language.model import (
    And,
    Atom,
    Condition,
    Not,
    Pattern,
    Term,
    Variable,
    show,
)
from task_planner_node.search.conditions import (
    Check,
    Choice,
    Conjunction,
    Goal,
    disjunction,
    negation,
)
from task_planner_node.search.state import Fact, IndexPlan, State
from task_planner_node.search.terms import (
    Compiled,
    Frame,
    Slots,
    build,
    builder,
    key_builder,
    match,
    slots_of,
)

# Given the arguments of a call, None where unbound, an axiom's predicate yields its true instances.
Call = Callable[[State, tuple[Any, ...]], Iterator[Fact]]


@dataclass
class Compiler:
    """What compiled conditions of one domain share; ``axioms`` is filled in after their names are known."""

    plan: IndexPlan = field(default_factory=IndexPlan)
    axioms: dict[tuple[str, int], Call] = field(default_factory=dict)
    axiom_heads: frozenset[tuple[str, int]] = frozenset()

    def condition(self, condition: Condition, slots: Slots, bound: set[int]) -> Conjunction:
        """Compile; ``bound`` holds the slots that surely have a value, and is extended."""
        return _Scope(self, slots, bound, set(bound)).conjunction([condition])

    def axiom_body(self, condition: Condition, slots: Slots) -> Conjunction:
        """Compile the body of an axiom: the variables of its head may be bound by the call, or not."""
        return _Scope(self, slots, set(), set(range(len(slots.template)))).conjunction([condition])


@dataclass
class _Scope:
    """The variables at one place of a condition: surely bound, and possibly bound by some branch."""

    compiler: Compiler
    slots: Slots
    bound: set[int]
    maybe: set[int]

    def inner(self) -> _Scope:
        return _Scope(self.compiler, self.slots, set(self.bound), set(self.maybe))

    def conjunction(self, conditions: Sequence[Condition]) -> Conjunction:
        goals: list[Goal] = []
        for condition in conditions:
            goals.extend(self.goals(condition))
        return Conjunction(goals)

    def goals(self, condition: Condition) -> Sequence[Goal]:
        if isinstance(condition, And):
            return [goal for part in condition.conditions for goal in self.goals(part)]
        if isinstance(condition, Atom):
            return [self.atom(condition)]
        describe = _describer(condition, self.slots)
        if isinstance(condition, Not):
            return [Check(negation(self.inner().conjunction([condition.condition])), describe)]
        scopes = [self.inner() for _ in condition.conditions]
        parts = [
            scope.conjunction([part])
            for scope, part in zip(scopes, condition.conditions, strict=True)
        ]
        if scopes:
            self.bound |= set.intersection(*(scope.bound for scope in scopes))
            self.maybe |= set().union(*(scope.maybe for scope in scopes))
        return [Choice(disjunction(parts), describe)]

    def atom(self, atom: Atom) -> Goal:
        terms = [self.slots.compile(argument) for argument in atom.args]
        self.bound |= self.slots.constants()
        describe = _describer(atom, self.slots)
        sure = [slots_of(term) <= self.bound for term in terms]
        arity = len(terms)
        if (atom.name, arity) in self.compiler.axiom_heads:
            goal: Goal = Choice(self._call(atom.name, terms), describe)
        elif all(sure):
            fact = builder([self.slots.constant(atom.name), *terms])
            return Check(lambda state, frame: fact(frame) in state.facts, describe)
        else:
            positions = tuple(i + 1 for i in range(arity) if sure[i])
            number = self.compiler.plan.number(atom.name, arity, positions)
            key = key_builder([terms[i] for i in range(arity) if sure[i]])
            free = [(i + 1, terms[i]) for i in range(arity) if not sure[i]]
            slots = [term for _, term in free if isinstance(term, int)]
            plain = len(slots) == len(free) == len(set(slots)) and self.maybe.isdisjoint(slots)
            look_up = _assigning if plain else _matching
            goal = Choice(look_up(number, key, free), describe)
        for term in terms:
            self.bound |= slots_of(term)
        self.maybe |= self.bound
        return goal

    def _call(
        self, name: str, terms: Sequence[Compiled]
    ) -> Callable[[State, Frame], Iterator[None]]:
        axioms = self.compiler.axioms
        head = (name, len(terms))
        wanted = [(term, tuple(slots_of(term))) for term in terms]

        def solutions(state: State, frame: Frame) -> Iterator[None]:
            arguments = tuple(
                [
                    None if any(frame[slot] is None for slot in slots) else build(term, frame)
                    for term, slots in wanted
                ]
            )
            for fact in axioms[head](state, arguments):
                bound: list[int] = []
                if all(
                    match(term, part, frame, bound)
                    for term, part in zip(terms, fact[1:], strict=True)
                ):
                    yield
                for slot in bound:
                    frame[slot] = None
                if None not in arguments:
                    return

        return solutions


def _assigning(
    number: int, key: Callable[[Frame], Any], free: Sequence[tuple[int, Compiled]]
) -> Callable[[State, Frame], Iterator[None]]:
    """Look-up for the usual case: every free argument is another variable, surely unbound."""
    pairs = [(position, slot) for position, slot in free if isinstance(slot, int)]

    def solutions(state: State, frame: Frame) -> Iterator[None]:
        for fact in state.buckets[number].get(key(frame), ()):
            for position, slot in pairs:
                frame[slot] = fact[position]
            yield
        for _, slot in pairs:
            frame[slot] = None

    return solutions


def _matching(
    number: int, key: Callable[[Frame], Any], free: Sequence[tuple[int, Compiled]]
) -> Callable[[State, Frame], Iterator[None]]:
    """Look-up with patterns, repeated variables, or variables that may be bound."""

    def solutions(state: State, frame: Frame) -> Iterator[None]:
        for fact in state.buckets[number].get(key(frame), ()):
            state.work += 1
            bound: list[int] = []
            if all(match(term, fact[position], frame, bound) for position, term in free):
                yield
            for slot in bound:
                frame[slot] = None

    return solutions


def _describer(condition: Condition, slots: Slots) -> Callable[[Frame], str]:
    return lambda frame: describe(condition, slots, frame)


def describe(condition: Condition, slots: Slots, frame: Frame) -> str:
    """The condition as text, with the values of the variables that are bound."""
    if isinstance(condition, Atom):
        return show((condition.name, *(_valued(arg, slots, frame) for arg in condition.args)))
    if isinstance(condition, Not):
        return f'(not {describe(condition.condition, slots, frame)})'
    word = 'and' if isinstance(condition, And) else 'or'
    return f'({" ".join([word, *(describe(part, slots, frame) for part in condition.conditions)])})'


def _valued(term: Term, slots: Slots, frame: Frame) -> Term:
    if isinstance(term, Variable):
        value = frame[slots.variable(term.name)]
        return term if value is None else value
    if isinstance(term, Pattern):
        return Pattern(tuple(_valued(item, slots, frame) for item in term.items), term.tail)
    return term
