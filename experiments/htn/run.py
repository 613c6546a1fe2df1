"""How fast does the task planner search, beside GTPyhop and unified-planning's Aries?

Run it with ``make experiment-htn``.  The tables go to the terminal and to the page docs/htn-benchmark.md when
asked for, the figures to results.json.  Public HDDL domains are tried by experiments.htn.public_domains.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from experiments.htn import comparison, ours, report, shop_texts, tracing
from experiments.htn.comparison import Hddl, Speed
from experiments.results import Target, machine, write_results

ROOT = Path(__file__).resolve().parent.parent.parent
#: Searches of which the fastest counts.
REPETITIONS = 10
#: [s] for Aries on each problem.
BUDGET = 20.0
#: Blocks problems of which the plan lengths are compared.
SEEDS = 5
PIGEONS = 7
PARTS = ('speed', 'hddl', 'long', 'tracing')


def speed_targets(speeds: Sequence[Speed]) -> list[Target]:
    """What was to be reached in speed."""
    slowest = min(speed.rate for speed in speeds)
    blocks = next(speed for speed in speeds if speed.name.startswith('blocks'))
    name = f'{blocks.name}: times faster than GTPyhop'
    return [
        Target('decompositions a second, slowest problem', slowest, 50_000, at_least=True),
        Target(name, blocks.times_faster, 5, at_least=True),
    ]


def plan_targets(speeds: Sequence[Speed], lengths: Sequence[tuple[int, int]]) -> list[Target]:
    """What was to be reached in the plans."""
    others = [s.actions / max(1, s.peer_actions) for s in speeds if not s.name.startswith('blocks')]
    blocks = sum(own for own, _ in lengths) / sum(peer for _, peer in lengths)
    return [
        Target('plans that do not reach the goal', sum(bool(s.fault) for s in speeds), 0),
        Target("blocks: actions over GTPyhop's, sum of several problems", blocks, 1),
        Target("actions over GTPyhop's, worst of the other problems", max(others), 1),
    ]


def hddl_targets(runs: Sequence[Hddl]) -> list[Target]:
    """What was to be reached with HDDL."""
    refused = sum(bool(run.fault) for run in runs)
    return [
        Target("HDDL problems without a plan that unified-planning's simulator accepts", refused, 0)
    ]


def main() -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').partition('\n')[0])
    parser.add_argument('--only', choices=PARTS, action='append', help='only this part')
    parser.add_argument('--seed', type=int, default=1, help='seed of the problems (default: 1)')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'htn', help='folder'
    )
    parser.add_argument('--page', type=Path, help='write the tables to this Markdown file as well')
    arguments = parser.parse_args()
    parts = arguments.only or PARTS
    seed = arguments.seed
    figures: dict[str, Any] = {'peers': report.peer_versions()}
    targets: list[Target] = []
    sections: list[tuple[str, str]] = []

    def show(title: str, text: str) -> None:
        sections.append((title, text))
        print(f'\n{title}\n\n{text}', flush=True)

    if 'speed' in parts:
        problems = comparison.large_problems(seed)
        speeds = [comparison.speed(name, p, REPETITIONS) for name, p in problems.items()]
        lengths = comparison.block_lengths(300, range(seed, seed + SEEDS))
        figures['speed'] = [speed.as_figures() for speed in speeds]
        figures['blocks_lengths'] = lengths
        targets += [*speed_targets(speeds), *plan_targets(speeds, lengths)]
        show('Beside GTPyhop', report.speed_table(speeds))
        show('Plan lengths of blocks', report.lengths_table(lengths))
    if 'hddl' in parts:
        small = comparison.small_problems(seed)
        runs = [comparison.hddl(name, problem, BUDGET) for name, problem in small.items()]
        figures['hddl'] = [run.as_figures() for run in runs]
        targets += hddl_targets(runs)
        show('HDDL, beside Aries', report.hddl_table(runs))
    if 'long' in parts:
        long = comparison.long_plan(comparison.LONG)
        seconds = long.reading + long.searching
        steps = len(long.result.steps)
        figures['long'] = {'steps': steps, 'seconds': seconds}
        targets += [
            Target('steps of the long plan', steps, comparison.LONG, at_least=True),
            Target('the long plan [s]', seconds, 5),
        ]
        show('A long plan', report.facts_table({f'{steps:,} steps': f'{seconds:.2f} s'}))
    if 'tracing' in parts:
        blocks = comparison.large_problems(seed)['blocks 300']
        texts = shop_texts.domain_text(blocks), shop_texts.problem_text(blocks)
        log = tracing.log_share(*texts, REPETITIONS)
        dead_ends = tracing.dead_end_share(PIGEONS, REPETITIONS)
        tried = ours.plan(tracing.PIGEONS, tracing.pigeons(PIGEONS)).decompositions
        figures['tracing'] = {'log': log, 'dead_ends': dead_ends, 'decompositions': tried}
        targets.append(
            Target('keeping track, part of the search [%]', 100 * max(log, dead_ends), 15)
        )
        shares = {
            'log of decompositions, blocks 300': f'{log:.1%}',
            f'dead ends, {tried:,} decompositions without a plan': f'{dead_ends:.1%}',
        }
        show('Keeping track', report.facts_table(shares))
    show('Targets', '\n'.join(f'- {target}' for target in targets))
    print(f'\nwritten: {write_results(arguments.output, seed, figures, targets)}')
    if arguments.page:
        arguments.page.write_text(report.page(sections, machine()), encoding='utf-8')


if __name__ == '__main__':
    main()
