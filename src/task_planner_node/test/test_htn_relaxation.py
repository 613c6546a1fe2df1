"""The relaxation: what it looks at grows no faster than the mission itself, and nothing that matters is missed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

import pytest

from task_planner_node.language.domain import read_domain
from task_planner_node.language.source import Source
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
from task_planner_node.search.network import Task
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.reads import Reads
from task_planner_node.search.relaxation import _Relaxation

DOMAIN = """(defdomain chain (
(:operator (!visit ?x) ((place ?x)) () ((visited ?x)))
(:method (visit nil) () ())
(:method (visit (?x . ?others)) () ((!visit ?x)(visit ?others)))))"""


@pytest.fixture
def looks(monkeypatch: pytest.MonkeyPatch) -> Counter[Task]:
    """How often each task is applied in relaxations."""
    found: Counter[Task] = Counter()
    apply = _Relaxation._apply

    def counted(self: _Relaxation, operator: CompiledOperator, task: Task) -> None:
        found[task] += 1
        apply(self, operator, task)

    monkeypatch.setattr(_Relaxation, '_apply', counted)
    return found


@pytest.mark.parametrize('count', [10, 80])
def test_a_task_below_many_others_is_looked_at_as_often_as_one_on_top(
    plan: Callable[..., Result], looks: Counter[Task], count: int
) -> None:
    places = [f'p{number}' for number in range(count)]
    facts = ' '.join(f'(place {place})' for place in places)
    problem = f'(defproblem walk chain ({facts}) ((visit ({" ".join(places)} nowhere))))'
    result = plan(DOMAIN, problem)
    assert result.outcome == Outcome.NO_PLAN
    assert looks == Counter([('!visit', place) for place in [*places, 'nowhere']])


def test_only_what_reads_a_new_fact_is_looked_at_again(
    plan: Callable[..., Result], looks: Counter[Task]
) -> None:
    domain = f"""(defdomain late (
    (:operator (!make) () () ((made)))
    (:operator (!use) ((made)) () ((used)))
    (:operator (!watch) ((not (made))) () ((watched)))
    {DRIVE}))"""
    tasks = '(!drive a) (!make) (!watch) (!use)'
    result = plan(domain, f'(defproblem p late ((place a)) ((:unordered {tasks})))', Everywhere())
    assert result.outcome == Outcome.SOLVED
    assert looks == {('!drive', 'a'): 1, ('!make',): 1, ('!watch',): 1, ('!use',): 2}


class Everywhere:
    """Every place is near, and the order does not matter."""

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def satisfy(self, _query: Query) -> Answer:
        return Answer(Status.FOUND)

    def advise(self, query: AdviceQuery) -> Advice:
        return Advice((CandidateAdvice(),) * len(query.preconditions), ())


DRIVE = '(Operator (!drive ?x) ((place ?x)) ((near ?x)) ((driven ?x)))'
NEED = '(:operator (!need) {condition} () ((had)))'
AXIOMS = '(:- (usable) ((whole)))(:- (whole) ((made)))'
LATE = {
    'a literal': NEED.format(condition='((made))'),
    'an axiom': NEED.format(condition='((usable))') + AXIOMS,
    'a literal in a list': NEED.format(condition='((assign ?f (list made)) ?f)'),
    'a quantifier': NEED.format(condition='((exists (?x) ((place ?x)) ((made))))'),
    'what a quantifier is about': NEED.format(condition='((exists (?x) ((made)) ((place a))))'),
    'an alternative': NEED.format(condition='((or (lost) (made)))'),
    'an effect': NEED.format(condition='((had-before))')
    + '(:operator (!other) () () ((when ((made)) ((had-before)))))',
    'a method': '(:method (need) ((made)) ())',
}


# Of tasks in parallel the last one is looked at first: where that needs the fact, it has to be looked at again.
@pytest.mark.parametrize('turned', [False, True])
@pytest.mark.parametrize('kind', LATE)
def test_what_a_later_task_makes_true_is_seen_by_whatever_reads_it(
    plan: Callable[..., Result], kind: str, turned: bool
) -> None:
    domain = f'(defdomain late ((:operator (!make) () () ((made))) {DRIVE} {LATE[kind]}))'
    need = '(need)' if kind == 'a method' else '(!need)'
    tasks = [need, *(['(!other)'] if kind == 'an effect' else []), '(!make)', '(!drive a)']
    together = ' '.join(tasks[::-1] if turned else tasks)
    problem = f'(defproblem later late ((place a)) ((:unordered {together})))'
    result = plan(domain, problem, Everywhere())
    assert result.outcome == Outcome.SOLVED, result.explanation


@pytest.mark.parametrize(
    ('condition', 'names'),
    [
        ('((a ?x) (b))', {'a', 'b'}),
        ('((usable) (b))', {'usable', 'whole', 'made', 'b'}),
        ('((setof ?x (a ?x) ?all))', {'a'}),
        ('((imply ((a)) ((b))))', {'a', 'b'}),
        ('((:first (a) (b)))', {'a', 'b'}),
        ('((:sort-by ?x ((a ?x) (b))))', {'a', 'b'}),
        ('((enforce (a) "no a"))', {'a'}),
        ('((not (a)) (forall (?x) ((a ?x)) ((b))) (c))', {'c'}),
        ('((call > 1 0))', set()),
        ('((assign ?f (list a)) ?f)', None),
    ],
)
def test_what_a_condition_reads(condition: str, names: set[str] | None) -> None:
    text = f'(defdomain d ({NEED.format(condition=condition)} {AXIOMS}))'
    assert Reads(read_domain(Source('d.lisp', text))).of('!need') == names
