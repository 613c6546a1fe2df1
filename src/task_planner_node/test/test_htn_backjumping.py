"""Of an action's destinations others are tried where that can help, and only there."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.oracle import Answer, Query, Status
from task_planner_node.outcomes import Options, Outcome, Result
from tests.support.sites import Point, Sites, label_of

Planned = Callable[..., Result]
NEAREST = Options(guidance='nearest_first', max_alternatives=4)
DOMAIN = """(defdomain d (
(Operator (!visit ?p) () ((near ?p)) ((visited ?p)))
(:operator (!open ?door) ((key ?door)) () ((open ?door)))
(:method (enter ?p ?door) () ((!visit ?p) (!open ?door)))
(:method (enter ?p ?door) () ((!visit ?p)))
(:method (round ?p ?q ?door) () ((!visit ?p) (!visit ?q) (!open ?door)))
(:method (round ?p ?q ?door) () ((!visit ?q)))
{methods}
))"""
FOUR = ((1.0, 0.0), (0.0, 2.0), (3.0, 0.0), (0.0, 4.0))
PLACES = ('a', 'b', 'c')
POINTS = {label: ((float(i), 1.0), (float(i), 2.0)) for i, label in enumerate(PLACES, 1)}
ENDS = [point for points in POINTS.values() for point in points]


@dataclass
class Lost(Sites):
    """From some points no way is found to some labels."""

    lost: frozenset[tuple[Point, str]] = frozenset()

    def satisfy(self, query: Query) -> Answer:
        if (query.start, label_of(query.preconditions)) in self.lost:
            self.queries.append(query)
            return Answer(Status.UNKNOWN, 202, message='no way')
        return super().satisfy(query)


def problem(tasks: str, facts: str = '') -> str:
    return f'(defproblem p d ({facts}) ({tasks}))'


def asked(world: Sites) -> list[tuple[str, int]]:
    return [(label_of(query.preconditions), query.alternative) for query in world.queries]


def test_what_the_facts_forbid_is_not_tried_again_from_elsewhere(plan: Planned) -> None:
    world = Sites({'a': FOUR})
    result = plan(DOMAIN.format(methods=''), problem('(enter a gate)'), world, NEAREST)
    assert result.outcome == Outcome.SOLVED
    assert asked(world) == [('a', 0)]
    assert result.statistics.geometric_backtracks == 0


def test_nor_are_the_destinations_of_actions_before(plan: Planned) -> None:
    world = Sites({'a': FOUR, 'b': FOUR})
    result = plan(DOMAIN.format(methods=''), problem('(round a b gate)'), world, NEAREST)
    assert result.outcome == Outcome.SOLVED
    assert asked(world) == [('a', 0), ('b', 0), ('b', 0)]


def test_where_the_next_motion_fails_the_other_destinations_are_tried(plan: Planned) -> None:
    world = Lost({'a': FOUR, 'b': ((9.0, 0.0),)}, lost=frozenset((p, 'b') for p in FOUR[:3]))
    tasks = problem('(!visit a) (!visit b)')
    result = plan(DOMAIN.format(methods=''), tasks, world, NEAREST)
    assert result.outcome == Outcome.SOLVED
    assert [number for label, number in asked(world) if label == 'a'] == [0, 1, 2, 3]


def is_solvable(steps: list[str], keys: set[str], lost: frozenset[tuple[Point, str]]) -> bool:
    """Whether some choice of destinations leads through all ``steps``, by trying all of them."""
    if any(step not in PLACES and step not in keys for step in steps):
        return False
    places = [step for step in steps if step in PLACES]
    return any(
        not any((end, label) in lost for end, label in zip(ends, places[1:], strict=False))
        for ends in itertools.product(*(POINTS[label] for label in places))
    )


@pytest.mark.parametrize('options', [NEAREST, Options(max_alternatives=4)])
@settings(max_examples=150, deadline=None)
@given(
    st.lists(
        st.lists(st.sampled_from([*PLACES, 'red', 'blue']), min_size=1, max_size=4),
        min_size=1,
        max_size=3,
    ),
    st.sets(st.sampled_from(['red', 'blue'])),
    st.frozensets(st.tuples(st.sampled_from(ENDS), st.sampled_from(PLACES))),
)
def test_a_plan_is_found_exactly_where_some_destinations_lead_to_one(
    plan: Planned,
    options: Options,
    branches: list[list[str]],
    keys: set[str],
    lost: frozenset[tuple[Point, str]],
) -> None:
    methods = ''
    for steps in branches:
        tasks = ' '.join(f'(!visit {s})' if s in PLACES else f'(!open {s})' for s in steps)
        methods += f'(:method (either) () ({tasks}))\n'
    facts = ' '.join(f'(key {key})' for key in sorted(keys))
    world = Lost(POINTS, lost=lost)
    result = plan(DOMAIN.format(methods=methods), problem('(either)', facts), world, options)
    expected = any(is_solvable(steps, keys, lost) for steps in branches)
    assert (result.outcome == Outcome.SOLVED) == expected
