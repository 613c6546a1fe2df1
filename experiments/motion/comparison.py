"""All planners on the same legs, each with as many iterations as it takes, for so many seconds.

How far a number of iterations gets depends on the planner and the world. So each planner begins with
few and is given twice as many, from the start, until it finds a path or its time is up.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.asking import planner_for
from experiments.motion.curve import Leg, legs_of
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from motion_planner_node.errors import Stopped
from motion_planner_node.paths import DEFAULT_PLANNER, PLANNERS, PathBudget, PathOutcome, plan_path
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.scene import Scene

#: [s] after which a planner is told to stop; it then counts as one that found nothing.
PATIENCE = 3.0
#: Iterations of a sampling planner in its first try.
FEWEST = 250
#: Planners that get farther with more iterations; the others have said all that they know.
SAMPLING = frozenset(PLANNERS) - {DEFAULT_PLANNER, 'direct'}


def _limit(end: float) -> Callable[[], bool]:
    return lambda: perf_counter() > end


def _tried(
    scene: Scene, robot: Robot, leg: Leg, planner: str, should_stop: Callable[[], bool]
) -> float:
    """Length [m] of the first path that the planner finds, infinite where it knows of none.

    :raises Stopped: when ``should_stop`` says so
    """
    iterations = FEWEST
    while True:
        budget = PathBudget(iterations=iterations)
        result = plan_path(
            scene, robot, leg.start, [leg.end], leg.seed, should_stop, budget, planner
        )
        if result.motion is not None:
            return result.motion.length
        # More iterations help where a search has ended, not where none was begun.
        if planner not in SAMPLING or result.outcome is not PathOutcome.NO_PATH:
            return inf
        iterations *= 2


def measure(place: Place, known: Sequence[Known]) -> dict[str, Any]:
    """Success, time and length of each planner; lengths by the shortest of all on the same leg."""
    legs = legs_of(known)
    world = planner_for(place).world
    scene, robot = Scene(world), world.robots[AGENT]
    lengths = np.full((len(PLANNERS), len(legs)), inf)
    times = np.empty_like(lengths)
    for row, name in enumerate(PLANNERS):
        for column, leg in enumerate(legs):
            began = perf_counter()
            with suppress(Stopped):
                lengths[row, column] = _tried(scene, robot, leg, name, _limit(began + PATIENCE))
            times[row, column] = 1e3 * (perf_counter() - began)
    # Legs on which all failed may be impossible.
    solved = np.isfinite(lengths).any(axis=0)
    lengths, times = lengths[:, solved], times[:, solved]
    best = lengths.min(axis=0)
    figures = {}
    for row, name in enumerate(PLANNERS):
        found = np.isfinite(lengths[row])
        ratios = (lengths[row] / best)[found]
        figures[name] = {
            'success': float(np.mean(found)),
            'ms_p50': float(np.median(times[row])),
            'ms_p95': float(np.percentile(times[row], 95)),
            'ratio_p50': float(np.median(ratios)) if len(ratios) else None,
            'ratio_p95': float(np.percentile(ratios, 95)) if len(ratios) else None,
        }
    return {'legs': int(solved.sum()), 'planners': figures}
