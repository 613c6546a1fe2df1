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

_starting = threading.Lock()


def on_deep_stack(function: Callable[[], T]) -> T:
    """The result of ``function``, or what it raises; RecursionError beyond MOST_FRAMES frames.

    The limit of the interpreter is raised for good, since it is one for all threads.
    """
    pool = ThreadPoolExecutor(1, 'search')
    with _starting:
        if sys.getrecursionlimit() < MOST_FRAMES:
            sys.setrecursionlimit(MOST_FRAMES)
        before = threading.stack_size(STACK)
        try:
            result = pool.submit(function)
        finally:
            threading.stack_size(before)
    try:
        return result.result()
    finally:
        pool.shutdown(wait=False)
