"""The shortest free word to any of several destinations."""

from __future__ import annotations

from math import inf

import numpy as np

from motion_planner_node.paths.edges import Frame, Row, Rows, free_word
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES


@kernel
def best_ending(
    frame: Frame, path: Rows, lengths: Row, ends: Rows, longest: float
) -> tuple[float, int, int]:
    """The shortest way along ``path`` (n, 3) and then straight to one of ``ends`` (k, 3).

    ``lengths`` (n,) [m] are those of the path up to each of its attitudes.  Returns the length [m]
    of the way, less than ``longest``, the attitude where the path is left, and the end; infinite,
    -1 and -1 when there is none.
    """
    best, leave, end = longest, -1, -1
    pieces = np.zeros((MOST_PIECES, 4))
    for i in range(len(path)):
        for k in range(len(ends)):
            length = free_word(frame, path[i], ends[k], best - lengths[i], pieces)[0]
            if lengths[i] + length < best:
                best, leave, end = lengths[i] + length, i, k
    return (best, leave, end) if leave >= 0 else (inf, -1, -1)


def direct(query: Query) -> Rows | None:
    """The shortest free word from the start to any of the goals: attitudes (2, 3)."""
    start = query.start[None, :]
    _, leave, end = best_ending(query.frame, start, np.zeros(1), query.goals, query.longest)
    if leave < 0:
        query.efforts.append(
            f'none of the shortest motions to {len(query.goals)} destinations is free'
        )
        return None
    return np.vstack((start, query.goals[end]))
