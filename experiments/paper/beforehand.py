"""Geometric preprocessing: every motion between destinations of all goals, then a tour through them.

This is what the paper argues against: "nodes are computed from the current objectives and geometrical
constraints on actions, and arcs may be computed using a motion planning method".
"""

from __future__ import annotations

import time
from typing import Any

import numpy as np
from geohtn_msgs import msg, srv

from experiments.exchange import Exchange, client
from experiments.paper.orders import Array, Costs, shortest_tours

#: Figure 3 for one objective.
PHOTO = (
    '((agent rover0)(object {0})(distance(rover0, {0}) >= 50)(distance(rover0, {0}) <= 100)'
    '(rel_angle(rover0, {0}) = cos-and-sin(pi/2)))'
)
ATTITUDE = '((agent rover0)(rover0.x = {0!r})(rover0.y = {1!r})(rover0.heading = {2!r}))'
START = (20.0, 20.0, 0.0)

Pose = tuple[float, float, float]


class Asking:
    """Asks for motions of the rover, and counts; what is no answer but an error counts as a request alone."""

    def __init__(self, exchange: Exchange, seed: int) -> None:
        self._exchange, self._seed = exchange, seed
        self.requests = self.answers = 0
        #: [s] in the motion planner, and of waiting for it in all.
        self.inside = self.waiting = 0.0

    def ask(self, preconditions: str, start: Pose, alternative: int = 0) -> Any:
        """The answer, nothing when no motion was found."""
        self.requests += 1
        x, y, heading = start
        request = msg.GeometricRequest(
            preconditions=preconditions,
            start=[msg.AgentState(agent='rover0', x=x, y=y, heading=heading)],
            alternative=alternative,
            seed=self._seed,
        )
        sent = srv.SatisfyPreconditions.Request(request=request)
        began = time.perf_counter()
        answer = self._exchange(srv.SatisfyPreconditions, sent).answer
        self.waiting += time.perf_counter() - began
        self.inside += answer.time_spent
        self.answers += answer.status != msg.GeometricAnswer.ERROR
        return answer if answer.status == msg.GeometricAnswer.FOUND else None


def plan_beforehand(namespace: str, goals: int, alternatives: int, seed: int) -> dict[str, float]:
    """Requests, time [s] and length [m] of the exact tour; the motion planner holds the world."""
    began = time.perf_counter()
    with client(namespace, {srv.SatisfyPreconditions: 'satisfy_preconditions'}) as exchange:
        connected = time.perf_counter()
        asking = Asking(exchange, seed)
        ends, first = [], []
        for k in range(1, goals + 1):
            answers = [
                asking.ask(PHOTO.format(f'location{k}'), START, a) for a in range(alternatives)
            ]
            found = [answer for answer in answers if answer]
            ends.append([(a.end[0].x, a.end[0].y, a.end[0].heading) for a in found])
            first.append(np.array([answer.length for answer in found]))
        between = {
            (i, j): _motions(asking, ends[i], ends[j])
            for i in range(goals)
            for j in range(goals)
            if i != j
        }
    tour = next(shortest_tours(Costs(first, between)))
    return {
        'requests': asking.requests,
        'answers': asking.answers,
        'advices': 0,
        'backtracks': 0,
        'geometric_backtracks': 0,
        'planning_time': time.perf_counter() - connected,
        'request_time': asking.inside,
        'transport_time': asking.waiting - asking.inside,
        'length': tour.length,
        'connecting_time': connected - began,
    }


def _motions(asking: Asking, origins: list[Pose], ends: list[Pose]) -> Array:
    """Lengths (n, m) [m] of motions, infinite where none was found."""
    lengths = np.full((len(origins), len(ends)), np.inf)
    for i, origin in enumerate(origins):
        for j, end in enumerate(ends):
            answer = asking.ask(ATTITUDE.format(*end), origin)
            if answer:
                lengths[i, j] = answer.length
    return lengths
