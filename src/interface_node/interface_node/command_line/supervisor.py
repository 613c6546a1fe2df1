"""Starts processes, listens to them, notices when one dies, and leaves none behind."""

from __future__ import annotations

import os
import secrets
import signal
import subprocess
import sys
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Thread
from types import TracebackType

from interface_node.command_line import guard

_LONGEST_LINE = 65536
_LAST_LINES = 15
_POLL = 0.02
_SWEEP_PATIENCE = 2.0


@dataclass(frozen=True, slots=True)
class Death:
    """A child that ended although nobody asked it to."""

    name: str
    return_code: int
    last_lines: tuple[str, ...]
    log: Path

    @property
    def reason(self) -> str:
        """How it ended, in words."""
        if self.return_code >= 0:
            return f'ended with exit code {self.return_code}'
        try:
            return f'was ended by {signal.Signals(-self.return_code).name}'
        except ValueError:
            return f'was ended by signal {-self.return_code}'


class Child:
    """One process in a session of its own, whose output goes line by line into a log file."""

    def __init__(
        self,
        name: str,
        command: Sequence[str],
        environment: Mapping[str, str],
        log: Path,
        on_line: Callable[[str, str], None],
    ):
        self.name = name
        self.log = log
        self.last_lines: deque[str] = deque(maxlen=_LAST_LINES)
        self.is_heard = True
        self._on_line = on_line
        self._log_file = log.open('wb')
        try:
            self.process = subprocess.Popen(
                command,
                env=dict(environment),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
        except OSError:
            self._log_file.close()
            raise
        self._listener = Thread(target=self._listen, name=f'{name} output', daemon=True)
        self._listener.start()

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the process and to all that is still in its group."""
        with suppress(ProcessLookupError, PermissionError):
            os.killpg(self.process.pid, number)

    def listen_to_the_end(self, patience: float) -> None:
        """Wait until all output is read, at most ``patience`` [s]."""
        self._listener.join(patience)

    def _listen(self) -> None:
        assert self.process.stdout is not None
        with self._log_file, self.process.stdout as output:
            while raw := output.readline(_LONGEST_LINE):
                self._log_file.write(raw)
                self._log_file.flush()
                line = raw.decode('utf-8', 'replace').rstrip()
                if line and self.is_heard:
                    self.last_lines.append(line)
                    self._on_line(self.name, line)


class Supervisor:
    """Context manager over child processes; when it is left, they have ended.

    :meth:`stop` sends SIGINT to each child's process group, SIGTERM to those that are still there
    after ``interrupt_patience`` [s], and SIGKILL after ``terminate_patience`` [s] more, also to
    descendants that left their group.  A guard process (:mod:`guard`) does the same when this
    process is killed before it could.  ``on_line`` is called with a child's name and a line of its
    output, from another thread.  ``log_directory`` must be there.
    """

    def __init__(
        self,
        log_directory: Path,
        on_line: Callable[[str, str], None],
        environment: Mapping[str, str],
        interrupt_patience: float = 3.0,
        terminate_patience: float = 2.0,
    ):
        self.token = secrets.token_hex(16)
        self._log_directory = log_directory
        self._on_line = on_line
        self._environment = {**environment, guard.MARK: self.token}
        self._patience = (
            (signal.SIGINT, interrupt_patience),
            (signal.SIGTERM, terminate_patience),
        )
        self._children: list[Child] = []
        self._guard: subprocess.Popen[bytes] | None = None

    def __enter__(self) -> Supervisor:
        self._guard = subprocess.Popen(
            [sys.executable, '-I', '-S', guard.__file__, self.token],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        self.stop()

    def start(self, name: str, command: Sequence[str]) -> None:
        """Start a child.

        Raises:
            OSError: when the log cannot be written or the command cannot be executed.
        """
        log = self._log_directory / f'{name}.log'
        self._children.append(Child(name, command, self._environment, log, self._on_line))

    def death(self) -> Death | None:
        """The first child, in the order of starting, that has ended; ``None`` while all live."""
        for child in self._children:
            return_code = child.process.poll()
            if return_code is not None:
                child.listen_to_the_end(0.5)
                return Death(child.name, return_code, tuple(child.last_lines), child.log)
        return None

    def stop(self) -> None:
        """End all children and what they started; again is harmless.

        What they say from now on goes into their logs alone.
        """
        for child in self._children:
            child.is_heard = False
        for number, patience in self._patience:
            living = [child for child in self._children if child.process.poll() is None]
            for child in living:
                child.signal(number)
            deadline = time.monotonic() + patience
            while time.monotonic() < deadline and any(c.process.poll() is None for c in living):
                time.sleep(_POLL)
        for child in self._children:
            if child.process.poll() is None:
                child.signal(signal.SIGKILL)
                child.process.wait()
        deadline = time.monotonic() + _SWEEP_PATIENCE
        while guard.signal_marked(self.token, signal.SIGKILL) and time.monotonic() < deadline:
            time.sleep(_POLL)
        for child in self._children:
            child.listen_to_the_end(1.0)
        self._children.clear()
        if self._guard is not None:
            self._guard.communicate()
            self._guard = None
