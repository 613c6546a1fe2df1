"""Reading problems: ``(defproblem name domain (fact ...) (task ...))``."""

from __future__ import annotations

from collections.abc import Iterator

from task_planner_node.errors import Diagnostic, MissionError
from task_planner_node.language.forms import read_forms
from task_planner_node.language.model import Atom, Problem
from task_planner_node.language.reader import (
    DEFINITION_WORDS,
    DOMAIN_WORDS,
    MARKS,
    ListNode,
    Node,
    Symbol,
    first_word,
    unmarked,
)
from task_planner_node.language.reading import Reading, Refused, children_of, elements, is_nil
from task_planner_node.language.source import Source
from task_planner_node.language.spelling import Spelling
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.tasks import read_tasks
from task_planner_node.language.terms import read_atom, read_name
from task_planner_node.language.walk import is_ground, tasks_of, variables_of

SHAPE = 'a problem is written (defproblem name domain (fact ...) (task ...))'
PROBLEM_WORDS = frozenset({'defproblem', 'make-problem'})


def read_problem(source: Source, spelling: Spelling | None = None, name: str = '') -> Problem:
    """Read the one problem of ``source``, or the one called ``name``; definitions of a domain are left alone.

    Raises MissionError with everything that cannot be read, and when ``name`` does not single out a problem.
    """
    reading = Reading(source, spelling)
    forms = read_forms(reading)
    try:
        return _read_defproblem(reading, _chosen(reading, forms, name))
    except Refused as refused:
        raise MissionError([refused.diagnostic]) from refused


def problem_names(source: Source) -> list[str]:
    """The names of all problems in ``source``, in order; raises MissionError if it cannot be read at all."""
    reading = Reading(source)
    forms = read_forms(reading)
    return [_name_of(reading, node) for node in forms if first_word(node) in PROBLEM_WORDS]


def _chosen(reading: Reading, forms: list[Node], name: str) -> ListNode:
    problems = [
        node for node in forms if isinstance(node, ListNode) and first_word(node) in PROBLEM_WORDS
    ]
    if not problems:
        raise _missing(reading, forms)
    for node in forms:
        if first_word(node) not in DEFINITION_WORDS | DOMAIN_WORDS:
            raise reading.refuse(node, _stray(reading, node))
    names = [_name_of(reading, node) for node in problems]
    if name:
        wanted = [node for node, found in zip(problems, names, strict=True) if _same(found, name)]
        if not wanted:
            message = f'the text has no problem {name}: it has {", ".join(names)}'
            raise reading.refuse(problems[0], message)
        return wanted[-1]
    if len(problems) > 1:
        message = (
            f'the text holds {len(problems)} problems, this is the second: '
            f'name one of {", ".join(names)}'
        )
        raise reading.refuse(problems[1], message)
    return problems[0]


def _same(left: str, right: str) -> bool:
    return left.lower() == right.lower()


def _unread_name(node: Node) -> list[Node]:
    """The name of a problem with the mark before it, if there is one."""
    children = children_of(node)[1:3]
    return children if children and _is_mark(children[0]) else children[:1]


def _is_mark(node: Node) -> bool:
    return isinstance(node, Symbol) and node.text in MARKS


def _name_of(reading: Reading, node: Node) -> str:
    """The name of a problem: a symbol, perhaps quoted, or the first of a list with options."""
    children = unmarked(reading.source, _unread_name(node))
    if children:
        named = _unquoted(children[0])
        inner = children_of(named)
        named = inner[0] if inner else named
        if isinstance(named, Symbol):
            return read_name(reading, named)
    raise reading.refuse(node, f'{SHAPE}: its name is missing')


def _stray(reading: Reading, node: Node) -> str:
    hint = did_you_mean(first_word(node), DEFINITION_WORDS | DOMAIN_WORDS)
    text = reading.source.excerpt(node.start, node.end)
    return f'{text} is neither a problem nor a definition of a domain{hint}'


def _missing(reading: Reading, nodes: list[Node]) -> Exception:
    for node in nodes:
        suggestion = did_you_mean(first_word(node), ('defproblem',))
        if suggestion:
            return reading.refuse(node, f'unknown form ({first_word(node)} ...){suggestion}')
    nothing = f'no problem in this text: {SHAPE}'
    return MissionError([Diagnostic(nothing, source=reading.source.name)])


def _fields(reading: Reading, node: ListNode) -> tuple[str, Symbol | None, Node, Node]:
    """The name, the domain's name if there is one, the facts and the tasks; options are left out."""
    children = unmarked(reading.source, node.children)[1:]
    if first_word(node) == 'make-problem':
        children = [_unquoted(child) for child in children]
    for i, child in enumerate(children):
        if isinstance(child, Symbol) and child.text.startswith(':'):
            children = children[:i]
            break
    if len(children) == 3 and (is_nil(children[1]) or isinstance(children[1], ListNode)):
        return _name_of(reading, node), None, children[1], children[2]
    if len(children) == 4:
        domain = children[1]
        if isinstance(domain, Symbol) and not is_nil(domain):
            return _name_of(reading, node), domain, children[2], children[3]
        if is_nil(domain):
            return _name_of(reading, node), None, children[2], children[3]
    raise reading.refuse(node, f'{SHAPE}; this one has {len(children)} fields')


def _unquoted(node: Node) -> Node:
    quoted = first_word(node) == 'quote' and len(children_of(node)) == 2
    return children_of(node)[1] if quoted else node


def _read_defproblem(reading: Reading, node: ListNode) -> Problem:
    name, domain, state, network = _fields(reading, node)
    facts: list[Atom] = []
    try:
        for child in elements(reading, state, 'the initial state'):
            if reading.hopeless:
                break
            try:
                facts.append(_ground(reading, read_atom(reading, child, 'a fact')))
            except Refused as refused:
                reading.errors.append(refused.diagnostic)
    except Refused as refused:
        reading.errors.append(refused.diagnostic)
    try:
        tasks = read_tasks(reading, network)
    except Refused as refused:
        reading.errors.append(refused.diagnostic)
    if reading.errors:
        raise MissionError(reading.errors)
    _warn_of_spellings(reading, facts)
    goals = tuple(goal for task in tasks_of(tasks) for goal in _goals(reading, task))
    domain_name = read_name(reading, domain) if domain else ''
    return Problem(
        reading.source,
        name,
        domain_name,
        domain,
        tuple(facts),
        tasks,
        network,
        goals,
        remarks=tuple(reading.warnings),
    )


def _warn_of_spellings(reading: Reading, facts: list[Atom]) -> None:
    """Warn of each label that the facts spell in two ways: for the motion planner they are two."""
    warned: set[str] = set()
    agenda: list[Node] = [child for fact in facts for child in fact.node.children[1:]][::-1]
    while agenda:
        node = agenda.pop()
        if isinstance(node, ListNode):
            agenda.extend(reversed(node.children))
            continue
        first = reading.names.get(node.text, node.text)
        if first.lower() == node.text.lower() and first != node.text and node.text not in warned:
            warned.add(node.text)
            message = f'{node.text} is {first}, spelt differently: names have no case'
            reading.warn(node, message)


def _ground(reading: Reading, atom: Atom) -> Atom:
    for name in variables_of(atom):
        raise reading.refuse(atom.node, f'a fact has no variables: {name}')
    if not all(map(is_ground, atom.args)):
        raise reading.refuse(atom.node, 'a fact is not computed')
    return atom


def _goals(reading: Reading, task: Atom) -> Iterator[Atom]:
    """The goals that a task names: the literals in its arguments ``(list (literal) ...)``."""
    for argument in task.node.children[1:]:
        if isinstance(argument, ListNode) and first_word(argument) == 'list':
            for child in argument.children[1:]:
                try:
                    yield _ground(reading, read_atom(reading, child, 'a goal'))
                except Refused:
                    continue
