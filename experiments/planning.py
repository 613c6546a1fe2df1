"""Missions planned by the three real nodes, over and over, for experiments."""

from __future__ import annotations

import json
import signal
import statistics
import subprocess
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from experiments.exchange import own_namespace
from tests.support.processes import processes_in_namespace

TIMES = ('planning_time', 'search_time', 'request_time', 'transport_time')
COUNTS = ('requests', 'answers', 'advices', 'backtracks', 'geometric_backtracks')
NODES = ('motion_planner_node', 'task_planner_node', 'interface_node')


#: [s] for the nodes to be seen: discovery takes its time on a busy machine.
PATIENCE = 60.0


class NotSolvedError(Exception):
    """A mission ended without a plan; says which, with what seed, and what was printed."""


@dataclass(frozen=True)
class Nodes:
    """The three nodes in ``namespace``, ready; ``folder`` is where plans are left."""

    namespace: str
    folder: Path

    def plan(self, mission: Path | str, seed: int, *options: str) -> dict[str, Any]:
        """Plan a mission once and return its plan.json; its other files stay in ``folder``.

        Raises:
            NotSolvedError: when there is no plan.
        """
        done = subprocess.run(
            [
                *('geohtn', 'plan', str(mission), '--namespace', self.namespace),
                *('--output', str(self.folder), '--seed', str(seed)),
                *('--wait', str(PATIENCE), *options),
            ],
            capture_output=True,
            text=True,
            check=False,
        )
        if done.returncode != 0:
            raise NotSolvedError(f'{mission}, seed {seed}, {options}: {done.stderr.strip()}')
        document: dict[str, Any] = json.loads((self.folder / 'plan.json').read_text())
        return document

    def plans(
        self, mission: Path | str, seeds: Iterable[int], *options: str
    ) -> list[dict[str, Any]]:
        """Plan a mission with each seed."""
        return [self.plan(mission, seed, *options) for seed in seeds]

    def memory(self) -> dict[str, float]:
        """The most memory [MB] that each node has had resident."""
        found = {}
        for process in processes_in_namespace(self.namespace):
            command = Path(f'/proc/{process}/cmdline').read_bytes().decode()
            for node in NODES:
                if f'/{node}\0' in command:
                    found[node] = _peak(process)
        return found


@contextmanager
def nodes_up(folder: Path) -> Iterator[Nodes]:
    """Three nodes of their own; ``folder`` takes what they plan."""
    namespace = own_namespace('planning')
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
        yield Nodes(namespace, folder)
    finally:
        process.send_signal(signal.SIGINT)
        process.wait()
        process.stdout.close()


def summary(plans: Sequence[Mapping[str, Any]]) -> dict[str, dict[str, float]]:
    """Median, least and greatest of every figure over ``plans``."""
    figures = {key: [plan['statistics'][key] for plan in plans] for key in (*TIMES, *COUNTS)}
    figures['length'] = [plan['length'] for plan in plans]
    return {key: middle_and_ends(values) for key, values in figures.items()}


def middle_and_ends(values: Sequence[float]) -> dict[str, float]:
    """Median, least and greatest of figures."""
    return {'median': statistics.median(values), 'min': min(values), 'max': max(values)}


def spread(figure: Mapping[str, float], digits: int = 0) -> str:
    """Median, and from least to greatest where they differ, for a table."""
    low, middle, high = (f'{figure[key]:.{digits}f}' for key in ('min', 'median', 'max'))
    return middle if low == high else f'{middle} ({low} to {high})'


def _peak(process: int) -> float:
    for line in Path(f'/proc/{process}/status').read_text(encoding='utf-8').splitlines():
        if line.startswith('VmHWM:'):
            return int(line.split()[1]) / 1024.0
    raise OSError('/proc tells no peak of memory')
