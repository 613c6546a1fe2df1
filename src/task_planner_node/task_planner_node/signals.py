"""How the node is told to stop: SIGINT and SIGTERM, also where a script's shell ignores SIGINT."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from queue import Empty, SimpleQueue
from types import FrameType

STOPPING = (signal.SIGINT, signal.SIGTERM)
#: [s] between two looks whether the node is alive; a signal that came to another thread is heard then.
PERIOD = 0.5


class StopSignals:
    """Notes the signals, and raises KeyboardInterrupt in the main thread only where that is asked for.

    An exception in the middle of an import leaves it half done; one inside an Event leaves its lock
    taken, and one inside ``Thread.is_alive`` takes a running thread for ended (Python before 3.13).
    Make one in the main thread, and wait there: inside ROS it would hear nothing.
    """

    def __init__(self) -> None:
        # Unlike a Queue or an Event it may be put to by a handler that interrupts its get.
        self._received: SimpleQueue[int] = SimpleQueue()
        self._raises = False
        for number in STOPPING:
            signal.signal(number, self._receive)

    @contextmanager
    def interrupting(self) -> Iterator[None]:
        """Inside the block the first signal raises KeyboardInterrupt, also one from before it.

        For long work that no other thread waits for.
        """
        self._raises = True
        try:
            if not self._received.empty():
                raise KeyboardInterrupt
            yield
        finally:
            self._raises = False

    def exit_code(self, is_alive: Callable[[], bool]) -> int:
        """Wait while a node is alive: 0 when a signal came, 1 when the node ended without one."""
        while is_alive():
            try:
                self._received.get(timeout=PERIOD)
            except Empty:
                continue
            return 0
        return 1

    def _receive(self, number: int, _frame: FrameType | None) -> None:
        self._received.put(number)
        if self._raises:
            self._raises = False
            raise KeyboardInterrupt
