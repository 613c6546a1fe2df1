"""How reliably and how fast are geometric constraints solved, beside scipy and CasADi?

Run it with ``make experiment-constraints``. The tables go to the terminal and to the page
docs/solving-benchmark.md when asked for, the figures to results.json.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from experiments.constraints import report
from experiments.constraints.search import Bench, Outcome
from experiments.constraints.sets import ConstraintSet, read_sets
from experiments.results import Target, machine, write_results

ROOT = Path(__file__).resolve().parent.parent.parent
#: Random starts of each set: 16 batches of 64.
STARTS = 1024
#: Starts on which the methods are compared, one at a time.
COMPARED = 100
EXCHANGES = 500
PARTS = ('search', 'speed', 'cold', 'service')


def search(sets: Sequence[ConstraintSet], starts: int, seed: int) -> list[Outcome]:
    """Solve every set from random starts of its own."""
    bench = Bench()
    return [
        bench.solve(constraints, bench.starts(seed + number, starts))
        for number, constraints in enumerate(sets)
    ]


def search_targets(outcomes: Sequence[Outcome]) -> list[Target]:
    """What was to be reached in the search for solutions, and for proofs that there are none."""
    feasible = [outcome for outcome in outcomes if outcome.feasible]
    infeasible = [outcome for outcome in outcomes if not outcome.feasible]
    solved = min(outcome.batches_solved / outcome.batches for outcome in feasible)
    found = sum(outcome.solved + outcome.wrong for outcome in infeasible)
    proven = sum(bool(outcome.proof_by) for outcome in infeasible) / len(infeasible)
    return [
        Target('constraint sets', len(outcomes), 30, at_least=True),
        Target('infeasible constraint sets', len(infeasible), 10, at_least=True),
        Target(
            'share of batches of 64 starts solved, worst feasible set', solved, 1, at_least=True
        ),
        Target('solutions that the judge refuses', sum(o.wrong for o in outcomes), 0),
        Target('solutions "found" of infeasible sets', found, 0),
        Target('share of infeasible sets proven impossible', proven, 0.8, at_least=True),
        Target('feasible sets "proven" impossible', sum(bool(o.proof_by) for o in feasible), 0),
    ]


def speed(sets: Sequence[ConstraintSet], starts: int, seed: int) -> dict[str, Any]:
    """Compare with the peers on the sets that are written out for them."""
    from experiments.constraints.formulations import FORMULATIONS
    from experiments.constraints.speed import compare

    bench = Bench()
    return {
        constraints.name: compare(bench, constraints, bench.starts(seed, starts), seed + 1)
        for constraints in sets
        if constraints.name in FORMULATIONS
    }


def speed_targets(comparisons: Mapping[str, Any]) -> list[Target]:
    """What was to be reached beside the peers, on the worst set."""

    def worst(key: str) -> float:
        return float(min(comparison[key] for comparison in comparisons.values()))

    return [
        Target(
            'one destination, times faster than the best peer, worst set',
            worst('times_faster_alone'),
            10,
            at_least=True,
        ),
        Target(
            'success rate above that of the best peer, worst set',
            worst('success_over_best_peer'),
            0,
            at_least=True,
        ),
        Target(
            'in a batch, times faster per destination than the best peer, worst set',
            worst('times_faster_in_batches'),
            100,
            at_least=True,
        ),
    ]


def main() -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--only', choices=PARTS, action='append', help='only this part')
    parser.add_argument('--seed', type=int, default=1, help='seed of the starts (default: 1)')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'constraints', help='folder'
    )
    parser.add_argument('--page', type=Path, help='write the tables to this Markdown file as well')
    arguments = parser.parse_args()
    parts = arguments.only or PARTS
    sets = read_sets()
    figures: dict[str, Any] = {}
    targets: list[Target] = []
    sections: list[tuple[str, str]] = []

    def show(title: str, text: str) -> None:
        sections.append((title, text))
        print(f'\n{title}\n\n{text}', flush=True)

    if 'search' in parts:
        outcomes = search(sets, STARTS, arguments.seed)
        figures['search'] = [outcome.as_figures() for outcome in outcomes]
        targets += search_targets(outcomes)
        show('Sets with solutions', report.feasible_table(outcomes))
        show('Sets without solutions', report.infeasible_table(outcomes))
    if 'speed' in parts:
        comparisons = speed(sets, COMPARED, arguments.seed)
        figures['speed'] = comparisons
        targets += speed_targets(comparisons)
        show('One destination: median time and success', report.alone_table(comparisons))
        show('In batches: time per destination and success', report.batch_table(comparisons))
    if 'cold' in parts:
        from experiments.constraints.cold import two_processes

        processes = two_processes()
        figures['cold'] = processes
        compiled = processes[1]['compiled_functions']
        targets.append(Target('functions compiled by a second process', compiled, 0))
        show('From an empty cache of compiled code', report.cold_table(processes))
    if 'service' in parts:
        from experiments.constraints.service import measure

        take_photo = next(constraints for constraints in sets if constraints.name == 'take_photo')
        service = measure(take_photo, EXCHANGES)
        figures['service'] = service
        more = service['more_than_bare_ms']
        targets.append(Target('take_photo over a bare exchange, median [ms]', more, 1))
        show('Through the service', report.service_table(service))
    show('Targets', '\n'.join(f'- {target}' for target in targets))
    print(f'\nwritten: {write_results(arguments.output, arguments.seed, figures, targets)}')
    if arguments.page:
        arguments.page.write_text(report.page(sections, machine()), encoding='utf-8')


if __name__ == '__main__':
    main()
