"""Every method on every set of goals: what it took, and how far the rover drives."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import inf, nan

import numpy as np

from experiments.htn import ours
from experiments.paper.methods.graphs import START, Graph
from experiments.paper.methods.missions import (
    ATTITUDES,
    BLIND,
    HYBRID,
    NEAREST,
    SIGHTED,
    UNMARKED,
    problem,
)
from experiments.paper.methods.oracles import Driving, ShortestPaths
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world.model import World, WorldObject
from task_planner_node.outcomes import Options, Outcome, Result

#: [s] of wall clock, far beyond the limit of processor time.
PATIENCE = 3600.0
ATTITUDES_NAME = 'hybrid with attitudes'


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    goals: numbers of goals; few: some with which indexed symbolic search and the variants are tried
    sets: random sets of goals for each number
    limit: [s] of processor time after which a search is given up
    """

    goals: tuple[int, ...]
    few: tuple[int, ...]
    sets: int
    limit: float

    @property
    def few_measured(self) -> tuple[int, ...]:
        """The few among the goals; all goals where these are not two, which a slope takes."""
        some = tuple(count for count in self.goals if count in self.few)
        return some if len(some) > 1 else self.goals


@dataclass(frozen=True)
class Method:
    """A domain, and how facts are matched; with ``ways`` among the facts there is no geometry.

    ``everywhere`` tells whether it is tried with all numbers of goals, or with few.
    """

    name: str
    domain: str
    linear: bool
    ways: bool = True
    everywhere: bool = True

    @property
    def label(self) -> str:
        """Name and matching."""
        return f'{self.name}, {"linear" if self.linear else "indexed"}'


METHODS = (
    Method('blind', BLIND, linear=True),
    Method('nearest first', NEAREST, linear=True),
    Method('hybrid', HYBRID, linear=True, ways=False),
    Method('blind', BLIND, linear=False, everywhere=False),
    Method('nearest first', NEAREST, linear=False, everywhere=False),
    Method('hybrid', HYBRID, linear=False, ways=False),
    Method('blind, objective in sight first', SIGHTED, linear=True, everywhere=False),
    Method('blind, circles left to the search', UNMARKED, linear=True, everywhere=False),
)


@dataclass(frozen=True)
class Trial:
    """One search.

    seconds: processor time of the search, without reading
    length: [m] driven; NaN without a plan
    work: goals of conditions that were tried, and facts that were compared one by one
    steps: actions of the plan
    decompositions: tasks decomposed and actions applied, also those that were taken back
    reason: why there is no plan
    """

    graph: str
    method: str
    goals: int
    number: int
    outcome: str
    seconds: float
    length: float
    work: int
    requests: int
    backtracks: int
    steps: int
    decompositions: int = 0
    reason: str = ''

    @property
    def solved(self) -> bool:
        """Whether there is a plan."""
        return self.outcome == Outcome.SOLVED.name


@dataclass(frozen=True)
class Bench:
    """Random sets of goals on one graph, the same for all methods; ``limit`` [s] ends a search."""

    graph: Graph
    seed: int
    limit: float

    def goals(self, count: int, number: int) -> list[str]:
        """The set of goals of that number."""
        rng = np.random.default_rng([self.seed, number, count])
        return [str(label) for label in rng.permutation(self.graph.goals)[:count]]

    def trial(self, method: Method, count: int, number: int) -> Trial:
        """One of the paper's methods on one set of goals."""
        goals = self.goals(count, number)
        options = Options(PATIENCE, use_advice=False, linear_matching=method.linear)
        if method.ways:
            text = problem(goals, self.graph)
            run = ours.plan(method.domain, text, options, limit=self.limit)
        else:
            paths = ShortestPaths(self.graph)
            run = ours.plan(method.domain, problem(goals), options, paths, START, self.limit)
        return self._noted(method.label, count, number, run, self._length)

    def drive(self, planner: MotionPlanner, start: Attitude, count: int, number: int) -> Trial:
        """The whole hybrid: attitudes and motions that the rover can drive, in an order by advice."""
        (agent,) = planner.world.robots
        oracle = Driving(planner, seed=self.seed + number)
        run = ours.plan(
            ATTITUDES,
            problem(self.goals(count, number)),
            Options(PATIENCE),
            oracle,
            ((agent, start),),
            self.limit,
        )
        return self._noted(ATTITUDES_NAME, count, number, run, lambda r: r.plans[0].length)

    def _length(self, result: Result) -> float:
        """Metres along the arcs of the plan, or of the answers."""
        driven = [step.action for step in result.steps if step.action[0] == '!go_to']
        arcs = sum(self.graph.arcs[str(a), str(b)] for _, _, a, b in driven)
        return arcs + result.plans[0].length

    def _noted(
        self,
        method: str,
        count: int,
        number: int,
        run: ours.Run,
        length_of: Callable[[Result], float],
    ) -> Trial:
        result = run.result
        told = result.statistics
        reason = '' if ours.solved(run) else result.explanation.partition('\n')[0]
        return Trial(
            self.graph.name,
            method,
            count,
            number,
            result.outcome.name,
            run.searching,
            length_of(result) if ours.solved(run) else nan,
            told.work,
            told.requests,
            told.backtracks,
            len(result.steps),
            told.decompositions,
            reason,
        )


def with_objects(world: World, graph: Graph) -> World:
    """The world with the waypoints of a graph as its objects."""
    objects: Mapping[str, WorldObject] = {
        label: WorldObject(label, {'x': x, 'y': y}) for label, (x, y) in graph.points.items()
    }
    return replace(world, objects=objects)


@contextmanager
def quiet_collector() -> Iterator[None]:
    """What exists already is left out of the collections between trials."""
    gc.collect()
    gc.freeze()
    try:
        yield
    finally:
        gc.unfreeze()


def run_paper_methods(
    bench: Bench, goals: Sequence[int], few: Sequence[int], sets: int
) -> Iterator[Trial]:
    """All methods on all sets, in turns; what is loaded at first is not counted."""
    with quiet_collector():
        for method in METHODS:
            bench.trial(method, goals[0], sets)
        for number in range(sets):
            for count in goals:
                for method in METHODS:
                    if method.everywhere or count in few:
                        yield bench.trial(method, count, number)


def run_attitudes(bench: Bench, world: World, goals: Sequence[int], sets: int) -> Iterator[Trial]:
    """The whole hybrid on all sets, from where the rover's mission starts.

    Before it counts, every number of goals is planned once without a limit: what is compiled at first
    differs with it, and takes longer than a search may.
    """
    planner = MotionPlanner(with_objects(world, bench.graph))
    planner.prepare()
    start = Attitude(*bench.graph.points[START], 0.0)
    with quiet_collector():
        for count in goals:
            replace(bench, limit=inf).drive(planner, start, count, sets)
        for number in range(sets):
            for count in goals:
                yield bench.drive(planner, start, count, number)
