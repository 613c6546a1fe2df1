"""Compiling conditions: each becomes goals over the frame of one definition."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

from task_planner_node.language.model import (
    And,
    Assign,
    AssignEach,
    Atom,
    Collect,
    Condition,
    Enforce,
    Exists,
    First,
    Forall,
    Holds,
    Imply,
    Not,
    Or,
    SortBy,
    Stated,
)
from task_planner_node.search import linear, logic
from task_planner_node.search.conditions import Begin, Conjunction, Goal, disjunction, negation
from task_planner_node.search.description import describer
from task_planner_node.search.literals import Look, enumerating, membership
from task_planner_node.search.state import Fact, IndexPlan, State
from task_planner_node.search.terms import Compiled, Slots, builder, slots_of


class Predicate(Protocol):
    """An axiom's head: its true instances."""

    def goal(self, terms: Sequence[Compiled], bound: set[int]) -> Begin:
        """The solutions of a literal; ``bound`` slots surely have a value."""

    def holds(self, state: State, fact: Fact) -> bool:
        """Whether a ground literal holds."""


@dataclass
class Compiler:
    """What compiled conditions of one domain share; ``axioms`` is filled in before any condition is compiled.

    With ``linear`` the literals of predicates without axioms are matched with one fact after the other.
    """

    plan: IndexPlan = field(default_factory=IndexPlan)
    axioms: dict[tuple[str, int], Predicate] = field(default_factory=dict)
    linear: bool = False

    def condition(
        self, condition: Condition, slots: Slots, bound: set[int], maybe: Iterable[int] = ()
    ) -> Conjunction:
        """Compile; ``bound`` holds the slots that surely have a value, and is extended.

        ``maybe`` holds those that may have one.
        """
        scope = Scope(self, slots, bound, bound | set(maybe) | slots.constants())
        return scope.conjunction([condition])


@dataclass
class Scope:
    """The variables at one place of a condition: surely bound, and possibly bound by some branch."""

    compiler: Compiler
    slots: Slots
    bound: set[int]
    maybe: set[int]

    def inner(self) -> Scope:
        """A scope whose bindings are its own."""
        return Scope(self.compiler, self.slots, set(self.bound), set(self.maybe))

    def conjunction(self, conditions: Sequence[Condition]) -> Conjunction:
        """Goals for all of the conditions, from left to right."""
        goals: list[Goal] = []
        for condition in conditions:
            goals.extend(self._goals(condition))
        return Conjunction(goals)

    def binding(self, slots: Iterable[int]) -> None:
        """Note that the slots have values from here on."""
        self.bound.update(slots)
        self.maybe |= self.bound

    def touched(self, *inner: Scope) -> list[int]:
        """The slots that ``inner`` scopes may bind and that are not surely bound here."""
        everything: set[int] = set().union(*(scope.bound | scope.maybe for scope in inner))
        return sorted(everything - self.bound - self.slots.constants())

    def _goals(self, condition: Condition) -> Sequence[Goal]:
        if isinstance(condition, And):
            return [goal for part in condition.conditions for goal in self._goals(part)]
        describe = describer(condition, self.slots)
        if isinstance(condition, Atom):
            binds = not self._is_bound(condition)
            return [Goal(self._atom(condition), describe, binds)]
        begin, binds = self._compound(condition)
        return [Goal(begin, describe, binds)]

    def _compound(self, condition: Condition) -> tuple[Begin, bool]:
        if isinstance(condition, Not):
            return self._negation(condition.condition), False
        if isinstance(condition, Or):
            return self._disjunction(condition.conditions)
        if isinstance(condition, (Forall, Exists)):
            return self._quantified(condition), False
        if isinstance(condition, Holds):
            return logic.true(self.compute(condition.expression)), False
        if isinstance(condition, Stated):
            return self._stated(condition), False
        if isinstance(condition, Imply):
            return self._imply(condition)
        if isinstance(condition, Assign):
            return self._assign(condition)
        if isinstance(condition, AssignEach):
            return self._assign_each(condition), True
        if isinstance(condition, Collect):
            return self._collect(condition), True
        if isinstance(condition, Enforce):
            inner = self.conjunction([condition.condition])
            message = [self.compute(term) for term in condition.message]
            return logic.enforced(inner, message, self.slots.source, condition.node), inner.binds
        if isinstance(condition, First):
            return self._first(condition)
        if isinstance(condition, SortBy):
            return self._sorted(condition), True
        raise TypeError(f'not a condition: {condition!r}')

    def compute(self, term: Any) -> Callable[[list[Any]], Any]:
        """How to get the value of a term."""
        compiled = self.slots.compile(term)
        self.binding(self.slots.constants())
        return logic.value(compiled)

    def _terms(self, atom: Atom) -> list[Compiled]:
        terms = [self.slots.compile(argument) for argument in atom.args]
        self.binding(self.slots.constants())
        return terms

    def _is_bound(self, atom: Atom) -> bool:
        return all(slots_of(term) <= self.bound for term in self._terms(atom))

    def _atom(self, atom: Atom) -> Begin:
        terms = self._terms(atom)
        predicate = self.compiler.axioms.get((atom.name, len(terms)))
        if predicate is not None:
            begin = predicate.goal(terms, self.bound)
        elif self.compiler.linear:
            begin = self._linear(atom, terms)
        elif self._is_bound(atom):
            begin = membership(builder([self.slots.constant(atom.name), *terms]))
        else:
            look = Look(atom.name, terms, self.bound, self.maybe)
            begin = enumerating(look, self.compiler.plan)
        for term in terms:
            self.binding(slots_of(term))
        return begin

    def _linear(self, atom: Atom, terms: Sequence[Compiled]) -> Begin:
        look = Look(atom.name, terms, self.bound, self.maybe)
        find = linear.presence if self._is_bound(atom) else linear.enumerating
        return find(look, self.compiler.plan)

    def _negation(self, condition: Condition) -> Begin:
        if isinstance(condition, Atom) and (condition.name, len(condition.args)) not in (
            self.compiler.axioms
        ):
            terms = self._terms(condition)
            look = Look(condition.name, terms, self.bound, self.maybe)
            if self.compiler.linear:
                absent = linear.absence(look, self.compiler.plan)
            elif self._is_bound(condition):
                fact = builder([self.slots.constant(condition.name), *terms])
                return lambda state, frame: state.relaxed or fact(frame) not in state.facts
            else:
                absent = look.absence(self.compiler.plan)
            if absent is not None:
                return absent
        return negation(self.inner().conjunction([condition]))

    def _disjunction(self, conditions: Sequence[Condition]) -> tuple[Begin, bool]:
        scopes = [self.inner() for _ in conditions]
        parts = [scope.conjunction([part]) for scope, part in zip(scopes, conditions, strict=True)]
        begin = disjunction(parts, self.touched(*scopes))
        if scopes:
            self.binding(set.intersection(*(scope.bound for scope in scopes)))
            self.maybe |= set().union(*(scope.maybe for scope in scopes))
        return begin, any(part.binds for part in parts)

    def _imply(self, condition: Imply) -> tuple[Begin, bool]:
        premise = self.inner().conjunction([condition.premise])
        scope = self.inner()
        conclusion = scope.conjunction([condition.conclusion])
        begin = logic.implication(premise, conclusion, self.touched(scope))
        self.maybe |= scope.maybe
        return begin, conclusion.binds

    def _quantified(self, condition: Forall | Exists) -> Begin:
        names = [variable.name for variable in condition.variables]
        before = [(name, self.slots.local(name)) for name in names]
        scope = self.inner()
        domain = scope.conjunction([condition.domain])
        inner = scope.conjunction([condition.condition])
        for name, slot in reversed(before):
            self.slots.end_local(name, slot)
        self.binding(self.slots.constants())
        if isinstance(condition, Forall):
            return logic.universal(domain, inner)
        return logic.existential(Conjunction([*domain.goals, *inner.goals]))

    def _stated(self, condition: Stated) -> Begin:
        axioms, slot = self.compiler.axioms, self.slots.variable(condition.variable.name)

        def holds(state: State, fact: Fact) -> bool:
            predicate = axioms.get((fact[0], len(fact) - 1))
            return fact in state.facts if predicate is None else predicate.holds(state, fact)

        return logic.stated(slot, condition.variable.name, holds, self.slots.source, condition.node)

    def _assign(self, condition: Assign) -> tuple[Begin, bool]:
        compute = self.compute(condition.expression)
        slot = self.slots.variable(condition.variable.name)
        known, maybe = slot in self.bound, slot in self.maybe
        self.binding([slot])
        if known:
            return logic.comparison(slot, compute), False
        return logic.assignment(slot, compute, maybe), True

    def _assign_each(self, condition: AssignEach) -> Begin:
        compute = self.compute(condition.expression)
        slot = self.slots.variable(condition.variable.name)
        self.binding([slot])
        return logic.assignments(slot, compute, self.slots.source, condition.node)

    def _collect(self, condition: Collect) -> Begin:
        scope = self.inner()
        inner = scope.conjunction([condition.condition])
        term = scope.compute(condition.term)
        slot = self.slots.variable(condition.variable.name)
        maybe = slot in self.maybe
        self.binding([slot, *self.slots.constants()])
        return logic.collection(inner, term, slot, condition.distinct, maybe)

    def _first(self, condition: First) -> tuple[Begin, bool]:
        known, possible = set(self.bound), set(self.maybe)
        inner = self.conjunction([condition.condition])
        loose = sorted((self.maybe - known) & possible - self.slots.constants())
        return logic.first(inner, loose), inner.binds

    def _sorted(self, condition: SortBy) -> Begin:
        scope = self.inner()
        inner = scope.conjunction([condition.condition])
        touched = self.touched(scope)
        key = scope.compute(condition.key)
        self.binding(scope.bound)
        self.maybe |= scope.maybe
        return logic.sorted_by(
            inner, key, condition.comparison, touched, self.slots.source, condition.node
        )
