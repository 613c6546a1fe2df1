"""Going on in the middle of a plan: what still holds is kept, the rest is done anew."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.mission import MissionText
from task_planner_node.oracle import Oracle, Token
from task_planner_node.outcomes import Options, Outcome, Result
from task_planner_node.planner import Planner
from task_planner_node.search.repair import Interrupted

Planned = Callable[..., Result]
PLACES = 'abcd'
ROADS = {(x, y) for x, y in zip('abcda', 'bcdab', strict=False)}
DELIVER = """(defdomain d (
(:operator (!go ?r ?x ?y) ((at ?r ?x)(road ?x ?y)(not (blocked ?x ?y))) ((at ?r ?x)) ((at ?r ?y)))
(:operator (!pick ?r ?p) ((at ?r ?x)(lies ?p ?x)) ((lies ?p ?x)) ((has ?r ?p)))
(:operator (!drop ?r ?p) ((at ?r ?x)(has ?r ?p)) ((has ?r ?p)) ((lies ?p ?x)))
(:method (travel ?r ?y) ((at ?r ?y)) () () ((hop ?r ?y)))
(:method (hop ?r ?y) ((at ?r ?x)(road ?x ?z)(not (blocked ?x ?z))) ((!go ?r ?x ?z) (travel ?r ?y)))
(:method (deliver ?p ?y)
  there ((lies ?p ?y)) ()
  loaded ((has ?r ?p)) ((travel ?r ?y) (!drop ?r ?p))
  lying ((lies ?p ?x)(at ?r ?any)) ((travel ?r ?x) (!pick ?r ?p) (travel ?r ?y) (!drop ?r ?p)))))"""
TASKS = '((deliver p1 c) (deliver p2 a))'


def facts_text(facts: list[Any]) -> str:
    return ' '.join(f'({" ".join(map(str, fact))})' for fact in facts)


def problem(facts: str) -> str:
    roads = ' '.join(f'(road {x} {y})(road {y} {x})' for x, y in sorted(ROADS))
    return f'(defproblem p d ({roads} {facts}) {TASKS})'


def go_on(before: Result, executed: int, facts: str, oracle: Oracle, start: Token = ()) -> Result:
    planner = Planner(oracle, Options(time_budget=60.0))
    texts = MissionText(text=DELIVER), MissionText(text=f'(defproblem p d ({facts}) {TASKS})')
    return planner.plan(*texts, start, Interrupted(before.plans[0], executed))


def simulate(actions: list[tuple[str, ...]], facts: set[tuple[str, ...]]) -> set[tuple[str, ...]]:
    """The facts after ``actions``, by the meaning of the operators as a person reads it."""
    facts = set(facts)
    for name, robot, *rest in actions:
        (here,) = (
            x for word, *args in facts if word == 'at' and args[0] == robot for x in args[1:]
        )
        if name == '!go':
            assert rest[0] == here
            assert ('road', *rest) in facts
            assert ('blocked', *rest) not in facts
            facts = (facts - {('at', robot, here)}) | {('at', robot, rest[1])}
        elif name == '!pick':
            assert ('lies', rest[0], here) in facts
            facts = (facts - {('lies', rest[0], here)}) | {('has', robot, rest[0])}
        else:
            assert ('has', robot, rest[0]) in facts
            facts = (facts - {('has', robot, rest[0])}) | {('lies', rest[0], here)}
    return facts


@settings(max_examples=60, deadline=None)
@given(
    st.sampled_from(PLACES),
    st.sampled_from(PLACES),
    st.sampled_from(PLACES),
    st.integers(0, 20),
    st.sampled_from([None, *sorted(ROADS)]),
    st.sampled_from([None, *PLACES]),
)
def test_what_is_left_is_done_from_wherever_things_are(
    plan: Planned,
    no_motion_planner: Oracle,
    robot: str,
    first: str,
    second: str,
    executed: int,
    blocked: tuple[str, str] | None,
    moved: str | None,
) -> None:
    before = plan(DELIVER, problem(f'(at r {robot})(lies p1 {first})(lies p2 {second})'))
    assert before.outcome == Outcome.SOLVED
    executed = min(executed, len(before.steps))
    initial = {*before.plans[0].facts_after(0)}
    actions = [step.action for step in before.steps]
    facts = before.plans[0].facts_after(executed)
    assert set(facts) == simulate(actions[:executed], initial)
    undisturbed = go_on(before, executed, facts_text(facts), no_motion_planner)
    assert [step.action for step in undisturbed.steps] == actions[executed:]
    if blocked is not None:
        facts.append(('blocked', *blocked))
    if moved is not None:
        facts = [('at', 'r', moved) if fact[0] == 'at' else fact for fact in facts]
    after = go_on(before, executed, facts_text(facts), no_motion_planner)
    assert after.outcome == Outcome.SOLVED
    end = simulate([step.action for step in after.steps], set(facts))
    if executed < len(actions):
        assert ('lies', 'p2', 'a') in end
        assert ('lies', 'p1', 'c') in end


def test_only_the_task_that_broke_is_done_anew(plan: Planned, no_motion_planner: Oracle) -> None:
    before = plan(DELIVER, problem('(at r a)(lies p1 b)(lies p2 c)'))
    actions = [' '.join(step.action) for step in before.steps]
    assert actions[4:8] == ['!go r d c', '!drop r p1', '!pick r p2', '!go r c b']
    facts = facts_text([*before.plans[0].facts_after(4), ('blocked', 'c', 'b')])
    after = go_on(before, 4, facts, no_motion_planner)
    kept = ['!go r d c', '!drop r p1', '!pick r p2']
    assert [' '.join(s.action) for s in after.steps] == [
        *kept,
        '!go r c d',
        '!go r d a',
        '!drop r p2',
    ]


def test_the_papers_mission_goes_on_from_where_the_robot_stands(
    plan: Planned, rover_mission: tuple[str, str], rover_motion_planner: Callable[..., Any]
) -> None:
    domain, text = rover_mission
    before = plan(domain, text, rover_motion_planner())
    found = before.plans[0]
    # What a person can see: nobody observes the planner's own notes of what it still needs.
    seen = [fact for fact in found.facts_after(3) if fact[0] != 'need_photo_of']
    assert len(seen) < len(found.facts_after(3))
    world = rover_motion_planner()
    planner = Planner(world, Options())
    now = MissionText(text=f'(defproblem p rover ({facts_text(seen)}) ())')
    after = planner.plan(
        MissionText(text=domain), now, before.steps[3].start, Interrupted(found, 3)
    )
    assert [step.action for step in after.steps] == [step.action for step in before.steps[3:]]
    assert len(world.queries) == len(before.steps) - 3
    assert after.steps[0].start == before.steps[3].start


@pytest.mark.parametrize('executed', [0, 10])
def test_the_ends_of_a_plan(plan: Planned, no_motion_planner: Oracle, executed: int) -> None:
    before = plan(DELIVER, problem('(at r a)(lies p1 b)(lies p2 c)'))
    facts = facts_text(before.plans[0].facts_after(executed))
    after = go_on(before, executed, facts, no_motion_planner)
    assert after.outcome == Outcome.SOLVED
    assert [s.action for s in after.steps] == [s.action for s in before.steps[executed:]]
