"""Waiting for an answer, with a deadline and a way out."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import monotonic
from typing import Any, Protocol

#: [s] between two looks at whether to stop.
PERIOD = 0.02


class FutureLike(Protocol):
    """What rclpy's and concurrent's futures have in common."""

    def add_done_callback(self, callback: Callable[[Any], None]) -> None:
        """Call back once there is a result, at once if there is one already."""

    def result(self) -> Any:
        """The result; raises what went wrong."""


class Cancelled(Exception):
    """The client took the mission back, or the node is shutting down."""


class TimedOut(Exception):
    """There was no answer within the time given."""


def wait_for(future: FutureLike, deadline: float, should_stop: Callable[[], bool]) -> Any:
    """The future's result, completed by another thread.

    ``deadline`` is a monotonic time [s]. Raises TimedOut, Cancelled when ``should_stop`` says so,
    and whatever the future failed with.
    """
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    wait_until(done.is_set, deadline, should_stop, done.wait)
    return future.result()


def wait_until(
    condition: Callable[[], bool],
    deadline: float,
    should_stop: Callable[[], bool],
    pause: Callable[[float], object] | None = None,
) -> None:
    """Return once ``condition`` holds; raises TimedOut and Cancelled as wait_for does."""
    pause = pause or threading.Event().wait
    while not condition():
        if should_stop():
            raise Cancelled
        left = deadline - monotonic()
        if left <= 0:
            raise TimedOut
        pause(min(left, PERIOD))


@contextmanager
def repeating(period: float, action: Callable[[], None]) -> Iterator[None]:
    """Do ``action`` every ``period`` [s] in a thread of its own until the block is left."""
    left = threading.Event()

    def repeat() -> None:
        while not left.wait(period):
            action()

    thread = threading.Thread(target=repeat, daemon=True)
    thread.start()
    try:
        yield
    finally:
        left.set()
        thread.join()
