"""The lattice search of one query: from both ends in turns, coarse first, and finer where it is stuck.

Where it is hard to leave the start, a search that comes from the destinations looks at all places
round the start; where it is hard to arrive, one from the start does so round the destination.  Each
in turns, with more and more effort, costs at most a few times what the luckier one would cost alone.

Where one of them runs out of places to go, the gaps of the lattice may have shut it in: a narrow
destination, or a narrow start.  A finer search looks for the way out of there, and the coarse one
goes on from where that has got to.
"""

from __future__ import annotations

from math import inf
from typing import NamedTuple

import numpy as np

from motion_planner_node.paths.edges import Rows, edge_lengths
from motion_planner_node.paths.lattice import EXHAUSTED, GOES_ON
from motion_planner_node.paths.lattice_end import End, Level, Roots, roots_at
from motion_planner_node.paths.query import Query

#: Attitudes that are expanded from one end before it is the other's turn; then twice as many.
FIRST_TURN = 500
COARSE = Level(0.4, 0.35, 24, 1.1, 1, any_word=False)
FINE = Level(0.2, 0.15, 48, 1.2, 4, any_word=True)
FINEST = Level(0.1, 0.06, 96, 1.2, 4, any_word=True)
#: Attitudes that a finer search may expand to find the way out, one after the other.
WAYS_OUT = (500, 1500, 6000)
#: Attitudes of a fine search, all that there are, below which it is made finer still.
NARROW = 300
#: Attitudes where a search has been that destinations are looked for near to.
LOOKS = 24


class _Ends(NamedTuple):
    """A search from both ends: ``ahead`` from the start, where there was one."""

    path: Rows | None
    backward: End
    ahead: End | None

    @property
    def is_stuck(self) -> bool:
        """Whether one of them has looked at all that there is."""
        return bool(self._stuck)

    @property
    def is_narrow(self) -> bool:
        """Whether that was so little that the gaps of the lattice may be to blame."""
        return any(end.expanded < NARROW for end in self._stuck)

    @property
    def _stuck(self) -> list[End]:
        return [end for end in (self.backward, self.ahead) if end and end.state == EXHAUSTED]


def search_lattice(query: Query, longest: float = inf) -> Rows | None:
    """A path to one of the goals shorter than ``longest`` [m], as attitudes (n, 3)."""
    goals, start = roots_at(query.goals), roots_at(query.start[None, :])
    ends = _search(query, COARSE, longest, goals, start)
    if ends.path is not None or longest < inf:
        return ends.path
    if not ends.is_stuck:
        return _shot_at(query, _search(query, FINE, longest, goals, start))
    ends = _way_out(query, FINE, goals, start)
    if ends.path is None and ends.is_narrow:
        ends = _way_out(query, FINEST, goals, start)
    return _shot_at(query, ends)


def _way_out(query: Query, level: Level, goals: Roots, start: Roots) -> _Ends:
    """A path that begins and ends in finer lattices, as far as it takes to get out of narrow places."""
    nearest = query.goals[int(np.argmin(query.estimates))]
    backward = End(query, level, query.start, -1.0, goals, inf)
    ahead = End(query, level, nearest, 1.0, start, inf)
    for expansions in WAYS_OUT:
        for end in (backward, ahead):
            path = end.go_on(expansions)
            if path is not None:
                return _Ends(path, backward, ahead)
        if EXHAUSTED in (backward.state, ahead.state):
            break
        ends = _search(query, COARSE, inf, backward.as_roots(), ahead.as_roots())
        if ends.path is not None or not ends.is_stuck:
            return ends
    return _Ends(None, backward, ahead)


def _shot_at(query: Query, ends: _Ends) -> Rows | None:
    """The path of ``ends``, or one to a destination near some place where the one from the start was.

    That one has looked for one of them, but maybe at all that the start leads to.
    """
    path, ahead = ends.path, ends.ahead
    query.hopeless = path is None and ends.is_stuck
    query.shut_in = path is None and ahead is not None and ahead.state == EXHAUSTED
    if query.shut_in and ahead is not None:
        path = ahead.shot(query.goals, inf)
        if path is None and query.region is not None:
            rows = ahead.rows
            some = rows[np.linspace(0, len(rows) - 1, min(LOOKS, len(rows))).astype(np.int64)]
            path = ahead.shot(query.region(some), inf)
        query.shut_in = query.hopeless = path is None
    if path is None:
        looked_at = ends.backward.expanded + (ahead.expanded if ahead else 0)
        everything = ', all that there are' if query.hopeless else ''
        query.efforts.append(f'{looked_at} attitudes of a fine lattice{everything}')
    return path


def _search(query: Query, level: Level, longest: float, goals: Roots, start: Roots) -> _Ends:
    backward, ahead, turn = End(query, level, query.start, -1.0, goals, longest), None, FIRST_TURN
    path = backward.go_on(turn)
    if path is None and backward.state == GOES_ON:
        way = backward.way_to_best_root()[::-1]
        ahead = End(query, level, way[0], 1.0, start, longest)
        while path is None and backward.state == GOES_ON and ahead.state == GOES_ON:
            path = ahead.go_on(turn)
            if path is not None:
                path = np.vstack((path, way[1:]))
            elif ahead.state != EXHAUSTED:
                path = backward.go_on(turn)
            turn *= 2
    if path is not None and not backward.has_path and backward.state == GOES_ON:
        # Another destination may be nearer than the one that was driven to.
        backward.lattice.best[0] = edge_lengths(query.frame, path).sum()
        shorter = backward.go_on(turn)
        path = path if shorter is None else shorter
    return _Ends(path, backward, ahead)
