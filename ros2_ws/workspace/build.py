"""The colcon build of the messages and the node packages, done again when something asks for it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from workspace import stamps
from workspace.commands import run_step, say
from workspace.environment import build_environment
from workspace.layout import Layout
from workspace.ros import SourcedRos

#: Files of a node package that the build reads. Everything else is installed as a link to the source.
READ_BY_BUILD = frozenset({'setup.py', 'setup.cfg', 'package.xml'})


def wanted(layout: Layout, venv: str) -> str:
    """The fingerprint of what is built, in the environment with the fingerprint ``venv``."""
    messages = stamps.files_below(layout.messages)
    sources = [
        path
        for path in stamps.files_below(layout.packages)
        if path.relative_to(layout.packages).parts[1:2] != ('test',)
    ]
    read = [path for path in sources if path.name in READ_BY_BUILD]
    defaults = layout.workspace / 'colcon_defaults.yaml'
    return stamps.fingerprint([venv], [*messages, *read, defaults, Path(__file__)], sources)


def build(layout: Layout, ros: SourcedRos | None, venv: str) -> None:
    """Build into ``ros2_ws/install`` unless that is current.

    Raises:
        SetUpError: colcon failed.
    """
    made_from = wanted(layout, venv)
    stamp = layout.workspace / 'install' / 'set_up.stamp'
    if stamps.is_current(stamp, made_from):
        return
    # Present while colcon runs, and left behind where it was killed: what it left cannot be trusted.
    running = layout.workspace / 'build' / 'set_up.running'
    environment_stamp = layout.workspace / 'build' / 'set_up.venv'
    first = running.exists() or not stamps.is_current(environment_stamp, venv)
    if first:
        for folder in ('build', 'install'):
            shutil.rmtree(layout.workspace / folder, ignore_errors=True)
        running.parent.mkdir()
        stamps.write(environment_stamp, venv)
    stamp.unlink(missing_ok=True)
    running.touch()
    _colcon(
        layout, ros, 'one to three minutes' if first else 'seconds; a minute or two for messages'
    )
    running.unlink()
    stamps.write(stamp, made_from)


def _colcon(layout: Layout, ros: SourcedRos | None, duration: str) -> None:
    environment = build_environment(layout, ros)
    environment['COLCON_DEFAULTS_FILE'] = str(layout.workspace / 'colcon_defaults.yaml')
    # Without this colcon adds a limit on the machine's load, and a busy machine builds one file at a time.
    environment['MAKEFLAGS'] = f'-j{len(os.sched_getaffinity(0))}'
    python = layout.venv / 'bin' / 'python'
    command: list[str | Path] = [
        python,
        '-m',
        'colcon',
        'build',
        '--cmake-args',
        '-DBUILD_TESTING=OFF',
    ]
    command.append(f'-DPython3_EXECUTABLE={python}')
    if ros is None:
        command.append('-DGEOHTN_PYTHON_ONLY=ON')
    run_step(
        f'Building the messages and the nodes with colcon ({duration})',
        command,
        layout.logs / 'colcon.log',
        environment=environment,
        cwd=layout.workspace,
    )
    say('The workspace is built.')
