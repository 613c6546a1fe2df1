"""Part 4: messages between the planners, with advice and without, and geometry all beforehand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from experiments.paper.beforehand import plan_beforehand
from experiments.paper.part import Claim, Part, write_csv
from experiments.paper.photos import WARM_UP, write_mission
from experiments.paper.report import table
from experiments.planning import COUNTS, Nodes, middle_and_ends, nodes_up

#: Options of geohtn by the names of the methods.
METHODS: Mapping[str, tuple[str, ...]] = {
    'tour': (),
    'nearest first': ('--guidance', 'nearest_first'),
    'no advice': ('--no-advice',),
}
BEFOREHAND = 'all beforehand'
SECONDS = ('planning_time', 'request_time', 'transport_time')
COLUMNS = (*COUNTS, *SECONDS, 'length')
HEADINGS = {
    'planning_time': 'planning time [s]',
    'request_time': 'in the motion planner [s]',
    'transport_time': 'between the nodes [s]',
    'length': 'length [m]',
}
#: What was counted in each plan, by the names of the methods.
Counted = dict[str, list[Mapping[str, float]]]
#: Median, least and greatest of each column, by the names of the methods.
Figures = dict[str, dict[str, dict[str, float]]]


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    goals: numbers of photos
    sets: random sets of each, and seeds of each of the ``missions``
    alternatives: destinations of each photo beforehand
    missions: others, in which the symbols restrict the order, so that the search has to step back
    """

    goals: tuple[int, ...]
    sets: int
    alternatives: int
    missions: tuple[str, ...]


FULL = Sizes(goals=(4, 8, 12), sets=5, alternatives=3, missions=('office', 'guards', 'samples'))
QUICK = Sizes(goals=(4,), sets=1, alternatives=2, missions=('samples',))


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Plan the same random missions in every way, and count."""
    figures: dict[int, Figures] = {}
    others: dict[str, Figures] = {}
    without_answer = 0.0
    with nodes_up(folder / 'plan') as nodes:
        nodes.plan(write_mission(folder / 'warm_up', WARM_UP, seed), seed)
        for count in sizes.goals:
            found: Counted = {}
            for number in range(sizes.sets):
                mission = write_mission(folder / f'{count}_{number}', count, seed + number, tiles=1)
                # Other seeds for each method: no answer to a request is remembered.
                for other, (name, options) in enumerate(METHODS.items(), seed):
                    found.setdefault(name, []).append(_counted(nodes, mission, other, options))
                # The nodes still hold this mission's world.
                found.setdefault(BEFOREHAND, []).append(
                    plan_beforehand(nodes.namespace, count, sizes.alternatives, seed + len(METHODS))
                )
            figures[count] = _figures(found)
            without_answer += _without_answer(found)
            asked = [figures[count][name]['requests']['median'] for name in (BEFOREHAND, 'tour')]
            print(
                f'  {count} photos: {asked[0]:.0f} requests beforehand, {asked[1]:.0f} when needed'
            )
        for installed in sizes.missions:
            found = {
                name: [
                    _counted(nodes, installed, seed + len(METHODS) * each + other, options)
                    for each in range(sizes.sets)
                ]
                for other, (name, options) in enumerate(METHODS.items())
            }
            others[installed] = _figures(found)
            without_answer += _without_answer(found)
            print(f'  {installed}: {others[installed]["tour"]["requests"]["median"]:.0f} requests')
    named = {f'{count} photos': methods for count, methods in figures.items()} | others
    records: list[dict[str, Any]] = [
        {'mission': mission, 'method': name, **told}
        for mission, methods in named.items()
        for name, told in methods.items()
    ]
    write_csv(folder / 'messages.csv', records)
    rows = [
        (f'{told["mission"]}, {told["method"]}', *(_cell(key, told[key]) for key in COLUMNS))
        for told in records
    ]
    head = ('mission, method', *(_heading(key) for key in COLUMNS))
    return Part(
        title='Messages, and geometry asked for beforehand',
        text=_text(sizes, table(head, rows), without_answer, figures),
        figures={'sizes': figures, 'missions': others, 'without_answer': without_answer},
        claims=_claims(figures, others),
    )


def _counted(
    nodes: Nodes, mission: Path | str, seed: int, options: tuple[str, ...]
) -> dict[str, float]:
    plan = nodes.plan(mission, seed, *options)
    counted = {**plan['statistics'], 'length': plan['length']}
    return {key: counted[key] for key in COLUMNS}


def _figures(found: Counted) -> Figures:
    return {
        name: {key: middle_and_ends([row[key] for row in rows]) for key in COLUMNS}
        for name, rows in found.items()
    }


def _without_answer(found: Counted) -> float:
    return sum(row['requests'] - row['answers'] for rows in found.values() for row in rows)


def _claims(figures: Mapping[int, Figures], others: Mapping[str, Figures]) -> tuple[Claim, ...]:
    count = max(figures)
    lazy, all_of_it, without = (
        {key: figure['median'] for key, figure in figures[count][name].items()}
        for name in ('tour', BEFOREHAND, 'no advice')
    )
    return (
        Claim(
            'With geometric preprocessing "geometric computations are performed even for actions that '
            'will not be selected to belong to the final plan".',
            f'{count} photos take {lazy["requests"]:.0f} requests and {lazy["advices"]:.0f} advices, '
            f'and {lazy["planning_time"]:.2f} s, {lazy["request_time"]:.2f} s of it in the motion planner; asked for '
            f'beforehand, {all_of_it["requests"]:.0f} requests one after the other and {all_of_it["planning_time"]:.1f} s, '
            f'{all_of_it["request_time"]:.1f} s of it in the motion planner. An advice is one message, but it works out '
            'attitudes, costs between them, an order and legs.',
        ),
        Claim(
            '"Advices allow a reordering of tasks according to geometric aspects."',
            f'The plan of {count} photos is {lazy["length"]:.0f} m long; without advice, in the order '
            f'of the problem, {without["length"]:.0f} m. {_restricted(others)}',
        ),
    )


def _restricted(others: Mapping[str, Figures]) -> str:
    """The lengths of missions whose order the facts restrict."""
    told = [
        f'`{name}` {methods["tour"]["length"]["median"]:.0f} m against '
        f'{methods["no advice"]["length"]["median"]:.0f} m'
        for name, methods in others.items()
    ]
    return f'Where facts restrict the order: {", ".join(told)}.'


def _heading(key: str) -> str:
    return HEADINGS.get(key, key.replace('_', ' '))


def _cell(key: str, figure: Mapping[str, float]) -> str:
    return f'{figure["median"]:.{2 if key in SECONDS else 0}f}'


def _inside(figures: Mapping[int, Figures]) -> str:
    """What the motion planner does for each method, at the greatest number of photos."""
    count = max(figures)
    medians = {
        name: {key: figure['median'] for key, figure in told.items()}
        for name, told in figures[count].items()
    }
    spent = ', '.join(
        f'{name} {told["request_time"]:.2f} s in {told["requests"] + told["advices"]:.0f} messages'
        for name, told in medians.items()
    )
    asked = medians[BEFOREHAND]
    each = [1e3 * asked[key] / asked['requests'] for key in SECONDS]
    return f"""- **An advice** is one message and much work: attitudes of all candidates, what it costs to drive between them, and of a tour an order and its
  legs as well ([ordering.md](ordering.md)). So the counts are those of messages, not of geometry that was computed; what that takes is the time in the
  motion planner. For {count} photos: {spent}. Requests beforehand are calls of a service, one after the other: {each[0]:.1f} ms each,
  {each[1]:.1f} ms of it in the motion planner and {each[2]:.1f} ms between the nodes."""


def _text(sizes: Sizes, lines: str, without_answer: float, figures: Mapping[int, Figures]) -> str:
    lost = (
        f'{without_answer:.0f} requests have none'
        if without_answer
        else 'no request is without one'
    )
    return f"""
Photos of random objectives in the rover's world, {sizes.sets} sets of each size, and other missions; medians. Each method has a seed of its own. The tour
is planned first: of a world of photos, and of another mission with the first seed, the motion planner knows nothing then.

{lines}

- **No advice** takes the photos in the order of the problem; **nearest first** asks which is nearest after each photo; **tour** is the default.
- **All beforehand** is the preprocessing that the paper argues against, over the same motion planner: {sizes.alternatives} destinations of each photo, then a motion
  from each of them to each of the others', one request each, and after that the exact shortest tour through this graph. It sees only these
  destinations; what it finds is a shortest tour among them, not among all.
- **{'**, **'.join(sizes.missions)}**: missions of [missions.md](missions.md), with {sizes.sets} seeds each. In `samples` a memory, a store and calibrations restrict the
  order. The task planner rehearses orders before it asks for a motion ([ordering.md](ordering.md#rehearsals)), so that no request is made for what the facts forbid.
  In `guards` one more order is driven once the first plan tells where the robots wait for each other, hence twice the requests.
{_inside(figures)}
- `answers` are counted where they arrive, errors left out: {lost}. A request beforehand that has no answer with a motion is no arc of the graph.
"""
