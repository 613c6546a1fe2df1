"""Matching facts one after the other: the same solutions, in the same order, as through an index."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.mission import MissionText
from task_planner_node.oracle import Oracle
from task_planner_node.outcomes import Options, Outcome, Result
from task_planner_node.planner import Planner
from task_planner_node.search import linear
from task_planner_node.search.literals import Look, enumerating
from task_planner_node.search.state import IndexPlan, State, fresh
from task_planner_node.search.terms import ListPattern

TOYS = sorted((Path(__file__).parents[1] / 'domains' / 'toys').glob('*.lisp'))
CASES = [
    (toy, name)
    for toy in TOYS
    for name in re.findall(r'^;; plan (\S+):', toy.read_text(), re.MULTILINE)
]
VALUES = ('a', 'b', ('a', 'b'), ('b',))
FACTS = [('p', *pair) for pair in itertools.product(VALUES, repeat=2)]
#: Two slots for variables and two for constants.
TEMPLATE = [None, None, 'a', 'b']
TERMS = (0, 1, 2, 3, ListPattern((2, 1), None), ListPattern((0, 3), None), ListPattern((1,), 0))


@settings(max_examples=300)
@given(
    st.lists(st.sampled_from(FACTS), unique=True),
    st.lists(st.tuples(st.booleans(), st.sampled_from(FACTS)), max_size=30),
    st.tuples(st.sampled_from(TERMS), st.sampled_from(TERMS)),
    st.dictionaries(st.sampled_from([0, 1]), st.sampled_from(VALUES)),
    st.booleans(),
)
def test_a_literal_has_the_solutions_of_an_index_in_its_order(
    facts: list[tuple[Any, ...]],
    changes: list[tuple[bool, tuple[Any, ...]]],
    terms: tuple[Any, Any],
    values: dict[int, Any],
    sure: bool,
) -> None:
    plan = IndexPlan()
    bound = {2, 3, *(values if sure else ())}
    look = Look('p', terms, bound, bound | set(values))
    ways = enumerating(look, plan), linear.enumerating(look, plan)
    state = State(plan, facts)
    for adds, fact in changes:
        if adds:
            state.add(fresh(fact))
        else:
            state.remove(fact)
    found = []
    for begin in ways:
        frame: list[Any] = [values.get(0), values.get(1), *TEMPLATE[2:]]
        solutions = begin(state, frame)
        if solutions is True:
            found.append([tuple(frame)])
        else:
            found.append([tuple(frame) for _ in solutions or ()])
    assert found[0] == found[1]
    absent, absent_linear = look.absence(plan), linear.absence(look, plan)
    assert (absent is None) == (absent_linear is None)
    if absent is not None and absent_linear is not None:
        frame = [values.get(0), values.get(1), *TEMPLATE[2:]]
        assert absent(state, frame) == absent_linear(state, frame) == (not found[0])


@pytest.mark.parametrize(('toy', 'name'), CASES, ids=[f'{t.stem}-{n}' for t, n in CASES])
def test_a_toy_has_the_same_plans(no_motion_planner: Oracle, toy: Path, name: str) -> None:
    def solve(*, linear_matching: bool) -> Result:
        options = Options(linear_matching=linear_matching, plans=3)
        planner = Planner(no_motion_planner, options)
        return planner.plan(MissionText(str(toy)), MissionText(f'{toy}#{name}'))

    indexed, compared = solve(linear_matching=False), solve(linear_matching=True)
    assert compared.outcome == indexed.outcome
    assert [plan.actions for plan in compared.plans] == [plan.actions for plan in indexed.plans]


LAST = """(defdomain d (
 (:operator (!go ?a ?b) ((road ?a ?b)) () ((at ?b)))
 (:method (leave ?a) ((road ?a ?b) (not (shut ?a ?b))) ((!go ?a ?b)))))"""


@pytest.mark.parametrize('count', [100, 1000])
def test_work_grows_with_the_facts_only_where_they_are_compared(
    plan: Callable[..., Result], count: int
) -> None:
    roads = ' '.join(f'(road p{i} q{i}) (shut p{i} q{i + 1})' for i in range(count))
    problem = f'(defproblem p d ({roads}) ((leave p{count - 1})))'
    compared = plan(LAST, problem, None, Options(linear_matching=True))
    indexed = plan(LAST, problem)
    assert compared.outcome == indexed.outcome == Outcome.SOLVED
    assert compared.plans[0].actions == indexed.plans[0].actions
    assert indexed.statistics.work < 20
    assert compared.statistics.work >= 3 * count


def test_the_first_fact_that_fits_ends_the_comparing(plan: Callable[..., Result]) -> None:
    roads = ' '.join(f'(road p q{i})' for i in range(1000))
    problem = f'(defproblem p d ({roads}) ((leave p)))'
    compared = plan(LAST, problem, None, Options(linear_matching=True))
    assert compared.plans[0].actions == (('!go', 'p', 'q0'),)
    assert compared.statistics.work < 20
