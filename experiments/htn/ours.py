"""GeoHTN's task planner on a mission: what it did, and the processor time of reading and of searching."""

from __future__ import annotations

import gc
from dataclasses import dataclass
from math import inf
from time import process_time

from experiments.htn.public_domains import NoMotionPlanner
from task_planner_node.mission import MissionText
from task_planner_node.oracle import Oracle, Token
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.planner import Planner


@dataclass(frozen=True)
class Run:
    """A result with the processor times [s] of reading, checking and compiling, and of the search."""

    result: Result
    reading: float
    searching: float

    @property
    def decompositions(self) -> int:
        """Tasks that were decomposed and actions that were applied."""
        return self.result.statistics.decompositions

    @property
    def rate(self) -> float:
        """Decompositions per second of search."""
        return self.decompositions / self.searching


def plan(
    domain: str,
    problem: str,
    options: Options | None = None,
    oracle: Oracle | None = None,
    start: Token = (),
    limit: float = inf,
) -> Run:
    """Plan once, with ``oracle`` to answer geometric requests; cancelled after ``limit`` [s] of processor time."""
    times: dict[str, float] = {}

    def note(progress: Progress) -> None:
        times.setdefault(progress.phase, process_time())

    gc.collect()
    end = process_time() + limit
    planner = Planner(
        oracle or NoMotionPlanner(),
        options or Options(time_budget=600.0),
        lambda: process_time() > end,
        note,
    )
    result = planner.plan(MissionText('domain', domain), MissionText('problem', problem), start)
    searching = times.get('searching', times['writing'])
    return Run(result, searching - times['loading'], times['writing'] - searching)


def best_of(count: int, domain: str, problem: str, options: Options | None = None) -> Run:
    """The run whose search was the fastest, with the least time of reading of all."""
    runs = [plan(domain, problem, options) for _ in range(count)]
    best = min(runs, key=lambda run: run.searching)
    return Run(best.result, min(run.reading for run in runs), best.searching)


def solved(run: Run) -> bool:
    """Whether there is a plan."""
    return run.result.outcome == Outcome.SOLVED
