"""The end of a search in a person's words."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from task_planner_node.errors import Diagnostic
from task_planner_node.language.model import Atom, Domain, Problem, show
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.mission import locate
from task_planner_node.oracle import Code
from task_planner_node.search.dead_ends import DeadEnd, describe
from task_planner_node.search.engine import Search
from task_planner_node.search.geometry import RequestRefused
from task_planner_node.search.network import Task

MOST_LINES = 8
WORD = re.compile(r'[\w-]+')
# A literal without lists as it is shown: its name and its arguments.
LITERAL = re.compile(r'\(([^\s()]+)((?: [^\s()]+)+)\)')
GEOMETRIC_WORD = re.compile(r'[^\s(),]+|[(),]')


def explain_solution(search: Search) -> str:
    """How long the plan is."""
    best = search.best
    if best is None or not best.steps:
        return 'nothing has to be done: the plan is empty'
    actions = '1 action' if len(best.steps) == 1 else f'{len(best.steps)} actions'
    return f'a plan of {actions}, {best.length:.1f} m'


def explain_failure(
    search: Search, limit: str, domain: Domain, problem: Problem
) -> tuple[str, tuple[Diagnostic, ...]]:
    """Why there is no plan, in a few lines, and remarks at the tasks that are to blame.

    ``limit`` says what ended the search, and is empty when the absence of a plan is proven.
    """
    proofs = [_with_unknown_objects(proof, domain, problem) for proof in search.proofs.values()]
    counted = sorted(search.dead_ends.groups.values(), key=lambda group: -group.count)
    blamed = proofs or counted
    title = 'no plan exists' if not limit else f'no plan found, {limit}'
    actions = '1 action' if search.deepest == 1 else f'{search.deepest} actions'
    lines = [f'{title}; the longest partial plan had {actions}', *describe(blamed, MOST_LINES)]
    remarks = [_remark(dead_end, problem) for dead_end in blamed[:MOST_LINES]]
    return '\n'.join(lines), tuple(dict.fromkeys(remark for remark in remarks if remark))


def _labels(task: Task) -> list[str]:
    """The arguments of a task, those in lists too."""

    def flat(term: object) -> Iterator[str]:
        if isinstance(term, str):
            yield term
        elif isinstance(term, tuple):
            for part in term:
                yield from flat(part)

    return list(flat(task[1:]))


def _with_unknown_objects(dead_end: DeadEnd, domain: Domain, problem: Problem) -> DeadEnd:
    """Add which objects no fact speaks of, where a literal can only be true initially."""
    effects = [effect for operator in domain.operators for effect in operator.adds]
    made = {effect.name for effect in effects if isinstance(effect, Atom)}
    made |= {axiom.head.name for axiom in domain.axioms}
    known = {label for fact in problem.facts for label in _labels((fact.name, *fact.args))}
    for name, text in LITERAL.findall(' '.join(dead_end.unmet)):
        words = [] if name in made else text.split()
        for place, word in enumerate(words):
            if word not in known and word != 'nil' and not word.startswith('?'):
                alike = (
                    f.args[place]
                    for f in problem.facts
                    if (f.name, len(f.args)) == (name, len(words))
                )
                hint = did_you_mean(word, (label for label in alike if isinstance(label, str)))
                reason = f'{dead_end.reason}; unknown object {word}: no fact speaks of it{hint}'
                return replace(dead_end, reason=reason, objects=(word,))
    return dead_end


def _remark(dead_end: DeadEnd, problem: Problem) -> Diagnostic | None:
    name = str(dead_end.task[0])
    labels = dead_end.objects or _labels(dead_end.task) or [name]
    place = locate(problem, labels, name)
    if place is None:
        return None
    return replace(place, message=f'{show(dead_end.task)}: {dead_end.reason}')


def place_refusal(refused: RequestRefused, domain: Domain, problem: Problem) -> Diagnostic:
    """The error of the motion planner at the label that it does not know, or in the operator's text."""
    message = f'{show(refused.task)}: {refused.message}'
    if refused.code in (Code.UNKNOWN_AGENT, Code.UNKNOWN_OBJECT):
        labels = _labels(refused.task)
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
