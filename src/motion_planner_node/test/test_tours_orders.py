"""Orders of groups of attitudes: as good as trying all, and never against a precedence."""

from __future__ import annotations

from itertools import pairwise, permutations, product
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.stopping import never
from motion_planner_node.tours.chains import Groups, best_chain
from motion_planner_node.tours.exact import any_order, best_tour
from motion_planner_node.tours.local_search import LocalSearch, best_place
from motion_planner_node.tours.moves import NONE, best_move, make, neighbours, reversal, tables_of
from motion_planner_node.tours.precedences import from_start, next_to
from tests.support.precedences import random_precedences


def groups_of(
    seed: int, goals: int, precedences: int, blocked: float = 0.0, sparse: bool = False
) -> Groups:
    """Random groups of one to three attitudes, with random precedences that agree with an order.

    There is no way between a share of the attitudes that is ``blocked``; ``sparse`` ones have none
    between groups of which no order has one right after the other, as those of `Samples`.
    """
    rng = np.random.default_rng(seed)
    count = np.concatenate(([1], rng.integers(1, 4, goals)))
    first = np.cumsum(count) - count
    total = int(count.sum())
    costs = rng.uniform(1.0, 100.0, (total, total)).astype(np.float32)
    costs[rng.uniform(size=costs.shape) < blocked] = inf
    before = random_precedences(rng, goals, precedences)
    groups = Groups(costs, first, count, before)
    return thinned(groups) if sparse else groups


def thinned(groups: Groups) -> Groups:
    """Without ways between groups that are in no order right after each other."""
    owner = np.repeat(np.arange(len(groups.first)), groups.sizes)
    used = next_to(groups.before)[owner][:, owner]
    return groups._replace(costs=np.where(used, groups.costs, np.float32(inf)))


def respects(groups: Groups, order: np.ndarray) -> bool:
    place = np.argsort(order)
    return all(place[i] < place[j] for i, j in zip(*np.nonzero(groups.before), strict=True))


def length_by_trying(groups: Groups, order: tuple[int, ...]) -> float:
    """The shortest way through an order, by trying all attitudes."""
    choices = [range(groups.first[g], groups.first[g] + groups.sizes[g]) for g in order]
    return min(
        sum(float(groups.costs[a, b]) for a, b in pairwise(way)) for way in product(*choices)
    )


def best_by_trying(groups: Groups) -> float:
    goals = range(1, len(groups.first))
    orders = ((0, *order) for order in permutations(goals))
    return min(length_by_trying(groups, o) for o in orders if respects(groups, np.array(o)))


instances = st.builds(
    groups_of,
    st.integers(0, 2**32),
    st.integers(1, 5),
    st.integers(0, 3),
    sparse=st.booleans(),
)
complete = st.builds(groups_of, st.integers(0, 2**32), st.integers(1, 5), st.integers(0, 8))


@given(complete)
@settings(max_examples=60, deadline=None)
def test_groups_are_next_to_each_other_where_some_order_has_them_so(groups: Groups) -> None:
    expected = np.zeros_like(groups.before)
    for goals in permutations(range(1, len(groups.first))):
        if respects(groups, np.array((0, *goals))):
            expected[(0, *goals[:-1]), goals] = True
    assert (next_to(groups.before) == expected).all()


@given(complete)
@settings(max_examples=40, deadline=None)
def test_costs_between_other_groups_do_not_count(groups: Groups) -> None:
    order = best_tour(thinned(groups), never)
    best = best_by_trying(groups)
    assert best_chain(groups, order)[0] == pytest.approx(best, rel=1e-5)
    assert best_chain(thinned(groups), order)[0] == pytest.approx(best, rel=1e-5)
    fixed = groups._replace(before=np.triu(np.ones_like(groups.before), 1))
    as_given = np.arange(len(groups.first))
    assert best_chain(thinned(fixed), as_given)[0] == best_chain(groups, as_given)[0]
    assert (best_tour(thinned(fixed), never) == as_given).all()


@given(instances)
@settings(max_examples=60, deadline=None)
def test_the_exact_tour_is_the_best_of_all_orders_and_attitudes(groups: Groups) -> None:
    order = best_tour(groups, never)
    assert sorted(order) == list(range(len(groups.first)))
    assert respects(groups, order)
    length, chosen = best_chain(groups, order)
    assert length == pytest.approx(best_by_trying(groups), rel=1e-5)
    assert length == pytest.approx(sum(groups.costs[a, b] for a, b in pairwise(chosen)), rel=1e-5)


@given(instances)
@settings(max_examples=40, deadline=None)
def test_a_chain_takes_the_attitudes_that_are_best_for_its_order(groups: Groups) -> None:
    order = np.arange(len(groups.first))
    expected = length_by_trying(groups, tuple(order))
    assert best_chain(groups, order)[0] == pytest.approx(expected, rel=1e-5)


@given(instances)
@settings(max_examples=40, deadline=None)
def test_a_group_is_inserted_where_that_is_shortest(groups: Groups) -> None:
    order = best_tour(groups, never)
    for group in order[1:]:
        rest = order[order != group]
        length, place = best_place(groups, rest, int(group))
        tried = [np.insert(rest, k + 1, group) for k in range(len(rest))]
        allowed = [best_chain(groups, one)[0] for one in tried if respects(groups, one)]
        assert length == pytest.approx(min(allowed), rel=1e-5)
        assert respects(groups, tried[place])


def bound_of(groups: Groups) -> np.ndarray:
    inner = groups.before[1:, 1:]
    return np.concatenate(([False], inner.any(axis=0) | inner.any(axis=1)))


@given(instances)
@settings(max_examples=40, deadline=None)
def test_a_reversal_is_valued_with_the_attitudes_that_are_best_after_it(groups: Groups) -> None:
    tables = tables_of(groups, best_tour(groups, never))
    order = tables.order
    for end in range(2, len(order)):
        for k in range(1, end):
            turned = np.concatenate((order[:k], order[k : end + 1][::-1], order[end + 1 :]))
            assert reversal(groups, tables, k, end) == pytest.approx(
                best_chain(groups, turned)[0], rel=1e-5
            )


@given(
    st.builds(
        groups_of,
        st.integers(0, 2**32),
        st.integers(1, 30),
        st.integers(0, 6),
        st.sampled_from((0.0, 0.2, 0.6)),
        st.booleans(),
    )
)
@settings(max_examples=60, deadline=None)
def test_a_move_is_allowed_and_makes_the_order_as_long_as_it_says(groups: Groups) -> None:
    near, order = neighbours(groups, 6), any_order(groups)
    for group in order[1:]:
        tables = tables_of(groups, order)
        move = best_move(groups, near, bound_of(groups), tables, group)
        if move.kind == NONE:
            continue
        make(tables, move)
        assert sorted(tables.order) == sorted(order)
        assert respects(groups, tables.order)
        assert move.length == pytest.approx(best_chain(groups, tables.order)[0], rel=1e-5)


@given(st.integers(0, 2**32), st.integers(1, 12), st.integers(0, 12), st.booleans())
@settings(max_examples=30, deadline=None)
def test_the_local_search_keeps_precedences_and_never_gets_worse(
    seed: int, goals: int, precedences: int, sparse: bool
) -> None:
    groups = groups_of(seed, goals, precedences, sparse=sparse)
    search = LocalSearch(groups, never)
    begin = search.tour(None, 0, np.random.default_rng(seed))
    order = search.tour(begin, 8, np.random.default_rng(seed))
    again = search.tour(begin, 8, np.random.default_rng(seed))
    assert sorted(order) == list(range(goals + 1))
    assert respects(groups, begin)
    assert respects(groups, order)
    assert best_chain(groups, order)[0] <= best_chain(groups, begin)[0] + 1e-3 < inf
    assert (order == again).all()


def places_of(seed: int, goals: int) -> Groups:
    """Groups of three places in the plane, near each other, with their distances."""
    rng = np.random.default_rng(seed)
    middles = rng.uniform(0.0, 100.0, (goals + 1, 1, 2))
    places = (middles + rng.uniform(-8.0, 8.0, (goals + 1, 3, 2))).reshape(-1, 2)[2:]
    costs = np.hypot(*(places[:, None] - places).transpose(2, 0, 1)).astype(np.float32)
    first = np.concatenate(([0], 1 + 3 * np.arange(goals)))
    before = from_start(np.zeros((goals, goals), np.bool_))
    return Groups(costs, first, np.array([1] + [3] * goals), before)


@given(st.integers(0, 2**32), st.integers(4, 9))
@settings(max_examples=30, deadline=None)
def test_the_local_search_is_near_the_best_of_all_orders(seed: int, goals: int) -> None:
    groups = places_of(seed, goals)
    found = LocalSearch(groups, never).tour(None, 64, np.random.default_rng(seed))
    best = best_chain(groups, best_tour(groups, never))[0]
    assert best - 1e-3 <= best_chain(groups, found)[0] <= 1.001 * best
