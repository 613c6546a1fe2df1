"""How the node is told to stop: SIGINT and SIGTERM, also where a script's shell ignores SIGINT."""

from __future__ import annotations

import signal
from queue import Empty, SimpleQueue
from types import FrameType

STOPPING = (signal.SIGINT, signal.SIGTERM)


class StopSignals:
    """Raises KeyboardInterrupt in the main thread at the first signal; after :meth:`hold` notes it.

    Once there are other threads nothing may be raised: an exception inside an Event leaves its lock
    taken, and one inside ``Thread.is_alive`` takes a running thread for ended (Python before 3.13).
    Make one in the main thread, and wait there: inside ROS it would hear nothing.
    """

    def __init__(self) -> None:
        self._received: SimpleQueue[int] = SimpleQueue()  # its put may interrupt its own get
        self._raises = True
        for number in STOPPING:
            signal.signal(number, self._receive)

    def hold(self) -> None:
        """From now on signals are noted for :meth:`wait`, also one whose exception got lost."""
        self._raises = False

    def wait(self, timeout: float) -> bool:
        """Wait for a signal, `timeout` seconds at most; True when one has come."""
        try:
            self._received.get(timeout=timeout)
        except Empty:
            return False
        return True

    def _receive(self, number: int, _frame: FrameType | None) -> None:
        self._received.put(number)
        if self._raises:
            self._raises = False
            raise KeyboardInterrupt
