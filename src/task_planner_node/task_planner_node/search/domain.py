"""A compiled domain: operators, methods and axioms ready to be applied to ground tasks."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum, auto
from typing import Protocol

from task_planner_node.errors import Diagnostic
from task_planner_node.language.model import (
    Atom,
    Axiom,
    Condition,
    Domain,
    Immediate,
    Method,
    Operator,
    Problem,
    Protection,
    TaskNetwork,
)
from task_planner_node.language.walk import effects_of
from task_planner_node.search.axioms import DerivedPredicate, Proofs
from task_planner_node.search.compilation import Compiler
from task_planner_node.search.conditions import Conjunction
from task_planner_node.search.early import Early
from task_planner_node.search.methods import CompiledMethod, Grow, Networks, compile_method
from task_planner_node.search.network import Network, Task
from task_planner_node.search.operators import CompiledOperator, compile_operator
from task_planner_node.search.reads import Reads
from task_planner_node.search.state import IndexPlan, State
from task_planner_node.search.structure import least_costs, names_above, recursive_names
from task_planner_node.search.terms import Frame, Slots
from task_planner_node.search.unbound import ground, known

# Tasks for which it is kept which methods fit, at most.
MOST_KNOWN = 100_000


class Start(Protocol):
    """What is to be done, and what is to hold in the end."""

    def networks(self, state: State) -> Iterator[Network]:
        """The networks to begin with: each is a choice."""

    def reached(self, state: State) -> bool:
        """Whether the goal holds."""

    def unmet(self, state: State) -> str:
        """The first part of the goal that does not hold."""


@dataclass(frozen=True, slots=True, eq=False)
class Beginning:
    """The tasks of a problem, one network for each solution of its precondition, and its goal."""

    condition: Conjunction
    template: Frame
    grow: Grow
    goal: Conjunction
    goal_template: Frame

    def networks(self, state: State) -> Iterator[Network]:
        """The networks to begin with."""
        frame = self.template.copy()
        for _ in self.condition.solutions(state, frame):
            yield self.grow(frame, None, None)

    def reached(self, state: State) -> bool:
        """Whether the goal holds."""
        return self.goal.holds(state, self.goal_template)

    def unmet(self, state: State) -> str:
        """The first part of the goal that does not hold."""
        return self.goal.first_failure(state, self.goal_template)


class Fit(Enum):
    """The methods whose head fits a task: none, one that decomposes it in one and the same way, or others."""

    NONE = auto()
    CERTAIN = auto()
    OPEN = auto()


class CompiledDomain:
    """All definitions by name; ``linear`` is the Compiler's.

    ``assigning`` names the operators whose geometric preconditions set an attitude.  ``geometric`` tells whether any
    operator has geometric preconditions, ``immediate`` whether any task has priority, ``loose`` whether tasks may
    have arguments without a value.  ``recursive`` names the tasks that may come up again below themselves;
    ``may_assign`` those below which an attitude may be set; ``least_costs`` are lower bounds of the cost of tasks by name.
    ``reads`` tells which facts decide how a task may be done.
    """

    def __init__(
        self, domain: Domain, assigning: frozenset[str] = frozenset(), linear: bool = False
    ) -> None:
        self._domain = domain
        self._compiler = compiler = Compiler(linear=linear)
        self._assigning = assigning
        self._early = Early(domain)
        self.reads = Reads(domain)
        effects = [e for o in domain.operators for e in (*o.deletes, *o.adds)]
        self._protecting = any(isinstance(effect, Protection) for effect in effects_of(effects))
        heads: dict[tuple[str, int], list[Axiom]] = {}
        for axiom in domain.axioms:
            heads.setdefault((axiom.head.name, len(axiom.head.args)), []).append(axiom)
        proofs = Proofs()
        for (name, arity), axioms in heads.items():
            predicate = DerivedPredicate(name, arity, axioms, domain.source, compiler, proofs)
            compiler.axioms[name, arity] = predicate
        self._texts: dict[str, Operator] = {o.head.name: o for o in domain.operators}
        self._method_texts: dict[str, list[Method]] = {}
        for method in domain.methods:
            self._method_texts.setdefault(method.head.name, []).append(method)
        self.operators: Mapping[str, CompiledOperator] = {
            name: self._operator(name) for name in self._texts
        }
        self.methods: Mapping[str, list[CompiledMethod]] = {
            name: self._methods(name) for name in self._method_texts
        }
        self._variants: dict[tuple[str, tuple[bool, ...]], CompiledOperator] = {}
        self._method_variants: dict[tuple[str, tuple[bool, ...]], list[CompiledMethod]] = {}
        self._fits: dict[Task, Fit] = {}
        self.geometric = any(operator.text is not None for operator in self.operators.values())
        self.recursive = recursive_names(self.methods)
        self.may_assign = names_above(self.methods, assigning)
        self.least_costs = least_costs(self.operators, self.methods)
        networks = [branch.tasks for method in domain.methods for branch in method.branches]
        self.immediate = any(_is_immediate(network) for network in networks)
        self.loose = any(b.loose for ms in self.methods.values() for m in ms for b in m.branches)
        self.plan: IndexPlan = compiler.plan

    def _operator(self, name: str, given: Sequence[bool] | None = None) -> CompiledOperator:
        return compile_operator(
            self._texts[name],
            self._compiler,
            self._domain.source,
            self._assigning,
            self._protecting,
            given,
        )

    def _methods(self, name: str, given: Sequence[bool] | None = None) -> list[CompiledMethod]:
        return [
            compile_method(method, number, self._compiler, self._domain.source, self._early, given)
            for number, method in enumerate(self._method_texts[name], start=1)
        ]

    def operator_for(self, task: Task) -> CompiledOperator:
        """The operator of a task some of whose arguments have no value."""
        key = (task[0], known(task))
        if key not in self._variants:
            self._variants[key] = self._operator(*key)
        return self._variants[key]

    def methods_for(self, task: Task) -> list[CompiledMethod]:
        """The methods of a task some of whose arguments have no value."""
        if task[0] not in self.methods:
            return []
        key = (task[0], known(task))
        if key not in self._method_variants:
            self._method_variants[key] = self._methods(*key)
        return self._method_variants[key]

    def fit(self, task: Task) -> Fit:
        """Which methods fit a task, whatever the facts are; all of its name, where it has arguments without a value."""
        if self.loose and not ground(task):
            return _fit(self.methods_for(task))
        fit = self._fits.get(task)
        if fit is None:
            if len(self._fits) >= MOST_KNOWN:
                self._fits.clear()
            methods = self.methods.get(task[0], ())
            fit = self._fits[task] = _fit([m for m in methods if m.bind(task) is not None])
        return fit

    def place_of(self, operator: str, message: str) -> Diagnostic:
        """An error at the head of an operator."""
        node = self._texts[operator].head.node
        return self._domain.source.diagnostic(node.start, node.end, message)

    def beginning(self, problem: Problem) -> Beginning:
        """The tasks and the goal of a problem."""
        source = problem.source
        slots = Slots(source)
        bound: set[int] = set()
        condition = self._compiler.condition(problem.precondition, slots, bound)
        networks = Networks(slots, bound)
        grow = networks.with_unbound(networks.compile(problem.tasks))
        self.loose = self.loose or networks.loose
        self.immediate = self.immediate or _is_immediate(problem.tasks)
        goal_slots = Slots(source)
        goal = self._condition(problem.goal, goal_slots)
        return Beginning(condition, slots.template, grow, goal, goal_slots.template)

    def _condition(self, condition: Condition, slots: Slots) -> Conjunction:
        return self._compiler.condition(condition, slots, set())


def _fit(methods: Sequence[CompiledMethod]) -> Fit:
    if len(methods) == 1 and methods[0].unconditional:
        return Fit.CERTAIN
    return Fit.OPEN if methods else Fit.NONE


def _is_immediate(network: TaskNetwork) -> bool:
    if isinstance(network, Immediate):
        return True
    return not isinstance(network, Atom) and any(_is_immediate(item) for item in network.items)
