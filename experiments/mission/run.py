"""How long does the paper's mission take to plan, and where does the time go?

Three nodes are started once; then the mission is planned over and over, with advice and, as the
peer in the same run, without it. Run it with ``make experiment-mission``.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import statistics
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from experiments.results import Target, write_results

ROOT = Path(__file__).resolve().parent.parent.parent
#: [s] for the eight photos, nodes already up.
PLANNING_TIME_TARGET = 2.0
TIMES = ('planning_time', 'search_time', 'request_time', 'transport_time')
COUNTS = ('requests', 'answers', 'advices', 'backtracks', 'geometric_backtracks')


@contextmanager
def nodes_up(namespace: str) -> Iterator[None]:
    """The three nodes in ``namespace``, ready."""
    process = subprocess.Popen(
        ['geohtn', 'up', '--namespace', namespace],
        stdout=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    assert process.stdout is not None
    try:
        if not any('ready' in line for line in process.stdout):
            raise SystemExit('geohtn up did not start the nodes')
        yield
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()
        process.stdout.close()


def plan(namespace: str, seed: int, *options: str) -> dict[str, Any]:
    """Plan the rover mission once and return its plan.json."""
    with tempfile.TemporaryDirectory() as folder:
        command = ['geohtn', 'plan', 'rover', '--namespace', namespace, '--output', folder]
        done = subprocess.run(
            [*command, '--seed', str(seed), *options], capture_output=True, text=True, check=False
        )
        if done.returncode != 0:
            raise SystemExit(f'seed {seed}: exit code {done.returncode}\n{done.stderr}')
        document: dict[str, Any] = json.loads(Path(folder, 'plan.json').read_text())
        return document


def summary(plans: list[dict[str, Any]]) -> dict[str, Any]:
    """Median, least and greatest of every figure over ``plans``."""
    figures = {key: [plan['statistics'][key] for plan in plans] for key in (*TIMES, *COUNTS)}
    figures['length'] = [plan['length'] for plan in plans]
    return {
        key: {'median': statistics.median(values), 'min': min(values), 'max': max(values)}
        for key, values in figures.items()
    }


def print_table(methods: dict[str, dict[str, Any]]) -> None:
    """One line per figure, one column per method: median (least to greatest)."""
    rows = [*((key, 's') for key in TIMES), ('length', 'm'), *((key, '') for key in COUNTS)]
    print(f'{"":24}' + ''.join(f'{name:>32}' for name in methods))
    for key, unit in rows:
        cells = []
        for figures in methods.values():
            spread = figures[key]
            digits = 3 if unit == 's' else 0
            low, middle, high = (f'{spread[k]:.{digits}f}' for k in ('min', 'median', 'max'))
            cells.append(f'{f"{middle} ({low} to {high})":>32}')
        print(f'{key + (f" [{unit}]" if unit else ""):24}' + ''.join(cells))


def main() -> None:
    """Run the experiment."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('--runs', type=int, default=10, help='plans per method (default: 10)')
    parser.add_argument('--seed', type=int, default=1, help='seed of the first (default: 1)')
    parser.add_argument(
        '--output', type=Path, default=ROOT / 'out' / 'experiments' / 'mission', help='folder'
    )
    arguments = parser.parse_args()
    namespace = f'experiment_mission_{os.getpid()}'
    seeds = range(arguments.seed, arguments.seed + arguments.runs)
    methods: dict[str, dict[str, Any]] = {}
    with nodes_up(namespace):
        plan(namespace, arguments.seed + arguments.runs)
        methods['with advice'] = summary([plan(namespace, seed) for seed in seeds])
        methods['without advice'] = summary(
            [plan(namespace, seed, '--no-advice') for seed in seeds]
        )
    ratio = (
        methods['without advice']['length']['median'] / methods['with advice']['length']['median']
    )
    targets = [
        Target(
            'planning time of eight photos, median [s]',
            methods['with advice']['planning_time']['median'],
            PLANNING_TIME_TARGET,
        ),
        Target(
            'planning time of eight photos, slowest [s]',
            methods['with advice']['planning_time']['max'],
            PLANNING_TIME_TARGET,
        ),
    ]
    figures = {'runs': arguments.runs, 'methods': methods, 'length_without_over_with_advice': ratio}
    print_table(methods)
    print(f'without advice the plans are {ratio:.2f} times as long')
    print(f'written: {write_results(arguments.output, arguments.seed, figures, targets)}')
    for target in targets:
        print(target)


if __name__ == '__main__':
    main()
