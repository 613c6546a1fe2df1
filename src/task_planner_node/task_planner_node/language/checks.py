"""What can be said about a mission before it is searched: undefined names, wrong arities, unbound variables."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.language.expressions import atoms_of, tasks_of, variables_of
from task_planner_node.language.model import (
    And,
    Atom,
    Condition,
    Domain,
    GeometricText,
    Not,
    Operator,
    Problem,
    TaskNetwork,
    show,
)
from task_planner_node.language.reader import ListNode, Node, Symbol
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean

VARIABLE = re.compile(r'\?[A-Za-z_][A-Za-z0-9_]*(?:-[A-Za-z][A-Za-z0-9_]*)*')


def check_mission(domain: Domain, problem: Problem) -> list[Diagnostic]:
    """All errors and warnings of a mission, in the order of the texts, the domain's first."""
    remarks = [
        *_check_operators(domain),
        *_check_methods(domain),
        *_check_tasks(domain, problem),
        *_check_predicates(domain, problem),
        *_check_domain_name(domain, problem),
        *_check_objects(domain, problem),
    ]
    return sorted(remarks, key=lambda r: (r.source != domain.source.name, r.line, r.column))


def bound_by(condition: Condition) -> set[str]:
    """The variables that every solution of ``condition`` binds."""
    if isinstance(condition, Atom):
        return set(variables_of(condition))
    if isinstance(condition, Not):
        return set()
    parts = [bound_by(part) for part in condition.conditions]
    if isinstance(condition, And):
        return set().union(*parts)
    return set.intersection(*parts) if parts else set()


def _at(
    source: Source, node: Node, message: str, severity: Severity = Severity.ERROR
) -> Diagnostic:
    return source.diagnostic(node.start, node.end, message, severity)


def _unbound(source: Source, atom: Atom, bound: set[str], what: str) -> Iterator[Diagnostic]:
    for name in dict.fromkeys(variables_of(atom)):
        if name not in bound:
            message = f'{name} in {what} is bound by neither the head nor the preconditions'
            yield _at(source, atom.node, message + did_you_mean(name, bound))


def _check_operators(domain: Domain) -> Iterator[Diagnostic]:
    source = domain.source
    first: dict[str, Operator] = {}
    for operator in domain.operators:
        head = operator.head
        if head.name in first:
            line, column = source.position(first[head.name].head.node.start)
            message = f'operator {head.name} is already defined at line {line}, column {column}'
            yield _at(source, head.node, message)
        first.setdefault(head.name, operator)
        bound = set(variables_of(head)) | bound_by(operator.condition)
        for effect in (*operator.deletes, *operator.adds):
            yield from _unbound(source, effect, bound, 'an effect')
        if operator.geometric is not None:
            yield from _unbound_in_text(source, operator.geometric, bound)


def _unbound_in_text(
    source: Source, geometric: GeometricText, bound: set[str]
) -> Iterator[Diagnostic]:
    for match in VARIABLE.finditer(geometric.text):
        name = match.group()
        if name not in bound:
            start = geometric.node.start + match.start()
            message = (
                f'{name} in the geometric preconditions is bound by neither the head nor the '
                f'symbolic preconditions{did_you_mean(name, bound)}'
            )
            yield source.diagnostic(start, start + len(name), message)


def _check_methods(domain: Domain) -> Iterator[Diagnostic]:
    arities = _arities(domain)
    for method in domain.methods:
        head = set(variables_of(method.head))
        for branch in method.branches:
            bound = head | bound_by(branch.condition)
            for task in tasks_of(branch.tasks):
                yield from _unbound(domain.source, task, bound, 'a task')
            yield from _undefined(arities, domain.source, branch.tasks)


def _heads(domain: Domain) -> list[Atom]:
    return [o.head for o in domain.operators] + [m.head for m in domain.methods]


def _arities(domain: Domain) -> dict[str, set[int]]:
    arities: dict[str, set[int]] = {}
    for head in _heads(domain):
        arities.setdefault(head.name, set()).add(len(head.args))
    return arities


def _undefined(
    arities: dict[str, set[int]], source: Source, network: TaskNetwork
) -> Iterator[Diagnostic]:
    for task in tasks_of(network):
        kind = 'operator' if task.name.startswith('!') else 'method'
        if task.name not in arities:
            message = f'no {kind} is defined for {show(task)}{did_you_mean(task.name, arities)}'
            yield _at(source, task.node, message)
        elif len(task.args) not in arities[task.name]:
            wanted = ' or '.join(str(count) for count in sorted(arities[task.name]))
            message = f'{task.name} takes {wanted} arguments, not {len(task.args)}'
            yield _at(source, task.node, message)


def _check_tasks(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    yield from _undefined(_arities(domain), problem.source, problem.tasks)


def _conditions(domain: Domain) -> Iterator[Condition]:
    for operator in domain.operators:
        yield operator.condition
    for method in domain.methods:
        for branch in method.branches:
            yield branch.condition
    for axiom in domain.axioms:
        yield from axiom.bodies


def _check_predicates(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    """Predicates that nothing makes true, and predicates with differing numbers of arguments."""
    made = [(problem.source, fact) for fact in problem.facts]
    made += [(domain.source, effect) for op in domain.operators for effect in op.adds]
    made += [(domain.source, axiom.head) for axiom in domain.axioms]
    used = [
        (domain.source, atom, positive)
        for condition in _conditions(domain)
        for atom, positive in atoms_of(condition)
    ]
    used += [(problem.source, goal, True) for goal in problem.goals]
    used += [(domain.source, effect, False) for op in domain.operators for effect in op.deletes]
    arities: dict[str, set[int]] = {}
    for _, atom in made:
        arities.setdefault(atom.name, set()).add(len(atom.args))
    reported: set[tuple[str, int]] = set()
    for source, atom, positive in used:
        count = len(atom.args)
        known = arities.get(atom.name)
        if (atom.name, count) in reported or (known is None and not positive):
            continue
        if known is None:
            reported.add((atom.name, count))
            message = f'no fact or effect ever makes {show(atom)} true'
            yield _warning(source, atom, message + did_you_mean(atom.name, arities))
        elif count not in known:
            reported.add((atom.name, count))
            wanted = ' or '.join(str(number) for number in sorted(known))
            yield _warning(
                source, atom, f'{atom.name} has {wanted} arguments elsewhere, not {count}'
            )


def _warning(source: Source, atom: Atom, message: str) -> Diagnostic:
    return _at(source, atom.node, message, Severity.WARNING)


def _check_domain_name(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    node = problem.domain_node
    if node is not None and domain.name and domain.name != problem.domain_name:
        message = f'the problem is for domain {problem.domain_name}, the domain is {domain.name}'
        yield _at(problem.source, node, message)


def _symbols(node: Node) -> Iterator[Symbol]:
    if isinstance(node, Symbol):
        yield node
    else:
        for child in node.children:
            yield from _symbols(child)


def _arguments(nodes: Iterable[Node]) -> Iterator[Symbol]:
    """The symbols that stand behind the first element of the lists in ``nodes``."""
    for node in nodes:
        if isinstance(node, ListNode):
            yield from (child for child in node.children[1:] if isinstance(child, Symbol))
            yield from _arguments(node.children)


def _check_objects(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    """Objects of goals that no fact mentions: often misspelt.

    Only the goals ``(list (literal) ...)`` are looked at: elsewhere a new symbol may well be meant.
    """
    known = {symbol.text for fact in problem.facts for symbol in _symbols(fact.node)}
    labels = {symbol.text for symbol in _arguments(fact.node for fact in problem.facts)}
    for head in _heads(domain):
        known.update(symbol.text for symbol in _symbols(head.node))
    for symbol in _arguments(goal.node for goal in problem.goals):
        if symbol.text not in known and symbol.text.lower() != 'nil':
            message = f'{symbol.text} occurs in no fact of the initial state'
            hint = did_you_mean(symbol.text, labels)
            yield _at(problem.source, symbol, message + hint, Severity.WARNING)
