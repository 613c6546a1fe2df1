"""The shortest words to any of several destinations."""

from __future__ import annotations

from math import hypot, inf

import numpy as np

from motion_planner_node.paths.edges import Frame, Row, Rows, shortest_length, shortest_word_if_free
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
    -1 and -1 when there is none.  Only the shortest words are looked at: most are in vain.
    """
    pieces, totals = np.zeros((MOST_PIECES, 4)), np.full(len(path) * len(ends), inf)
    for i in range(len(path)):
        for k in range(len(ends)):
            if lengths[i] + hypot(ends[k, 0] - path[i, 0], ends[k, 1] - path[i, 1]) < longest:
                shortest = shortest_length(frame, path[i], ends[k], pieces)
                totals[i * len(ends) + k] = lengths[i] + shortest
    # What would be shortest if it were free is tried first: few have to be tried then.
    best, leave, end = longest, -1, -1
    while len(totals) > 0:
        at = int(np.argmin(totals))
        if not totals[at] < best:
            break
        totals[at] = inf
        i, k = at // len(ends), at % len(ends)
        length = shortest_word_if_free(frame, path[i], ends[k], best - lengths[i], pieces)
        if lengths[i] + length < best:
            best, leave, end = lengths[i] + length, i, k
    return (best, leave, end) if leave >= 0 else (inf, -1, -1)


def shortest_shot(query: Query) -> tuple[Rows | None, float]:
    """The shortest of the shortest words from the start to the goals that are free, and its length [m].

    It is given by attitudes (2, 3).
    """
    start = query.start[None, :]
    length, leave, end = best_ending(query.frame, start, np.zeros(1), query.goals, query.longest)
    if leave < 0:
        query.efforts.append(
            f'none of the shortest motions to {len(query.goals)} destinations is free'
        )
        return None, length
    return np.vstack((start, query.goals[end])), length


def direct(query: Query) -> Rows | None:
    """The path of `shortest_shot`, and no other."""
    return shortest_shot(query)[0]
