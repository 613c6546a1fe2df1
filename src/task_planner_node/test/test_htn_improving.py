"""Improvement of whole plans: opportunities, orders and attitudes that are proposed, as far as symbols allow them."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.errors import LimitReached
from task_planner_node.mission import MissionText, read_mission
from task_planner_node.oracle import Advice, AdviceQuery, Answer, Oracle, Purpose, Query
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.planner import Planner
from task_planner_node.search.itinerary import Itinerary
from tests.support.sites import Sites, label_of, shortest_way

Planned = Callable[..., Result]
DOMAIN = """(defdomain d (
(Operator (!visit ?p) () ((near ?p)) ((visited ?p)))
(:operator (!wait) () () ())

(Operator (!visit-on-battery ?p) ((charge ?c)(call > ?c 0)) ((near ?p))
  ((not (charge ?c)) (charge (call - ?c 1))))
(Operator (!charge) ((charge ?c)(call < ?c 2)) ((near dock)) ((not (charge ?c)) (charge 2)))
(:method (survey ?p) full ((charge ?c)(call > ?c 0)) ((!visit-on-battery ?p))
  empty () ((!charge) (survey ?p)))

(Operator (!visit-in-time ?p) ((clock ?t)(closes ?p ?last)(call <= ?t ?last)) ((near ?p))
  ((not (clock ?t)) (clock (call + ?t 1))))

(Operator (!fetch ?p) ((place ?p)) ((near ?p)) ((has ?p)))
(Operator (!bring ?p ?to) ((has ?p)) ((near ?to)) ((not (has ?p))))
(:method (carry ?p ?to) () ((!fetch ?p) (!bring ?p ?to)))

(:method (visit-all) some ((place ?p)(not (visited ?p))) ((!visit ?p) (visit-all)) none () ())
))"""
# Advice of effort 0 knows the far side of b only; it is also seen on the way to a.
ON_THE_WAY = {'a': ((10.0, 0.0),), 'b': ((10.0, 8.0), (4.0, 0.0))}


def problem(tasks: str, facts: str = '') -> str:
    return f'(defproblem p d ({facts}) {tasks})'


def seen(result: Result) -> list[str]:
    return [label_of(step.preconditions) for step in result.steps if step.preconditions]


def told(oracle: Oracle, text: str, options: Options) -> tuple[Result, list[Progress]]:
    heard: list[Progress] = []
    planner = Planner(oracle, options, report=heard.append)
    result = planner.plan(MissionText('d.lisp', DOMAIN), MissionText('p.lisp', text))
    return result, [progress for progress in heard if progress.improved is not None]


def test_a_goal_is_met_on_the_way_to_another_one() -> None:
    world = Sites(ON_THE_WAY, careless=True)
    text = problem('(:unordered (!visit a) (!visit b))')
    result, heard = told(world, text, Options())
    assert (seen(result), result.plans[0].length) == (['b', 'a'], 10.0)
    assert (result.statistics.opportunities, result.statistics.improvements) == (1, 1)
    lengths = [progress.best_length for progress in heard]
    assert (len(lengths), lengths[-1]) == (2, 10.0)
    assert lengths[0] > 10.0
    assert world.count(Purpose.OPPORTUNITIES) == 1


@pytest.mark.parametrize(
    ('tasks', 'facts'),
    [
        ('((!visit a) (!visit b))', ''),
        (
            '(:unordered (!visit-in-time a) (!visit-in-time b))',
            '(clock 0)(closes a 0)(closes b 9)',
        ),
    ],
)
def test_an_opportunity_that_symbols_forbid_is_left(plan: Planned, tasks: str, facts: str) -> None:
    for optimise in (False, True):
        world = Sites(ON_THE_WAY, careless=True)
        result = plan(DOMAIN, problem(tasks, facts), world, Options(optimise=optimise))
        assert seen(result) == ['a', 'b']
        assert result.plans[0].length == (16.0 if optimise else result.plans[0].length)
        assert result.statistics.opportunities == 0


def test_attitudes_of_an_ordered_plan_are_moved(plan: Planned) -> None:
    points = {
        'a': ((1.0, 0.0), (0.0, 3.0)),
        'b': ((9.0, 9.0), (0.0, 9.0)),
        'c': ((0.0, 12.0), (20.0, 20.0)),
    }
    tasks = '((!visit a) (!visit b) (!visit c))'
    # The second answer to a request is out of reach, but for what is proposed.
    options = Options(optimise=True, max_alternatives=1)
    world = Sites(points)
    result = plan(DOMAIN, problem(tasks), world, options)
    assert result.plans[0].length == shortest_way((0.0, 0.0), list(points.values()))[0] == 12.0
    assert world.count(Purpose.FIXED_ORDER)


def test_an_order_that_bindings_choose_is_toured(plan: Planned) -> None:
    # Nearest first b, a, c: 1 + 3 + 14.
    points = {'a': ((-2.0, 0.0),), 'b': ((1.0, 0.0),), 'c': ((12.0, 0.0),)}
    facts = ''.join(f'(place {label})' for label in points)
    result, heard = told(Sites(points), problem('((visit-all))', facts), Options(optimise=True))
    assert (seen(result), result.plans[0].length) == (['a', 'b', 'c'], 16.0)
    assert [progress.best_length for progress in heard] == [16.0]
    nearest = plan(
        DOMAIN,
        problem('((visit-all))', facts),
        Sites(points),
        Options(guidance='nearest_first'),
    )
    assert nearest.plans[0].length == 18.0


def test_at_a_limit_the_best_plan_so_far_is_the_result() -> None:
    class Patient(Sites):
        """Time is over when the first order is proposed."""

        def advise(self, query: AdviceQuery) -> Advice:
            if query.purpose == Purpose.FIXED_ORDER:
                raise LimitReached('time is over')
            return super().advise(query)

    world = Patient(ON_THE_WAY, careless=True)
    text = problem('(:unordered (!visit a) (!visit b))')
    result, heard = told(world, text, Options(optimise=True))
    assert result.outcome == Outcome.SOLVED
    assert result.plans[0].length == 10.0
    assert [progress.best_length for progress in heard] == [18.0, 10.0]


networks = st.recursive(
    st.just('leaf'),
    lambda inner: st.tuples(st.sampled_from(['', ':unordered']), st.lists(inner, max_size=3)),
    max_leaves=5,
)


def written(network: object, methods: list[str], labels: list[str], draw: st.DataObject) -> str:
    """A random network as text; some parts of it are tasks with a method of their own."""
    if network == 'leaf':
        labels.append(f'l{len(labels)}')
        text = f'(!visit {labels[-1]})'
    else:
        assert isinstance(network, tuple)
        word, parts = network
        text = f'({word} {" ".join(written(part, methods, labels, draw) for part in parts)})'
    if draw.draw(st.booleans(), label='method'):
        methods.append(
            f'(:method (m{len(methods)}) () {text if network != "leaf" else f"({text})"})'
        )
        return f'(m{len(methods) - 1})'
    return text


@settings(max_examples=60, deadline=None)
@given(networks, st.data())
def test_precedences_are_the_order_that_all_plans_share(
    plan: Planned, network: object, data: st.DataObject
) -> None:
    methods: list[str] = []
    labels: list[str] = []
    tasks = written(network, methods, labels, data)
    domain = f'(defdomain d ((Operator (!visit ?p) () ((near ?p)) ()) {" ".join(methods)}))'
    text = f'(defproblem p d () ({tasks}))'
    world = Sites(dict.fromkeys(labels, ((1.0, 0.0),)))
    options = Options(plans=1000, use_advice=False, max_alternatives=1)
    result = plan(domain, text, world, options)
    assert result.outcome == Outcome.SOLVED
    read = read_mission(MissionText('d', domain), MissionText('p', text))[1]
    itinerary = Itinerary(result.plans[0].log, read.tasks, frozenset())
    names = [label_of(motion.preconditions) for motion in itinerary.motions]
    pairs = {(names[a], names[b]) for a, b in itinerary.precedences(strict=True)}
    while more := {(a, d) for a, b in pairs for c, d in pairs if b == c} - pairs:
        pairs |= more
    orders = [[action[1] for action in found.actions] for found in result.plans]
    shared = {
        (a, b)
        for a, b in itertools.permutations(names, 2)
        if all(order.index(a) < order.index(b) for order in orders)
    }
    assert pairs == shared


coordinates = st.tuples(st.integers(-9, 9).map(float), st.integers(-9, 9).map(float))
maps = st.lists(st.lists(coordinates, min_size=1, max_size=2, unique=True), min_size=3, max_size=3)


def carried(labels: Sequence[str]) -> str:
    facts = ''.join(f'(place {label})' for label in labels)
    return problem('(:unordered (carry a b) (carry c a))', facts)


def surveyed(labels: Sequence[str]) -> str:
    tasks = ' '.join(f'(survey {label})' for label in labels)
    return problem(f'(:unordered {tasks})', '(charge 1)')


@settings(max_examples=20, deadline=None)
@given(maps, st.booleans(), st.sampled_from([carried, surveyed]))
def test_the_cheapest_plan_is_that_of_a_search_without_advice(
    plan: Planned,
    points: list[list[tuple[float, float]]],
    careless: bool,
    mission: Callable[..., str],
) -> None:
    sites = {chr(ord('a') + i): tuple(choice) for i, choice in enumerate(points)}
    text = mission(list(sites))
    sites['dock'] = ((0.0, 0.0),)
    reference = plan(DOMAIN, text, Sites(sites), Options(optimise=True, use_advice=False))
    best = plan(DOMAIN, text, Sites(sites, careless), Options(optimise=True))
    first = plan(DOMAIN, text, Sites(sites, careless))
    assert best.plans[0].cost == pytest.approx(reference.plans[0].cost)
    assert first.plans[0].cost >= reference.plans[0].cost - 1e-9


def test_no_more_is_asked_for_than_rounds_without_a_gain_allow(plan: Planned) -> None:
    class Counted(Sites):
        """Answers as many requests as are needed."""

        def satisfy(self, query: Query) -> Answer:
            assert len(self.queries) < 1000
            return super().satisfy(query)

    points = {'a': ((1.0, 0.0),), 'b': ((2.0, 0.0),), 'c': ((3.0, 0.0),)}
    world = Counted(points)
    tasks = '(:unordered (!visit a) (!visit b) (!visit c))'
    result = plan(DOMAIN, problem(tasks), world, Options(optimise=True))
    assert result.plans[0].length == 3.0
    efforts = [q.effort for q in world.advised if q.purpose == Purpose.FIXED_ORDER]
    assert efforts == [1, 2, 3]
