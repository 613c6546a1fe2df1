"""Enumerations that never end are ended, and what the relaxation cannot evaluate proves nothing."""

from __future__ import annotations

import time
from collections.abc import Callable

import pytest

from task_planner_node.mission import MissionText
from task_planner_node.oracle import Oracle
from task_planner_node.outcomes import Options, Outcome, Result
from task_planner_node.planner import Planner

Plan = Callable[..., Result]
FACTS = ''.join(f'(p x{i})' for i in range(60)) + '(zz q q)'
JOIN = '(p ?a)(p ?b)(p ?c)(p ?d)(p ?e)(zz ?a ?e)'
EITHER = ' '.join(f'(or (p ?a{i}) (zz ?a{i} ?a{i}))' for i in range(60))
# Each is true for no binding, but that takes 60^5 or 2^60 attempts to see.
ENDLESS = {
    'operator': f'(:operator (!do) ({JOIN}) () ())(:method (t) () ((!do)))',
    'method': f'(:method (t) ({JOIN}) ())',
    'later branch': f'(:method (t) ({JOIN}) () () ())',
    'negation': f'(:method (t) ((not ({JOIN}))) ())',
    'axiom': f'(:- (ax ?a) ({JOIN}))(:method (t) ((ax ?x)) ())',
    'disjunction': f'(:method (t) ({EITHER} (zz x0 x0)) ())',
    'pattern': '(:method (t) ((p ?a)(p ?b)(p ?c)(p ?d)(p (?a ?b ?c ?d))) ())',
    'advice': f'(:operator (!do) ({JOIN}) () ())(:method (t) () (:unordered (!do) (!do)))',
}

#: [s] of this process's own time, which other work on the machine does not stretch.
AT_ONCE = 0.7


@pytest.mark.parametrize('kind', ENDLESS)
def test_the_time_budget_ends_an_enumeration_without_solutions(plan: Plan, kind: str) -> None:
    problem = f'(defproblem x d ({FACTS}) ((t)))'
    before = time.process_time()
    result = plan(f'(defdomain d ({ENDLESS[kind]}))', problem, None, Options(time_budget=0.2))
    assert result.outcome == Outcome.LIMIT
    assert 'the time budget of 0.2 s is spent' in result.explanation
    assert time.process_time() - before < AT_ONCE


@pytest.mark.parametrize('kind', ENDLESS)
def test_an_enumeration_without_solutions_is_cancelled_at_once(
    no_motion_planner: Oracle, kind: str
) -> None:
    began, before = time.monotonic(), time.process_time()
    planner = Planner(no_motion_planner, Options(), lambda: time.monotonic() - began > 0.2)
    domain = MissionText(text=f'(defdomain d ({ENDLESS[kind]}))')
    result = planner.plan(domain, MissionText(text=f'(defproblem x d ({FACTS}) ((t)))'))
    assert result.outcome == Outcome.CANCELLED
    assert time.process_time() - before < AT_ONCE


def test_a_proof_that_takes_too_long_is_given_up_and_the_plan_found(plan: Plan) -> None:
    """The first branch decides; only the relaxation looks at the second."""
    domain = f'(defdomain d ((:operator (!do) () () ())(:method (t) () ((!do)) ({JOIN}) ())))'
    result = plan(domain, f'(defproblem x d ({FACTS}) ((t)))', None, Options(time_budget=10.0))
    assert result.outcome == Outcome.SOLVED
    assert [step.action for step in result.steps] == [('!do',)]


REACH = '(:- (reach ?a ?b) ((edge ?a ?b)) ((edge ?a ?c) (reach ?c ?b)))'
CYCLE = '(edge a b)(edge b a)'


@pytest.mark.parametrize(
    ('definitions', 'facts', 'task', 'plan_expected'),
    [
        (f'{REACH}(:operator (!go ?x) ((reach ?x ?y)) () ())', CYCLE, '(!go a)', [('!go', 'a')]),
        (
            f'{REACH}(:operator (!go ?x) ((reach ?x ?y)) () ())',
            CYCLE,
            '(:unordered (!go a) (!go b))',
            [('!go', 'a'), ('!go', 'b')],
        ),
        (
            '(:- (ax ?x) ((p ?x)) ((q)))(:operator (!go) ((ax ?y)) () ())',
            '(p a)(q)',
            '(!go)',
            [('!go',)],
        ),
        (
            '(:operator (!go) () () ())(:method (t ?x) () ((!go)) () ((t ((((((((((?x)))))))))))))',
            '',
            '(t a)',
            [('!go',)],
        ),
    ],
)
def test_trouble_in_the_relaxation_is_no_trouble_of_the_mission(
    plan: Plan,
    definitions: str,
    facts: str,
    task: str,
    plan_expected: list[tuple[str, ...]],
) -> None:
    result = plan(f'(defdomain d ({definitions}))', f'(defproblem x d ({facts}) ({task}))')
    assert result.outcome == Outcome.SOLVED, result.explanation
    assert [step.action for step in result.steps] == plan_expected


def test_as_many_facts_as_a_text_may_hold_are_loaded_at_once(plan: Plan) -> None:
    facts = ''.join(f'(p {i})' for i in range(100_000))
    domain = '(defdomain d ((:operator (!do ?x) ((p ?x)(p ?y)) () ())))'
    result = plan(domain, f'(defproblem x d ({facts}) ((!do 99999)))')
    assert result.outcome == Outcome.SOLVED
    assert result.statistics.planning_time < 10.0


def test_as_many_methods_as_a_text_may_hold_are_checked_at_once(plan: Plan) -> None:
    methods = ''.join(f'(:method (t{i}) ((p)) ((t{i + 1})) () ())' for i in range(5000))
    domain = f'(defdomain d ({methods} (:method (t5000) () ())))'
    result = plan(domain, '(defproblem x d () ((t0)))')
    assert result.outcome == Outcome.SOLVED
    assert result.statistics.planning_time < 10.0
