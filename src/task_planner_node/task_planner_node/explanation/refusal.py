"""Where in a mission's text it is that the motion planner refused to work on a request."""

from __future__ import annotations

import re
from dataclasses import replace

from task_planner_node.errors import Diagnostic
from task_planner_node.explanation.vocabulary import labels_of
from task_planner_node.language.model import Domain, Problem, show
from task_planner_node.mission import locate
from task_planner_node.oracle import Code
from task_planner_node.search.geometry import RequestRefused

WORD = re.compile(r'[\w-]+')
GEOMETRIC_WORD = re.compile(r'[^\s(),]+|[(),]')


def place_refusal(refused: RequestRefused, domain: Domain, problem: Problem) -> Diagnostic:
    """The error of the motion planner at the label that it does not know, or in the operator's text."""
    message = f'{show(refused.task)}: {refused.message}'
    if refused.code in (Code.UNKNOWN_AGENT, Code.UNKNOWN_OBJECT):
        labels = labels_of(refused.task)
        named = [word for word in WORD.findall(refused.message) if word in labels]
        place = locate(problem, named[:1] or labels, str(refused.task[0]))
        if place is not None:
            return replace(place, message=message)
    for operator in domain.operators:
        if operator.head.name == refused.task[0] and operator.geometric is not None:
            text, node = operator.geometric.text, operator.geometric.node
            found = _written(text, refused.text, refused.column)
            start, end = found or (0, node.end - node.start)
            return domain.source.diagnostic(node.start + start, node.start + end, message)
    return Diagnostic(message)


def _written(text: str, ground: str, column: int) -> tuple[int, int] | None:
    """The word of ``text`` that became the word at ``column`` (from 1, 0 is nowhere) of the ground text.

    Grounding keeps the number of words, as long as no variable stands for a list.
    """
    words, grounded = (list(GEOMETRIC_WORD.finditer(t)) for t in (text, ground))
    if len(words) != len(grounded):
        return None
    pairs = zip(words, grounded, strict=True)
    return next((w.span() for w, g in pairs if g.start() < column <= g.end()), None)
