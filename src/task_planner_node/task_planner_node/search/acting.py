"""What applying an operator takes, with geometric preconditions or without."""

from __future__ import annotations

from typing import TYPE_CHECKING

from task_planner_node.search.dead_ends import Reason, not_satisfied
from task_planner_node.search.network import Cell, Kept, Task
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.partial_plan import Expansion
from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame

if TYPE_CHECKING:
    from task_planner_node.search.engine import Search


def act(
    search: Search, state: State, cell: Cell, operator: CompiledOperator, frame: Frame
) -> tuple[float, Expansion] | None:
    """Apply the effects and log it: the price and the entry of the log; None where it may not be."""
    price = operator.cost(frame)
    reason = operator.apply(state, frame)
    if isinstance(cell[0], Kept) and not cell[0].done(state.facts):
        reason = 'it would not do any more what it did in the plan before'
    if reason:
        search.dead_ends.add(cell[0], 'protected', reason)
        return None
    expansion = Expansion(cell[0], cell[2], cell[3], operator)
    expansion.mark = state.mark()
    search.log.append(expansion)
    return price, expansion


def unsatisfied(
    search: Search, state: State, task: Task, operator: CompiledOperator, frame: Frame
) -> None:
    """Note that no solution of the symbolic preconditions was found."""

    def reason() -> Reason:
        return not_satisfied([('', operator.condition.first_failure(state, frame))])

    search.dead_ends.add(task, 'symbolic', reason)
