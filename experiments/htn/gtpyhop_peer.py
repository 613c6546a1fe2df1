"""GTPyhop on the same problems: its own blocks world, and the other domains written for it method for method."""

from __future__ import annotations

import contextlib
import gc
import importlib
import io
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import process_time
from typing import Any

from experiments.htn import gtpyhop_domains
from experiments.htn.problems import Blocks, Logistics, Rovers, Satellites

STRATEGIES = ('iterative_greedy', 'iterative_dfs_backtracking')
#: Our actions by the names of GTPyhop's.
NAMES = {'pick-up': 'pickup', 'put-down': 'putdown'}

Action = tuple[str, ...]
Problem = Blocks | Logistics | Rovers | Satellites


@dataclass(frozen=True)
class Run:
    """A plan, the processor time [s] of the search, and how many tasks and actions were tried in it."""

    strategy: str
    plan: Sequence[Action]
    seconds: float
    nodes: int


class Peer:
    """One problem in GTPyhop."""

    def __init__(self, problem: Problem) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            import gtpyhop

            gtpyhop.set_verbose_level(0)
            self._gtpyhop: Any = gtpyhop
            if isinstance(problem, Blocks):
                self._blocks(problem)
            else:
                self._domain = gtpyhop.Domain(type(problem).__name__)
                self._state = gtpyhop.State('start')
                if isinstance(problem, Logistics):
                    self._goal = gtpyhop_domains.logistics(gtpyhop, problem, self._state)
                elif isinstance(problem, Rovers):
                    self._goal = gtpyhop_domains.rovers(gtpyhop, problem, self._state)
                else:
                    self._goal = gtpyhop_domains.satellites(gtpyhop, problem, self._state)
                self._tasks: Any = [('all',)]

    def _blocks(self, problem: Blocks) -> None:
        """GTPyhop's own example, blocks_htn."""
        self._domain = importlib.import_module('gtpyhop.examples.blocks_htn').the_domain
        state = self._state = self._gtpyhop.State('start')
        covered = set(problem.start.values())
        state.pos = dict(problem.start)
        state.clear = {block: block not in covered for block in problem.start}
        state.holding = {'hand': False}
        goal = self._gtpyhop.Multigoal('goal')
        goal.pos = dict(problem.goal)
        self._tasks = [('achieve', goal)]
        self._goal = lambda final: final.pos == problem.goal

    def plan(self, repetitions: int) -> Run:
        """The fastest of ``repetitions`` searches with each strategy."""
        runs = []
        for strategy in STRATEGIES:
            self._gtpyhop.set_recursive_planning(strategy)
            for _ in range(repetitions):
                gc.collect()
                began = process_time()
                plan = self._find()
                runs.append(Run(strategy, plan or (), process_time() - began, 0))
        best = min(runs, key=lambda run: run.seconds)
        return Run(best.strategy, best.plan, best.seconds, self._count(best.strategy))

    def _find(self) -> Any:
        self._gtpyhop.set_current_domain(self._domain)
        return self._gtpyhop.find_plan(self._state.copy(), self._tasks)

    def _count(self, strategy: str) -> int:
        """How often actions and methods are called in a search that is not timed."""
        self._gtpyhop.set_recursive_planning(strategy)
        calls = 0

        def counted(function: Callable[..., Any]) -> Callable[..., Any]:
            def call(*arguments: Any) -> Any:
                nonlocal calls
                calls += 1
                return function(*arguments)

            return call

        actions, methods = self._declared('action'), self._declared('task_method')
        kept = dict(actions), dict(methods)
        actions.update({name: counted(action) for name, action in kept[0].items()})
        methods.update({name: [counted(m) for m in some] for name, some in kept[1].items()})
        try:
            self._find()
        finally:
            actions.update(kept[0])
            methods.update(kept[1])
        return calls

    def _declared(self, kind: str) -> dict[str, Any]:
        found: dict[str, Any] = vars(self._domain)[f'_{kind}_dict']
        return found

    def fault_of(self, plan: Sequence[Action]) -> str:
        """Why ``plan`` does not reach the goal by GTPyhop's actions; empty when it does."""
        state = self._state.copy()
        for number, (name, *arguments) in enumerate(plan):
            word = name.lstrip('!')
            action = self._declared('action')[NAMES.get(word, word)]
            state = action(state, *arguments)
            if not state:
                return f'step {number}, {" ".join([name, *arguments])}, is not applicable'
        return '' if self._goal(state) else 'the goal does not hold at the end'
