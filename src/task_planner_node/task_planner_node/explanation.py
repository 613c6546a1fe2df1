"""The end of a search in a person's words."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import replace

from task_planner_node.errors import Diagnostic
from task_planner_node.language.model import Domain, Problem, show
from task_planner_node.mission import locate as locate_in
from task_planner_node.oracle import Code
from task_planner_node.search.dead_ends import DeadEnd, describe
from task_planner_node.search.engine import Search
from task_planner_node.search.geometry import RequestRefused

MOST_LINES = 8
WORD = re.compile(r'[\w-]+')


def explain_solution(search: Search) -> str:
    """How long the plan is."""
    steps = search.best or ()
    if not steps:
        return 'nothing has to be done: the plan is empty'
    actions = '1 action' if len(steps) == 1 else f'{len(steps)} actions'
    return f'a plan of {actions}, {search.best_length:.1f} m'


def explain_failure(
    search: Search, limit: str, locate: Callable[[Sequence[str]], Diagnostic | None]
) -> tuple[str, tuple[Diagnostic, ...]]:
    """Why there is no plan, in a few lines, and remarks at the tasks that are to blame.

    ``limit`` says what ended the search, and is empty when the absence of a plan is proven.
    """
    proofs = list(search.proofs.values())
    counted = sorted(search.dead_ends.groups.values(), key=lambda group: -group.count)
    blamed = proofs or counted
    title = 'no plan exists' if not limit else f'no plan found, {limit}'
    actions = '1 action' if search.deepest == 1 else f'{search.deepest} actions'
    lines = [f'{title}; the longest partial plan had {actions}', *describe(blamed, MOST_LINES)]
    remarks = [_remark(dead_end, locate) for dead_end in blamed[:MOST_LINES]]
    return '\n'.join(lines), tuple(dict.fromkeys(remark for remark in remarks if remark))


def _remark(
    dead_end: DeadEnd, locate: Callable[[Sequence[str]], Diagnostic | None]
) -> Diagnostic | None:
    words = [part for part in dead_end.task[1:] if isinstance(part, str)]
    place = locate(dead_end.objects or words or [dead_end.task[0]])
    if place is None:
        return None
    return replace(place, message=f'{show(dead_end.task)}: {dead_end.reason}')


def place_refusal(
    refused: RequestRefused, domain: Domain | None, problem: Problem | None
) -> Diagnostic:
    """The error of the motion planner at the label that it does not know, or at the operator's text."""
    message = f'{show(refused.task)}: {refused.message}'
    if refused.code in (Code.UNKNOWN_AGENT, Code.UNKNOWN_OBJECT) and problem is not None:
        labels = [part for part in refused.task[1:] if isinstance(part, str)]
        named = [word for word in WORD.findall(refused.message) if word in labels]
        place = locate_in(problem, named[:1] or labels)
        if place is not None:
            return replace(place, message=message)
    for operator in domain.operators if domain is not None else ():
        if operator.head.name == refused.task[0] and operator.geometric is not None and domain:
            node = operator.geometric.node
            return domain.source.diagnostic(node.start, node.end, message)
    return Diagnostic(message)
