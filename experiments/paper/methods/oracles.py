"""Who answers geometric requests in one process: shortest paths on a graph, or the motion planner."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.sparse.csgraph import dijkstra

from experiments.paper.methods.graphs import Graph
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from task_planner_node.oracle import (
    Advice,
    Answer,
    CandidateAdvice,
    Query,
    Scope,
    Status,
    TextCheck,
    Token,
)

_OBJECT = re.compile(r'\(object (\S+?)\)')
State = tuple[tuple[str, Attitude], ...]


class ShortestPaths:
    """The paper's external algorithm: each request is a search of its own (Dijkstra, by scipy).

    A geometric state is the label of a waypoint; what an answer carries is the way's waypoints.
    """

    def __init__(self, graph: Graph) -> None:
        self._labels = list(graph.points)
        self._number = {label: index for index, label in enumerate(self._labels)}
        self._lengths = graph.lengths()

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        """Oracle.check: there is nothing to check."""
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        """Oracle.satisfy: the shortest way to the waypoint that the text names as its object."""
        (goal,) = _OBJECT.findall(query.preconditions)
        start = self._number[str(query.start)]
        lengths, before = dijkstra(self._lengths, indices=start, return_predecessors=True)
        at = self._number[goal]
        if not np.isfinite(lengths[at]):
            return Answer(Status.IMPOSSIBLE, scope=Scope.CONNECTED_STARTS, objects=(goal,))
        way = [goal]
        while at != start:
            at = int(before[at])
            way.append(self._labels[at])
        length = float(lengths[self._number[goal]])
        return Answer(Status.FOUND, end=goal, length=length, objects=(goal,), payload=way[::-1])

    def advise(self, _start: Token, _preconditions: Sequence[str]) -> Advice:
        """Oracle.advise: none."""
        return Advice((), ())


@dataclass(frozen=True)
class Driving:
    """The motion planner behind its own types; a geometric state is the attitudes by agent."""

    planner: MotionPlanner
    seed: int

    def check(self, text: str, source: str, line: int, column: int) -> TextCheck:
        """Oracle.check; raises ValueError for a text of the experiment that is wrong."""
        checked = self.planner.check(text, source, line, column)
        if not checked.valid:
            raise ValueError('; '.join(map(str, checked.diagnostics)))
        return TextCheck(checked.assigns)

    def satisfy(self, query: Query) -> Answer:
        """Oracle.satisfy."""
        request = GeometricRequest(
            query.preconditions,
            dict(_state(query.start)),
            behaviour=query.behaviour,
            alternative=query.alternative,
            seed=self.seed,
        )
        answer = self.planner.satisfy(request)
        return Answer(
            Status(answer.status),
            int(answer.code),
            Scope(answer.scope),
            answer.message,
            tuple(answer.end.items()),
            answer.assigned,
            answer.length,
            answer.objects,
            payload=answer,
        )

    def advise(self, start: Token, preconditions: Sequence[str]) -> Advice:
        """Oracle.advise: the nearest first."""
        request = AdviceRequest(tuple(preconditions), dict(_state(start)), seed=self.seed)
        advice = self.planner.advise(request)
        candidates = tuple(
            CandidateAdvice(
                candidate.impossible,
                Scope(candidate.scope),
                int(candidate.code),
                candidate.message,
                candidate.objects,
                candidate.lower_bound,
            )
            for candidate in advice.candidates
        )
        return Advice(candidates, advice.order)


def _state(token: Token) -> State:
    if not isinstance(token, tuple):
        raise TypeError(f'not a geometric state: {token!r}')
    return token
