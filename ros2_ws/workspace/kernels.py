"""The numerical kernels of the motion planner, compiled before anybody waits for a node to be ready."""

from __future__ import annotations

from pathlib import Path

from workspace import stamps
from workspace.commands import run_step
from workspace.environment import build_environment
from workspace.layout import Layout
from workspace.ros import SourcedRos

COMPILE = 'from motion_planner_node.planner import warm_up; warm_up()'


def compile_kernels(layout: Layout, ros: SourcedRos | None, venv: str) -> None:
    """Compile the kernels unless those on disk are of the present sources and of ``venv``.

    Raises:
        SetUpError: they could not be compiled.
    """
    package = layout.packages / 'motion_planner_node' / 'motion_planner_node'
    sources = [path for path in stamps.files_below(package) if path.suffix == '.py']
    made_from = stamps.fingerprint([venv], [*sources, Path(__file__)])
    stamp = layout.workspace / 'build' / 'kernels.stamp'
    if stamps.is_current(stamp, made_from):
        return
    run_step(
        'Compiling the numerical kernels (a minute or so)',
        [layout.workspace / 'run', 'python', '-c', COMPILE],
        layout.logs / 'kernels.log',
        environment=build_environment(layout, ros),
        cwd=layout.root,
    )
    stamps.write(stamp, made_from)
