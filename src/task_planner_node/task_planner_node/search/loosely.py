"""Tasks with arguments that nothing has bound yet: whoever does such a task binds them, for all others too."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from task_planner_node.errors import MissionError
from task_planner_node.language.model import shorten, show
from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.heads import Head
from task_planner_node.search.methods import CompiledBranch
from task_planner_node.search.network import Task
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame, build, slots_of
from task_planner_node.search.unbound import (
    Unbound,
    Values,
    ground,
    known,
    resolved,
    unify,
)


class Loosely:
    """The ways of such tasks, by definitions that are compiled for the arguments that are bound."""

    def __init__(self, domain: CompiledDomain, state: State) -> None:
        self._domain = domain
        self._state = state

    def bindings(
        self, task: Task
    ) -> Iterator[tuple[CompiledOperator | CompiledBranch, Frame, Values]]:
        """Each way of a task: an operator or a branch, its frame, and the values of place-holders."""
        if task[0] in self._domain.operators:
            operator = self._domain.operator_for(task)
            frame = operator.bind(task)
            for _ in operator.condition.solutions(self._state, frame) if frame else ():
                values = _bound(operator.head, task, frame or [])
                if values is not None:
                    self._refuse_unbound(task, values)
                    yield operator, frame or [], values
            return
        for method in self._domain.methods_for(task):
            frame = method.bind(task)
            if frame is None:
                continue
            for branch in method.branches:
                found = False
                trial = frame.copy()
                for _ in branch.condition.solutions(self._state, trial):
                    done = trial.copy()
                    values = _bound(method.head, task, done)
                    if values is not None:
                        found = True
                        yield branch, done, values
                if found:
                    break

    def _refuse_unbound(self, task: Task, values: Values) -> None:
        if not ground(resolved(tuple(task), values)):
            message = f'{shorten(show(task))} is done with an argument that nothing has bound'
            raise MissionError([self._domain.place_of(task[0], message)])


def _bound(head: Head, task: Task, frame: Frame) -> Values | None:
    """Unify the head's arguments with those of the task; None when that cannot be done.

    Variables of the head that have no value get a place-holder.
    """
    values: Values = {}
    unbound = [i for i, is_known in enumerate(known(task), start=1) if not is_known]
    for position in unbound:
        term: Any = head.terms[position - 1]
        if isinstance(term, int) and frame[term] is None:
            frame[term] = task[position]
            continue
        for slot in slots_of(term):
            if frame[slot] is None:
                frame[slot] = Unbound('?')
        if not unify(task[position], build(term, frame), values):
            return None
    return values


def shape(task: Any) -> Any:
    """A task with all place-holders alike."""
    if isinstance(task, Unbound):
        return None
    if isinstance(task, tuple):
        return tuple([shape(part) for part in task])
    return task
