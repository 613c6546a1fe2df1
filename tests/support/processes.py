"""The product's own commands and nodes, as a user runs them: real processes over real DDS."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path

from ament_index_python.packages import get_package_prefix

#: [s] after which a command that does not end is a failure of its own.
PATIENCE = 120.0


def geohtn_command() -> str:
    """The installed ``geohtn``; raises FileNotFoundError where the set-up was not run."""
    found = shutil.which('geohtn')
    if found is None:
        raise FileNotFoundError('geohtn is not on PATH: run the tests with `make test`')
    return found


def geohtn(
    *arguments: str | Path, timeout: float = PATIENCE, cwd: Path | None = None
) -> subprocess.CompletedProcess[str]:
    """Run ``geohtn`` to its end and return what it printed."""
    return subprocess.run(
        [geohtn_command(), *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=timeout,
        cwd=cwd,
        check=False,
    )


def node_command(package: str, namespace: str) -> list[str]:
    """The command line with which ``ros2 run`` starts the node of ``package`` in ``namespace``."""
    executable = Path(get_package_prefix(package)) / 'lib' / package / package
    return [str(executable), '--ros-args', '-r', f'__ns:=/{namespace}']


def output_of(process: subprocess.Popen[str], patience: float) -> str:
    """What ``process`` prints until it ends.

    Where it does not end it is killed, and the assertion shows where its threads are, if it was
    started with ``-X faulthandler``.
    """
    try:
        return process.communicate(timeout=patience)[0]
    except subprocess.TimeoutExpired:
        process.send_signal(signal.SIGABRT)
    try:
        output = process.communicate(timeout=5.0)[0]
    except subprocess.TimeoutExpired:
        process.kill()
        output = process.communicate()[0]
    raise AssertionError(f'still there after {patience:g} s:\n{output}')


@contextmanager
def running(
    command: list[str], environment: Mapping[str, str] = os.environ
) -> Iterator[subprocess.Popen[str]]:
    """``command`` in a session of its own; interrupted, then killed, when the block is left."""
    process = subprocess.Popen(
        command,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            process.send_signal(signal.SIGINT)
            try:
                process.wait(20)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if process.stdout:
            process.stdout.close()


def started(*arguments: str | Path) -> AbstractContextManager[subprocess.Popen[str]]:
    """``geohtn`` with ``arguments``, as ``running`` gives it."""
    return running([geohtn_command(), *map(str, arguments)])


def processes_in_namespace(namespace: str) -> list[int]:
    """The processes whose command line names ``namespace``: what a clean stop leaves none of."""
    found = []
    for entry in Path('/proc').iterdir():
        if not entry.name.isdigit() or int(entry.name) == os.getpid():
            continue
        try:
            command = (entry / 'cmdline').read_bytes()
        except OSError:
            continue
        if namespace.encode() in command:
            found.append(int(entry.name))
    return found
