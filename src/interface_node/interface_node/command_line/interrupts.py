"""Signals that ask the command to stop, noted and never raised in the middle of something."""

from __future__ import annotations

import signal
from types import FrameType, TracebackType

from interface_node.command_line.errors import Interrupted


class Interrupts:
    """Context manager that notes SIGINT, SIGTERM and SIGHUP; whoever waits asks :meth:`check`.

    Children that are started inside it have the signals' default behaviour, even when the
    command itself was started in the background of a script, where SIGINT is ignored.
    """

    def __init__(self) -> None:
        self.received: int | None = None
        self._before: dict[int, signal._HANDLER] = {}

    def __enter__(self) -> Interrupts:
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            if number == signal.SIGHUP and signal.getsignal(number) == signal.SIG_IGN:
                continue  # nohup
            self._before[number] = signal.signal(number, self._note)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    def check(self) -> None:
        """Raise :class:`Interrupted` when a signal has come."""
        if self.received is not None:
            raise Interrupted(self.received)

    def _note(self, number: int, _frame: FrameType | None) -> None:
        self.received = number
