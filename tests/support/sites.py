"""A motion planner that is not there, exact and slow: sites in a plane, driven to in straight lines."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Opportunity,
    Place,
    Purpose,
    Query,
    Scope,
    Status,
    TextCheck,
    Token,
)

Point = tuple[float, float]
# A length, and the points and the indices of stops on the way.
Way = tuple[float, tuple[Point, ...], tuple[int, ...]]


@dataclass
class Sites:
    """Each label has the points from which it is seen.  ``((near a))`` is met at any point of a; one starts at (0, 0).

    Advice of effort 0 knows the first point of each label only when it is ``careless``; its places are all points that
    it knows.  ``shut`` labels are never reached, and ``narrow`` ones not where that is preferred.
    """

    points: Mapping[str, Sequence[Point]]
    careless: bool = False
    shut: frozenset[str] = frozenset()
    narrow: frozenset[str] = frozenset()
    queries: list[Query] = field(default_factory=list)
    advised: list[AdviceQuery] = field(default_factory=list)

    def count(self, purpose: Purpose) -> int:
        """How often advice of a purpose was asked for."""
        return sum(query.purpose == purpose for query in self.advised)

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        self.queries.append(query)
        label = label_of(query.preconditions)
        if label in self.shut:
            return Answer(Status.IMPOSSIBLE, 103, Scope.CONNECTED_STARTS, f'{label} is shut')
        here = point_of(query.start)
        near = sorted(self.points[label], key=lambda point: (math.dist(here, point), point))
        if query.alternative >= len(near):
            return Answer(Status.UNKNOWN, 203, message='no more of them')
        end = near[query.alternative]
        wanted = query.preferred
        if query.alternative == 0 and wanted in near and label not in self.narrow:
            end = point_of(wanted)
        return Answer(
            Status.FOUND,
            end=end,
            length=math.dist(here, end),
            payload=(here, end),
            attitude=end,
            as_preferred=end == wanted,
        )

    def advise(self, query: AdviceQuery) -> Advice:
        self.advised.append(query)
        labels = [label_of(text) for text in query.preconditions]
        advice = self._advice(labels, query)
        return self._with_places(advice, labels, query) if query.places else advice

    def _advice(self, labels: Sequence[str], query: AdviceQuery) -> Advice:
        here = point_of(query.start)
        least = [min(math.dist(here, point) for point in self.points[label]) for label in labels]
        candidates = tuple(
            CandidateAdvice(
                label in self.shut,
                Scope.CONNECTED_STARTS,
                103 if label in self.shut else 0,
                f'{label} is shut' if label in self.shut else '',
                (label,),
                bound,
            )
            for label, bound in zip(labels, least, strict=True)
        )
        order = tuple(sorted(range(len(labels)), key=lambda i: (labels[i] in self.shut, least[i])))
        if query.purpose == Purpose.OPPORTUNITIES:
            return Advice(candidates, order, opportunities=tuple(self._met(labels, query.motions)))
        if query.purpose == Purpose.NEAREST_FIRST:
            return Advice(candidates, order)
        pairs = query.precedences
        if query.purpose == Purpose.FIXED_ORDER:
            pairs = tuple(itertools.pairwise(range(len(labels))))
        way, points = shortest_tour(here, [self._known(label, query) for label in labels], pairs)
        ends = dict(zip(way, points, strict=True))
        return Advice(candidates, way, ends=tuple(ends[i] for i in range(len(labels))))

    def _known(self, label: str, query: AdviceQuery) -> Sequence[Point]:
        """The points of a label that advice knows."""
        return self.points[label][: 1 if self.careless and not query.effort else None]

    def _with_places(self, advice: Advice, labels: Sequence[str], query: AdviceQuery) -> Advice:
        """Advice with the points of each label as places, known ends first, and straight ways between them."""
        places = []
        for index, label in enumerate(labels):
            points = () if label in self.shut else self._known(label, query)
            end = query.ends[index] if query.ends else None
            known = points if end is None else (point_of(end), *points)
            places += [(index, point) for point in list(dict.fromkeys(known))[: query.places]]
        rows = [(None, point_of(query.start)), *places]
        lengths = [
            math.inf if one == other else math.dist(here, there)
            for one, here in rows
            for other, there in places
        ]
        told = tuple(Place(index, point) for index, point in places)
        return replace(advice, places=told, place_lengths=tuple(lengths))

    def _met(self, labels: Sequence[str], motions: Sequence[Answer]) -> Iterator[Opportunity]:
        for number, motion in enumerate(motions):
            assert isinstance(motion.payload, tuple)
            start, end = motion.payload
            found = [
                Opportunity(candidate, number, math.dist(start, point), point)
                for candidate, label in enumerate(labels)
                for point in self.points[label]
                if point != end
                and math.isclose(
                    math.dist(start, point) + math.dist(point, end), math.dist(start, end)
                )
            ]
            yield from sorted(found, key=lambda opportunity: opportunity.distance)


def label_of(text: str) -> str:
    """The label of ``((near label))``."""
    return text.split()[1].rstrip(')')


def point_of(state: Token) -> Point:
    """Where a geometric state is."""
    if not isinstance(state, tuple) or not state:
        return (0.0, 0.0)
    return state


def shortest_way(here: Point, stops: Sequence[Sequence[Point]]) -> tuple[float, tuple[Point, ...]]:
    """The shortest way through one point of each of the stops in their order: its length and points."""
    ways: dict[Point, tuple[float, tuple[Point, ...]]] = {here: (0.0, ())}
    for points in stops:
        ways = {
            point: min(
                (length + math.dist(last, point), (*way, point))
                for last, (length, way) in ways.items()
            )
            for point in points
        }
    return min(ways.values())


def shortest_tour(
    here: Point, stops: Sequence[Sequence[Point]], pairs: Sequence[tuple[int, int]]
) -> tuple[tuple[int, ...], tuple[Point, ...]]:
    """The shortest way through one point of each of the stops, the first of each pair before the other one.

    It is told by the indices of the stops and the points, both in the order of the way.
    """
    tours: dict[tuple[frozenset[int], Point], Way] = {(frozenset(), here): (0.0, (), ())}
    for _ in stops:
        longer: dict[tuple[frozenset[int], Point], Way] = {}
        for (done, last), (length, points, way) in tours.items():
            waiting = {later for first, later in pairs if first not in done}
            for index in set(range(len(stops))) - done - waiting:
                for point in stops[index]:
                    tour = (length + math.dist(last, point), (*points, point), (*way, index))
                    key = (done | {index}, point)
                    longer[key] = min(longer.get(key, tour), tour)
        tours = longer
    _, points, way = min(tours.values())
    return way, points
