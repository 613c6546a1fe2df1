"""Part 6: missions that are no rover demo, planned with several seeds and judged independently.

An inspection round with lines of sight in an office map, a guard tour of two robots whose attitudes
constrain each other, and a rover that samples, calibrates cameras and delivers.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path

import yaml

from experiments.paper.part import Claim, Part, write_csv
from experiments.planning import Nodes, middle_and_ends, nodes_up, spread
from experiments.results import Target
from tests.support.checker import Judge

#: Folder name and what is shown by it.
MISSIONS = {
    'office': 'lines of sight in an office map, a differential drive',
    'guards': 'two robots, a car and an omnidirectional one, that keep each other in view',
    'samples': 'cameras to calibrate, a store of two compartments, a car that reverses',
}
FOLDER = Path(__file__).resolve().parents[2] / 'src' / 'interface_node' / 'missions'


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    seeds: plans of each mission, with as many seeds
    others: of these the ones with which it is also planned nearest first, and optimised for so many ``seconds``
    """

    seeds: int
    others: int
    seconds: float


FULL, QUICK = Sizes(seeds=10, others=3, seconds=30.0), Sizes(seeds=1, others=1, seconds=5.0)
NEAREST, OPTIMISED = 'nearest first', 'optimised'


@dataclass(frozen=True)
class Planned:
    """One plan of one mission.

    ``length`` [m] of all motions, ``planning_time`` [s], ``not_found`` how many requests were
    answered IMPOSSIBLE or UNKNOWN, ``faults`` what the independent checker complains of. ``backtracks`` are among
    tasks, methods and bindings, ``geometric_backtracks`` among destinations, as in part 4.
    """

    mission: str
    seed: int
    outcome: str
    actions: int = 0
    length: float = 0.0
    planning_time: float = 0.0
    requests: int = 0
    not_found: int = 0
    backtracks: int = 0
    geometric_backtracks: int = 0
    faults: tuple[str, ...] = ()


def plan(nodes: Nodes, mission: str, seed: int) -> Planned:
    """Plan a mission with nodes that run, leave its files in their folder and have them judged."""
    shutil.rmtree(nodes.folder, ignore_errors=True)
    document = nodes.plan(FOLDER / mission, seed)
    counts = document['statistics']
    judge = Judge(nodes.folder / 'plan.json', FOLDER / mission / 'world.yaml')
    return Planned(
        mission=mission,
        seed=seed,
        outcome=document['outcome'],
        actions=len(document['steps']),
        length=document['length'],
        planning_time=document['planning_time'],
        requests=counts['requests'],
        not_found=counts['impossible'] + counts['unknown'],
        backtracks=counts['backtracks'],
        geometric_backtracks=counts['geometric_backtracks'],
        faults=tuple(judge.complaints()),
    )


def measure(sizes: Sizes, seed: int, folder: Path) -> Part:
    """Plan every mission ``sizes.seeds`` times from ``seed`` on; files go into ``folder``."""
    plans: list[Planned] = []
    lengths: dict[str, dict[str, list[float]]] = {}
    options = {
        NEAREST: ('--guidance', 'nearest_first'),
        OPTIMISED: ('--optimise', '--time-budget', str(sizes.seconds)),
    }
    pictures: list[Path] = []
    with nodes_up(folder) as nodes:
        for mission in MISSIONS:
            for number in range(seed, seed + sizes.seeds):
                output = folder / 'missions' / f'{mission}-{number}'
                plans.append(plan(replace(nodes, folder=output), mission, number))
            picture = folder / f'mission_{mission}.png'
            shutil.copyfile(folder / 'missions' / f'{mission}-{seed}' / 'mission.png', picture)
            pictures.append(picture)
            lengths[mission] = {
                name: [
                    nodes.plan(FOLDER / mission, number, *chosen)['length']
                    for number in range(seed, seed + sizes.others)
                ]
                for name, chosen in options.items()
            }
    table = write_csv(folder / 'missions.csv', map(asdict, plans))
    return Part(
        title='Other missions',
        text=_text(plans, lengths, sizes, table),
        figures={'plans': [asdict(plan) for plan in plans], 'lengths': lengths},
        targets=_targets(plans),
        claims=[_claim(plans)],
        pictures=pictures,
    )


def _targets(plans: Sequence[Planned]) -> list[Target]:
    solved = sum(plan.outcome == 'SOLVED' for plan in plans)
    return [
        Target('missions solved, share', solved / len(plans), 1.0, at_least=True),
        Target(
            'motions refused and constraints missed, by the independent checker',
            sum(len(plan.faults) for plan in plans),
            0.0,
        ),
    ]


def _claim(plans: Sequence[Planned]) -> Claim:
    worlds = [
        yaml.safe_load((FOLDER / name / 'world.yaml').read_text('utf-8')) for name in MISSIONS
    ]
    models = [robot['model'] for world in worlds for robot in world['robots'].values()]
    solved = sum(plan.outcome == 'SOLVED' for plan in plans)
    return Claim(
        'The language of operators with geometric preconditions is general; the paper shows it with '
        'one mission of one rover.',
        f'{len(MISSIONS)} further missions with {len(models)} robots of {len(set(models))} models: {solved} of '
        f'{len(plans)} plans found, {sum(len(plan.faults) for plan in plans)} faults in them.',
    )


def _text(
    plans: Sequence[Planned],
    lengths: Mapping[str, Mapping[str, Sequence[float]]],
    sizes: Sizes,
    table: Path,
) -> str:
    """The Markdown: a line for each mission."""
    lines = [
        (
            'Each mission is planned by the three nodes with several seeds. Every plan is judged by '
            '`tests/support/checker.py`, which shares no code with the planner: commands, motions by '
            'integration, clearance (also from the other robot) and lines of sight by shapely, all '
            'preconditions of the domain '
            'file at every step. Figures are medians (least to greatest). **Nearest first** and **optimised** are the lengths '
            f'with `--guidance nearest_first` and with {sizes.seconds:g} s of `--optimise`.'
        ),
        '',
        (
            '| mission | what it shows | plans | actions | length [m] | nearest first [m] | optimised [m] '
            '| planning time [s] | requests | not found | backtracks | geometric backtracks | faults |'
        ),
        '|---|---|---|---|---|---|---|---|---|---|---|---|---|',
    ]
    for mission, shows in MISSIONS.items():
        own = [plan for plan in plans if plan.mission == mission]
        solved = sum(plan.outcome == 'SOLVED' for plan in own)
        cells = [
            f'`{mission}`',
            shows,
            f'{solved} of {len(own)}',
            spread(middle_and_ends([plan.actions for plan in own]), 0),
            spread(middle_and_ends([plan.length for plan in own]), 0),
            spread(middle_and_ends(lengths[mission][NEAREST]), 0),
            spread(middle_and_ends(lengths[mission][OPTIMISED]), 0),
            spread(middle_and_ends([plan.planning_time for plan in own]), 1),
            spread(middle_and_ends([plan.requests for plan in own]), 0),
            spread(middle_and_ends([plan.not_found for plan in own]), 0),
            spread(middle_and_ends([plan.backtracks for plan in own]), 0),
            spread(middle_and_ends([plan.geometric_backtracks for plan in own]), 0),
            str(sum(len(plan.faults) for plan in own)),
        ]
        lines.append('| ' + ' | '.join(cells) + ' |')
    lines += ['', f'Every plan is a line of `{table.name}`.']
    return '\n'.join(lines)
