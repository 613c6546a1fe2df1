"""A domain and a problem in HDDL, together: the problem's objects need the domain's types."""

from __future__ import annotations

import re

from task_planner_node.errors import Diagnostic, MissionError
from task_planner_node.hddl.domain import read_domain
from task_planner_node.hddl.problem import read_problem
from task_planner_node.language.model import Domain, Problem
from task_planner_node.language.reader import ListNode, first_word, read
from task_planner_node.language.reading import Reading
from task_planner_node.language.source import Source
from task_planner_node.language.spelling import Spelling

_BLANK = re.compile(r'\s*')
_START = re.compile(r'\(\s*define\s', re.IGNORECASE)


def is_hddl(source: Source) -> bool:
    """Whether a text begins with ``(define``, comments aside."""
    place = 0
    while True:
        blank = _BLANK.match(source.text, place)
        place = blank.end() if blank else place
        if not source.text.startswith(';', place):
            return _START.match(source.text, place) is not None
        place = source.text.find('\n', place)
        if place < 0:
            return False


def read_hddl(domain: Source, problem: Source) -> tuple[Domain, Problem]:
    """Read both texts, which may be one and the same; raises MissionError with everything that cannot be read."""
    spelling = Spelling()
    definitions = {source.name: read(source) for source in (problem, domain)}
    for source in (problem, domain):
        spelling.learn(definitions[source.name])
    found = []
    for source, what in ((domain, 'domain'), (problem, 'problem')):
        nodes = [
            node
            for node in definitions[source.name]
            if isinstance(node, ListNode)
            and first_word(node) == 'define'
            and len(node.children) > 1
            and first_word(node.children[1]) == what
        ]
        if len(nodes) != 1:
            count = f'{len(nodes)} {what}s' if nodes else f'no {what}'
            message = f'this text has {count}: expected one (define ({what} name) ...)'
            raise MissionError([Diagnostic(message, source=source.name)])
        found.append(nodes[0])
    of = read_domain(Reading(domain, spelling, anonymous=False), found[0])
    return of.domain, read_problem(Reading(problem, spelling, anonymous=False), found[1], of)
