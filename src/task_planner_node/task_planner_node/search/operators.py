"""Compiled operators: what they need, what they change, and what they cost."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from task_planner_node.errors import MissionError
from task_planner_node.language.model import (
    Atom,
    Effect,
    ForEach,
    GeometricText,
    Operator,
    Protection,
    Spread,
    Term,
    Variable,
    shorten,
    show,
)
from task_planner_node.language.operators import VARIABLE
from task_planner_node.language.reader import Node
from task_planner_node.language.source import Source
from task_planner_node.search.compilation import Compiler
from task_planner_node.search.conditions import Conjunction
from task_planner_node.search.heads import Bind, Head
from task_planner_node.search.logic import value
from task_planner_node.search.protections import PROTECTED, UNPROTECTED, guarded
from task_planner_node.search.state import Fact, State, fresh
from task_planner_node.search.terms import Frame, Slots, builder

Build = Callable[[Frame], Fact]
Text = Callable[[Frame], str]
# Facts, and protections as facts of PROTECTED and UNPROTECTED.
Several = Callable[[State, Frame], list[Fact]]
# Applies the effects; the answer is empty, or says which protection forbids them.
Apply = Callable[[State, Frame], str]


@dataclass(frozen=True, slots=True, eq=False)
class CompiledOperator:
    """An operator; ``text`` grounds its geometric preconditions, and is None when it has none.

    ``behaviour`` grounds the behaviour constraints.  ``least_cost`` is a lower bound of ``cost``.  ``loose`` are
    slots of the head that have a value only once the condition holds, if at all.
    """

    name: str
    bind: Bind
    head: Head
    condition: Conjunction
    apply: Apply
    adds: Several
    cost: Callable[[Frame], float]
    least_cost: float
    internal: bool
    text: Text | None
    behaviour: Text | None
    assigns: bool


def compile_operator(
    operator: Operator,
    compiler: Compiler,
    source: Source,
    assigning: frozenset[str],
    protecting: bool,
    known: Sequence[bool] | None = None,
) -> CompiledOperator:
    """Compile for tasks with values for the ``known`` arguments.

    ``assigning`` names the operators whose geometric preconditions set an attitude; ``protecting`` tells whether any
    operator of the domain protects.
    """
    slots = Slots(source)
    head = Head(operator.head, slots, known)
    bound = set(head.bound)
    condition = compiler.condition(operator.condition, slots, bound)
    effects = _Effects(compiler, slots, bound, operator.head.node)
    deletes, adds = effects.several(operator.deletes), effects.several(operator.adds)
    plain = [effects.plain(some) for some in (operator.deletes, operator.adds)]
    if protecting:
        apply = guarded(deletes, adds)
    elif plain[0] is not None and plain[1] is not None:
        apply = _applying(plain[0], plain[1])
    else:
        apply = _applying_several(deletes, adds)
    cost, least_cost = _cost(operator, slots, source)
    return CompiledOperator(
        operator.head.name,
        head.binder(),
        head,
        condition,
        apply,
        adds,
        cost,
        least_cost,
        operator.internal,
        ground_text(operator.geometric, slots),
        ground_text(operator.behaviour, slots),
        operator.head.name in assigning,
    )


def _applying(deletes: Sequence[Build], adds: Sequence[Build]) -> Apply:
    removed, added = tuple(deletes), tuple(adds)

    def apply(state: State, frame: Frame) -> str:
        for fact in removed:
            state.remove(fact(frame))
        for fact in added:
            state.add(fact(frame))
        return ''

    return apply


def _applying_several(deletes: Several, adds: Several) -> Apply:
    def apply(state: State, frame: Frame) -> str:
        added = adds(state, frame)
        for fact in deletes(state, frame):
            state.remove(fact)
        for fact in added:
            state.add(fact)
        return ''

    return apply


@dataclass
class _Effects:
    """The effects of one operator, over its slots."""

    compiler: Compiler
    slots: Slots
    bound: set[int]
    node: Node

    def plain(self, effects: Sequence[Effect]) -> list[Build] | None:
        """How to build each of the facts; None when that depends on the state."""
        literals = [effect for effect in effects if isinstance(effect, (Atom, Variable))]
        if len(literals) < len(effects):
            return None
        return [self._fact(literal) for literal in literals]

    def several(self, effects: Sequence[Effect]) -> Several:
        """How to build all of the facts in the state before the operator."""
        parts = [self._effect(effect) for effect in effects]
        return lambda state, frame: [fact for part in parts for fact in part(state, frame)]

    def _fact(self, atom: Atom | Variable) -> Build:
        if isinstance(atom, Variable):
            return self._named(atom)
        terms = [self.slots.compile(argument) for argument in atom.args]
        return builder([self.slots.constant(atom.name), *terms])

    def _named(self, variable: Variable) -> Build:
        slot, source = self.slots.variable(variable.name), self.slots.source

        def fact(frame: Frame) -> Fact:
            found = frame[slot]
            if is_fact(found):
                return fresh(found)
            shown = 'nothing' if found is None else shorten(show(found))
            message = f'{variable.name} has to be a fact, (name argument ...), and not {shown}'
            raise MissionError([source.diagnostic(self.node.start, self.node.end, message)])

        return fact

    def _effect(self, effect: Effect) -> Several:
        if isinstance(effect, (Atom, Variable)):
            fact = self._fact(effect)
            return lambda _, frame: [fact(frame)]
        if isinstance(effect, Spread):
            return self._spread(effect)
        if isinstance(effect, Protection):
            literal = self._fact(effect.literal)
            name = PROTECTED if effect.positive else UNPROTECTED
            return lambda _, frame: [(name, literal(frame))]
        return self._for_each(effect)

    def _spread(self, effect: Spread) -> Several:
        slot = self.slots.variable(effect.variable.name)
        source, node = self.slots.source, effect.node

        def facts(_: State, frame: Frame) -> list[Fact]:
            found = frame[slot]
            if not isinstance(found, tuple) or not all(map(is_fact, found)):
                shown = 'nothing' if found is None else shorten(show(found))
                message = f'{effect.variable.name} has to be a list of facts, and not {shown}'
                raise MissionError([source.diagnostic(node.start, node.end, message)])
            return [fresh(fact) for fact in found]

        return facts

    def _for_each(self, effect: ForEach) -> Several:
        own = [variable.name for variable in effect.variables]
        before = [(name, self.slots.local(name)) for name in own]
        bound = set(self.bound)
        condition = self.compiler.condition(effect.condition, self.slots, bound)
        inner = _Effects(self.compiler, self.slots, bound, effect.node).several(effect.effects)
        for name, slot in reversed(before):
            self.slots.end_local(name, slot)

        def facts(state: State, frame: Frame) -> list[Fact]:
            trial = frame.copy()
            found: list[Fact] = []
            for _ in condition.solutions(state, trial):
                state.worked(1)
                found += inner(state, trial)
            return found

        return facts


def is_fact(term: Any) -> bool:
    """Whether a ground term is a list that begins with a name."""
    return isinstance(term, tuple) and bool(term) and isinstance(term[0], str)


def ground_text(geometric: GeometricText | None, slots: Slots) -> Text | None:
    """Split the text at its variables once; white space is reduced to single blanks."""
    if geometric is None:
        return None
    text = ' '.join(geometric.text.split())
    pieces: list[str] = []
    variables: list[int] = []
    end = 0
    for occurrence in VARIABLE.finditer(text):
        pieces.append(text[end : occurrence.start()])
        variables.append(slots.variable(occurrence.group()))
        end = occurrence.end()
    pieces.append(text[end:])
    form = '%s'.join([piece.replace('%', '%%') for piece in pieces])
    return lambda frame: form % tuple([show(frame[slot]) for slot in variables])


def _cost(
    operator: Operator, slots: Slots, source: Source
) -> tuple[Callable[[Frame], float], float]:
    term: Term = operator.cost
    if isinstance(term, (int, float)):
        constant = float(term)
        return (lambda _: constant), constant
    compute = value(slots.compile(term))
    node = operator.head.node

    def cost(frame: Frame) -> float:
        found: Any = compute(frame)
        if isinstance(found, (int, float)) and math.isfinite(found) and found >= 0:
            return float(found)
        message = (
            f'the cost of {operator.head.name} is {shorten(show(found))}: it has to be a finite number, '
            'not negative'
        )
        raise MissionError([source.diagnostic(node.start, node.end, message)])

    return cost, 0.0
