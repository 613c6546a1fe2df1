"""First plans that know what is to come: orders that the facts allow, and attitudes with regard to the next goal."""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Callable, Sequence
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.oracle import Advice, AdviceQuery, Purpose
from task_planner_node.outcomes import Options, Outcome, Result
from tests.support.sites import Point, Sites, shortest_way

Planned = Callable[..., Result]
# A store that is emptied at the base when it is full, and at the end.
DOMAIN = """(defdomain d (
(Operator (!visit ?p) () ((near ?p)) ((visited ?p)))
(Operator (!collect ?s ?c) ((free ?c)) ((near ?s)) ((in ?c ?s) (not (free ?c))))
(Operator (!unload ?c ?s) ((in ?c ?s)) ((near base)) ((not (in ?c ?s)) (free ?c)))
(:method (fetch ?s) room ((free ?c)) ((!collect ?s ?c)) full () ((unload) (fetch ?s)))
(:method (unload) some ((:first (in ?c ?s))) ((!unload ?c ?s) (unload)) none () ())
(:method (fetch-all nil) () ())
(:method (fetch-all (?s . ?rest)) () (:unordered (fetch ?s) (fetch-all ?rest)))
(:method (look) ((target ?t)) ((!visit ?t)))
))"""
ORDERED = Options(guidance='nearest_first')


def stored(samples: Sequence[str], room: int) -> str:
    free = ' '.join(f'(free c{number})' for number in range(room))
    return f'(defproblem p d ({free}) ((fetch-all ({" ".join(samples)})) (unload)))'


def seen(result: Result) -> list[str]:
    """The labels of the motions, in their order."""
    return [re.findall(r'near (\w+)', s.preconditions)[0] for s in result.steps if s.preconditions]


def best_store(points: dict[str, Sequence[Point]], samples: str, room: int) -> float:
    """The shortest way that fetches all samples, ``room`` of them at a time, full or at the end to the base."""
    ways = []
    for order in itertools.permutations(samples):
        stops = []
        for number, label in enumerate(order):
            stops.append(points[label])
            if (number + 1) % room == 0 or number + 1 == len(order):
                stops.append(points['base'])
        ways.append(shortest_way((0.0, 0.0), stops)[0])
    return min(ways)


coordinates = st.tuples(st.integers(-9, 9).map(float), st.integers(-9, 9).map(float))


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.lists(coordinates, min_size=1, max_size=2, unique=True), min_size=3, max_size=5),
    st.integers(1, 3),
)
def test_orders_of_a_store_are_short_and_nothing_is_asked_in_vain(
    plan: Planned, places: list[list[Point]], room: int
) -> None:
    samples = 'abcd'[: len(places) - 1]
    points = dict(zip(['base', *samples], map(tuple, places), strict=True))
    world = Unnoticed(points)
    result = plan(DOMAIN, stored(samples, room), world)
    assert result.outcome == Outcome.SOLVED
    assert sorted(label for label in seen(result) if label != 'base') == list(samples)
    assert len(world.queries) == len({(s.preconditions, s.start) for s in result.steps})
    assert result.statistics.backtracks == result.statistics.geometric_backtracks == 0
    best = best_store(points, samples, room)
    assert result.plans[0].length <= 1.3 * best + 1e-9
    plain = plan(DOMAIN, stored(samples, room), Sites(points), Options(use_advice=False))
    assert result.plans[0].length <= plain.plans[0].length + 1e-9


class Unnoticed(Sites):
    """What is met on the way of a motion is not noticed."""

    def advise(self, query: AdviceQuery) -> Advice:
        return replace(super().advise(query), opportunities=())


@settings(max_examples=40, deadline=None)
@given(st.lists(st.lists(coordinates, min_size=1, max_size=3, unique=True), min_size=2, max_size=5))
def test_ordered_tasks_end_with_regard_to_the_next_ones(
    plan: Planned, places: list[list[Point]]
) -> None:
    points = {chr(ord('a') + number): tuple(some) for number, some in enumerate(places)}
    text = f'(defproblem p d () ({" ".join(f"(!visit {label})" for label in points)}))'
    best = shortest_way((0.0, 0.0), list(points.values()))[0]
    assert plan(DOMAIN, text, Sites(points)).plans[0].length == pytest.approx(best)


def test_one_by_one_the_way_is_longer(plan: Planned) -> None:
    points = {'a': ((1.0, 0.0), (0.0, 2.0)), 'b': ((0.0, 9.0),)}
    text = '(defproblem p d () ((!visit a) (!visit b)))'
    world = Sites(points)
    assert plan(DOMAIN, text, world, ORDERED).plans[0].length > 10.0
    assert not world.advised
    assert plan(DOMAIN, text, Sites(points)).plans[0].length == 9.0


def test_the_choice_that_suits_what_follows_is_made(plan: Planned) -> None:
    """Both targets can be looked at; the nearer one is farther from where the way leads."""
    points = {'s': ((-1.0, 0.0),), 't': ((3.0, 0.0),), 'a': ((9.0, 0.0),)}
    facts = '(target s) (target t)'
    text = f'(defproblem p d ({facts}) ((look) (!visit a)))'
    result = plan(DOMAIN, text, Sites(points))
    assert (seen(result), result.plans[0].length) == (['t', 'a'], 9.0)


@pytest.mark.parametrize('room', [1, 2])
def test_without_places_plans_are_found_all_the_same(plan: Planned, room: int) -> None:
    class Silent(Sites):
        def advise(self, query: AdviceQuery) -> Advice:
            return replace(super().advise(query), places=(), place_lengths=())

    points = {'base': ((0.0, 0.0),), 'a': ((5.0, 0.0),), 'b': ((-5.0, 0.0),), 'c': ((0.0, 5.0),)}
    result = plan(DOMAIN, stored('abc', room), Silent(points))
    assert result.outcome == Outcome.SOLVED
    assert seen(result)[-1] == 'base'


def test_places_that_make_no_sense_are_left(plan: Planned) -> None:
    class Confused(Sites):
        def advise(self, query: AdviceQuery) -> Advice:
            return replace(super().advise(query), place_lengths=(1.0, math.inf))

    points = {'base': ((0.0, 0.0),), 'a': ((5.0, 0.0),), 'b': ((-5.0, 0.0),), 'c': ((0.0, 5.0),)}
    assert plan(DOMAIN, stored('abc', 2), Confused(points)).outcome == Outcome.SOLVED


def test_the_same_mission_has_the_same_plan(plan: Planned) -> None:
    points = {'base': ((0.0, 0.0),), 'a': ((5.0, 0.0),), 'b': ((-5.0, 1.0),), 'c': ((3.0, 5.0),)}
    plans = [plan(DOMAIN, stored('abc', 2), Sites(points)).steps for _ in range(2)]
    assert plans[0] == plans[1]


def test_a_sample_out_of_reach_is_told(plan: Planned) -> None:
    points = {'base': ((0.0, 0.0),), 'a': ((5.0, 0.0),), 'b': ((-5.0, 1.0),)}
    result = plan(DOMAIN, stored('ab', 2), Sites(points, shut=frozenset('b')))
    assert result.outcome == Outcome.NO_PLAN
    assert 'b is shut' in result.explanation


def test_what_is_asked_for_belongs_to_tours_only(plan: Planned) -> None:
    points = {'base': ((0.0, 0.0),), 'a': ((5.0, 0.0),), 'b': ((-5.0, 1.0),)}
    for options in (ORDERED, Options(use_advice=False)):
        world = Sites(points)
        assert plan(DOMAIN, stored('ab', 1), world, options).outcome == Outcome.SOLVED
        assert not any(query.places for query in world.advised)
        assert world.count(Purpose.SHORTEST_TOUR) == world.count(Purpose.FIXED_ORDER) == 0
