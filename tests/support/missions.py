"""Missions that the tests plan, and what a run of one leaves behind."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from tests.support.processes import geohtn

ROOT = Path(__file__).resolve().parent.parent.parent
#: The folder of the paper's mission.
ROVER = ROOT / 'src' / 'interface_node' / 'missions' / 'rover'


@dataclass(frozen=True)
class Run:
    """What one ``geohtn run`` printed and left behind."""

    output: Path
    stdout: str
    stderr: str
    exit_code: int


def run_mission(mission: Path | str, output: Path, *options: str) -> Run:
    """Plan ``mission`` with three processes of its own."""
    done = geohtn('run', mission, '--output', output, '--seed', '1', *options)
    return Run(output, done.stdout, done.stderr, done.returncode)
