"""Ends what a supervisor started when the supervisor itself is gone, even by SIGKILL.

Run as ``python -I -S guard.py TOKEN`` with a pipe as standard input.  The pipe's other end is open
in the supervisor alone, so it closes when the supervisor ends, however it ends.  Whatever still
carries the supervisor's token in its environment then gets SIGINT, SIGTERM and SIGKILL in turn:
children, their children, and those that have left their session or process group.
"""

from __future__ import annotations

import os
import signal
import sys
import time
from contextlib import suppress
from pathlib import Path

#: Environment variable that marks the processes of one supervisor.
MARK = 'GEOHTN_SUPERVISOR'
_PATIENCE = ((signal.SIGINT, 3.0), (signal.SIGTERM, 2.0), (signal.SIGKILL, 2.0))


def marked_processes(token: str) -> list[int]:
    """Ids of the living processes that carry ``token``; none where there is no ``/proc``."""
    entry = f'{MARK}={token}'.encode()
    folders = Path('/proc').glob('[1-9]*')
    return [int(folder.name) for folder in folders if entry in _environment(folder)]


def signal_marked(token: str, number: signal.Signals) -> bool:
    """Send a signal to every process that carries ``token``; whether there was one."""
    processes = marked_processes(token)
    for process in processes:
        with suppress(ProcessLookupError):
            os.kill(process, number)
    return bool(processes)


def _environment(folder: Path) -> list[bytes]:
    try:
        return (folder / 'environ').read_bytes().split(b'\0')
    except OSError:
        return []  # gone, or somebody else's


def end_marked(token: str) -> None:
    """Make every process that carries ``token`` end: politely, firmly, by force."""
    for number, patience in _PATIENCE:
        if not signal_marked(token, number):
            return
        deadline = time.monotonic() + patience
        while time.monotonic() < deadline and marked_processes(token):
            time.sleep(0.02)


if __name__ == '__main__':
    sys.stdin.buffer.read()
    end_marked(sys.argv[1])
