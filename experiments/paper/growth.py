"""Part 5: how time, memory and length grow with the number of goals."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np

from experiments.paper.part import Claim, Part, flat, write_csv
from experiments.paper.photos import WARM_UP, write_mission
from experiments.paper.report import table
from experiments.pictures.scales import plain_logarithms
from experiments.planning import (
    NODES,
    Nodes,
    NotSolvedError,
    middle_and_ends,
    nodes_up,
    spread,
    summary,
)
from experiments.results import Target

#: To reach: the first plan of so many photos in so many seconds.
MANY, MANY_TIME = 256, 60.0
#: [s] that a search may take here, so that what takes longer than the target is seen, too.
BUDGET = 300.0
#: Panels of the picture by their axes: columns of growth.csv and what they are called.
PANELS = {
    'median time [s]': {
        'planning_time_median': 'planning time',
        'search_time_median': 'in the task planner',
        'request_time_median': 'in the motion planner',
    },
    'median length [m]': {'length_median': 'length'},
    'greatest memory [MB]': {
        'memory_mb_task_planner_node': 'task planner',
        'memory_mb_motion_planner_node': 'motion planner',
        'memory_mb_interface_node': 'interface',
    },
}
#: Columns whose growth is a power of the number of goals.
POWERS = (
    'planning_time_median',
    'search_time_median',
    'request_time_median',
    'length_median',
    'requests_median',
)


@dataclass(frozen=True)
class Sizes:
    """Numbers of photos, and random missions of each; some are optimised for so many ``seconds``."""

    goals: tuple[int, ...]
    missions: int
    optimised: tuple[int, ...]
    seconds: float


FULL = Sizes(goals=(8, 16, 32, 64, 128, 256), missions=3, optimised=(8, 16, 32, 64), seconds=60.0)
QUICK = Sizes(goals=(8, 16), missions=2, optimised=(16,), seconds=5.0)


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Plan missions of every size, the small ones first, and see what memory the nodes take."""
    figures: dict[int, dict[str, Any]] = {}
    with nodes_up(folder / 'plan') as nodes:
        nodes.plan(write_mission(folder / 'warm_up', WARM_UP, seed), seed)
        for count in sizes.goals:
            plans = _plans(nodes, count, sizes.missions, seed, folder)
            figures[count] = _figures(plans, sizes.missions) | {'memory_mb': nodes.memory()}
            print(f'  {count} photos: {_told(figures[count], "planning_time", 2)} s', flush=True)
        # Last, so that the memory of the nodes is that of first plans.
        for count in sorted(figures.keys() & set(sizes.optimised)):
            first = [plan['length'] for plan in _plans(nodes, count, sizes.missions, seed, folder)]
            options = ('--optimise', '--time-budget', str(sizes.seconds))
            best = _plans(nodes, count, sizes.missions, seed, folder, options)
            if first and len(first) == len(best):
                figures[count]['excess'] = excess(first, [plan['length'] for plan in best])
            over = _told(figures[count], 'excess', 1, 100.0)
            print(f'  {count} photos: {over} % over optimised', flush=True)
    records = [flat({'photos': count, **told}) for count, told in figures.items()]
    write_csv(folder / 'growth.csv', records)
    exponents = {column: fitted(records, column) for column in POWERS}
    last = {column: fitted(records[-2:], column) for column in POWERS}
    memory = {node: per_photo(figures, node) for node in NODES}
    picture = folder / 'growth.png'
    draw(records, exponents, picture)
    rows = [cells(count, told) for count, told in figures.items()]
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
        text=_text(sizes, table(list(rows[0]), [list(row.values()) for row in rows]))
        + (_growth(sizes, exponents, last, memory) if len(sizes.goals) > 1 else ''),
        figures={
            'sizes': figures,
            'exponents': exponents,
            'exponents_of_the_last_two_sizes': last,
            'memory_kb_per_photo': memory,
        },
        targets=targets,
        claims=_claims(figures),
        pictures=[picture],
    )


def _claims(figures: Mapping[int, Mapping[str, Any]]) -> tuple[Claim, ...]:
    told = {count: each for count, each in figures.items() if 'met_on_the_way' in each}
    met = sum(each['met_on_the_way']['max'] > 0 for each in told.values())
    count, most = max(
        ((count, each['most_gained']) for count, each in told.items()),
        key=lambda found: found[1]['share'],
        default=(0, {'met': 0, 'metres': 0.0, 'share': 0.0}),
    )
    return (
        Claim(
            'A research track is "to evaluate already generated paths in order to detect opportunities '
            'to achieve actions earlier".',
            f'For {met} of {len(told)} numbers of photos there are plans that take some on the way of a motion for another '
            'one. '
            + (
                f'The most that it makes a plan shorter, as a share of the first one, is {most["share"]:.1%}: '
                f'{most["metres"]:.0f} m of {count} photos, {most["met"]} of them met on the way.'
                if most['met']
                else 'It makes no plan shorter.'
            ),
        ),
    )


def fitted(records: Sequence[Mapping[str, Any]], column: str) -> float:
    """The exponent e with which a figure grows as the number of goals to the e.

    Least squares in logarithms over the sizes that have the figure; NaN where these are less than two.
    """
    known = [(told['photos'], told[column]) for told in records if column in told]
    if len(known) < 2:
        return math.nan
    goals, values = np.log(np.array(known, float)).T
    return float(np.polyfit(goals, values, 1)[0])


def per_photo(figures: Mapping[int, Mapping[str, Any]], node: str) -> float:
    """How much a node's memory grows for an added photo [kB], from the least number to the greatest; NaN for one number."""
    few, many = min(figures), max(figures)
    if few == many:
        return math.nan
    grown = figures[many]['memory_mb'][node] - figures[few]['memory_mb'][node]
    return 1e3 * float(grown) / (many - few)


def draw(records: Sequence[Mapping[str, Any]], exponents: Mapping[str, float], path: Path) -> None:
    """Times, length and memory by the number of goals, on logarithmic scales, with exponents."""
    figure, panels = plt.subplots(1, len(PANELS), figsize=(12.0, 4.6), layout='constrained')
    counts = [told['photos'] for told in records]
    for axes, (label, curves) in zip(panels, PANELS.items(), strict=True):
        for column, name in curves.items():
            values = [told.get(column, math.nan) for told in records]
            power = f': goals to the {exponents[column]:.2f}' if column in exponents else ''
            axes.plot(counts, values, 'o-', label=name + power)
        axes.set(xscale='log', xlabel='photos', ylabel=label)
        axes.set_xticks(counts, [str(count) for count in counts])
        plain_logarithms(axes)
        axes.grid(alpha=0.3)
        axes.legend(loc='lower left', bbox_to_anchor=(0.0, 1.0), frameon=False, fontsize=9)
    figure.savefig(path, dpi=100)
    plt.close(figure)


def excess(first: Sequence[float], best: Sequence[float]) -> dict[str, float]:
    """By how much first plans are longer than the best ones of the same missions, as shares of these."""
    return middle_and_ends([one / other - 1.0 for one, other in zip(first, best, strict=True)])


def _plans(
    nodes: Nodes,
    count: int,
    missions: int,
    seed: int,
    folder: Path,
    options: Sequence[str] = ('--time-budget', str(BUDGET)),
) -> list[Mapping[str, Any]]:
    plans: list[Mapping[str, Any]] = []
    for number in range(missions):
        mission = write_mission(folder / f'{count}_{number}', count, seed + number)
        try:
            plans.append(nodes.plan(mission, seed, *options))
        except NotSolvedError as error:
            print(f'  {error}', flush=True)
    return plans


def _figures(plans: Sequence[Mapping[str, Any]], missions: int) -> dict[str, Any]:
    told: dict[str, Any] = {'unsolved': missions - len(plans)}
    if not plans:
        return told
    met = middle_and_ends([plan['statistics']['opportunities'] for plan in plans])
    shorter = middle_and_ends([gained(plan) for plan in plans])
    share = middle_and_ends([_share(plan) for plan in plans])
    return (
        told
        | summary(plans)
        | {'met_on_the_way': met, 'shorter_m': shorter, 'shorter_share': share}
        | {'most_gained': most_gained(plans)}
    )


def gained(plan: Mapping[str, Any]) -> float:
    """By how much [m] a plan is shorter than the first one that was found.

    Without ``--optimise`` nothing but what is met on the way leads to another plan; in that one it need not be met.
    """
    lengths = [found['length'] for found in plan['improvements']]
    return float(lengths[0] - lengths[-1]) if lengths else 0.0


def most_gained(plans: Iterable[Mapping[str, Any]]) -> dict[str, float]:
    """Of the plan that became shortest by goals that it meets: how many, metres, share of the first plan.

    All are 0 where no plan both meets a goal and is shorter than the first one.
    """
    found = [
        {'met': met, 'metres': gained(plan), 'share': _share(plan)}
        for plan in plans
        if (met := plan['statistics']['opportunities']) and gained(plan) > 0.0
    ]
    nothing = {'met': 0, 'metres': 0.0, 'share': 0.0}
    return max(found, key=lambda each: each['share'], default=nothing)


def _share(plan: Mapping[str, Any]) -> float:
    return gained(plan) / plan['improvements'][0]['length'] if gained(plan) else 0.0


def _told(told: Mapping[str, Any], key: str, digits: int = 0, factor: float = 1.0) -> str:
    if key not in told:
        return ''
    return spread({name: factor * value for name, value in told[key].items()}, digits)


def cells(count: int, told: Mapping[str, Any]) -> dict[str, str]:
    """The line of the table for one size, by its headings."""
    memory = {node: f'{peak:.0f}' for node, peak in told['memory_mb'].items()}
    return {
        'photos': str(count),
        'planning time [s]': _told(told, 'planning_time', 2),
        'in the task planner [s]': _told(told, 'search_time', 2),
        'in the motion planner [s]': _told(told, 'request_time', 2),
        'requests': _told(told, 'requests'),
        'advices': _told(told, 'advices'),
        'length [m]': _told(told, 'length'),
        'over optimised [%]': _told(told, 'excess', 1, 100.0),
        'met on the way': _told(told, 'met_on_the_way'),
        'shorter [m]': _told(told, 'shorter_m', 1),
        'shorter [%]': _told(told, 'shorter_share', 2, 100.0),
        'unsolved': str(told['unsolved']),
        'memory: task planner [MB]': memory['task_planner_node'],
        'memory: motion planner [MB]': memory['motion_planner_node'],
        'memory: interface [MB]': memory['interface_node'],
    }


def _text(sizes: Sizes, lines: str) -> str:
    return f"""
Photos of random objectives. The world grows with them: the paper's obstacles are laid side by side once for every eight objectives, so that the density
stays the paper's and each photo has as much room and as many obstacles around as before. {sizes.missions} random missions of each size; medians, and from least
to greatest. **Met on the way** are photos that are taken on the way of a motion planned for another one, offered to the task planner as advice once
there is a first plan; **shorter** is the plan than this first one, also where the search along what was offered led to one that meets nothing.
**Over optimised** is how much longer the plan is than that of the same mission after {sizes.seconds:g} s of `--optimise`, which is no bound, but tells what more time would find.
Memory is the most that each node has had resident so far; the small sizes come first. Nothing of a mission's world is known to the nodes before.

{lines}
"""


def _growth(
    sizes: Sizes,
    exponents: Mapping[str, float],
    last: Mapping[str, float],
    memory: Mapping[str, float],
) -> str:
    few, many = min(sizes.goals), max(sizes.goals)
    before = sorted(sizes.goals)[-2]
    powers = {name: f'{exponents[name]:.2f} ({last[name]:.2f})' for name in POWERS}
    return f"""
Powers of the number of photos as which the figures grow, by least squares over the medians of all sizes, in logarithms, and in brackets from
{before} to {many} photos alone: the planning time {powers['planning_time_median']}, what is spent in the motion planner {powers['request_time_median']} and in the
task planner {powers['search_time_median']}; the length {powers['length_median']}, the requests {powers['requests_median']}. Where the figure in brackets is the greater one,
the growth is getting steeper. The most memory grows from {few} to {many} photos by {memory['task_planner_node']:.0f} kB for each
added photo in the task planner, {memory['motion_planner_node']:.0f} kB in the motion planner and {memory['interface_node']:.0f} kB in the interface.
"""
