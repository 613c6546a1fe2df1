"""``make setup``: from a bare checkout to a built workspace, and nothing at all the second time."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from workspace import build, kernels, prerequisites, venv
from workspace.commands import complain, say
from workspace.layout import Layout
from workspace.problems import SetUpError
from workspace.ros import find_sourced_ros


def main() -> int:
    """Set up the checkout that this file is in, and return the exit code."""
    try:
        layout = Layout(Path(__file__).resolve().parents[2])
        with only_one(layout.workspace / '.set_up.lock'):
            ros = find_sourced_ros()
            if ros is not None and (python := prerequisites.python_of(ros)) is not None:
                os.execv(python, [str(python), str(layout.workspace / 'set_up.py')])
            prerequisites.check(ros)
            packages = venv.make(layout, ros)
            build.build(layout, ros, packages)
            kernels.compile_kernels(layout, ros, packages)
    except (SetUpError, OSError) as problem:
        complain(str(problem))
        return 2
    except KeyboardInterrupt:
        complain('interrupted; the next run goes on from here.')
        return 130
    return 0


@contextmanager
def only_one(lock: Path) -> Iterator[None]:
    """Hold ``lock``; where another set-up of this checkout runs, wait for it."""
    with lock.open('w') as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            say('Another set-up of this checkout is running: waiting for it.')
            fcntl.flock(file, fcntl.LOCK_EX)
        yield
