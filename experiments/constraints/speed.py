"""How fast one destination is found, alone and in batches, beside the peers on the same starts.

Times are what the computing thread spends on its processor: a batch takes long enough to be
interrupted where the machine has other work, a single start of a peer does not.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable, Sequence
from time import thread_time
from typing import Any

import numpy as np
from numpy.typing import NDArray

from experiments.constraints.formulations import FORMULATIONS
from experiments.constraints.peers import PEERS, wrapped
from experiments.constraints.search import Bench
from experiments.constraints.sets import ConstraintSet
from motion_planner_node.satisfaction import descend

Array = NDArray[np.float64]
#: Violation [m or rad] up to which a result counts as a success, the motion planner's or a peer's.
TOLERANCE = 1e-6
OURS = 'motion planner'
BATCHES = (256, 1024)
#: Repetitions of a batch after each of the methods, so that all see the machine alike; the median
#: of all counts.
REPETITIONS = 10


def compare(bench: Bench, constraints: ConstraintSet, starts: Array, seed: int) -> dict[str, Any]:
    """Median time [us] and success rate of one start after the other, and of batches."""
    rows = FORMULATIONS[constraints.name]

    def succeeds(state: Array) -> bool:
        # Peers may leave the map: only the constraints themselves count here.
        return bench.judge.violation(constraints, wrapped(state), bounded=False) <= TOLERANCE

    program = bench.program(constraints)
    batches = [bench.starts(seed, size) for size in BATCHES]
    times: dict[int, list[float]] = {size: [] for size in BATCHES}

    def solve_batches() -> None:
        for batch in batches * REPETITIONS:
            began = thread_time()
            descend(program, batch)
            times[len(batch)].append(thread_time() - began)

    methods: dict[str, Any] = {
        OURS: _alone(lambda start: descend(program, start[None]).states[0], starts, succeeds)
    }
    solve_batches()
    for name, make in PEERS.items():
        began = thread_time()
        solve = make(rows)
        built = thread_time() - began
        methods[name] = {'build_ms': 1e3 * built, **_alone(solve, starts, succeeds)}
        solve_batches()
    figures = {}
    for batch in batches:
        descent = descend(program, batch)
        solved = sum(map(succeeds, descent.states[descent.satisfied]))
        figures[len(batch)] = {
            'us_per_destination': 1e6 * statistics.median(times[len(batch)]) / max(solved, 1),
            'success': solved / len(batch),
        }
    return {'methods': methods, 'batches': figures, **_ratios(methods, figures)}


def _alone(
    solve: Callable[[Array], Array], starts: Array, succeeds: Callable[[Array], bool]
) -> dict[str, float]:
    times, successes = [], 0
    began = thread_time()
    solve(starts[0])
    first = thread_time() - began
    for start in starts:
        began = thread_time()
        state = solve(start)
        times.append(thread_time() - began)
        successes += succeeds(state)
    return {
        'first_us': 1e6 * first,
        'median_us': 1e6 * statistics.median(times),
        'success': successes / len(starts),
    }


def _ratios(methods: dict[str, Any], batches: dict[int, Any]) -> dict[str, Any]:
    """How often our time fits into the best peer's; the best is the fastest per destination.

    Of the batches the slower size counts.
    """

    def per_destination(name: str) -> float:
        figures = methods[name]
        return float(figures['median_us'] / figures['success'] if figures['success'] else np.inf)

    best = min(PEERS, key=per_destination)
    most = max(batch['us_per_destination'] for batch in batches.values())
    return {
        'best_peer': best,
        'times_faster_alone': per_destination(best) / per_destination(OURS),
        'times_faster_in_batches': per_destination(best) / most,
        'success_over_best_peer': methods[OURS]['success'] - methods[best]['success'],
    }


def median_ratio(comparisons: Sequence[dict[str, Any]], key: str) -> float:
    """The middle of a ratio over the sets."""
    return float(statistics.median(comparison[key] for comparison in comparisons))
