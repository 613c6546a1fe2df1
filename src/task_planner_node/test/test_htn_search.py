"""The search: the paper's mission, backtracking over geometry, proofs, limits and progress."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest

from task_planner_node.mission import MissionText
from task_planner_node.oracle import Answer, Oracle, Query, Scope, Status, Token
from task_planner_node.outcomes import Options, Outcome, Progress, Result
from task_planner_node.planner import Planner

Plan = Callable[..., Result]
PLACES = {'location0': (20.0, 20.0)}
World = Callable[..., Any]
Mission = tuple[str, str]


def photos(result: Result) -> list[str]:
    return [step.action[2] for step in result.steps if step.action[0] == '!take_photo']


def test_the_papers_mission_takes_every_photo_nearest_first(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    result = plan(*rover_mission, rover_motion_planner(), Options(guidance='nearest_first'))
    assert result.outcome == Outcome.SOLVED
    assert not result.diagnostics
    assert result.steps[0].action == ('!init_rover_attitude', 'rover0', 'location0')
    assert photos(result) == [f'location{i}' for i in (1, 8, 3, 6, 5, 4, 2, 7)]
    statistics = result.statistics
    assert (statistics.requests, statistics.answers, statistics.found) == (9, 9, 9)
    assert (statistics.advices, statistics.backtracks) == (7, 0)
    for before, after in itertools.pairwise(result.steps):
        assert before.answer is not None
        assert after.start == before.answer.end
    assert result.steps[1].preconditions == (
        '((agent rover0)(object location1) (distance(rover0, location1) >= 50) '
        '(distance(rover0, location1) <= 100) (rel_angle(rover0,location1) = cos-and-sin(pi/2)))'
    )


def test_all_open_goals_are_advised_together(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner()
    plan(*rover_mission, world, Options(guidance='nearest_first'))
    assert [len(places) for places in world.advised] == [8, 7, 6, 5, 4, 3, 2]


def test_without_advice_the_order_is_that_of_the_text(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner()
    result = plan(*rover_mission, world, Options(use_advice=False))
    assert photos(result) == [f'location{i}' for i in range(1, 9)]
    assert not world.advised


@pytest.mark.parametrize('use_advice', [True, False])
@pytest.mark.parametrize('place', [f'location{i}' for i in range(1, 9)])
def test_a_goal_that_is_walled_in_is_proven_in_few_requests(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World, place: str, use_advice: bool
) -> None:
    world = rover_motion_planner(walled=frozenset({place}))
    result = plan(*rover_mission, world, Options(use_advice=use_advice))
    assert result.outcome == Outcome.NO_PLAN
    assert result.statistics.requests < 10
    assert f'(!take_photo rover0 {place} cam_0): {place} is walled in' in result.explanation
    (diagnostic,) = result.diagnostics
    line = rover_mission[1].split('\n')[diagnostic.line - 1]
    assert line[diagnostic.column - 1 :].startswith(place)


def test_two_walled_in_goals_are_both_named(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner(walled=frozenset({'location2', 'location7'}))
    result = plan(*rover_mission, world)
    assert result.outcome == Outcome.NO_PLAN
    assert 'location2 is walled in' in result.explanation
    assert 'location7 is walled in' in result.explanation


def test_what_is_not_found_is_no_proof(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner(unknown=frozenset({'location7'}))
    domain, problem = rover_mission
    for place in (3, 4, 5, 6, 8):
        problem = problem.replace(f'(has_photo_of rover0 location{place})', '')
    result = plan(domain, problem, world)
    assert result.outcome == Outcome.LIMIT
    assert 'nothing is proven' in result.explanation
    assert 'no path to location7' in result.explanation


def destination(token: Token) -> object:
    assert isinstance(token, tuple)
    return token[1]


class OnlyFrom:
    """A place can only be reached from the second destination of another one."""

    def __init__(self, base: Oracle) -> None:
        self.check = base.check
        self.advise = base.advise
        self._base = base

    def satisfy(self, query: Query) -> Answer:
        answer = self._base.satisfy(query)
        if 'location7' in query.preconditions and destination(query.start) == 0:
            return Answer(Status.UNKNOWN, 202, message='no path')
        return answer


def test_another_destination_of_the_step_before_is_tried(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner(destinations=2)
    result = plan(*rover_mission, OnlyFrom(world))
    assert result.outcome == Outcome.SOLVED
    assert sorted(photos(result)) == [f'location{i}' for i in range(1, 9)]
    assert result.statistics.geometric_backtracks >= 1
    last = result.steps[1 + photos(result).index('location7')]
    assert destination(last.start) == 1
    result = plan(*rover_mission, OnlyFrom(world), Options(max_alternatives=1, time_budget=0.3))
    assert result.outcome == Outcome.LIMIT


@pytest.mark.parametrize(
    ('goals', 'facts'),
    [('', ''), ('(has_photo_of rover0 location1)', '(has_photo_of rover0 location1)')],
)
def test_nothing_to_do_is_an_empty_plan(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World, goals: str, facts: str
) -> None:
    problem = (
        f'(defproblem p rover ((rover rover0)(has_camera rover0 cam_0) {facts}) '
        f'((achieve-goals (list {goals}))))'
    )
    result = plan(rover_mission[0], problem, rover_motion_planner())
    assert result.outcome == Outcome.SOLVED
    assert result.steps == ()


def test_optimising_gives_a_shorter_plan_and_never_a_longer_one(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    def length(result: Result) -> float:
        return sum(step.answer.length for step in result.steps if step.answer is not None)

    domain, problem = rover_mission
    for place in (2, 5, 7, 8):
        problem = problem.replace(f'(has_photo_of rover0 location{place})', '')
    textual = Options(use_advice=False)
    first = plan(domain, problem, rover_motion_planner())
    best = plan(domain, problem, rover_motion_planner(), Options(optimise=True))
    goals = [f'(has_photo_of rover0 location{place})' for place in (1, 3, 4, 6)]
    head = problem[: problem.index('(list') + len('(list')]
    lengths = [
        length(plan(domain, head + ' '.join(order) + '))))', rover_motion_planner(), textual))
        for order in itertools.permutations(goals)
    ]
    assert length(best) <= length(first)
    assert length(best) == pytest.approx(min(lengths))


def test_the_same_mission_gives_the_same_result(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    results = []
    for _ in range(2):
        world = rover_motion_planner(destinations=2)
        result = plan(*rover_mission, OnlyFrom(world))
        statistics = replace(
            result.statistics, planning_time=0.0, request_time=0.0, transport_time=0.0
        )
        results.append((result.steps, statistics, world.queries, world.advised))
    assert results[0] == results[1]


COUNT = """
(defdomain count (
(:operator (!step ?x) ((next ?x ?y)) () ((seen ?x)))
(:method (walk ?x) ((next ?x ?y)) ((!step ?x) (walk ?y)) () ()))
)
"""


def test_a_plan_of_twenty_thousand_steps_is_found(plan: Plan) -> None:
    facts = ''.join(f'(next {i} {i + 1})' for i in range(20_000))
    result = plan(COUNT, f'(defproblem p count ({facts}) ((walk 0)))')
    assert result.outcome == Outcome.SOLVED
    assert len(result.steps) == 20_000


@pytest.mark.parametrize(
    ('method', 'message'),
    [
        ('(:method (t ?x) () ((t ?x)))', '(t a): it decomposes into itself for ever'),
        ('(:method (t ?x) () ((!a ?x) (t ?x)) stop () ())', '(t a): it comes up again'),
        ('(:method (t ?x) () ((!a ?x) (t ?x) (!a ?x)))', 'more than 1000 decompositions'),
        ('(:method (t ?x) () ((t (?x))) stop () ())', 'nests deeper than 200'),
        ('(:- (p ?x) ((p ?x)))(:method (t ?x) ((p ?x)) ())', 'nothing can make (p a) true'),
        (
            '(:- (p ?x ?n) ((p ?x (call + ?n 1))))(:method (t ?x) ((p ?x 0)) ())',
            'the axioms recurse too deeply',
        ),
    ],
)
def test_what_never_ends_is_ended(plan: Plan, method: str, message: str) -> None:
    domain = f'(defdomain d ((:operator (!a ?x) () () ()) {method}))'
    result = plan(domain, '(defproblem x d () ((t a)))', None, Options(max_depth=1000))
    assert result.outcome in (Outcome.LIMIT, Outcome.NO_PLAN)
    assert message in result.explanation


def run(
    mission: Mission, world: Oracle, options: Options, stop_after: int
) -> tuple[Result, list[Progress]]:
    heard: list[Progress] = []
    asked = itertools.count()
    planner = Planner(world, options, lambda: next(asked) >= stop_after, heard.append)
    domain, problem = (MissionText('', text) for text in mission)
    return planner.plan(domain, problem), heard


def test_a_cancelled_mission_stops_at_the_next_request(
    rover_mission: Mission, rover_motion_planner: World
) -> None:
    world = rover_motion_planner()
    result, heard = run(rover_mission, world, Options(), 3)
    assert result.outcome == Outcome.CANCELLED
    assert result.steps == ()
    assert len(world.queries) + len(world.advised) <= 3
    assert [progress.phase for progress in heard[:3]] == ['loading', 'checking', 'searching']


def test_progress_counts_the_goals(rover_mission: Mission, rover_motion_planner: World) -> None:
    result, heard = run(rover_mission, rover_motion_planner(), Options(), 10**9)
    assert result.outcome == Outcome.SOLVED
    assert (heard[-1].phase, heard[-1].goals_reached, heard[-1].goals_total) == ('writing', 8, 8)
    assert heard[-1].depth == 9
    assert heard[-1].requests == 9
    total = sum(step.answer.length for step in result.steps if step.answer is not None)
    assert heard[-1].current_length == pytest.approx(total)
    assert heard[-1].best_length == pytest.approx(total)


def test_the_time_budget_ends_a_search(rover_mission: Mission, rover_motion_planner: World) -> None:
    world = rover_motion_planner(unknown=frozenset({'location7'}), destinations=3)
    result, _ = run(rover_mission, world, Options(time_budget=0.3), 10**9)
    assert result.outcome == Outcome.LIMIT
    assert 'the time budget of 0.3 s is spent' in result.explanation
    assert result.statistics.planning_time < 1.0


def test_a_proof_reckons_with_deletions_and_with_facts_still_to_come(plan: Plan) -> None:
    domain = """(defdomain d (
        (:operator (!clear) () ((p)) ())
        (:operator (!fill) () () ((q)))
        (:operator (!last) ((not (p)) (q)) () ())
        (:method (work) ((p)) ((never)) ((not (p))) ((!last)))
        (:method (never) ((r)) ())))"""
    result = plan(domain, '(defproblem x d ((p)) ((!clear) (!fill) (work)))')
    assert result.outcome == Outcome.SOLVED
    assert len(result.steps) == 3
    result = plan(domain, '(defproblem x d ((p)) ((!clear) (work)))')
    assert result.outcome == Outcome.NO_PLAN
    assert '(!last): nothing can make (q) true' in result.explanation


class Reassigning:
    """location1 is walled off from location0, where the robot is put first, but not from location2."""

    def __init__(self, base: Oracle) -> None:
        self.check = base.check
        self.advise = base.advise
        self._base = base

    def satisfy(self, query: Query) -> Answer:
        if 'distance' in query.preconditions and query.start == (PLACES['location0'], 0):
            return Answer(Status.IMPOSSIBLE, 103, Scope.CONNECTED_STARTS, 'walled off')
        return self._base.satisfy(query)


def test_a_proof_ends_where_an_attitude_is_assigned_anew(
    plan: Plan, rover_mission: Mission, rover_motion_planner: World
) -> None:
    domain = rover_mission[0].replace('(not(initialized ?r))', '')
    facts = '(rover r)(available r)(has_camera r c)(location location0)(location location1)(location location2)'
    tasks = '(!init_rover_attitude r location0) (:unordered (!!need_photo location1) %s)'
    photo = '(!take_photo r location1 c)'
    again = f'(!init_rover_attitude r location2) {photo}'
    oracle = Reassigning(rover_motion_planner())
    result = plan(domain, f'(defproblem p rover ({facts}) ({tasks % photo}))', oracle)
    assert result.outcome == Outcome.NO_PLAN
    result = plan(domain, f'(defproblem p rover ({facts}) ({tasks % again}))', oracle)
    assert result.outcome == Outcome.SOLVED
    assert [step.action[0] for step in result.steps][-2:] == ['!init_rover_attitude', '!take_photo']


AXIOMS = """(defdomain d (
(:- (same ?x ?x) ())
(:- (reach ?x ?y) ((edge ?x ?y)) ((edge ?x ?z) (reach ?z ?y)))
(:operator (!go ?x ?y) ((reach ?x ?y) (not (same ?x ?y))) () ())
(:operator (!mark ?x) ((or (red ?x) (green ?x))) () ())
(:method (tour ?x) ((edge ?x ?y)) ((!go ?x ?y)))
(:method (paint) ((or (red ?x) (green ?x)) (not (edge ?x ?x))) ((!mark ?x)))
))"""


@pytest.mark.parametrize(
    ('facts', 'task', 'outcome', 'plans'),
    [
        ('(edge a b)(edge b c)', '(!go a b)', Outcome.SOLVED, [('!go', 'a', 'b')]),
        ('(edge b c)(edge a a)', '(!go a a)', Outcome.NO_PLAN, []),
        ('(edge a a)(edge a b)', '(tour a)', Outcome.SOLVED, [('!go', 'a', 'b')]),
        ('(green b)(red a)(edge a a)', '(paint)', Outcome.SOLVED, [('!mark', 'b')]),
    ],
)
def test_axioms_negation_and_disjunction(
    plan: Plan, facts: str, task: str, outcome: Outcome, plans: list[tuple[str, ...]]
) -> None:
    result = plan(AXIOMS, f'(defproblem p d ({facts}) ({task}))')
    assert result.outcome == outcome, result.explanation
    assert [step.action for step in result.steps] == plans


def test_what_failed_with_other_facts_is_tried_again(plan: Plan) -> None:
    domain = """(defdomain d (
        (:operator (!p) () () ((p)))
        (:operator (!q) () () ((q)))
        (:operator (!b) ((q)) () ())
        (:operator (!c) ((q)) () ())
        (:method (choose) () ((!p)))
        (:method (choose) () ((!q)))))"""
    result = plan(domain, '(defproblem x d () (:unordered (choose) (!b) (!c)))')
    assert result.outcome == Outcome.SOLVED
    assert result.steps[0].action == ('!q',)
