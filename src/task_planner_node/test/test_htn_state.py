"""The state: what is undone is exactly as it was, and the indices tell what the facts are."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.search.state import IndexPlan, State

FACTS = [('p', a, b) for a, b in itertools.product('abc', repeat=2)] + [('q', a) for a in 'abc']
CHANGES = st.lists(st.tuples(st.booleans(), st.sampled_from(FACTS)), max_size=30)


def snapshot(state: State) -> object:
    return set(state.facts), [dict(buckets) for buckets in state.buckets]


@given(st.sets(st.sampled_from(FACTS)), CHANGES, CHANGES)
def test_undo_restores_facts_and_indices(
    initial: set[tuple[str, ...]],
    first: list[tuple[bool, tuple[str, ...]]],
    second: list[tuple[bool, tuple[str, ...]]],
) -> None:
    plan = IndexPlan()
    numbers = [plan.number('p', 2, positions) for positions in ((), (1,), (2,), (1, 2))]
    state = State(plan, sorted(initial))
    facts = set(initial)

    def change(changes: list[tuple[bool, tuple[str, ...]]]) -> None:
        for adds, fact in changes:
            if adds:
                state.add(fact)
                facts.add(fact)
            else:
                state.remove(fact)
                facts.discard(fact)
        assert state.facts == facts
        for a in 'abc':
            bucket = state.buckets[numbers[1]].get(a, ())
            assert len(bucket) == len(set(bucket))
            assert set(bucket) == {fact for fact in facts if fact[:2] == ('p', a)}

    change(first)
    mark, before = state.mark(), snapshot(state)
    change(second)
    state.undo(mark)
    assert snapshot(state) == before
    state.undo(0)
    assert state.facts == initial
