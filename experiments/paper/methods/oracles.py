"""Who answers geometric requests in one process: shortest paths on a graph, or the motion planner."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import pairwise
from math import hypot, remainder, tau

import rustworkx

from experiments.paper.methods.graphs import Graph
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude, Motion
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Opportunity,
    Query,
    Scope,
    Status,
    TextCheck,
    Token,
)

_OBJECT = re.compile(r'\(object (\S+?)\)')
State = tuple[tuple[str, Attitude], ...]
#: [m] and [rad] by which the end of a motion may miss the attitude that was preferred.
SAME = 1e-6


class ShortestPaths:
    """The paper's external algorithm: each request is a search of its own (Dijkstra, by rustworkx).

    A geometric state is the label of a waypoint; what an answer carries is the way's waypoints.
    """

    def __init__(self, graph: Graph) -> None:
        self._labels = list(graph.points)
        self._number = {label: index for index, label in enumerate(self._labels)}
        self._arcs = graph.arcs
        self._graph: rustworkx.PyDiGraph[str, float] = rustworkx.PyDiGraph()
        self._graph.add_nodes_from(self._labels)
        self._graph.add_edges_from(
            [(self._number[a], self._number[b], length) for (a, b), length in graph.arcs.items()]
        )

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        """Oracle.check: there is nothing to check."""
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        """Oracle.satisfy: the shortest way to the waypoint that the text names as its object."""
        (goal,) = _OBJECT.findall(query.preconditions)
        start, end = self._number[str(query.start)], self._number[goal]
        ways = rustworkx.dijkstra_shortest_paths(self._graph, start, end, weight_fn=float)
        way = [goal]
        if end in ways:
            way = [self._labels[index] for index in ways[end]]
        elif end != start:
            return Answer(Status.IMPOSSIBLE, scope=Scope.CONNECTED_STARTS, objects=(goal,))
        length = sum([self._arcs[arc] for arc in pairwise(way)], 0.0)
        return Answer(Status.FOUND, end=goal, length=length, objects=(goal,), payload=way)

    def advise(self, _query: AdviceQuery) -> Advice:
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
            preferred_end=dict(_state(query.preferred)) if query.preferred is not None else {},
        )
        answer = self.planner.satisfy(request)
        end = answer.end.get(answer.agent)
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
            attitude=((answer.agent, end),) if end else None,
            as_preferred=_is_at(end, request.preferred_end.get(answer.agent)),
        )

    def advise(self, query: AdviceQuery) -> Advice:
        """Oracle.advise."""
        pairs = query.precedences
        request = AdviceRequest(
            query.preconditions,
            dict(_state(query.start)),
            seed=self.seed,
            purpose=int(query.purpose),
            before=tuple(before for before, _ in pairs),
            after=tuple(after for _, after in pairs),
            ends=tuple(_state(end)[0] if end is not None else None for end in query.ends),
            effort=query.effort,
            motions=tuple(_motion(answer) for answer in query.motions),
        )
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
        return Advice(
            candidates,
            advice.order,
            ends=tuple((end,) if end else None for end in advice.ends),
            opportunities=tuple(
                Opportunity(found.candidate, found.motion, found.distance, (found.end,))
                for found in advice.opportunities
            ),
        )


def _state(token: Token) -> State:
    if not isinstance(token, tuple):
        raise TypeError(f'not a geometric state: {token!r}')
    return token


def _motion(answer: Answer) -> Motion:
    """The motion of an answer that was FOUND."""
    found = answer.payload
    if not isinstance(found, GeometricAnswer) or found.motion is None:
        raise TypeError(f'not an answer with a motion: {found!r}')
    return found.motion


def _is_at(end: Attitude | None, wanted: Attitude | None) -> bool:
    """Whether an end is the wanted one, but for rounding."""
    return (
        end is not None
        and wanted is not None
        and hypot(end.x - wanted.x, end.y - wanted.y) < SAME
        and abs(remainder(end.heading - wanted.heading, tau)) < SAME
    )
