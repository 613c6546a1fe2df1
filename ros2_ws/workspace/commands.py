"""Run a long step: its output goes to a log, the person sees one line, or why it failed."""

from __future__ import annotations

import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

from workspace.problems import SetUpError

#: A program and its arguments.
Command: TypeAlias = 'Sequence[str | Path]'

#: [s] of silence after which a step says that it is still at work.
HEARTBEAT = 30.0
#: How many lines of a log an error shows.
SHOWN_LINES = 12


def say(text: str) -> None:
    """One line for the person who waits."""
    print(text, flush=True)


def run_step(
    what: str,
    command: Command,
    log: Path,
    *,
    environment: Mapping[str, str],
    cwd: Path,
) -> None:
    """Run ``command`` with its output in ``log``.

    Raises:
        SetUpError: it could not be started or ended with another code than 0.
    """
    say(f'{what} ...')
    began = time.monotonic()
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open('wb') as output:
        process = subprocess.Popen(
            [str(word) for word in command],
            cwd=cwd,
            env=dict(environment),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
        )
        code = _wait(process, began)
    if code != 0:
        raise SetUpError(_failure(what, code, log))
    say(f'  done in {time.monotonic() - began:.0f} s')


def _wait(process: subprocess.Popen[bytes], began: float) -> int:
    """The exit code; on Ctrl-C the child, which got the signal too, ends first."""
    while True:
        try:
            return process.wait(HEARTBEAT)
        except subprocess.TimeoutExpired:
            say(f'  still at it after {time.monotonic() - began:.0f} s')
        except KeyboardInterrupt:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
            raise


def _failure(what: str, code: int, log: Path) -> str:
    shown = '\n'.join(f'    {line}' for line in telling_lines(log.read_text('utf-8', 'replace')))
    return f'{what}: failed with exit code {code}. From {log}:\n{shown}'


def telling_lines(text: str) -> list[str]:
    """The lines of a log that say what went wrong: from its first error on, or else its last lines."""
    lines = [line.rstrip() for line in text.splitlines() if line.strip()]
    for number, line in enumerate(lines):
        if 'error:' in line.lower() or 'CMake Error' in line:
            return lines[number : number + SHOWN_LINES]
    return lines[-SHOWN_LINES:]


def complain(text: str) -> None:
    """Say what stopped the set-up."""
    print(f'set-up: {text}', file=sys.stderr, flush=True)
