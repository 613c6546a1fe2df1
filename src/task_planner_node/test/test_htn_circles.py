"""What comes up again below itself: literals of recursive axioms, and tasks in a state that actions led back to."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.outcomes import Options, Outcome, Result

Planned = Callable[..., Result]
Edges = frozenset[tuple[int, int]]
NODES = range(6)

WAYS = {
    'in bodies': '(:- (reach ?a ?b) ((edge ?a ?b)) ((edge ?a ?c) (reach ?c ?b)))',
    'in axioms': '(:- (reach ?a ?b) ((edge ?a ?c) (reach ?c ?b))) (:- (reach ?a ?b) ((edge ?a ?b)))',
    'of two predicates': """
        (:- (reach ?a ?b) ((edge ?a ?b)) ((edge ?a ?c) (beyond ?c ?b)))
        (:- (beyond ?a ?b) ((edge ?a ?c) (reach ?c ?b)) ((edge ?a ?b)))""",
    'of itself first': """
        (:- (reach ?a ?b) ((node ?c) (reach ?a ?c) (reach ?c ?b)) ((edge ?a ?b)))""",
}


def reachable(edges: Edges, start: int) -> set[int]:
    found: set[int] = set()
    agenda = [start]
    while agenda:
        node = agenda.pop()
        for left, right in edges:
            if left == node and right not in found:
                found.add(right)
                agenda.append(right)
    return found


@pytest.mark.parametrize('axioms', WAYS.values(), ids=WAYS)
@settings(max_examples=20, deadline=None)
@given(st.frozensets(st.tuples(st.sampled_from(NODES), st.sampled_from(NODES)), max_size=12))
def test_axioms_hold_over_circles_of_facts(plan: Planned, axioms: str, edges: Edges) -> None:
    domain = f"""(defdomain d ({axioms}
        (:operator (!yes ?a ?b) () () ())
        (:method (ask ?a ?b) ((reach ?a ?b)) ((!yes ?a ?b)) () ())))"""
    facts = ' '.join(f'(edge {a} {b})' for a, b in sorted(edges))
    nodes = ' '.join(f'(node {node})' for node in NODES)
    asked = ' '.join(f'(ask {a} {b})' for a in NODES for b in NODES)
    problem = f'(defproblem p d ({facts} {nodes}) ({asked}))'
    result = plan(domain, problem, None, Options(time_budget=5.0))
    assert result.outcome == Outcome.SOLVED
    assert [step.action for step in result.steps] == [
        ('!yes', str(a), str(b)) for a in NODES for b in NODES if b in reachable(edges, a)
    ]


def test_actions_that_lead_back_to_the_same_task_in_the_same_state(plan: Planned) -> None:
    domain = """(defdomain d (
        (:operator (!off ?x) ((power ?x)) ((power ?x)) ())
        (:operator (!on ?x) ((not (power ?x))) () ((power ?x)))
        (:operator (!calibrate ?x) ((power ?x)) () ((ready ?x)))
        (:operator (!shoot ?x ?y) ((ready ?x)) () ((picture ?y)))
        (:method (prepare ?x) again ((power ?x)) ((!off ?x) (!on ?x) (prepare ?x) (!calibrate ?x)))
        (:method (prepare ?x) at-once ((power ?x)) ((!calibrate ?x)))
        (:method (take ?y) ((instrument ?x)) ((prepare ?x) (!shoot ?x ?y)))))"""
    facts = '(instrument i) (instrument j) (power i) (power j)'
    result = plan(domain, f'(defproblem p d ({facts}) ((take a) (take b)))')
    assert result.outcome == Outcome.SOLVED
    assert [step.action[0] for step in result.steps].count('!off') <= 2
    assert result.statistics.decompositions < 100


@pytest.mark.parametrize('wanted', range(5))
def test_circles_are_gone_through_as_often_as_a_plan_needs(plan: Planned, wanted: int) -> None:
    domain = """(defdomain d (
        (:operator (!lift) () () ((up)))
        (:operator (!lower) () ((up)) ())
        (:operator (!count ?n) ((at ?n) (next ?n ?m)) ((at ?n)) ((at ?m)))
        (:operator (!end) ((at ?n) (last ?n)) () ())
        (:method (more) () ((!lift) (!lower) (more) (tick)))
        (:method (more) () ())
        (:method (tick) ((at ?n)) ((!count ?n)))))"""
    numbers = ' '.join(f'(next {n} {n + 1})' for n in range(9))
    problem = f'(defproblem p d ((at 0) (last {wanted}) {numbers}) ((more) (!end)))'
    result = plan(domain, problem, None, Options(time_budget=600.0))
    assert result.outcome == Outcome.SOLVED
    assert [step.action[0] for step in result.steps].count('!count') == wanted
