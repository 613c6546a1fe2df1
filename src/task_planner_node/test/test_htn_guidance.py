"""Advice, requests in flight together, and lower bounds: they change the order and the effort, never what is found."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Query,
    Scope,
    Status,
    TextCheck,
    Token,
)
from task_planner_node.outcomes import Options, Outcome, Result

Planned = Callable[..., Result]
Point = tuple[float, float]
DOMAIN = """(defdomain d (
(Operator (!visit ?p) ((place ?p)) ((near ?p)) ((visited ?p)))
(:method (visit-any ?kind) ((of ?kind ?p)(not (visited ?p))) ((!visit ?p)))
(:method (visit-sorted ?kind) (:sort-by ?rank < ((of ?kind ?p)(rank ?p ?rank))) ((!visit ?p)))
(:method (see ?p) done ((visited ?p)) () not-yet () ((!visit ?p)))))"""


@dataclass
class Plane:
    """Points that are driven to in straight lines; some cannot be found from some."""

    places: dict[str, Point]
    lost: frozenset[tuple[str, str]] = frozenset()
    together: list[int] = field(default_factory=list)
    asked: int = 0

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def _place(self, text: str) -> str:
        return text.split()[1].rstrip(')')

    def _at(self, start: Token) -> tuple[str, Point]:
        if start == ():
            return '', (0.0, 0.0)
        name = str(start)
        return name, self.places[name]

    def satisfy(self, query: Query) -> Answer:
        self.asked += 1
        goal = self._place(query.preconditions)
        name, here = self._at(query.start)
        if query.alternative or (name, goal) in self.lost:
            return Answer(Status.UNKNOWN, 202, message='no path')
        return Answer(Status.FOUND, end=goal, length=math.dist(here, self.places[goal]))

    def advise(self, query: AdviceQuery) -> Advice:
        here = self._at(query.start)[1]
        lengths = [math.dist(here, self.places[self._place(t)]) for t in query.preconditions]
        order = sorted(range(len(lengths)), key=lengths.__getitem__)
        return Advice(
            tuple(CandidateAdvice(lower_bound=length) for length in lengths), tuple(order)
        )


class Batches(Plane):
    """The same, several at once."""

    def satisfy_together(self, queries: Sequence[Query]) -> Sequence[Answer]:
        self.together.append(len(queries))
        return [self.satisfy(query) for query in queries]


class Vague(Plane):
    """The same, without lower bounds."""

    def advise(self, query: AdviceQuery) -> Advice:
        advice = super().advise(query)
        return Advice(tuple(CandidateAdvice() for _ in advice.candidates), advice.order)


LINE = {'far': (9.0, 0.0), 'near': (1.0, 0.0), 'middle': (5.0, 0.0)}
FACTS = ' '.join(f'(place {p})(of spot {p})(rank {p} {len(p)})' for p in LINE)


def visited(result: Result) -> list[str]:
    return [step.action[1] for step in result.steps]


@pytest.mark.parametrize(
    ('task', 'use_advice', 'order'),
    [
        ('(visit-any spot)', True, ['near', 'middle', 'far']),
        ('(visit-any spot)', False, ['far', 'near', 'middle']),
        ('(visit-sorted spot)', True, ['far', 'near', 'middle']),
    ],
)
def test_ways_of_a_method_are_tried_nearest_first_unless_they_are_sorted(
    plan: Planned, task: str, use_advice: bool, order: list[str]
) -> None:
    problem = f'(defproblem p d ({FACTS}) ({task}))'
    result = plan(DOMAIN, problem, Plane(LINE), Options(use_advice=use_advice, plans=5))
    assert [found.actions[0][1] for found in result.plans] == order


def tours(places: dict[str, Point]) -> str:
    facts = ' '.join(f'(place {p})' for p in places)
    return f'(defproblem p d ({facts}) (:unordered {" ".join(f"(see {p})" for p in places)}))'


coordinates = st.tuples(st.integers(0, 20).map(float), st.integers(0, 20).map(float))


@settings(max_examples=40, deadline=None)
@given(st.lists(coordinates, min_size=2, max_size=4), st.data())
def test_batches_and_bounds_change_the_effort_only(
    plan: Planned, points: list[Point], data: st.DataObject
) -> None:
    places = {f'p{i}': point for i, point in enumerate(points)}
    pairs = st.tuples(st.sampled_from(['', *places]), st.sampled_from(list(places)))
    lost = data.draw(st.frozensets(pairs, max_size=4))
    results = {}
    for kind in (Plane, Batches, Vague):
        for optimise in (False, True):
            world = kind(places, lost)
            result = plan(DOMAIN, tours(places), world, Options(optimise=optimise))
            assert result.statistics.requests == world.asked
            results[kind, optimise] = result
    for optimise in (False, True):
        one = results[Plane, optimise]
        for kind in (Batches, Vague):
            other = results[kind, optimise]
            assert other.outcome == one.outcome
            if one.plans and optimise:
                assert other.plans[0].cost == pytest.approx(one.plans[0].cost)
        assert visited(results[Batches, optimise]) == visited(one)
    assert results[Plane, True].statistics.backtracks <= results[Vague, True].statistics.backtracks


def test_what_comes_next_is_asked_for_together_once_the_first_did_not_help(plan: Planned) -> None:
    places = {f'p{i}': (float(i), 0.0) for i in range(6)}
    # p0 is nearest and leads nowhere.
    lost = frozenset(('p0', f'p{i}') for i in range(1, 6))
    world = Batches(places, lost)
    result = plan(DOMAIN, tours(places), world)
    assert result.outcome == Outcome.SOLVED
    assert sorted(visited(result)) == sorted(places)
    assert max(world.together) == 4


def test_behaviour_constraints_are_handed_on(plan: Planned) -> None:
    domain = '(defdomain d ((Operator (!go ?p) () ((near ?p)) ((slow ?p)) ((been ?p)) ())))'
    queries: list[Any] = []

    class Listening(Plane):
        def satisfy(self, query: Query) -> Answer:
            queries.append(query)
            return super().satisfy(query)

    result = plan(domain, '(defproblem p d () ((!go far)))', Listening(LINE))
    assert result.outcome == Outcome.SOLVED
    assert (queries[0].preconditions, queries[0].behaviour) == ('((near far))', '((slow far))')


class Shut(Plane):
    """A plane whose places in ``shut`` cannot be reached from anywhere."""

    shut: frozenset[str] = frozenset({'b'})

    def satisfy(self, query: Query) -> Answer:
        if self._place(query.preconditions) in self.shut:
            return Answer(Status.IMPOSSIBLE, 103, Scope.CONNECTED_STARTS, 'walled in')
        return super().satisfy(query)


@pytest.mark.parametrize('use_advice', [True, False])
def test_nothing_is_left_of_a_way_that_a_lasting_impossibility_ended(
    plan: Planned, use_advice: bool
) -> None:
    domain = """(defdomain d (
        (:operator (!note ?p) ((not (noted))) () ((noted)))
        (Operator (!visit ?p) () ((near ?p)) ())
        (:method (visit-any) ((place ?p)) ((!note ?p) (!visit ?p)))))"""
    problem = '(defproblem p d ((place b) (place a)) ((visit-any)))'
    options = Options(use_advice=use_advice)
    result = plan(domain, problem, Shut({'a': (3.0, 4.0), 'b': (1.0, 0.0)}), options)
    assert result.outcome == Outcome.SOLVED
    assert [step.action for step in result.steps] == [('!note', 'a'), ('!visit', 'a')]
