"""How short, how fast and how safe are motions, beside an exhaustive reference and plain OMPL?

Run it with ``make experiment-motion``. The tables go to the terminal and to the page
docs/motion-benchmark.md when asked for, the figures to results.json, the pictures beside it.
"""

from __future__ import annotations

import argparse
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import ceil
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from experiments.motion import report
from experiments.motion.asking import ask, summary
from experiments.motion.reference import FOLDER, Known, read
from experiments.motion.worlds import ROOT, WORLDS, Place
from experiments.results import Target, machine, write_results
from motion_planner_node.planner import warm_up

if TYPE_CHECKING:
    from experiments.motion.service import Exchanges

PARTS = (
    'requests', 'vain', 'curve', 'planners', 'advice', 'stopping', 'service', 'memory', 'pictures',
)  # fmt: skip
PAPERS = 'rover'
#: Worlds on whose legs ours and the usual way, and all planners, are compared.
COMPARED = ('rover', 'maze', 'field')
#: Worlds in which searches are told to stop: the one that is searched longest, and the largest.
STOPPED = ('maze', 'park')
IMAGES = {'curve': 'motion_curve', 'worlds': 'motion_worlds'}


@dataclass(frozen=True)
class Sizes:
    """How much is measured.

    requests, legs, compared: of each world, for the reference, for the curve, for all planners
    motions: that are judged at least, when each request has as many alternatives as are asked for
    vain: requests of each world that the reference searched in vain, at most
    patience: [s] that RRTConnect may take for a leg
    rounds, exchanges: times that advice and the service are tried
    exchange_rounds: times that each request is asked through the service
    stopped: requests that are told to stop, in each world and in each way
    asked, early: requests after which memory is looked at
    """

    requests: int = 1000
    motions: int = 10_500
    vain: int = 1000
    legs: int = 80
    patience: float = 1.0
    compared: int = 24
    rounds: int = 50
    stopped: int = 120
    exchanges: int = 1000
    exchange_rounds: int = 5
    asked: int = 10_000
    early: int = 1_000


QUICK = Sizes(
    requests=20,
    motions=100,
    vain=10,
    legs=4,
    patience=0.3,
    compared=4,
    rounds=4,
    stopped=10,
    exchanges=20,
    exchange_rounds=2,
    asked=60,
    early=20,
)


class Experiment:
    """One run: what was measured, and what was to be reached."""

    def __init__(self, sizes: Sizes, folder: Path, worlds: Sequence[str]) -> None:
        self.sizes = sizes
        self.folder = folder
        self.figures: dict[str, Any] = {}
        self.targets: list[Target] = []
        self.sections: list[tuple[str, str]] = []
        self.places: dict[str, Place] = {name: WORLDS[name](folder) for name in worlds}
        self.references = {
            name: read(name) for name in worlds if (FOLDER / f'{name}.json.gz').exists()
        }

    def known(self, world: str, count: int) -> Sequence[Known]:
        """The first requests of a world."""
        return self.references[world].known[:count]

    @cached_property
    def exchanges(self) -> Exchanges:
        """Requests through the service."""
        from experiments.motion.service import Exchanges

        return Exchanges(self.places[PAPERS], self.known(PAPERS, self.sizes.exchanges))

    def show(self, title: str, text: str) -> None:
        """Add a section, and print it."""
        self.sections.append((title, text))
        print(f'\n{title}\n\n{text}', flush=True)

    def run_requests(self) -> None:
        """Ask all requests that the reference has solved."""
        coverage = {
            name: {
                'solved': len(reference.known),
                'searched_in_vain': len(reference.unsolved),
                'broken_off': len(reference.unsearched),
            }
            for name, reference in self.references.items()
        }
        asked = {name: self.known(name, self.sizes.requests) for name in self.references}
        # As many alternatives of each as make enough motions, and so many where there are fewer.
        alternatives = ceil(self.sizes.motions / sum(map(len, asked.values())))
        worlds = {}
        for name, known in asked.items():
            outcomes = ask(self.places[name], known, alternatives)
            worlds[name] = summary(outcomes)
            print(f'{name}: {len(outcomes)} requests asked', flush=True)
        self.figures['reference'] = coverage
        self.figures['requests'] = worlds
        self.targets += request_targets(worlds)
        self.show('What the reference covers', report.reference_table(coverage))
        self.show('Requests: success, length by the reference, time', report.request_table(worlds))

    def run_vain(self) -> None:
        """Ask the requests that the reference has searched in vain."""
        from experiments.motion.vain import measure

        worlds = {
            name: measure(self.places[name], reference, self.sizes.vain)
            for name, reference in self.references.items()
            if reference.unsolved
        }
        self.figures['vain'] = worlds
        self.show('Requests that the reference searched in vain', report.vain_table(worlds))

    def run_curve(self) -> None:
        """Compare with RRTConnect and simplifier."""
        from experiments.motion.curve import combine, measure

        sizes = self.sizes
        curve = combine(
            [
                measure(self.places[name], self.known(name, sizes.legs), sizes.patience)
                for name in COMPARED
                if name in self.references
            ]
        )
        self.figures['curve'] = curve
        self.targets += curve_targets(curve)
        self.show('Length against time, beside RRTConnect', report.curve_table(curve))

    def run_planners(self) -> None:
        """Compare all planners."""
        from experiments.motion.comparison import measure

        worlds = {
            name: measure(self.places[name], self.known(name, self.sizes.compared))
            for name in COMPARED
            if name in self.references
        }
        self.figures['planners'] = worlds
        self.show('All planners on the same legs', report.planner_table(worlds))

    def run_advice(self) -> None:
        """Measure advice."""
        from experiments.motion.advising import measure

        known = self.known(PAPERS, max(self.sizes.requests, 64))
        advice = measure(self.places[PAPERS], known, self.sizes.rounds)
        self.figures['advice'] = advice
        self.targets += [
            Target('advice on 64 candidates, median [ms]', advice['ms_p50'], 10.0),
            Target('lower bounds above a known length', advice['wrong_bounds'], 0),
        ]
        self.show('Advice on 64 candidates', report.figure_table(advice))

    def run_stopping(self) -> None:
        """Measure how soon searches stop."""
        from experiments.motion.stopping import measure

        stopping = {
            name: measure(self.places[name], self.known(name, self.sizes.stopped))
            for name in STOPPED
            if name in self.references
        }
        self.figures['stopping'] = stopping
        self.targets += stopping_targets(stopping)
        self.show('Searches that are told to stop', report.stopping_table(stopping))

    def run_service(self) -> None:
        """Measure requests through the service, with the rounds that were asked before."""
        while len(self.exchanges) < self.sizes.exchange_rounds:
            self.exchanges.ask()
        service = self.exchanges.figures()
        self.figures['service'] = service
        self.targets += [
            Target('request within the node, rover, p50 [ms]', service['node_ms_p50'], 5.0),
            Target('request within the node, rover, p95 [ms]', service['node_ms_p95'], 50.0),
            Target('more through the service, median [ms]', service['more_ms_p50'], 1.5),
        ]
        self.show('Through the service', report.figure_table(service))

    def run_memory(self) -> None:
        """Measure what 10,000 requests leave behind."""
        from experiments.motion.memory import measure

        memory = measure(self.places[PAPERS], self.sizes.asked, self.sizes.early)
        self.figures['memory'] = memory
        growth = memory['growth_mb']
        self.targets.append(Target('memory after all requests over early ones [MB]', growth, 10.0))
        self.show('Memory', report.figure_table(memory))

    def run_pictures(self) -> None:
        """Draw the curve and the worlds."""
        from experiments.motion.pictures import draw_curve, draw_worlds

        if 'curve' in self.figures:
            draw_curve(self.figures['curve'], self.folder / f'{IMAGES["curve"]}.png')
        shown = [(self.places[name], self.known(name, 12)) for name in self.references]
        draw_worlds(shown, self.folder / f'{IMAGES["worlds"]}.png')


def request_targets(worlds: Mapping[str, Mapping[str, Any]]) -> list[Target]:
    """What was to be reached with the requests, in the worst world."""
    least = min(figures['success'] for figures in worlds.values())
    targets = [
        Target('success where the reference has a way, worst world', least, 1.0, at_least=True),
        Target(
            'motions judged', sum(figures['motions'] for figures in worlds.values()), 10_000,
            at_least=True,
        ),
        Target(
            'motions that the judge refuses',
            sum(figures['refused_motions'] for figures in worlds.values()),
            0,
        ),
    ]  # fmt: skip
    for key, name, most in (('ratio_p50', 'median', 1.05), ('ratio_p95', '95 %', 1.25)):
        value = max(figures[key] for figures in worlds.values())
        targets.append(Target(f'length by the reference, {name}, worst world', value, most))
    return targets


def curve_targets(curve: Mapping[str, Any]) -> list[Target]:
    """What was to be reached beside RRTConnect, at the worst of the budgets."""
    return [
        Target(
            'times longer RRTConnect is in the same time, least',
            min(curve['shorter_at_equal_time'].values()),
            1.0,
            at_least=True,
        ),
        Target(
            'times slower RRTConnect is to the same length, least',
            min(curve['faster_at_equal_length'].values()),
            1.0,
            at_least=True,
        ),
    ]


def stopping_targets(worlds: Mapping[str, Sequence[Mapping[str, Any]]]) -> list[Target]:
    """What was to be reached by searches that are told to stop, in the worst world."""
    return [
        Target(
            f'answer after a deadline or cancel, {name}, latest [ms]',
            max(
                row['late_ms_max']
                for rows in worlds.values()
                for row in rows
                if row['beside_another'] is beside
            ),
            50.0,
        )
        for beside, name in ((False, 'alone'), (True, 'another robot at a new place'))
    ]


def main() -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--only', choices=PARTS, action='append', help='only this part')
    parser.add_argument('--world', choices=WORLDS, action='append', help='only this world')
    parser.add_argument('--quick', action='store_true', help='a few of everything')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'motion', help='folder'
    )
    parser.add_argument('--page', type=Path, help='write the tables to this Markdown file as well')
    arguments = parser.parse_args()
    sizes = QUICK if arguments.quick else Sizes()
    warm_up()
    experiment = Experiment(sizes, arguments.output, arguments.world or list(WORLDS))
    parts = arguments.only or PARTS
    for part in parts:
        if 'service' in parts and len(experiment.exchanges) < sizes.exchange_rounds:
            # Spread over the run, as a machine is slower for minutes when others use it.
            experiment.exchanges.ask()
        began = perf_counter()
        getattr(experiment, f'run_{part}')()
        print(f'{part}: {perf_counter() - began:.0f} s', flush=True)
    experiment.show('Targets', '\n'.join(f'- {target}' for target in experiment.targets))
    path = write_results(arguments.output, 1, experiment.figures, experiment.targets)
    print(f'\nwritten: {path}')
    if arguments.page:
        page = report.page(experiment.sections, machine(), IMAGES.values(), arguments.quick)
        arguments.page.write_text(page, encoding='utf-8')
        for image in IMAGES.values():
            name = f'{image}.png'
            shutil.copyfile(arguments.output / name, arguments.page.parent / 'images' / name)


if __name__ == '__main__':
    main()
