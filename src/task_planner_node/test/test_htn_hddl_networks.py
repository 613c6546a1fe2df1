"""HDDL: networks of tasks that may come in several orders."""

from __future__ import annotations

from itertools import permutations

from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.hddl.networks import nested
from task_planner_node.language.model import (
    Atom,
    Immediate,
    Ordered,
    Partial,
    TaskNetwork,
)
from task_planner_node.language.reader import ListNode


def atoms(count: int) -> list[Atom]:
    return [Atom(f't{i}', (), ListNode([], 0, 0)) for i in range(count)]


def orders(network: TaskNetwork) -> set[tuple[str, ...]]:
    """All orders in which a network of few tasks can be done."""
    if isinstance(network, (Atom, Immediate)):
        return {(network.name if isinstance(network, Atom) else network.task.name,)}
    if isinstance(network, Partial):
        names = [item.name for item in network.items]
        return {
            order
            for order in permutations(names)
            if all(order.index(names[i]) < order.index(names[j]) for i, j in network.before)
        }
    found: set[tuple[str, ...]] = {()}
    for part in map(orders, network.items):
        if isinstance(network, Ordered):
            found = {left + right for left in found for right in part}
        else:
            found = {each for left in found for right in part for each in shuffles(left, right)}
    return found


def shuffles(left: tuple[str, ...], right: tuple[str, ...]) -> set[tuple[str, ...]]:
    if not left or not right:
        return {left + right}
    return {(left[0], *rest) for rest in shuffles(left[1:], right)} | {
        (right[0], *rest) for rest in shuffles(left, right[1:])
    }


@given(
    st.integers(1, 6).flatmap(
        lambda n: st.tuples(
            st.just(n), st.sets(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)))
        )
    )
)
def test_nested_networks_allow_exactly_the_orders_of_the_constraints(
    case: tuple[int, set[tuple[int, int]]],
) -> None:
    count, pairs = case
    pairs = {(i, j) for i, j in pairs if i < j}
    after = [sum(1 << j for j in range(count) if (i, j) in pairs) for i in range(count)]
    for i in reversed(range(count)):
        for j in range(count):
            if after[i] >> j & 1:
                after[i] |= after[j]
    network = nested(atoms(count), list(range(count)), after)
    wanted = {
        tuple(f't{i}' for i in order)
        for order in permutations(range(count))
        if all(order.index(i) < order.index(j) for i, j in pairs)
    }
    assert orders(network) == wanted


def test_a_partial_order_has_no_pair_that_follows_from_others() -> None:
    after = [0b01000, 0b11100, 0, 0b10000, 0]
    after[0] |= after[3]
    network = nested(atoms(5), [*range(5)], after)
    assert isinstance(network, Partial)
    assert network.before == ((0, 3), (1, 2), (1, 3), (3, 4))
