"""How the node is told to stop: SIGINT and SIGTERM, also where a script's shell ignores SIGINT."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

STOPPING = (signal.SIGINT, signal.SIGTERM)


def interrupt_on_signals() -> None:
    """Make the first SIGINT or SIGTERM raise KeyboardInterrupt in the main thread; more change nothing.

    The main thread has to wait for an Event: inside ROS it would hear nothing, and a join that an
    exception leaves takes the other thread for ended (Python before 3.13).
    """
    for number in STOPPING:
        signal.signal(number, _interrupt)


@contextmanager
def held_back() -> Iterator[None]:
    """Inside the block no signal interrupts; one that comes meanwhile does at its end."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, STOPPING)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _interrupt(_number: int, _frame: FrameType | None) -> None:
    for number in STOPPING:
        signal.signal(number, signal.SIG_IGN)
    raise KeyboardInterrupt
