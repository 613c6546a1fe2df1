"""The relaxation: what it looks at grows with the mission no faster than the mission itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Query,
    Status,
    TextCheck,
)
from task_planner_node.outcomes import Outcome, Result
from task_planner_node.search.relaxation import _Relaxation

DOMAIN = """(defdomain chain (
(:operator (!visit ?x) ((place ?x)) () ((visited ?x)))
(:method (visit nil) () ())
(:method (visit (?x . ?others)) () ((!visit ?x)(visit ?others)))))"""


@pytest.mark.parametrize('count', [10, 80])
def test_a_task_below_many_others_is_looked_at_as_often_as_one_on_top(
    plan: Callable[..., Result], monkeypatch: pytest.MonkeyPatch, count: int
) -> None:
    looks = 0
    apply = _Relaxation._apply

    def counted(self: _Relaxation, *arguments: Any) -> None:
        nonlocal looks
        looks += 1
        apply(self, *arguments)

    monkeypatch.setattr(_Relaxation, '_apply', counted)
    places = [f'p{number}' for number in range(count)]
    facts = ' '.join(f'(place {place})' for place in places)
    problem = f'(defproblem walk chain ({facts}) ((visit ({" ".join(places)} nowhere))))'
    result = plan(DOMAIN, problem)
    assert result.outcome == Outcome.NO_PLAN
    assert count <= looks <= 3 * count


class Everywhere:
    """Every place is near, and the order does not matter."""

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def satisfy(self, _query: Query) -> Answer:
        return Answer(Status.FOUND)

    def advise(self, query: AdviceQuery) -> Advice:
        return Advice((CandidateAdvice(),) * len(query.preconditions), ())


NEED = '(:operator (!need) {condition} () ((had)))'
LATE = {
    'a literal': NEED.format(condition='((made))'),
    'an axiom': NEED.format(condition='((usable))')
    + '(:- (usable) ((whole)))(:- (whole) ((made)))',
    'a literal in a list': NEED.format(condition='((assign ?f (list made)) ?f)'),
    'all solutions': NEED.format(condition='((setof ?x (made-of ?x) ?all))'),
    'a quantifier': NEED.format(condition='((exists (?x) ((made-of ?x)) ((made))))'),
    'an alternative': NEED.format(condition='((or (lost) (made)))'),
    'a conclusion': NEED.format(condition='((imply ((place a)) ((made))))'),
    'an effect': NEED.format(condition='((had-before))')
    + '(:operator (!other) () () ((when ((made)) ((had-before)))))',
    'a method': '(:method (need) ((made)) ())',
}


@pytest.mark.parametrize('turned', [False, True])
@pytest.mark.parametrize('kind', LATE)
def test_what_a_later_task_makes_true_is_seen_by_whatever_reads_it(
    plan: Callable[..., Result], kind: str, turned: bool
) -> None:
    domain = f"""(defdomain late (
    (Operator (!drive ?x) ((place ?x)) ((near ?x)) ((driven ?x)))
    (:operator (!make) () () ((made)(made-of glass)))
    {LATE[kind]}))"""
    need = '(need)' if kind == 'a method' else '(!need)'
    tasks = [need, *(['(!other)'] if kind == 'an effect' else []), '(!make)', '(!drive a)']
    together = ' '.join(tasks[::-1] if turned else tasks)
    problem = f'(defproblem later late ((place a)) ((:unordered {together})))'
    result = plan(domain, problem, Everywhere())
    assert result.outcome == Outcome.SOLVED, result.explanation
