"""Which goals of a tour have to come before which others, and what follows for its orders."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]


def from_start(before: Mask) -> Mask:
    """The precedences (n, n) of goals with the start before all of them, (n + 1, n + 1): its row is the first."""
    whole = np.pad(before, ((1, 0), (1, 0)))
    whole[0, 1:] = True
    return whole


def next_to(before: Mask) -> Mask:
    """Whether a group may come right after another one, (groups, groups), by row and column.

    ``before`` tells which groups have to come before which others, also by way of others.
    """
    between = before.astype(np.int64) @ before.astype(np.int64) > 0
    return np.asarray(~before.T & ~between & ~np.eye(len(before), dtype=np.bool_))
