"""A queue of numbers by priority, in arrays that outlive a call of a kernel."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.kernel import kernel


class OpenList(NamedTuple):
    """A binary heap: ``keys`` and ``items`` (most,), ``size`` (1,) of them in use."""

    keys: NDArray[np.float64]
    items: NDArray[np.int64]
    size: NDArray[np.int64]


def empty_open_list(most: int) -> OpenList:
    """Room for ``most`` items."""
    return OpenList(np.empty(most), np.empty(most, np.int64), np.zeros(1, np.int64))


@kernel
def push(queue: OpenList, key: float, item: int) -> None:
    """Add ``item``; there has to be room."""
    at = queue.size[0]
    queue.size[0] = at + 1
    while at > 0:
        above = (at - 1) // 2
        if queue.keys[above] <= key:
            break
        queue.keys[at], queue.items[at] = queue.keys[above], queue.items[above]
        at = above
    queue.keys[at], queue.items[at] = key, item


@kernel
def pop(queue: OpenList) -> tuple[float, int]:
    """Take out the item of the smallest key; there has to be one."""
    first, item = queue.keys[0], queue.items[0]
    size = queue.size[0] - 1
    queue.size[0] = size
    last_key, last_item = queue.keys[size], queue.items[size]
    at = 0
    while True:
        below = 2 * at + 1
        if below >= size:
            break
        if below + 1 < size and queue.keys[below + 1] < queue.keys[below]:
            below += 1
        if last_key <= queue.keys[below]:
            break
        queue.keys[at], queue.items[at] = queue.keys[below], queue.items[below]
        at = below
    queue.keys[at], queue.items[at] = last_key, last_item
    return first, item
