"""Compiled methods: their branches, and the tasks that these put in the place of a task."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from task_planner_node.language.model import (
    And,
    Atom,
    Condition,
    Immediate,
    Method,
    Ordered,
    Partial,
    SortBy,
    TaskNetwork,
)
from task_planner_node.language.source import Source
from task_planner_node.language.walk import variables_of
from task_planner_node.search.compilation import Compiler
from task_planner_node.search.conditions import Conjunction
from task_planner_node.search.early import Early, Literal, literal_atom
from task_planner_node.search.heads import Bind, Head
from task_planner_node.search.network import Immediate as ImmediateTask
from task_planner_node.search.network import Network, constrained, parallel
from task_planner_node.search.terms import Frame, Slots, builder, slots_of
from task_planner_node.search.unbound import Unbound

# Puts ground tasks in front of a network; the third argument is their parent.
Grow = Callable[[Frame, Network, Any], Network]


@dataclass(frozen=True, slots=True, eq=False)
class CompiledBranch:
    """A branch; ``grow`` puts its ground tasks in front of a network.

    ``numbers`` counts the method among those for the same task and the branch in the method, from 1.
    ``tasks`` are the names of its tasks in the order of the text; ``loose`` tells whether these may have arguments
    without a value, ``sorted`` whether the order of its solutions is asked for.
    ``early`` is what a solution of the condition has to meet so that the tasks can be done; ``network`` is the text's.
    """

    method: str
    name: str
    numbers: tuple[int, int]
    condition: Conjunction
    grow: Grow
    tasks: tuple[str, ...]
    loose: bool
    sorted: bool
    early: Conjunction | None
    network: TaskNetwork

    @property
    def label(self) -> str:
        """Its name, or the name of its method, or its place in the text."""
        return self.name or self.method or f'branch {self.numbers[1]} of method {self.numbers[0]}'


@dataclass(frozen=True, slots=True, eq=False)
class CompiledMethod:
    """A method; its branches share one frame."""

    bind: Bind
    head: Head
    branches: tuple[CompiledBranch, ...]

    @property
    def unconditional(self) -> bool:
        """Whether it always decomposes in one and the same way."""
        return len(self.branches) == 1 and not self.branches[0].condition.goals


def compile_method(
    method: Method,
    number: int,
    compiler: Compiler,
    source: Source,
    early: Early,
    known: Sequence[bool] | None = None,
) -> CompiledMethod:
    """Compile for tasks with values for the ``known`` arguments."""
    slots = Slots(source)
    head = Head(method.head, slots, known)
    branches = []
    for index, branch in enumerate(method.branches, start=1):
        bound = set(head.bound)
        condition = compiler.condition(branch.condition, slots, bound)
        network = Networks(slots, bound)
        grow = network.compile(branch.tasks)
        branches.append(
            CompiledBranch(
                method.name,
                branch.name,
                (number, index),
                condition,
                network.with_unbound(grow),
                tuple(network.tasks),
                network.loose,
                _is_sorted(branch.condition),
                _early(early.literals(branch), compiler, slots, head.bound, bound),
                branch.tasks,
            )
        )
    return CompiledMethod(head.binder(), head, tuple(branches))


def _early(
    literals: Sequence[Literal],
    compiler: Compiler,
    slots: Slots,
    head: set[int],
    bound: set[int],
) -> Conjunction | None:
    """Those of the literals that are bound, and speak of something that the condition chose."""
    told = []
    for literal in literals:
        places = {slots.variable(name) for name in variables_of(literal_atom(literal))}
        if places <= bound and not places <= head:
            told.append(literal)
    return compiler.condition(And(tuple(told)), slots, set(bound)) if told else None


def _is_sorted(condition: Condition) -> bool:
    if isinstance(condition, And):
        return any(_is_sorted(part) for part in condition.conditions)
    return isinstance(condition, SortBy)


@dataclass
class Networks:
    """Compiles one task network; ``tasks`` are its tasks so far, in the order of the text.

    ``bound`` holds the slots that have values when the network is put in place.
    """

    slots: Slots
    bound: set[int]
    tasks: list[str] = field(default_factory=list)
    _loose: dict[int, str] = field(default_factory=dict)

    def compile(self, network: TaskNetwork) -> Grow:
        """How to put the tasks of ``network`` in front of a network."""
        if isinstance(network, (Atom, Immediate)):
            return self._task(network)
        parts = [self.compile(item) for item in network.items]
        if isinstance(network, Ordered):
            return _ordered(parts)
        if isinstance(network, Partial):
            return _partial(parts, network.before)
        return lambda frame, rest, parent: parallel(
            [part(frame, None, parent) for part in parts], rest
        )

    @property
    def loose(self) -> bool:
        """Whether some task has a variable that nothing bound."""
        return bool(self._loose)

    def with_unbound(self, grow: Grow) -> Grow:
        """The same, with a place-holder of its own in each variable that nothing bound."""
        loose = tuple(self._loose.items())
        if not loose:
            return grow

        def grow_loose(frame: Frame, rest: Network, parent: Any) -> Network:
            frame = frame.copy()
            for slot, name in loose:
                if frame[slot] is None:
                    frame[slot] = Unbound(name)
            return grow(frame, rest, parent)

        return grow_loose

    def _task(self, network: Atom | Immediate) -> Grow:
        atom = network.task if isinstance(network, Immediate) else network
        place = len(self.tasks)
        self.tasks.append(atom.name)
        terms = [self.slots.compile(argument) for argument in atom.args]
        known = self.bound | self.slots.constants()
        for name in variables_of(atom):
            slot = self.slots.variable(name)
            if slot not in known:
                self._loose[slot] = name
        known.update(*(slots_of(term) for term in terms))
        task = builder([self.slots.constant(atom.name), *terms])
        if isinstance(network, Immediate):

            def grow_immediate(frame: Frame, rest: Network, parent: Any) -> Network:
                first = ImmediateTask(task(frame))
                return first, rest, parent, place, hash((first, rest[4] if rest else 0))

            return grow_immediate

        def grow(frame: Frame, rest: Network, parent: Any) -> Network:
            first = task(frame)
            return first, rest, parent, place, hash((first, rest[4] if rest else 0))

        return grow


def _ordered(parts: Sequence[Grow]) -> Grow:
    if len(parts) == 1:
        return parts[0]
    backwards = tuple(reversed(parts))

    def grow(frame: Frame, rest: Network, parent: Any) -> Network:
        for part in backwards:
            rest = part(frame, rest, parent)
        return rest

    return grow


def _partial(parts: Sequence[Grow], pairs: Sequence[tuple[int, int]]) -> Grow:
    labels = range(len(parts))
    before = {
        label: frozenset(first for first, later in closure(pairs) if later == label)
        for label in labels
    }

    def grow(frame: Frame, rest: Network, parent: Any) -> Network:
        branches = [part(frame, None, parent) for part in parts]
        return constrained(branches, labels, before, rest)

    return grow


def closure(pairs: Sequence[tuple[int, int]]) -> set[tuple[int, int]]:
    """All pairs that follow from ``pairs``: a branch that is done leaves the order of the others as it was."""
    closed = set(pairs)
    after: dict[int, set[int]] = {}
    for first, later in pairs:
        after.setdefault(first, set()).add(later)
    for start, following in after.items():
        agenda = list(following)
        while agenda:
            reached = agenda.pop()
            closed.add((start, reached))
            agenda += [n for n in after.get(reached, ()) if (start, n) not in closed]
    return closed
