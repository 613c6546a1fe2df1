"""A compiled domain: operators, methods and axioms ready to be applied to ground tasks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from task_planner_node.errors import MissionError
from task_planner_node.language.checks import VARIABLE
from task_planner_node.language.model import (
    Atom,
    Axiom,
    Domain,
    GeometricText,
    Method,
    Operator,
    Ordered,
    TaskNetwork,
    show,
)
from task_planner_node.search.compilation import Call, Compiler
from task_planner_node.search.conditions import Conjunction
from task_planner_node.search.network import Network, Task, parallel
from task_planner_node.search.state import Fact, IndexPlan, State
from task_planner_node.search.terms import Frame, Slots, builder, match, matcher, slots_of

Matcher = Callable[[Frame, Task], bool]
Build = Callable[[Frame], tuple[Any, ...]]
Grow = Callable[[Frame, Network], Network]


@dataclass(frozen=True, slots=True, eq=False)
class CompiledOperator:
    """An operator; ``text`` grounds its geometric preconditions, and is None when it has none."""

    name: str
    template: Frame
    matches: Matcher
    condition: Conjunction
    deletes: tuple[Build, ...]
    adds: tuple[Build, ...]
    cost: float
    internal: bool
    text: Callable[[Frame], str] | None
    assigns: bool

    def bind(self, task: Task) -> Frame | None:
        """A frame with the head's variables bound, or None when the head does not fit."""
        frame = self.template.copy()
        return frame if self.matches(frame, task) else None

    def apply(self, state: State, deletes: Sequence[Fact], adds: Sequence[Fact]) -> None:
        """Change ``state`` by ground effects, the deletions first."""
        for fact in deletes:
            state.remove(fact)
        for fact in adds:
            state.add(fact)

    def effects(self, frame: Frame) -> tuple[list[Fact], list[Fact]]:
        """Ground deletions and additions."""
        return [fact(frame) for fact in self.deletes], [fact(frame) for fact in self.adds]


@dataclass(frozen=True, slots=True, eq=False)
class CompiledBranch:
    """A branch; ``grow`` puts its ground tasks in front of a network."""

    name: str
    condition: Conjunction
    grow: Grow


@dataclass(frozen=True, slots=True, eq=False)
class CompiledMethod:
    """A method; its branches share one frame."""

    template: Frame
    matches: Matcher
    branches: tuple[CompiledBranch, ...]

    @property
    def unconditional(self) -> bool:
        """Whether it always decomposes in one and the same way."""
        return len(self.branches) == 1 and not self.branches[0].condition.goals

    def bind(self, task: Task) -> Frame | None:
        """A frame with the head's variables bound, or None when the head does not fit."""
        frame = self.template.copy()
        return frame if self.matches(frame, task) else None


class CompiledDomain:
    """All definitions by name.

    ``assigning`` names the operators whose geometric preconditions set an attitude.
    """

    def __init__(self, domain: Domain, assigning: frozenset[str] = frozenset()) -> None:
        compiler = Compiler()
        compiler.axiom_heads = frozenset((a.head.name, len(a.head.args)) for a in domain.axioms)
        for head in sorted(compiler.axiom_heads):
            compiler.axioms[head] = _compile_axioms(domain, head, compiler)
        self.operators: Mapping[str, CompiledOperator] = {
            operator.head.name: _compile_operator(operator, compiler, assigning)
            for operator in domain.operators
        }
        self.methods: dict[str, list[CompiledMethod]] = {}
        for method in domain.methods:
            compiled = _compile_method(method, compiler)
            self.methods.setdefault(method.head.name, []).append(compiled)
        self.plan: IndexPlan = compiler.plan

    def initial_network(self, tasks: TaskNetwork) -> Network:
        """The ground tasks of a problem."""
        slots = Slots()
        grow = _compile_tasks(tasks, slots)
        return grow(slots.template, None)


def _head(atom: Atom, slots: Slots) -> tuple[Matcher, set[int]]:
    terms = [slots.compile(argument) for argument in atom.args]
    matches = matcher(terms, slots)
    return matches, set(range(len(slots.template)))


def _compile_operator(
    operator: Operator, compiler: Compiler, assigning: frozenset[str]
) -> CompiledOperator:
    slots = Slots()
    matches, bound = _head(operator.head, slots)
    condition = compiler.condition(operator.condition, slots, bound)
    deletes = tuple(_fact_builder(effect, slots) for effect in operator.deletes)
    adds = tuple(_fact_builder(effect, slots) for effect in operator.adds)
    text = _text_builder(operator.geometric, slots) if operator.geometric else None
    return CompiledOperator(
        operator.head.name,
        slots.template,
        matches,
        condition,
        deletes,
        adds,
        operator.cost,
        operator.internal,
        text,
        operator.head.name in assigning,
    )


def _fact_builder(atom: Atom, slots: Slots) -> Build:
    return builder([slots.constant(atom.name), *(slots.compile(arg) for arg in atom.args)])


def _text_builder(geometric: GeometricText, slots: Slots) -> Callable[[Frame], str]:
    """Split the text at its variables once; white space is reduced to single blanks."""
    text = ' '.join(geometric.text.split())
    pieces: list[str] = []
    variables: list[int] = []
    end = 0
    for occurrence in VARIABLE.finditer(text):
        pieces.append(text[end : occurrence.start()])
        variables.append(slots.variable(occurrence.group()))
        end = occurrence.end()
    last = text[end:]

    def ground(frame: Frame) -> str:
        parts: list[str] = []
        for piece, slot in zip(pieces, variables, strict=True):
            parts.append(piece)
            value = frame[slot]
            parts.append(value if isinstance(value, str) else show(value))
        parts.append(last)
        return ''.join(parts)

    return ground


def _compile_method(method: Method, compiler: Compiler) -> CompiledMethod:
    slots = Slots()
    matches, head = _head(method.head, slots)
    branches = []
    for branch in method.branches:
        condition = compiler.condition(branch.condition, slots, set(head))
        branches.append(CompiledBranch(branch.name, condition, _compile_tasks(branch.tasks, slots)))
    return CompiledMethod(slots.template, matches, tuple(branches))


def _compile_tasks(network: TaskNetwork, slots: Slots) -> Grow:
    if isinstance(network, Atom):
        task = _fact_builder(network, slots)
        return lambda frame, rest: (task(frame), rest)
    parts = [_compile_tasks(item, slots) for item in network.items]
    if isinstance(network, Ordered):
        backwards = parts[::-1]

        def grow(frame: Frame, rest: Network) -> Network:
            for part in backwards:
                rest = part(frame, rest)
            return rest

        return grow
    return lambda frame, rest: parallel([part(frame, None) for part in parts], rest)


def _compile_axioms(domain: Domain, head: tuple[str, int], compiler: Compiler) -> Call:
    calls = [
        _compile_axiom(domain, axiom, compiler)
        for axiom in domain.axioms
        if (axiom.head.name, len(axiom.head.args)) == head
    ]
    name, arity = head
    number = compiler.plan.number(name, arity, ())

    def call(state: State, arguments: tuple[Any, ...]) -> Iterator[Fact]:
        if None not in arguments:
            if (name, *arguments) in state.facts:
                yield (name, *arguments)
        else:
            yield from state.buckets[number].get((), ())
        for axiom in calls:
            yield from axiom(state, arguments)

    return call


def _compile_axiom(domain: Domain, axiom: Axiom, compiler: Compiler) -> Call:
    slots = Slots()
    terms = [slots.compile(argument) for argument in axiom.head.args]
    # Any head variable may be unbound when the axiom is called, so none counts as surely bound;
    # the condition compiler treats them as possibly bound.
    bodies = [compiler.axiom_body(body, slots) for body in axiom.bodies]
    fact = _fact_builder(axiom.head, slots)
    template = slots.template
    head_slots = sorted(set().union(*(slots_of(term) for term in terms)))

    def call(state: State, arguments: tuple[Any, ...]) -> Iterator[Fact]:
        frame = template.copy()
        for term, argument in zip(terms, arguments, strict=True):
            if argument is not None and not match(term, argument, frame, []):
                return
        for body in bodies:
            found = False
            for _ in body.solutions(state, frame):
                found = True
                if any(frame[slot] is None for slot in head_slots):
                    message = (
                        f'{show(axiom.head)} is asked for with arguments that it does not bind'
                    )
                    node = axiom.head.node
                    raise MissionError([domain.source.diagnostic(node.start, node.end, message)])
                yield fact(frame)
            if found and not state.relaxed:
                return

    return call
