"""Guidance by tours: one advice for many goals, asked for anew where the search leaves the tour; nothing is lost."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Purpose,
    Query,
    Status,
)
from task_planner_node.outcomes import Options, Outcome, Result
from task_planner_node.parameters import Guidance
from task_planner_node.search.guidance import leading_request
from tests.support.sites import Point, Sites, label_of, shortest_way

Planned = Callable[..., Result]
NEAREST = Options(guidance='nearest_first')
# Any order, and orders that symbols restrict: a battery for two visits, a camera that is calibrated before each
# visit, and doors that close after so many visits.
DOMAIN = """(defdomain d (
(Operator (!visit ?p) () ((near ?p)) ((visited ?p)))
(:method (see ?p) done ((visited ?p)) () not-yet () ((!visit ?p)))

(Operator (!visit-on-battery ?p) ((charge ?c)(call > ?c 0)) ((near ?p))
  ((not (charge ?c)) (charge (call - ?c 1))))
(Operator (!charge) ((charge ?c)(call < ?c 2)) ((near dock)) ((not (charge ?c)) (charge 2)))
(:method (survey ?p) full ((charge ?c)(call > ?c 0)) ((!visit-on-battery ?p)) empty () ((!charge) (survey ?p)))

(:operator (!calibrate) ((not (calibrated))) () ((calibrated)))
(Operator (!shoot ?p) ((calibrated)) ((near ?p)) ((not (calibrated)) (visited ?p)))
(:method (photograph ?p) () ((!calibrate) (!shoot ?p)))

(Operator (!visit-in-time ?p) ((clock ?t)(closes ?p ?last)(call <= ?t ?last)) ((near ?p))
  ((not (clock ?t)) (clock (call + ?t 1))))
(:method (call-on ?p) () ((!visit-in-time ?p)))

(Operator (!fetch ?p) () ((near ?p)) ((has ?p)))
(Operator (!bring ?p ?to) ((has ?p)) ((near ?to)) ((not (has ?p))))
(:method (carry ?p ?to) () ((!fetch ?p) (!bring ?p ?to)))
))"""


def unordered(tasks: Sequence[str], facts: str = '') -> str:
    return f'(defproblem p d ({facts}) (:unordered {" ".join(tasks)}))'


def seen(result: Result) -> list[str]:
    """The labels of the motions, in their order."""
    return [label_of(step.preconditions) for step in result.steps if step.preconditions]


def one_by_one(points: dict[str, Point]) -> dict[str, tuple[Point]]:
    return {label: (point,) for label, point in points.items()}


# From (0, 0) the nearest first is b, a, c: 1 + 3 + 14; the tour is a, b, c: 2 + 3 + 11.
ZIGZAG = one_by_one({'a': (-2.0, 0.0), 'b': (1.0, 0.0), 'c': (12.0, 0.0)})
TASKS = ('(see a)', '(see b)', '(see c)')


def test_one_advice_is_followed_to_its_end(plan: Planned) -> None:
    world = Sites(ZIGZAG)
    result = plan(DOMAIN, unordered(TASKS), world)
    assert seen(result) == ['a', 'b', 'c']
    assert world.count(Purpose.SHORTEST_TOUR) == 1
    assert [query.preferred for query in world.queries] == [p for (p,) in ZIGZAG.values()]
    nearest = Sites(ZIGZAG)
    assert seen(plan(DOMAIN, unordered(TASKS), nearest, NEAREST)) == ['b', 'a', 'c']
    assert nearest.count(Purpose.SHORTEST_TOUR) == nearest.count(Purpose.OPPORTUNITIES) == 0


def test_attitudes_are_those_of_the_tour(plan: Planned) -> None:
    world = Sites({'a': ((3.0, 0.0), (0.0, 4.0)), 'b': ((0.0, 9.0),)})
    assert plan(DOMAIN, unordered(TASKS[:2]), world).plans[0].length == 9.0
    assert plan(DOMAIN, unordered(TASKS[:2]), world, NEAREST).plans[0].length > 12.0


def test_where_a_motion_ends_elsewhere_the_tour_is_asked_for_anew(plan: Planned) -> None:
    others = one_by_one({'b': (4.0, 0.0), 'c': (6.0, 0.0), 'd': (8.0, 0.0)})
    points = {'a': ((0.0, 1.0), (2.0, 0.0)), **others}
    world = Sites(points, narrow=frozenset('a'))
    result = plan(DOMAIN, unordered([*TASKS, '(see d)']), world)
    assert seen(result) == ['a', 'b', 'c', 'd']
    tours = [q for q in world.advised if q.purpose == Purpose.SHORTEST_TOUR]
    assert [len(query.preconditions) for query in tours] == [4, 3]


class Ends(Sites):
    """From the label in ``lost`` no way leads on."""

    lost = 'a'

    def satisfy(self, query: Query) -> Answer:
        if query.start in self.points[self.lost]:
            return Answer(Status.UNKNOWN, 202, message='no way on')
        return super().satisfy(query)


def test_the_search_backs_out_of_a_tour_that_leads_nowhere(plan: Planned) -> None:
    world = Ends(ZIGZAG)
    result = plan(DOMAIN, unordered(TASKS), world)
    assert result.outcome == Outcome.SOLVED
    assert seen(result)[-1] == 'a'


class Misled(Sites):
    """Tours begin with the candidate that is farthest away."""

    def advise(self, query: AdviceQuery) -> Advice:
        nearest = super().advise(replace(query, purpose=Purpose.NEAREST_FIRST))
        self.advised[-1] = query
        if query.purpose != Purpose.SHORTEST_TOUR:
            return nearest
        ends = tuple(self.points[label_of(text)][0] for text in query.preconditions)
        return replace(nearest, order=nearest.order[::-1], ends=ends)


def test_tours_into_many_dead_ends_are_left_for_the_nearest_first(plan: Planned) -> None:
    """Only the end of the mission tells that p0 had to be the first, which is too much for a rehearsal, too."""
    domain = """(defdomain d (
    (Operator (!visit ?p) () ((near ?p)) ())
    (:operator (!!begin ?p) () () ((first ?p)))
    (:operator (!finish) ((first p0)) () ())
    (:method (see ?p) later ((first ?q)) ((!visit ?p)) at-once () ((!visit ?p) (!!begin ?p)))
    ))"""
    goals = [f'p{number}' for number in range(12)]
    tasks = ' '.join(f'(see {goal})' for goal in reversed(goals))
    problem = f'(defproblem p d () ((:unordered {tasks}) (!finish)))'
    points = {goal: ((1.0 + number, 0.0),) for number, goal in enumerate(goals)}
    world = Misled(points)
    result = plan(domain, problem, world)
    assert result.outcome == Outcome.SOLVED
    assert seen(result) == goals
    assert 300 <= result.statistics.backtracks < 1000
    assert world.count(Purpose.NEAREST_FIRST) > 0


def test_after_the_preferred_attitude_come_all_others(plan: Planned) -> None:
    class Picky(Sites):
        """One can go on only from the last of the points of a."""

        def satisfy(self, query: Query) -> Answer:
            if query.start in self.points['a'][:-1]:
                return Answer(Status.UNKNOWN, 202, message='no way on')
            return super().satisfy(query)

    world = Picky({'a': ((-1.0, 0.0), (-2.0, 0.0), (-1.0, 9.0)), 'b': ((5.0, 0.0),)})
    facts = '(clock 0)(closes a 0)(closes b 9)'
    result = plan(DOMAIN, unordered(['(call-on a)', '(call-on b)'], facts), world)
    assert seen(result) == ['a', 'b']
    assert world.queries[0].preferred == (-1.0, 0.0)
    assert result.steps[0].answer is not None
    assert result.steps[0].answer.end == (-1.0, 9.0)


def test_what_a_tour_proves_impossible_is_not_searched_for(plan: Planned) -> None:
    world = Sites(ZIGZAG, shut=frozenset('c'))
    result = plan(DOMAIN, unordered(TASKS), world)
    assert result.outcome == Outcome.NO_PLAN
    assert not world.queries
    assert 'c is shut' in result.explanation


def test_what_was_carried_changes_the_tour(plan: Planned) -> None:
    points = one_by_one({'a': (1.0, 0.0), 'b': (2.0, 0.0), 'x': (3.0, 0.0), 'y': (-9.0, 0.0)})
    world = Sites(points)
    result = plan(DOMAIN, unordered(['(carry a y)', '(carry b x)']), world)
    assert sorted(seen(result)) == ['a', 'b', 'x', 'y']
    for goods, place in (('a', 'y'), ('b', 'x')):
        assert seen(result).index(goods) < seen(result).index(place)


@pytest.mark.parametrize('guidance', ['tour', 'nearest_first'])
def test_the_same_goal_may_be_wanted_twice(plan: Planned, guidance: Guidance) -> None:
    tasks = ['(call-on a)', '(call-on b)', '(call-on a)']
    facts = '(clock 0)(closes a 9)(closes b 9)'
    options = Options(guidance=guidance, optimise=True)
    result = plan(DOMAIN, unordered(tasks, facts), Sites(ZIGZAG), options)
    assert sorted(seen(result)) == ['a', 'a', 'b']
    assert result.plans[0].length == 4.0


def test_following_a_tour_takes_little_work(plan: Planned, monkeypatch: pytest.MonkeyPatch) -> None:
    count = 60
    guesses = []

    def guess(domain: Any, state: Any, network: Any, where: Any) -> Any:
        guesses.append(network)
        return leading_request(domain, state, network, where)

    class Row(Sites):
        """Points in a row, the tour of which is no work to find."""

        def advise(self, query: AdviceQuery) -> Advice:
            self.advised.append(query)
            ends = tuple(self.points[label_of(text)][0] for text in query.preconditions)
            order = tuple(sorted(range(len(ends)), key=lambda i: ends[i]))
            return Advice((CandidateAdvice(),) * len(ends), order, ends=ends)

    monkeypatch.setattr('task_planner_node.search.candidates.leading_request', guess)
    world = Row({f'p{i}': ((float(i * 7 % count), 0.0),) for i in range(count)})
    result = plan(DOMAIN, unordered([f'(see {label})' for label in world.points]), world)
    assert result.plans[0].length == count - 1
    assert len(guesses) <= 2 * count
    assert world.count(Purpose.SHORTEST_TOUR) == 1


coordinates = st.tuples(st.integers(-9, 9).map(float), st.integers(-9, 9).map(float))
maps = st.lists(st.lists(coordinates, min_size=1, max_size=2, unique=True), min_size=2, max_size=4)


def missions(labels: Sequence[str], data: st.DataObject) -> tuple[str, Callable[..., bool]]:
    """A problem, and which orders of the labels its symbols allow."""
    kind = data.draw(st.sampled_from(['see', 'photograph', 'call-on']))
    facts = ''
    last = {label: len(labels) for label in labels}
    if kind == 'call-on':
        last = {label: data.draw(st.integers(0, len(labels)), label='closes') for label in labels}
        facts = '(clock 0)' + ''.join(f'(closes {label} {t})' for label, t in last.items())
    problem = unordered([f'({kind} {label})' for label in labels], facts)
    return problem, lambda order: all(i <= last[label] for i, label in enumerate(order))


@settings(max_examples=60, deadline=None)
@given(maps, st.booleans(), st.data())
def test_orders_are_valid_and_the_best_one_is_found(
    plan: Planned, points: list[list[Point]], careless: bool, data: st.DataObject
) -> None:
    sites = {chr(ord('a') + i): tuple(choice) for i, choice in enumerate(points)}
    problem, allowed = missions(list(sites), data)
    orders = [order for order in itertools.permutations(sites) if allowed(order)]
    lengths = [shortest_way((0.0, 0.0), [sites[label] for label in way])[0] for way in orders]
    result = plan(DOMAIN, problem, Sites(sites, careless))
    best = plan(DOMAIN, problem, Sites(sites, careless), Options(optimise=True))
    if not orders:
        assert not result.plans
        assert not best.plans
        return
    assert result.outcome == best.outcome == Outcome.SOLVED
    assert tuple(seen(result)) in orders
    assert result.plans[0].length >= min(lengths) - 1e-9
    assert best.plans[0].length == pytest.approx(min(lengths))
    again = plan(DOMAIN, problem, Sites(sites, careless))
    assert [step.answer for step in again.steps] == [step.answer for step in result.steps]
    if not careless and len(orders) == math.factorial(len(sites)):
        assert result.plans[0].length == pytest.approx(min(lengths))
