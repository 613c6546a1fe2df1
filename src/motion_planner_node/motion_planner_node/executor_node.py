"""An executor that answers as fast as one thread, and goes on answering while a callback takes long.

rclpy's MultiThreadedExecutor hands every callback to another thread, which makes each exchange more
than twice as slow.  Here the thread that waits for messages also works on them; only when that takes
longer than PATIENCE another thread takes over the waiting.
"""

from __future__ import annotations

import threading
from time import perf_counter, sleep
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.executors import (
    ConditionReachedException,
    Executor,
    ExternalShutdownException,
    ShutdownException,
    TimeoutException,
)

#: [s] that a callback may take before another thread takes over, and how often that is looked at.
PATIENCE = 0.01


class RelayExecutor(Executor):
    """Run `spin_once` in a loop in as many threads as callbacks may take long at the same time, and one.

    One thread leads: it waits for messages and works on them itself.  One more looks whether the
    leader is busy for long, and then leads in its place.  All others sleep.
    """

    def __init__(self, **options: Any) -> None:
        super().__init__(**options)
        self._leader = 0
        self._busy_since: float | None = None
        self._deputy = threading.Lock()
        self._leading = threading.Lock()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Work on one callback, or find after ``timeout_sec`` [s] that there is nothing to do."""
        if self._leader != threading.get_ident() and not self._succeed(timeout_sec):
            return
        try:
            handler, _, _ = self.wait_for_ready_callbacks(timeout_sec)
        except (
            ConditionReachedException,
            ExternalShutdownException,
            ShutdownException,
            TimeoutException,
        ):
            return
        self._busy_since = perf_counter()
        handler()
        with self._leading:
            if self._leader == threading.get_ident():
                self._busy_since = None
        handler.result()  # raises what the callback raised

    def _succeed(self, timeout_sec: float | None) -> bool:
        """Wait to lead; False when there was no need to for ``timeout_sec`` [s]."""
        if not self._deputy.acquire(timeout=-1 if timeout_sec is None else timeout_sec):
            return False
        try:
            end = None if timeout_sec is None else perf_counter() + timeout_sec
            while end is None or perf_counter() < end:
                with self._leading:
                    since = self._busy_since
                    if not self._leader or (since and perf_counter() - since > PATIENCE):
                        self._leader = threading.get_ident()
                        self._busy_since = None
                        return True
                sleep(PATIENCE)
            return False
        finally:
            self._deputy.release()


class AtMost(CallbackGroup):
    """Callbacks of which ``most`` may run at a time; what comes then waits in the middleware."""

    def __init__(self, most: int) -> None:
        super().__init__()
        self._most = most
        self._running: list[object] = []
        self._lock = threading.Lock()

    def can_execute(self, entity: object) -> bool:
        """Whether one more callback, that of ``entity``, may begin."""
        return self.has_entity(entity) and len(self._running) < self._most

    def beginning_execution(self, entity: object) -> bool:
        """Count one more, if it may begin."""
        with self._lock:
            may_begin = self.can_execute(entity)
            if may_begin:
                self._running.append(entity)
            return may_begin

    def ending_execution(self, entity: object) -> None:
        """One has ended."""
        with self._lock:
            self._running.remove(entity)
