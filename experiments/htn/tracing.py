"""What it costs to keep track of a search, so that plans and failures can be explained.

The log of decompositions is measured by making as many entries again as the search made for tasks that are no
actions; the dead ends by searching with and without noting them.
"""

from __future__ import annotations

import gc
from statistics import median
from time import process_time
from typing import Any
from unittest.mock import patch

from experiments.htn import ours
from task_planner_node.outcomes import Result
from task_planner_node.search.dead_ends import DeadEnds
from task_planner_node.search.partial_plan import Expansion

#: Each pigeon has to get a hole of its own: nothing but trying all shows that there is one hole too few.
PIGEONS = """(defdomain pigeons (
 (:operator (!settle ?p ?h) ((free ?h)) ((free ?h)) ((in ?p ?h)))
 (:method (place ?p) ((hole ?h)) ((!settle ?p ?h)))))"""


def pigeons(count: int) -> str:
    """So many pigeons, and a hole less."""
    holes = ' '.join(f'(hole h{i}) (free h{i})' for i in range(count - 1))
    tasks = ' '.join(f'(place p{i})' for i in range(count))
    return f'(defproblem too-many pigeons ({holes}) ({tasks}))'


def log_share(domain: str, problem: str, repetitions: int) -> float:
    """Part of the time of a search that goes into log entries for decomposed tasks."""
    run = ours.best_of(repetitions, domain, problem)
    entries = run.decompositions - len(run.result.steps)
    best = min(_logging(run.result, entries) for _ in range(repetitions))
    return best / run.searching


def _logging(result: Result, entries: int) -> float:
    expansion = result.plans[0].log[0]
    task, by = expansion.task, expansion.by
    gc.collect()
    began = process_time()
    log = []
    parent = None
    for _ in range(entries):
        parent = Expansion(task, parent, 0, by)
        log.append(parent)
    return process_time() - began


def dead_end_share(count: int, repetitions: int) -> float:
    """How much longer a search without a plan takes because of the dead ends that it notes, in turns."""
    problem = pigeons(count)
    noted, silent = [], []
    for _ in range(repetitions):
        noted.append(ours.plan(PIGEONS, problem).searching)
        with patch.object(DeadEnds, 'add', _forget):
            silent.append(ours.plan(PIGEONS, problem).searching)
    return median(noted) / median(silent) - 1.0


def _forget(*_: Any, **__: Any) -> None:
    """Note nothing."""
