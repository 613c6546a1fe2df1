"""Random precedences between the goals of a tour."""

from __future__ import annotations

import numpy as np

from motion_planner_node.tours.precedences import Mask, from_start


def random_precedences(rng: np.random.Generator, goals: int, pairs: int) -> Mask:
    """So many random pairs that agree with an order, with what follows from them, and the start before all."""
    before = from_start(np.zeros((goals, goals), np.bool_))
    hidden = 1 + rng.permutation(goals)
    for _ in range(pairs if goals > 1 else 0):
        i, j = np.sort(rng.choice(goals, 2, replace=False))
        before[hidden[i], hidden[j]] = True
    for middle in range(goals + 1):
        before |= np.outer(before[:, middle], before[middle])
    return before
