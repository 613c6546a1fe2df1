"""Part 5: how time, memory and length grow with the number of goals."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np

from experiments.paper.part import Part, write_csv
from experiments.paper.photos import WARM_UP, write_mission
from experiments.paper.report import table
from experiments.planning import Nodes, NotSolvedError, nodes_up, spread, summary
from experiments.results import Target

#: To reach: the first plan of so many photos in so many seconds.
MANY, MANY_TIME = 256, 60.0
#: [s] that a search may take here, so that what takes longer than the target is seen, too.
BUDGET = 300.0
#: Curves of the picture and what they are called.
CURVES = {
    'planning_time': 'planning time',
    'search_time': 'in the task planner',
    'request_time': 'in the motion planner',
}


@dataclass(frozen=True)
class Sizes:
    """Numbers of photos, and random missions of each."""

    goals: tuple[int, ...]
    missions: int


FULL = Sizes(goals=(8, 16, 32, 64, 128, 256), missions=3)
QUICK = Sizes(goals=(8, 16), missions=1)


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Plan missions of every size, the small ones first, and see what memory the nodes take."""
    figures: dict[int, dict[str, Any]] = {}
    with nodes_up(folder / 'plan') as nodes:
        nodes.plan(write_mission(folder / 'warm_up', WARM_UP, seed), seed)
        for count in sizes.goals:
            plans = _plans(nodes, count, sizes.missions, seed, folder)
            figures[count] = _figures(plans, sizes.missions) | {'memory_mb': nodes.memory()}
            print(f'  {count} photos: {_told(figures[count], "planning_time", 2)} s', flush=True)
    exponents = {key: fitted(figures, key) for key in (*CURVES, 'length', 'requests')}
    rows = [_row(count, told) for count, told in figures.items()]
    head = (
        *('photos', 'planning time [s]', 'in the task planner [s]', 'in the motion planner [s]'),
        *('requests', 'advices', 'length [m]', 'unsolved'),
        'memory of motion planner, task planner, interface [MB]',
    )
    write_csv(folder / 'growth.csv', head, rows)
    picture = folder / 'growth.png'
    draw(figures, exponents, picture)
    targets = []
    if MANY in figures:
        told = figures[MANY]
        targets = [
            Target(
                f'planning time of {MANY} photos, slowest [s]',
                told['planning_time']['max'] if 'planning_time' in told else BUDGET,
                MANY_TIME,
            ),
            Target(f'missions of {MANY} photos without a plan', told['unsolved'], 0),
        ]
    return Part(
        title='Growth with the number of goals',
        text=_text(sizes, table(head, rows), exponents),
        figures={'sizes': figures, 'exponents': exponents},
        targets=targets,
        pictures=[picture],
    )


def fitted(figures: Mapping[int, Mapping[str, Any]], key: str) -> float:
    """The exponent e with which the median of a figure grows as the number of goals to the e.

    Least squares in logarithms over the sizes that have plans; NaN where these are less than two.
    """
    solved = [(count, told[key]['median']) for count, told in figures.items() if key in told]
    if len(solved) < 2:
        return math.nan
    goals, medians = np.log(np.array(solved, float)).T
    return float(np.polyfit(goals, medians, 1)[0])


def draw(
    figures: Mapping[int, Mapping[str, Any]], exponents: Mapping[str, float], path: Path
) -> None:
    """Times by the number of goals, both on logarithmic scales, with the fitted exponents."""
    figure, axes = plt.subplots(figsize=(6.4, 4.0))
    for key, name in CURVES.items():
        solved = [(count, told[key]['median']) for count, told in figures.items() if key in told]
        goals, medians = zip(*solved, strict=True)
        axes.plot(goals, medians, 'o-', label=f'{name}: goals to the {exponents[key]:.2f}')
    axes.set(xscale='log', yscale='log', xlabel='photos', ylabel='median time [s]')
    axes.set_xticks(list(figures), [str(count) for count in figures])
    axes.minorticks_off()
    axes.grid(alpha=0.3)
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=100)
    plt.close(figure)


def _plans(
    nodes: Nodes, count: int, missions: int, seed: int, folder: Path
) -> list[Mapping[str, Any]]:
    plans: list[Mapping[str, Any]] = []
    for number in range(missions):
        mission = write_mission(folder / f'{count}_{number}', count, seed + number)
        try:
            plans.append(nodes.plan(mission, seed, '--time-budget', str(BUDGET)))
        except NotSolvedError as error:
            print(f'  {error}', flush=True)
    return plans


def _figures(plans: Sequence[Mapping[str, Any]], missions: int) -> dict[str, Any]:
    told: dict[str, Any] = {'unsolved': missions - len(plans)}
    return told | (summary(plans) if plans else {})


def _told(told: Mapping[str, Any], key: str, digits: int = 0) -> str:
    return spread(told[key], digits) if key in told else 'none'


def _row(count: int, told: Mapping[str, Any]) -> Sequence[str]:
    memory = ', '.join(f'{told["memory_mb"][node]:.0f}' for node in sorted(told['memory_mb']))
    return (
        str(count),
        *(_told(told, key, 2) for key in CURVES),
        *(_told(told, key) for key in ('requests', 'advices', 'length')),
        str(told['unsolved']),
        memory,
    )


def _text(sizes: Sizes, lines: str, exponents: Mapping[str, float]) -> str:
    return f"""
Photos of random objectives. The world grows with them: the paper's obstacles are laid side by side once for every eight objectives, so that the density
stays the paper's and each photo has as much room and as many obstacles around as before. {sizes.missions} random missions of each size; medians, and from least
to greatest. Memory is the most that each node has had resident so far; the small sizes come first. Nothing of a mission's world is known to the nodes before.

{lines}

The planning time grows as the number of photos to the {exponents['planning_time']:.2f}, what is spent in the motion planner as its power {exponents['request_time']:.2f}, and in
the task planner as its power {exponents['search_time']:.2f} (least squares over the medians, in logarithms). The length grows as its power {exponents['length']:.2f}, the requests as
its power {exponents['requests']:.2f}.
"""
