"""What can be told from the names of tasks alone: which come up below themselves, and what they cost at least."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import inf

from task_planner_node.search.methods import CompiledMethod
from task_planner_node.search.operators import CompiledOperator

Methods = Mapping[str, Sequence[CompiledMethod]]


def recursive_names(methods: Methods) -> frozenset[str]:
    """The names of tasks that can be decomposed into tasks of their own name, in any number of steps."""
    below = {
        name: list(dict.fromkeys(t for m in found for b in m.branches for t in b.tasks))
        for name, found in methods.items()
    }
    recursive = {name for name, names in below.items() if name in names}
    for component in _components(below):
        if len(component) > 1:
            recursive.update(component)
    return frozenset(recursive)


def names_above(methods: Methods, below: frozenset[str]) -> frozenset[str]:
    """The names of tasks that may be decomposed into some of those ``below``, and these."""
    above: dict[str, list[str]] = {}
    for name, found in methods.items():
        for task in {
            task for method in found for branch in method.branches for task in branch.tasks
        }:
            above.setdefault(task, []).append(name)
    names: set[str] = set()
    agenda = list(below)
    while agenda:
        name = agenda.pop()
        if name not in names:
            names.add(name)
            agenda.extend(above.get(name, ()))
    return frozenset(names)


def _components(below: Mapping[str, Sequence[str]]) -> Iterator[list[str]]:
    """Strongly connected components (Tarjan), without recursion."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    path: list[str] = []
    on_path: set[str] = set()
    for root in below:
        if root in number:
            continue
        agenda: list[tuple[str, Iterator[str]]] = []

        def enter(name: str, agenda: list[tuple[str, Iterator[str]]] = agenda) -> None:
            number[name] = low[name] = len(number)
            path.append(name)
            on_path.add(name)
            agenda.append((name, iter(below[name])))

        enter(root)
        while agenda:
            name, rest = agenda[-1]
            child = next(rest, None)
            if child is not None:
                if child in below and child not in number:
                    enter(child)
                elif child in on_path:
                    low[name] = min(low[name], number[child])
                continue
            agenda.pop()
            if agenda:
                parent = agenda[-1][0]
                low[parent] = min(low[parent], low[name])
            if low[name] == number[name]:
                component = [path.pop()]
                while component[-1] != name:
                    component.append(path.pop())
                on_path.difference_update(component)
                yield component


def least_costs(operators: Mapping[str, CompiledOperator], methods: Methods) -> dict[str, float]:
    """Lower bounds of what the operators of a task cost, by name; 0 for tasks that never end."""
    least = {name: operator.least_cost for name, operator in operators.items()}
    least.update(dict.fromkeys(methods, inf))
    waiting: dict[str, list[str]] = {}
    for name, found in methods.items():
        for task in {t for m in found for b in m.branches for t in b.tasks}:
            waiting.setdefault(task, []).append(name)
    agenda = dict.fromkeys(methods)
    while agenda:
        name = next(iter(agenda))
        del agenda[name]
        cost = min(
            sum(least.get(task, 0.0) for task in branch.tasks)
            for method in methods[name]
            for branch in method.branches
        )
        if cost < least[name]:
            least[name] = cost
            agenda.update(dict.fromkeys(waiting.get(name, ())))
    return {name: cost if cost < inf else 0.0 for name, cost in least.items()}
