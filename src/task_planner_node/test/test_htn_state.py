"""The state: what is undone is exactly as it was, and the indices tell what the facts are."""

from __future__ import annotations

import itertools

from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.search.state import Bucket, Index, IndexPlan, State, fresh

FACTS = [('p', a, b) for a, b in itertools.product('abc', repeat=2)] + [('q', a) for a in 'abc']
CHANGES = st.lists(st.tuples(st.booleans(), st.sampled_from(FACTS)), max_size=60)


PATHS = ((), ((1,),), ((2,),), ((1,), (2,)))


def snapshot(state: State) -> object:
    """Facts and what the indices enumerate, in order."""
    indices = [
        {
            key: facts
            for key, bucket in state.buckets[number].items()
            if (facts := [*state.living(bucket)])
        }
        for number in range(len(PATHS))
    ]
    for buckets, index in zip((state.buckets[n] for n in range(len(PATHS))), indices, strict=True):
        for key, bucket in buckets.items():
            assert len(bucket) - bucket.dead == len(index.get(key, []))
            if len(bucket) - bucket.dead == 1:
                assert [state.only(bucket)] == index[key]
    return set(state.facts), indices, state.key


@given(st.sets(st.sampled_from(FACTS)), CHANGES, CHANGES, st.booleans())
def test_undo_restores_facts_and_indices(
    initial: set[tuple[str, ...]],
    first: list[tuple[bool, tuple[str, ...]]],
    second: list[tuple[bool, tuple[str, ...]]],
    late: bool,
) -> None:
    plan = IndexPlan()
    numbers = [plan.number(Index('p', 2, paths)) for paths in PATHS]
    state = State(plan, sorted(initial))
    if not late:
        snapshot(state)
    facts = set(initial)

    def change(changes: list[tuple[bool, tuple[str, ...]]]) -> None:
        for adds, fact in changes:
            if adds:
                state.add(fresh(fact))
                facts.add(fact)
            else:
                state.remove(fact)
                facts.discard(fact)
        assert set(state.facts) == facts
        for a in 'abc':
            bucket = list(state.living(state.buckets[numbers[1]].get(a, Bucket())))
            assert len(bucket) == len(set(bucket))
            assert set(bucket) == {fact for fact in facts if fact[:2] == ('p', a)}

    change(first)
    mark, before = state.mark(), snapshot(state)
    change(second)
    state.undo(mark)
    assert snapshot(state) == before
    state.undo(0)
    assert set(state.facts) == initial
    assert state.key == 0
