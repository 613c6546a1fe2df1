"""Which motion a task would begin with: what the motion planner is asked advice about."""

from __future__ import annotations

from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.network import Network, Task, first_tasks, replace, rest_after
from task_planner_node.search.state import State

MOST_STEPS = 32


def leading_text(domain: CompiledDomain, state: State, task: Task) -> str | None:
    """The ground geometric preconditions that ``task`` would meet first if it were done now.

    Methods are followed by their first applicable branch and binding; operators without geometric
    preconditions are passed over without their effects.  None when that leads to no motion.  It is a
    guess that only serves to order choices.
    """
    network: Network = (task, None)
    for _ in range(MOST_STEPS):
        if network is None:
            return None
        first, path = first_tasks(network)[0]
        rest = rest_after(network, path)
        operator = domain.operators.get(first[0])
        if operator is not None:
            frame = operator.bind(first)
            if frame is None:
                return None
            if operator.text is not None:
                for _ in operator.condition.solutions(state, frame):
                    return operator.text(frame)
                return None
            grown = rest
        else:
            found = _first_decomposition(domain, state, first, rest)
            if found is None:
                return None
            (grown,) = found
        network = replace(network, path, grown, to_front=True)
    return None


def _first_decomposition(
    domain: CompiledDomain, state: State, task: Task, rest: Network
) -> tuple[Network] | None:
    for method in domain.methods.get(task[0], ()):
        frame = method.bind(task)
        if frame is None:
            continue
        for branch in method.branches:
            for _ in branch.condition.solutions(state, frame):
                return (branch.grow(frame, rest),)
    return None
