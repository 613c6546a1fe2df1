"""Part 2: the rover's mission of Figure 5, and how long plans are beside the best known."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from experiments.motion.worlds import ROVER
from experiments.paper.best_known import kept
from experiments.paper.lower_bound import lower_bound, outlines
from experiments.paper.part import Claim, Part, write_csv
from experiments.paper.photos import WARM_UP, problem, write_mission
from experiments.paper.report import table
from experiments.planning import Nodes, middle_and_ends, nodes_up, spread, summary
from experiments.results import Target
from interface_node.command_line.solution import solution_plan
from interface_node.plan import Step
from tests.support.checker import Judge

#: To reach: how much longer than the best known, and in how much time [s].
DEFAULT_EXCESS, DEFAULT_TIME = 0.10, 2.0
OPTIMISED_EXCESS = 0.03
#: Figure 3: a photo is taken from at most this far [m].
FARTHEST = 100.0
DEFAULT, OPTIMISED = 'default', 'default, optimised'
PRINTED, ONE_BY_ONE = "the paper's printed order", 'printed order, one by one'


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    seeds: plans of each method
    budget: [s] that the optimised plan may take
    arc: [m] of the lower bound's arcs
    """

    seeds: int
    budget: float
    arc: float


FULL = Sizes(seeds=10, budget=30.0, arc=4.0)
QUICK = Sizes(seeds=1, budget=5.0, arc=9.0)


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Plan the mission in every way, and judge every plan by the independent checker."""
    in_order = folder / 'in_order.lisp'
    in_order.write_text(problem(_labels(), in_order=True), encoding='utf-8')
    # The default comes first: nothing of this world is known to the nodes yet.
    options: Mapping[str, tuple[str, ...]] = {
        DEFAULT: (),
        ONE_BY_ONE: ('--problem', str(in_order), '--guidance', 'nearest_first'),
        PRINTED: ('--problem', str(in_order)),
        'nearest first': ('--guidance', 'nearest_first'),
        OPTIMISED: ('--optimise', '--time-budget', str(sizes.budget)),
    }
    warm_up = write_mission(folder / 'warm_up', WARM_UP, seed)
    methods: dict[str, dict[str, dict[str, float]]] = {}
    faults: list[str] = []
    shown: dict[str, list[dict[str, Any]]] = {}
    with nodes_up(folder / 'plan') as nodes:
        nodes.plan(warm_up, seed)
        for name, chosen in options.items():
            plans = []
            for number in range(sizes.seeds):
                plans.append(nodes.plan('rover', seed + number, *chosen))
                faults += _faults(nodes)
                if name in (DEFAULT, OPTIMISED):
                    shutil.copyfile(nodes.folder / 'mission.png', _picture(folder, name, number))
            methods[name] = summary(plans)
            print(f'  {name}: {spread(methods[name]["length"])} m', flush=True)
            shown[name] = plans
    # What most is gained on: the longest plan of the default.
    number = int(np.argmax([plan['length'] for plan in shown[DEFAULT]]))
    default, optimised = shown[DEFAULT][number], shown[OPTIMISED][number]
    symbolic = solution_plan(Step(tuple(step['action'])) for step in default['steps'])
    known = kept.read()
    bound = rover_bound(sizes.arc)
    ways = _ways(methods, known['length'], bound)
    write_csv(folder / 'lengths.csv', ways)
    excess = {name: _excess(figures, known['length']) for name, figures in methods.items()}
    return Part(
        title='The mission of Figure 5',
        text=_text(ways, symbolic, sizes, known, methods[DEFAULT]) + _gained(default, optimised),
        figures={
            'methods': methods,
            'best_known': known['length'],
            'lower_bound': bound,
            'faults': faults,
            'improvements': optimised['improvements'],
        },
        targets=(
            Target('default: length over the best known, median', excess[DEFAULT], DEFAULT_EXCESS),
            Target(
                'default: planning time of eight photos, slowest [s]',
                methods[DEFAULT]['planning_time']['max'],
                DEFAULT_TIME,
            ),
            Target(
                f'optimised, {sizes.budget:g} s: length over the best known, median',
                excess[OPTIMISED],
                OPTIMISED_EXCESS,
            ),
            Target('faults that the independent checker finds in the plans', len(faults), 0),
        ),
        claims=(
            Claim(
                'Figure 5 is "one possible solution": eight photos, in the order in which they are listed.',
                f'All photos are taken; in the order of the paper the way is '
                f'{methods[ONE_BY_ONE]["length"]["median"]:.0f} m long where each attitude is chosen by itself, '
                f'{methods[PRINTED]["length"]["median"]:.0f} m with regard to the next photo, and in the order '
                f'that is found {methods[DEFAULT]["length"]["median"]:.0f} m. The best known is '
                f'{known["length"]:.0f} m, and none is shorter than {bound:.0f} m.',
            ),
        ),
        pictures=[_shown(folder, name, number) for name in (DEFAULT, OPTIMISED)],
    )


def rover_bound(arc: float) -> float:
    """The lower bound [m] for the rover's eight photos, with arcs of length ``arc`` [m]."""
    world = yaml.safe_load(ROVER.read_text(encoding='utf-8'))
    places = np.array([[at['x'], at['y']] for at in world['objects'].values()], float)
    return lower_bound(
        places[0],
        places[1:],
        FARTHEST,
        outlines(world['obstacles']),
        world['bounds'],
        world['robots']['rover0']['radius'],
        arc,
    )


def _labels() -> list[str]:
    return [f'location{k}' for k in range(1, 9)]


def _faults(nodes: Nodes) -> list[str]:
    return Judge(nodes.folder / 'plan.json', ROVER).complaints()


def _picture(folder: Path, name: str, number: int) -> Path:
    return folder / f'{name.replace(", ", "_")}_{number}.png'


def _shown(folder: Path, name: str, number: int) -> Path:
    """The picture of one plan under the name that it has on the page."""
    picture = folder / f'{name.replace(", ", "_")}.png'
    shutil.copyfile(_picture(folder, name, number), picture)
    return picture


def _gained(default: Mapping[str, Any], optimised: Mapping[str, Any]) -> str:
    """How one plan became shorter."""
    steps = optimised['improvements']
    if len(steps) < 2:
        return 'Nothing was gained on this plan.\n'
    found = ', '.join(f'{step["length"]:.1f} m after {step["elapsed"]:.1f} s' for step in steps[:6])
    return (
        f'Of the seeds this is the one whose default is longest, {default["length"]:.1f} m. '
        f'Optimised: {found}{" ..." if len(steps) > 6 else ""}.\n'
    )


def _excess(figures: Mapping[str, Mapping[str, float]], known: float) -> float:
    return figures['length']['median'] / known - 1.0


def _ways(
    methods: Mapping[str, Mapping[str, Mapping[str, float]]], known: float, bound: float
) -> list[dict[str, Any]]:
    """Lengths and times, the longest way first."""
    found: list[dict[str, Any]] = [
        {'way': name, **{key: figures[key] for key in ('length', 'planning_time')}}
        for name, figures in sorted(methods.items(), key=lambda item: -item[1]['length']['median'])
    ]
    found.append({'way': 'best known', 'length': middle_and_ends([known])})
    found.append({'way': 'lower bound', 'length': middle_and_ends([bound])})
    return [way | {'of_the_best_known': way['length']['median'] / known} for way in found]


def _row(way: Mapping[str, Any]) -> tuple[str, str, str, str]:
    return (
        way['way'],
        spread(way['length']),
        f'{way["of_the_best_known"]:.3f}',
        spread(way['planning_time'], 2) if 'planning_time' in way else '',
    )


def _text(
    ways: Sequence[Mapping[str, Any]],
    symbolic: Sequence[str],
    sizes: Sizes,
    known: Mapping[str, Any],
    default: Mapping[str, Mapping[str, float]],
) -> str:
    head = ('', 'length [m]', 'of the best known', 'planning time [s]')
    shares = [
        f'{default[key]["median"]:.2f} s {what}'
        for key, what in (
            ('search_time', 'in the task planner'),
            ('request_time', 'in the motion planner'),
            ('transport_time', 'between them'),
        )
    ]
    order = ', '.join(step['action'][2].removeprefix('location') for step in known['steps'][1:])
    return f"""
The three nodes plan the mission `rover` in each way with {sizes.seeds} seeds; medians, and from least to greatest. The default is
planned first: with its first seed the nodes know nothing of this world yet, with the others and in the other ways they do. Every plan is judged by the independent
checker of the tests (`tests/support/checker.py`), which shares no code with the planner.

{table(head, map(_row, ways))}

- **The printed order** is that of the paper's plan, 1 to 8, as ordered tasks. Attitudes and motions are free; **one by one** each photo is taken from where it is
  nearest, otherwise with regard to the photos that follow.
- **Nearest first** is `--guidance nearest_first`; **default** asks for a tour ([ordering.md](ordering.md)); **optimised** is `--optimise` with
  {sizes.budget:g} s. Of the default's time, in the median, {', '.join(shares)}.
- **Best known** is from a long search that shares no code with the planner: thousands of attitudes laid at random bearings, joined by free Dubins
  words, an exact tour through them by dynamic programming over subsets, and local moves of the whole tour; again with other seeds. It meets the objectives in
  the order {order}. It is kept as a plan in `experiments/paper/best_known/rover.json`, which the tests have judged by the checker.
  `ros2_ws/run {known['made_by']}` runs the round that found it once more, in about a
  minute, and says whether its tour is as long as the one that is kept; a shorter one would be kept instead.
- **Lower bound**: who photographs an objective crosses the circle of 100 m round it. No way from the start that touches a point of each circle, round
  the obstacles, headings and turning radius set aside, is shorter than this. It is no shortest way itself: the circles are cut into arcs of {sizes.arc:g} m, the order
  and the arcs are the best ones exactly, and half an arc is taken off at both ends of each leg; `experiments/paper/lower_bound.py` has the argument.

The plan of the default, as the paper prints it, and its picture; below it the optimised one:

```
{chr(10).join(symbolic)}
```
"""
