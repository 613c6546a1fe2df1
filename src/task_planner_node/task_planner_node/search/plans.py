"""The plans that a search found: steps and decomposition trees out of its log, the best ones first."""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf

from task_planner_node.language.model import show
from task_planner_node.oracle import Answer, Token
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.partial_plan import Expansion, Limits
from task_planner_node.search.state import Fact, History
from task_planner_node.search.tree import Tree, TreeNode
from task_planner_node.search.unbound import Values, resolved


@dataclass(frozen=True, slots=True)
class Step:
    """One action of a plan; ``answer`` is None for a purely symbolic one."""

    action: tuple[str, ...]
    cost: float
    preconditions: str
    start: Token
    answer: Answer | None


@dataclass(frozen=True, eq=False)
class Plan:
    """A complete plan: ``cost`` is that of the operators plus ``length`` [m], the length of all motions."""

    log: tuple[Expansion, ...]
    history: History
    cost: float
    length: float

    def facts_after(self, executed: int) -> list[Fact]:
        """The facts that hold once the first ``executed`` actions are done."""
        mark = 0
        for expansion in self.log:
            if isinstance(expansion.by, CompiledOperator):
                executed -= not expansion.by.internal
                if executed < 0:
                    break
                mark = expansion.mark
        return self.history.facts(mark)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """The actions."""
        return tuple(
            [
                _step(expansion, expansion.by, self._values)
                for expansion in self.log
                if isinstance(expansion.by, CompiledOperator) and not expansion.by.internal
            ]
        )

    @cached_property
    def actions(self) -> tuple[tuple[str, ...], ...]:
        """The actions without anything else."""
        return tuple([step.action for step in self.steps])

    @cached_property
    def tree(self) -> Tree:
        """How the tasks were decomposed into the actions."""
        # Children come after their parents in the log, so they are complete when it is gone through backwards.
        below: dict[int, list[tuple[int, TreeNode]]] = {}
        step = len(self.steps)
        for began in range(len(self.log) - 1, -1, -1):
            expansion = self.log[began]
            by = expansion.by
            task = resolved(tuple(expansion.task), self._values)
            if isinstance(by, CompiledOperator):
                step -= not by.internal
                number = None if by.internal else step
                node = TreeNode(task, primitive=True, step=number, began=began)
            else:
                children = sorted(below.pop(id(expansion), []), key=lambda child: child[0])
                inner = tuple([child for _, child in children])
                node = TreeNode(
                    task,
                    primitive=False,
                    children=inner,
                    method=by.method,
                    branch=by.name,
                    method_number=by.numbers[0],
                    branch_number=by.numbers[1],
                    began=began,
                )
            below.setdefault(id(expansion.parent), []).append((expansion.place, node))
        roots = sorted(below.get(id(None), []), key=lambda child: child[0])
        return Tree(tuple([root for _, root in roots]))

    @cached_property
    def _values(self) -> Values:
        values: Values = {}
        for expansion in self.log:
            if expansion.values:
                values.update(expansion.values)
        return values


def _step(expansion: Expansion, operator: CompiledOperator, values: Values) -> Step:
    action = tuple([show(part) for part in resolved(tuple(expansion.task), values)])
    motion = expansion.motion
    if motion is None:
        return Step(action, operator.least_cost, '', (), None)
    return Step(action, motion.cost, motion.preconditions, motion.start, motion.answer)


class Plans:
    """The plans that are wanted, as far as they are found; ``found`` hears each that is kept.

    When optimising, ``bound`` is the cost that another plan has to stay below; with ``first`` one such plan is enough.
    """

    def __init__(
        self,
        limits: Limits,
        found: Callable[[Plan], None],
        bound: float = inf,
        first: bool = False,
    ) -> None:
        self.kept: list[Plan] = []
        self.bound = bound
        self._first = first
        self._limits = limits
        self._found = found

    @property
    def best(self) -> Plan | None:
        """The cheapest plan when optimising, else the first."""
        return self.kept[0] if self.kept else None

    @property
    def enough(self) -> bool:
        """Whether no further plan is wanted."""
        if self._first:
            return bool(self.kept)
        return not self._limits.optimise and len(self.kept) >= self._limits.plans

    def add(self, log: Sequence[Expansion], history: History, length: float, cost: float) -> None:
        """Keep a plan that the search came to."""
        self.keep(Plan(tuple(log), history, cost, length))

    def keep(self, plan: Plan) -> None:
        """Keep a plan, unless one with the same actions is kept already or it is too expensive."""
        wanted = self._limits.plans
        for kept in self.kept if wanted > 1 else ():
            if kept.actions == plan.actions:
                if kept.cost <= plan.cost or not self._limits.optimise:
                    return
                self.kept.remove(kept)
                break
        if self._limits.optimise:
            insort(self.kept, plan, key=lambda kept: kept.cost)
            del self.kept[wanted:]
            if len(self.kept) == wanted:
                self.bound = self.kept[-1].cost
        else:
            self.kept.append(plan)
        if plan in self.kept:
            self._found(plan)

    def improve(self, plan: Plan) -> None:
        """Keep a plan that is better than the best one."""
        if self._limits.optimise:
            self.keep(plan)
        else:
            self.kept[0] = plan
            self._found(plan)
