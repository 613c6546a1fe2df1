"""What every experiment leaves behind: ``results.json`` with machine, date, seed and targets."""

from __future__ import annotations

import json
import os
import platform
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from datetime import datetime, timezone
from pathlib import Path
from typing import Any


@dataclass(frozen=True)
class Target:
    """A figure that was to be reached: ``value`` at most, or ``at_least``, ``target``."""

    name: str
    value: float
    target: float
    at_least: bool = False

    @property
    def met(self) -> bool:
        """Whether it was reached."""
        return self.value >= self.target if self.at_least else self.value <= self.target

    def figures(self) -> dict[str, Any]:
        """For results.json and tables."""
        return {**asdict(self), 'met': self.met}

    def __str__(self) -> str:
        verdict = 'met' if self.met else 'MISSED'
        side = 'at least' if self.at_least else 'at most'
        return f'{verdict}: {self.name} {self.value:.4g}, {side} {self.target:g}'


def machine() -> dict[str, Any]:
    """The machine that the figures hold for."""
    model = platform.processor() or platform.machine()
    cpu_info = Path('/proc/cpuinfo')
    if cpu_info.exists():
        lines = cpu_info.read_text().splitlines()
        model = next((line.partition(': ')[2] for line in lines if 'model name' in line), model)
    return {
        'cpu': model,
        'cores': os.cpu_count(),
        'system': platform.platform(terse=True),
        'python': platform.python_version(),
    }


def write_results(
    folder: Path, seed: int, figures: Mapping[str, Any], targets: Iterable[Target]
) -> Path:
    """Write ``results.json`` into ``folder`` and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    results = {
        'machine': machine(),
        'date': datetime.now(timezone.utc).isoformat(timespec='seconds'),
        'seed': seed,
        'figures': dict(figures),
        'targets': [target.figures() for target in targets],
    }
    path = folder / 'results.json'
    path.write_text(json.dumps(results, indent=2) + '\n', encoding='utf-8')
    return path
