"""The end of a search in a person's words."""

from __future__ import annotations

from dataclasses import replace

from task_planner_node.errors import Diagnostic
from task_planner_node.explanation.causes import causes_of
from task_planner_node.explanation.vocabulary import Vocabulary, labels_of
from task_planner_node.language.model import Domain, Problem, shorten, show
from task_planner_node.mission import locate
from task_planner_node.search.dead_ends import DeadEnd
from task_planner_node.search.engine import Search
from task_planner_node.search.plans import Plan

MOST_LINES = 8
MOST_ACTIONS = 5


def explain_solution(best: Plan) -> str:
    """How long the plan is."""
    if not best.steps:
        return 'nothing has to be done: the plan is empty'
    return f'a plan of {_actions(len(best.steps))}, {best.length:.1f} m'


def explain_failure(
    search: Search, limit: str, domain: Domain, problem: Problem
) -> tuple[str, tuple[Diagnostic, ...]]:
    """Why there is no plan, in a few lines, and remarks at the tasks that are to blame.

    ``limit`` says what ended the search, and is empty when the absence of a plan is proven.
    """
    vocabulary = Vocabulary(domain, problem)
    blamed = [
        vocabulary.with_suspects(dead_end)
        for dead_end in list(search.proofs.values()) or search.dead_ends.most_frequent()
    ]
    title = 'no plan exists' if not limit else f'no plan found, {limit}'
    lines = [f'{title}; the longest partial plan had {_actions(search.deepest)}']
    causes = causes_of(blamed, MOST_LINES)
    lines += [str(cause) for cause in causes[:MOST_LINES]]
    if len(causes) > MOST_LINES:
        lines.append(f'... and {len(causes) - MOST_LINES} more')
    lines += _farthest(search, vocabulary)
    remarks = [_remark(cause.example, problem) for cause in causes[:MOST_LINES]]
    return '\n'.join(lines), tuple(dict.fromkeys(remark for remark in remarks if remark))


def details_of(explanation: str, search: Search | None) -> str:
    """The explanation with all dead ends, one for each task."""
    if search is None or not search.dead_ends.groups:
        return explanation
    lines = []
    for group in search.dead_ends.most_frequent():
        times = f' ({group.count} times)' if group.count > 1 else ''
        lines.append(f'{shorten(show(group.task))}: {group.reason}{times}')
    return '\n'.join([explanation, 'all dead ends:', *lines])


def _actions(count: int) -> str:
    return '1 action' if count == 1 else f'{count} actions'


def _farthest(search: Search, vocabulary: Vocabulary) -> list[str]:
    """The last actions of the longest partial plan, and what came after them."""
    if search.deepest > search.farthest.actions:
        search.note_farthest()
    farthest = search.farthest
    if not farthest.last:
        return []
    shown = [shorten(show(task)) for task in farthest.last[-MOST_ACTIONS:]]
    before = '... ' if farthest.actions > len(shown) else ''
    lines = [f'the longest partial plan: {before}{" ".join(shown)}']
    if farthest.end is not None:
        end = vocabulary.with_suspects(farthest.end)
        lines.append(f'after that {shorten(show(end.task))}: {end.reason}')
    return lines


def _remark(dead_end: DeadEnd, problem: Problem) -> Diagnostic | None:
    name = str(dead_end.task[0])
    labels = dead_end.objects or labels_of(dead_end.task) or [name]
    place = locate(problem, labels, name)
    if place is None:
        return None
    return replace(place, message=f'{show(dead_end.task)}: {dead_end.reason}')
