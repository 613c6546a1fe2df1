"""Orders, arguments that are bound later, circles and the cheapest plans: against plans worked out by hand or by permutation."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.language import Source, read_domain, read_problem
from task_planner_node.language.model import Atom, Ordered, Partial
from task_planner_node.mission import MissionText, check_and_compile
from task_planner_node.oracle import Oracle
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.planner import Planner
from task_planner_node.search.engine import Search
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.partial_plan import Limits
from task_planner_node.search.plans import Plans
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics

Planned = Callable[..., Result]
ALL = Options(plans=1000, use_advice=False)


def actions(result: Result) -> list[list[str]]:
    """The actions of every plan, each as one text."""
    return [[' '.join(action).lstrip('!') for action in plan.actions] for plan in result.plans]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=5), st.booleans())
def test_an_explicit_order_allows_its_linear_extensions(
    no_motion_planner: Oracle, pairs: list[tuple[int, int]], compound: bool
) -> None:
    before = {(min(pair), max(pair)) for pair in pairs if pair[0] != pair[1]}
    text = '(defdomain d ((:operator (!o ?x) () () ())(:method (m ?x) () ((!o ?x)))))'
    domain = read_domain(Source('d', text))
    name = 'm' if compound else '!o'
    found = read_problem(
        Source('p', f'(defproblem p d () ({" ".join(f"({name} {i})" for i in range(4))}))')
    )
    assert isinstance(found.tasks, Ordered)
    atoms = tuple(item for item in found.tasks.items if isinstance(item, Atom))
    problem = replace(found, tasks=Partial(atoms, tuple(sorted(before))))
    mission = check_and_compile(domain, problem, no_motion_planner)
    state, statistics = State(mission.domain.plan, []), Statistics()
    geometry = Geometry(no_motion_planner, statistics, 1, lambda: None)
    limits = Limits(plans=100)
    search = Search(
        mission.domain,
        mission.domain.beginning(problem),
        state,
        geometry,
        statistics,
        limits,
        lambda: None,
        Plans(limits, lambda _: None),
    )
    search.run(())
    plans = {tuple(int(action[1]) for action in plan.actions) for plan in search.plans.kept}
    assert plans == {
        order
        for order in itertools.permutations(range(4))
        if all(order.index(first) < order.index(later) for first, later in before)
    }


LATER = """(defdomain d (
(:operator (!take ?x) ((thing ?x)) ((thing ?x)) ((has ?x)))
(:operator (!give ?x ?y) ((has ?x)(person ?y)) ((has ?x)) ((got ?y ?x)))
(:operator (!note ?x) () () ())
(:method (hand-over) () ((!take ?x) (!give ?x ?y)))
(:method (hand-over-to ?y) () ((pick ?x) (!give ?x ?y) (!note ?x)))
(:method (pick ?x) ((likes ?z ?x)) ((!take ?x)))
(:method (fixed) () ((constant ?x) (!note ?x)))
(:method (constant c) () ())
(:method (pair ?x ?x) () ((!note ?x)))
(:method (unified) () ((pair ?u b)))
))"""


@pytest.mark.parametrize(
    ('facts', 'task', 'plans'),
    [
        ('(thing t)(person p)', '(hand-over)', [['take t', 'give t p']]),
        (
            '(thing s)(thing t)(person p)',
            '(hand-over)',
            [['take s', 'give s p'], ['take t', 'give t p']],
        ),
        (
            '(thing s)(thing t)(person p)(likes q t)',
            '(hand-over-to p)',
            [['take t', 'give t p', 'note t']],
        ),
        ('', '(fixed)', [['note c']]),
        ('', '(unified)', [['note b']]),
        ('(person p)', '(hand-over)', []),
    ],
)
def test_what_binds_an_argument_binds_it_for_all(
    plan: Planned, facts: str, task: str, plans: list[list[str]]
) -> None:
    result = plan(LATER, f'(defproblem p d ({facts}) ({task}))', None, ALL)
    assert actions(result) == plans


def test_an_operator_that_leaves_an_argument_unbound_is_an_error(plan: Planned) -> None:
    domain = '(defdomain d ((:operator (!note ?x) () () ())(:method (t) () ((!note ?x)))))'
    result = plan(domain, '(defproblem p d () ((t)))')
    assert result.outcome == Outcome.INVALID
    assert (
        'd.lisp:1:26: (!note ?x) is done with an argument that nothing has bound'
        in result.explanation
    )


def test_the_tree_has_the_values_that_were_bound_later(plan: Planned) -> None:
    result = plan(LATER, '(defproblem p d ((thing t)(person p)(likes q t)) ((hand-over-to p)))')
    lines = [(depth, node.task, node.step) for node, depth in result.plans[0].tree.nodes()]
    assert lines == [
        (0, ('hand-over-to', 'p'), None),
        (1, ('pick', 't'), None),
        (2, ('!take', 't'), 0),
        (1, ('!give', 't', 'p'), 1),
        (1, ('!note', 't'), 2),
    ]


def test_the_tree_is_in_the_order_of_the_text_and_the_steps_in_that_of_the_plan(
    plan: Planned,
) -> None:
    domain = """(defdomain d (
        (:operator (!a) ((ready)) () ())
        (:operator (!b) () () ((ready)))
        (:operator (!!hidden) () () ())
        (:method both (t) way-one ((no)) () way-two () (:unordered (u) (!b) (!!hidden)))
        (:method (u) () ((!a)))))"""
    result = plan(domain.replace('both ', ''), '(defproblem p d () ((t) (!a)))')
    assert actions(result) == [['b', 'a', 'a']]
    first, second = result.plans[0].tree.roots
    assert (first.task, first.branch, first.method_number, first.branch_number) == (
        ('t',),
        'way-two',
        1,
        2,
    )
    assert [(child.task, child.step) for child in first.children] == [
        (('u',), None),
        (('!b',), 0),
        (('!!hidden',), None),
    ]
    assert [child.step for child in first.children[0].children] == [1]
    assert (second.task, second.step, second.primitive) == (('!a',), 2, True)


ROADS = '(road a b)(road b a)(road b c)(road c b)(road c d)(at a)'
DRIVE = '(:operator (!drive ?x ?y) ((at ?x)(road ?x ?y)) ((at ?x)) ((at ?y)) (call + 1 1))'


@pytest.mark.parametrize(
    'methods',
    [
        # Forwards, the same place comes up again; backwards, the same task does below itself.
        '(:method (go ?z) here ((at ?z)) () there ((at ?x)(road ?x ?y)) ((!drive ?x ?y) (go ?z)))',
        '(:method (go ?z) ((road ?y ?z)) ((go ?y) (!drive ?y ?z)))(:method (go ?z) ((at ?z)) ())',
    ],
)
def test_circles_are_no_ways(plan: Planned, methods: str) -> None:
    domain = f'(defdomain d ({DRIVE} {methods}))'
    result = plan(domain, f'(defproblem p d ({ROADS}) ((go d)))', None, Options(time_budget=60.0))
    assert actions(result) == [['drive a b', 'drive b c', 'drive c d']]
    assert result.plans[0].cost == 6.0
    nowhere = plan(domain, f'(defproblem p d ({ROADS}) ((go e)))', None, Options(time_budget=60.0))
    assert nowhere.outcome == Outcome.NO_PLAN


def test_a_task_below_itself_is_tried_once_nothing_else_helps(plan: Planned) -> None:
    domain = """(defdomain d (
        (:operator (!one) ((n ?x)(assign ?y (call + ?x 1))) ((n ?x)) ((n ?y)))
        (:method (many) () ((many) (!one)))
        (:method (many) () ())
        (:operator (!check) ((n 3)) () ())))"""
    result = plan(domain, '(defproblem p d ((n 0)) ((many) (!check)))')
    assert actions(result) == [['one', 'one', 'one', 'check']]


PRICES = """(defdomain d (
(:operator (!pay ?x) ((price ?x ?c)) () ((paid ?x)) ?c)
(:method (buy) ((price ?x ?c)) ((!pay ?x)))))"""


@settings(max_examples=40, deadline=None)
@given(st.lists(st.integers(0, 9), min_size=1, max_size=4), st.integers(1, 3), st.integers(1, 5))
def test_the_cheapest_plans_are_found(
    plan: Planned, prices: list[int], purchases: int, wanted: int
) -> None:
    facts = ' '.join(f'(price x{i} {price})' for i, price in enumerate(prices))
    problem = f'(defproblem p d ({facts}) ({"(buy)" * purchases}))'
    result = plan(PRICES, problem, None, Options(optimise=True, plans=wanted))
    costs = sorted(map(sum, itertools.product(prices, repeat=purchases)))
    assert [found.cost for found in result.plans] == costs[:wanted]
    assert len({found.actions for found in result.plans}) == len(result.plans)
    first = plan(PRICES, problem, None, Options(plans=wanted))
    assert first.plans[0].cost == prices[0] * purchases


def test_each_better_plan_is_told_on_the_way(no_motion_planner: Oracle) -> None:
    heard: list[Progress] = []
    planner = Planner(no_motion_planner, Options(optimise=True), report=heard.append)
    problem = '(defproblem p d ((price a 5)(price b 7)(price c 2)(price e 3)) ((buy)))'
    result = planner.plan(MissionText(text=PRICES), MissionText(text=problem))
    told = [progress.improved for progress in heard if progress.improved is not None]
    assert [found.cost for found in told] == [5.0, 2.0]
    assert [progress.best_cost for progress in heard][-1] == 2.0
    assert result.plans == (told[-1],)


def test_a_cost_that_is_none_is_an_error(plan: Planned) -> None:
    result = plan(PRICES, '(defproblem p d ((price a free)) ((buy)))')
    assert result.outcome == Outcome.INVALID
    assert 'the cost of !pay is free' in result.explanation


def test_the_memory_limit_ends_a_search(plan: Planned) -> None:
    domain = """(defdomain d (
        (:operator (!step ?n) () () ((done ?n)))
        (:method (count ?n) ((assign ?m (eval (+ ?n 1)))) ((!step ?n) (count ?m)))))"""
    options = Options(time_budget=600.0, memory_limit=100, max_depth=20_000_000)
    result = plan(domain, '(defproblem p d () ((count 0)))', None, options)
    assert result.outcome == Outcome.LIMIT
    assert 'the memory limit of 100 MiB is reached' in result.explanation


def test_deep_axioms_are_evaluated(plan: Planned) -> None:
    domain = """(defdomain d (
        (:- (reach ?a ?b) ((edge ?a ?b)) ((edge ?a ?c) (reach ?c ?b)))
        (:operator (!go) ((reach 0 1000)) () ())))"""
    facts = ''.join(f'(edge {i} {i + 1})' for i in range(1000))
    assert plan(domain, f'(defproblem p d ({facts}) ((!go)))').outcome == Outcome.SOLVED


def test_a_plan_of_a_hundred_thousand_steps_is_found(plan: Planned) -> None:
    domain = """(defdomain d (
        (:operator (!step ?n) () () ((done ?n)))
        (:method (count ?n) ((eval (= ?n 0))) () ((assign ?m (eval (- ?n 1)))) ((!step ?n) (count ?m)))))"""
    result = plan(domain, '(defproblem p d () ((count 100000)))', None, Options(time_budget=600.0))
    assert len(result.steps) == 100_000
    assert result.steps[-1].action == ('!step', '1')


def test_what_no_action_changes_is_tested_where_it_is_chosen(plan: Planned) -> None:
    """Without that the search would take and put back, for each of the pairs."""
    domain = """(defdomain d (
        (:operator (!take ?x) () () ((has ?x)))
        (:operator (!join ?x ?y) ((has ?x)(fits ?x ?y)(not (broken ?y))) () ((joined ?x ?y)))
        (:method (assemble) ((part ?x)(part ?y)) ((!take ?x) (finish ?x ?y)))
        (:method (finish ?a ?b) () ((!join ?a ?b)))))"""
    facts = ' '.join(f'(part p{i})(fits p{i} p{i + 1})(broken p{i})' for i in range(30))
    result = plan(domain, f'(defproblem p d ({facts} (part p30)) ((assemble)))')
    assert actions(result) == [['take p29', 'join p29 p30']]
    assert result.statistics.decompositions < 10
    broken = plan(domain, f'(defproblem p d ({facts} (part p30)(broken p30)) ((assemble)))')
    assert broken.outcome == Outcome.NO_PLAN
    assert broken.statistics.decompositions < 10
