"""Loading a mission: two texts to a checked, compiled domain and a problem."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeVar

from task_planner_node.errors import Diagnostic, GeometryUnavailable, MissionError, Severity
from task_planner_node.hddl import is_hddl, read_hddl
from task_planner_node.language import (
    Spelling,
    check_mission,
    load_source,
    read_domain,
    read_problem,
    split_name,
)
from task_planner_node.language.model import Domain, Problem
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.oracle import Oracle
from task_planner_node.search.domain import CompiledDomain

T = TypeVar('T')


@dataclass(frozen=True, slots=True)
class MissionText:
    """Where a domain or a problem comes from: its text, or the file at ``path`` when that is empty.

    One of several problems in it is chosen by its name behind the path: ``problems.lisp#first``.
    """

    path: str = ''
    text: str = ''


@dataclass(frozen=True, slots=True)
class Mission:
    """A mission that can be searched; ``warnings`` do not prevent that."""

    domain: CompiledDomain
    problem: Problem
    warnings: tuple[Diagnostic, ...]


def read_mission(domain: MissionText, problem: MissionText) -> tuple[Domain, Problem]:
    """Read both texts; raises MissionError with what is wrong in either of them.

    Texts that begin with ``(define`` are HDDL.  The problem is read first, so that labels are spelt as in its facts.
    """
    of_domain: list[Diagnostic] = []
    of_problem: list[Diagnostic] = []
    path, chosen = split_name(problem.path)
    text = _attempt(of_domain, lambda: load_source('domain', domain.path, domain.text))
    task = _attempt(of_problem, lambda: load_source('problem', path, problem.text))
    if text is not None and task is not None:
        if is_hddl(text) or is_hddl(task):
            return read_hddl(text, task)
        spelling = Spelling()
        read_two = _attempt(of_problem, lambda: read_problem(task, spelling, chosen))
        name = read_two.domain_name if read_two else ''
        read_one = _attempt(of_domain, lambda: read_domain(text, spelling, name))
        if read_one is not None and read_two is not None:
            return read_one, read_two
    raise MissionError([*of_domain, *of_problem])


def _attempt(errors: list[Diagnostic], read: Callable[[], T]) -> T | None:
    try:
        return read()
    except MissionError as error:
        errors.extend(error.diagnostics)
        return None


def check_and_compile(
    domain: Domain, problem: Problem, oracle: Oracle, linear: bool = False
) -> Mission:
    """Check a mission, its geometric preconditions by ``oracle``, and compile it.

    With ``linear`` facts are matched one after the other, and not looked up (search/linear.py).
    Raises MissionError with all diagnostics when one of them is an error, and GeometryUnavailable.
    """
    diagnostics = check_mission(domain, problem)
    assigning: set[str] = set()
    try:
        for operator in domain.operators:
            if operator.geometric is not None:
                node = operator.geometric.node
                line, column = domain.source.position(node.start)
                check = oracle.check(operator.geometric.text, domain.source.name, line, column)
                diagnostics += check.diagnostics
                if check.assigns:
                    assigning.add(operator.head.name)
    except GeometryUnavailable:
        if not _has_errors(diagnostics):
            raise
    if _has_errors(diagnostics):
        raise MissionError(diagnostics)
    return Mission(
        CompiledDomain(domain, frozenset(assigning), linear), problem, tuple(diagnostics)
    )


def _has_errors(diagnostics: Sequence[Diagnostic]) -> bool:
    return any(diagnostic.severity == Severity.ERROR for diagnostic in diagnostics)


def locate(problem: Problem, labels: Sequence[str], name: str = '') -> Diagnostic | None:
    """Where the tasks of ``problem`` speak of ``labels``: the smallest list that holds the most of them.

    Among lists that hold equally many one that begins with ``name`` is preferred.  A label that occurs
    nowhere in the tasks is looked for in the initial state.
    """
    wanted = set(labels)
    best: tuple[int, bool, int] = (0, False, 0)
    place: Node | None = None
    for node, count in _lists(problem.tasks_node, wanted):
        rank = (count, first_word(node) == name.lower(), node.start - node.end)
        if count and (place is None or rank > best):
            best, place = rank, node
    if place is None:
        mentions = (s for fact in problem.facts for s in _symbols(fact.node) if s.text in wanted)
        place = next(mentions, None)
    elif len(wanted) == 1:
        place = next((s for s in _symbols(place) if s.text in wanted), place)
    if place is None:
        return None
    return problem.source.diagnostic(place.start, place.end, '')


def _symbols(node: Node) -> Iterator[Symbol]:
    if isinstance(node, Symbol):
        yield node
    else:
        for child in node.children:
            yield from _symbols(child)


def _lists(node: Node, wanted: set[str]) -> list[tuple[ListNode, int]]:
    """All lists below ``node`` with the number of wanted labels in each, the innermost ones first."""
    found: list[tuple[ListNode, int]] = []

    def visit(current: Node) -> set[str]:
        if isinstance(current, Symbol):
            return {current.text} & wanted
        labels: set[str] = set().union(*(visit(child) for child in current.children))
        found.append((current, len(labels)))
        return labels

    visit(node)
    return found
