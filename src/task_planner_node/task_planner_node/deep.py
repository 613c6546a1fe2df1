"""Calling a function that may recurse deeply, as recursive axioms do: on a thread with a large stack."""

from __future__ import annotations

import sys
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

T = TypeVar('T')

# Python frames, a few of which each level of an axiom takes; and bytes, well above 1 kB for each.
MOST_FRAMES = 30_000
STACK = 128 * 2**20


class _Limit:
    """The interpreter's recursion limit: one for all threads, so the last one that is done puts it back."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._users = 0
        self._before = 0

    def submit(self, pool: ThreadPoolExecutor, function: Callable[[], T]) -> Callable[[], T]:
        """Start ``function`` with a large stack; the answer waits for its result."""
        with self._lock:
            if not self._users:
                self._before = sys.getrecursionlimit()
                sys.setrecursionlimit(max(self._before, MOST_FRAMES))
            self._users += 1
            before = threading.stack_size(STACK)
            try:
                return pool.submit(function).result
            finally:
                threading.stack_size(before)

    def release(self) -> None:
        """One that was started is done."""
        with self._lock:
            self._users -= 1
            if not self._users:
                sys.setrecursionlimit(self._before)


_limit = _Limit()


def on_deep_stack(function: Callable[[], T]) -> T:
    """The result of ``function``, or what it raises; RecursionError beyond MOST_FRAMES frames."""
    pool = ThreadPoolExecutor(1, 'search')
    result = _limit.submit(pool, function)
    try:
        return result()
    finally:
        pool.shutdown(wait=False)
        _limit.release()
