"""Length against time on the same legs: ours at several budgets, and the usual way given more and more time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from time import perf_counter
from typing import Any

import numpy as np

from experiments.motion.asking import planner_for
from experiments.motion.goals import AGENT, Array
from experiments.motion.peers import Usual
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from motion_planner_node.paths import PathBudget, plan_path
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.stopping import never
from motion_planner_node.world.scene import Scene

#: Our budgets from the smallest to the largest; the default is one of them.
BUDGETS: Mapping[str, PathBudget] = {
    'least': PathBudget(attitudes=4000, improving=0, refinements=0),
    'less': PathBudget(improving=0, refinements=1),
    'default': PathBudget(),
    'more': PathBudget(attitudes=80000, improving=2000, refinements=6, good_enough=1.0),
}
#: What stands for a factor that is infinite, as there is no path at all.
NO_PATH = 100.0
#: Times [s] at which the usual way is looked at.
TIMES = tuple(float(value) for value in np.geomspace(0.001, 1.0, 31))


@dataclass(frozen=True)
class Leg:
    """From one attitude to another."""

    seed: int
    start: Attitude
    end: Attitude


def legs_of(known: Sequence[Known]) -> list[Leg]:
    """From the start of each second request to that of the next: attitudes that no planner chose."""
    pairs = zip(known[::2], known[1::2], strict=False)
    return [Leg(one.number, Attitude(*one.start), Attitude(*other.start)) for one, other in pairs]


def measure(place: Place, known: Sequence[Known], patience: float) -> dict[str, Any]:
    """Times [s] and lengths [m] of ours by budget, and of the usual way as time goes by."""
    legs = legs_of(known)
    world = planner_for(place).world
    scene, robot = Scene(world), world.robots[AGENT]
    usual = Usual(place)

    def plan(leg: Leg, budget: PathBudget) -> tuple[float, float]:
        began = perf_counter()
        result = plan_path(scene, robot, leg.start, [leg.end], leg.seed, never, budget)
        return perf_counter() - began, result.motion.length if result.motion else inf

    for budget in BUDGETS.values():
        plan(legs[0], budget)
    ours = {name: [plan(leg, budget) for leg in legs] for name, budget in BUDGETS.items()}
    theirs, broken, tries = [], 0, 0
    for leg in legs:
        spent, best = 0.0, inf
        steps: list[tuple[float, float]] = []
        while spent < patience:
            solved = usual.plan(leg.start, leg.end, tries, patience - spent)
            spent += solved.seconds
            tries, broken = tries + 1, broken + solved.broken
            if solved.length < best:
                best = solved.length
                steps.append((spent, best))
        theirs.append(steps)
    return {
        'legs': len(legs),
        'ours': ours,
        'theirs': theirs,
        'simplified_paths_that_were_broken': broken / max(tries, 1),
    }


def combine(measured: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """The curves over the legs of all worlds, lengths by the best that any found."""
    ours = {
        name: np.array([leg for one in measured for leg in one['ours'][name]]) for name in BUDGETS
    }
    theirs = [steps for one in measured for steps in one['theirs']]
    best = np.minimum.reduce([rows[:, 1] for rows in ours.values()])
    best = np.minimum(best, [min((length for _, length in steps), default=inf) for steps in theirs])
    # Legs on which all failed may be impossible.
    solved = np.isfinite(best)
    ours, best = {name: rows[solved] for name, rows in ours.items()}, best[solved]
    theirs = [steps for steps, is_solved in zip(theirs, solved, strict=True) if is_solved]
    table = np.array([[_at(steps, time) for time in TIMES] for steps in theirs]) / best[:, None]
    points = {
        name: {
            'milliseconds': 1e3 * float(np.median(rows[:, 0])),
            'ratio': float(np.median(rows[:, 1] / best)),
            'success': float(np.mean(np.isfinite(rows[:, 1]))),
        }
        for name, rows in ours.items()
    }
    peer = [_percentile(column, 50.0) for column in table.T]
    return {
        'legs': len(theirs),
        'legs_that_nobody_solved': int(np.sum(~solved)),
        'ours': points,
        'usual': [
            {
                'milliseconds': 1e3 * time,
                'ratio': ratio if ratio < inf else None,
                'success': float(np.mean(np.isfinite(column))),
            }
            for time, ratio, column in zip(TIMES, peer, table.T, strict=True)
        ],
        'shorter_at_equal_time': _shorter(points, table),
        'faster_at_equal_length': _faster(points, peer),
        'simplified_paths_that_were_broken': float(
            np.mean([one['simplified_paths_that_were_broken'] for one in measured])
        ),
    }


def _at(steps: Sequence[tuple[float, float]], time: float) -> float:
    """The length after so much time."""
    return min((length for spent, length in steps if spent <= time), default=inf)


def _percentile(values: Array, percent: float) -> float:
    """A percentile that is one of the values, so that infinite ones do no harm."""
    return float(np.percentile(values, percent, method='higher'))


def _shorter(points: Mapping[str, Any], table: Array) -> dict[str, float]:
    """By which factor the usual way's paths are longer in the time that each budget takes."""
    factors = {}
    for name, point in points.items():
        column = min(int(np.searchsorted(TIMES, 1e-3 * point['milliseconds'])), len(TIMES) - 1)
        factors[name] = min(_percentile(table[:, column], 50.0) / point['ratio'], NO_PATH)
    return factors


def _faster(points: Mapping[str, Any], peer: Sequence[float]) -> dict[str, float]:
    """How often the time of each budget fits into what the usual way takes to get as short.

    A lower bound where it does not get there in all the time that it has.
    """
    factors = {}
    for name, point in points.items():
        reached = [t for t, ratio in zip(TIMES, peer, strict=True) if ratio <= point['ratio']]
        time = min(reached, default=TIMES[-1])
        factors[name] = 1e3 * time / point['milliseconds']
    return factors
