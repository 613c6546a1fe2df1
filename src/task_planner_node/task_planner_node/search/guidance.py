"""Which motion a task would begin with: what the motion planner is asked advice about."""

from __future__ import annotations

from task_planner_node.errors import MissionError
from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.geometry import Request
from task_planner_node.search.network import Network, Task, first_cells, replace
from task_planner_node.search.partial_plan import Whereabouts
from task_planner_node.search.state import State
from task_planner_node.search.unbound import ground

MOST_STEPS = 32


def leading_request(
    domain: CompiledDomain, state: State, network: Network, where: Whereabouts
) -> Request | None:
    """What would be asked of the motion planner first if ``network`` were done now.

    Methods are followed by their first applicable branch and binding, operators without geometric preconditions by
    the first way to apply them, if there is one.  None when that leads to no motion.  It is a guess that only serves
    to order choices; the state is left as it was.
    """
    mark = state.mark()
    try:
        return _leading(domain, state, network, where)
    except MissionError:
        # It is told when the search comes to it.
        return None
    finally:
        state.undo(mark)


def _leading(
    domain: CompiledDomain, state: State, network: Network, where: Whereabouts
) -> Request | None:
    for _ in range(MOST_STEPS):
        if network is None:
            return None
        first, path = first_cells(network)[0]
        doing = first[0]
        operator = domain.operators.get(doing[0])
        if not ground(doing):
            return None
        if operator is not None:
            frame = operator.bind(doing)
            if frame is None:
                return None
            if operator.text is not None:
                for _ in operator.condition.solutions(state, frame):
                    behaviour = operator.behaviour(frame) if operator.behaviour else ''
                    text = operator.text(frame)
                    return Request(doing, text, behaviour, where.start, where.lineage)
                return None
            for _ in operator.condition.solutions(state, frame):
                operator.apply(state, frame)
                break
            grown = first[1]
        else:
            found = _first_decomposition(domain, state, doing, first[1])
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
            trial = frame.copy()
            for _ in branch.condition.solutions(state, trial):
                return (branch.grow(trial, rest, None),)
    return None
