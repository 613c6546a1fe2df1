"""Reading a problem: ``(defproblem name domain (fact ...) (task ...))``."""

from __future__ import annotations

from collections.abc import Iterator

from task_planner_node.errors import Diagnostic, MissionError
from task_planner_node.language.expressions import (
    Refused,
    elements,
    read_atom,
    read_tasks,
    refuse,
    tasks_of,
    variables_of,
)
from task_planner_node.language.model import Atom, Problem
from task_planner_node.language.reader import (
    DEFINITION_WORDS,
    DOMAIN_WORDS,
    ListNode,
    Node,
    Symbol,
    first_word,
    read,
)
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean

SHAPE = 'a problem is written (defproblem name domain (fact ...) (task ...))'


def read_problem(source: Source) -> Problem:
    """Read the one problem of ``source``; definitions of a domain in the same text are left alone.

    Raises MissionError with everything that cannot be read.
    """
    nodes = read(source)
    problems = [node for node in nodes if first_word(node) == 'defproblem']
    try:
        if not problems:
            raise _missing(source, nodes)
        if len(problems) > 1:
            raise refuse(source, problems[1], 'a text holds one problem: this is the second')
        for node in nodes:
            if first_word(node) not in DEFINITION_WORDS | DOMAIN_WORDS:
                raise refuse(source, node, _stray(source, node))
        return _read_defproblem(source, problems[0])
    except Refused as refused:
        raise MissionError([refused.diagnostic]) from refused


def _stray(source: Source, node: Node) -> str:
    hint = did_you_mean(first_word(node), DEFINITION_WORDS | DOMAIN_WORDS)
    text = source.excerpt(node.start, node.end)
    return f'{text} is neither a problem nor a definition of a domain{hint}'


def _missing(source: Source, nodes: list[Node]) -> Exception:
    for node in nodes:
        suggestion = did_you_mean(first_word(node), ('defproblem',))
        if suggestion:
            return refuse(source, node, f'unknown form ({first_word(node)} ...){suggestion}')
    return MissionError([Diagnostic(f'no problem in this text: {SHAPE}', source=source.name)])


def _read_defproblem(source: Source, node: Node) -> Problem:
    children = node.children if isinstance(node, ListNode) else []
    names = [child for child in children[1:3] if isinstance(child, Symbol)]
    fields = children[1 + len(names) :]
    if not names or len(fields) != 2:
        raise refuse(source, node, f'{SHAPE}; this one has {len(children) - 1} fields')
    facts: list[Atom] = []
    errors: list[Diagnostic] = []
    for child in _each(source, fields[0], 'the initial state', errors):
        try:
            facts.append(_ground(source, read_atom(source, child, 'a fact')))
        except Refused as refused:
            errors.append(refused.diagnostic)
    try:
        tasks = read_tasks(source, fields[1])
        for task in tasks_of(tasks):
            _ground(source, task)
    except Refused as refused:
        errors.append(refused.diagnostic)
    if errors:
        raise MissionError(errors)
    domain_node = names[1] if len(names) == 2 else None
    domain_name = domain_node.text if domain_node else ''
    goals = tuple(goal for task in tasks_of(tasks) for goal in _goals(source, task))
    return Problem(
        source, names[0].text, domain_name, domain_node, tuple(facts), tasks, fields[1], goals
    )


def _each(source: Source, node: Node, what: str, errors: list[Diagnostic]) -> list[Node]:
    try:
        return elements(source, node, what)
    except Refused as refused:
        errors.append(refused.diagnostic)
        return []


def _ground(source: Source, atom: Atom) -> Atom:
    for name in variables_of(atom):
        raise refuse(source, atom.node, f'a problem has no variables: {name}')
    return atom


def _goals(source: Source, task: Atom) -> Iterator[Atom]:
    """The goals that a task names: the literals in its arguments ``(list (literal) ...)``."""
    for argument in task.node.children[1:]:
        if isinstance(argument, ListNode) and first_word(argument) == 'list':
            for child in argument.children[1:]:
                try:
                    yield read_atom(source, child, 'a goal')
                except Refused:
                    continue
