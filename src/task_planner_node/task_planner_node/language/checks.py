"""What can be said about a mission before it is searched: undefined names, wrong arities, unbound variables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import islice

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.language.bindings import check_bindings
from task_planner_node.language.model import Atom, Condition, Domain, Operator, Problem, show
from task_planner_node.language.reader import ListNode, Node, Symbol
from task_planner_node.language.singletons import check_singletons
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.walk import atoms_of, conditions_in, facts_of, is_open, tasks_of

#: More of one kind nobody reads.
MOST_REMARKS = 100


def check_mission(domain: Domain, problem: Problem) -> list[Diagnostic]:
    """The errors and warnings of a mission, in the order of the texts, the domain's first.

    Of each kind there are at most MOST_REMARKS.
    """
    checks = (
        _check_operators(domain),
        check_bindings(domain),
        check_singletons(domain),
        _check_tasks(domain, problem),
        _check_predicates(domain, problem),
        _check_domain_name(domain, problem),
        _check_objects(domain, problem),
    )
    remarks = [*domain.remarks, *problem.remarks]
    for check in checks:
        remarks += islice(check, MOST_REMARKS)
    order = {domain.source.name: 0}
    return sorted(dict.fromkeys(remarks), key=lambda r: (order.get(r.source, 1), r.line, r.column))


def _at(
    source: Source, node: Node, message: str, severity: Severity = Severity.ERROR
) -> Diagnostic:
    return source.diagnostic(node.start, node.end, message, severity)


def _warning(source: Source, atom: Atom, message: str) -> Diagnostic:
    return _at(source, atom.node, message, Severity.WARNING)


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


def _heads(domain: Domain) -> list[Atom]:
    return [o.head for o in domain.operators] + [m.head for m in domain.methods]


def _check_tasks(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    arities: dict[str, set[int]] = {}
    for head in _heads(domain):
        arities.setdefault(head.name, set()).add(len(head.args))
    for name, count in domain.declared:
        arities.setdefault(name, set()).add(count)
    intact = {
        method.head.name
        for method in domain.methods
        for branch in method.branches
        if all(len(task.args) in arities.get(task.name, ()) for task in tasks_of(branch.tasks))
    }
    for task in tasks_of(problem.tasks):
        message, hint = _fault(task, arities)
        if message:
            yield _at(problem.source, task.node, message + hint)
    hints: dict[str, str] = {}
    useless: list[tuple[Atom, str]] = []
    for method in domain.methods:
        for branch in method.branches:
            for task in tasks_of(branch.tasks):
                message, hint = _fault(task, arities, hints)
                if message and (hint or method.head.name not in intact):
                    yield _at(domain.source, task.node, message + hint)
                elif message:
                    useless.append((task, message))
    for task, message in useless:
        yield _warning(domain.source, task, f'{message}: this branch leads nowhere')


def _fault(
    task: Atom, arities: dict[str, set[int]], hints: dict[str, str] | None = None
) -> tuple[str, str]:
    """What is wrong with a task, and which one may have been meant; empty if nothing is.

    In a method it is an error if another task was probably meant, or if the method's task cannot be done
    without it.  Otherwise it makes one branch useless.  ``hints`` remembers what was meant by a name; beyond
    MOST_REMARKS names it is not looked for.
    """
    if task.name not in arities:
        kind = 'operator' if task.name.startswith('!') else 'method'
        hints = {} if hints is None else hints
        if task.name not in hints and len(hints) < MOST_REMARKS:
            hints[task.name] = did_you_mean(task.name, arities)
        return f'no {kind} is defined for {show(task)}', hints.get(task.name, '')
    if len(task.args) not in arities[task.name]:
        wanted = ' or '.join(str(count) for count in sorted(arities[task.name]))
        return f'{task.name} takes {wanted} arguments, not {len(task.args)}', ''
    return '', ''


def _conditions(domain: Domain) -> Iterator[Condition]:
    for operator in domain.operators:
        yield operator.condition
        yield from conditions_in((*operator.deletes, *operator.adds))
    for method in domain.methods:
        for branch in method.branches:
            yield branch.condition
    for axiom in domain.axioms:
        yield from axiom.bodies


def _check_predicates(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    """Predicates that nothing makes true, and predicates with differing numbers of arguments."""
    made = [(problem.source, fact) for fact in problem.facts]
    made += [(domain.source, fact) for op in domain.operators for fact in facts_of(op.adds)]
    made += [(domain.source, axiom.head) for axiom in domain.axioms]
    used = [
        (domain.source, atom, positive)
        for condition in _conditions(domain)
        for atom, positive in atoms_of(condition)
    ]
    for condition in (problem.precondition, problem.goal):
        used += [(problem.source, atom, positive) for atom, positive in atoms_of(condition)]
    used += [(problem.source, goal, True) for goal in problem.goals]
    used += [
        (domain.source, fact, False) for op in domain.operators for fact in facts_of(op.deletes)
    ]
    anything = any(is_open(operator.adds) for operator in domain.operators)
    arities: dict[str, set[int]] = {}
    for _, atom in made:
        arities.setdefault(atom.name, set()).add(len(atom.args))
    reported: set[tuple[str, int]] = set()
    for source, atom, positive in used:
        count = len(atom.args)
        known = arities.get(atom.name)
        if (atom.name, count) in reported or (known is None and (anything or not positive)):
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


def _check_domain_name(domain: Domain, problem: Problem) -> Iterator[Diagnostic]:
    node = problem.domain_node
    if node is not None and domain.name and domain.name != problem.domain_name:
        message = f'the problem is for domain {problem.domain_name}, the domain is {domain.name}'
        severity = Severity.WARNING if domain.typed else Severity.ERROR
        yield _at(problem.source, node, message, severity)


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
    known = {symbol.text.lower() for fact in problem.facts for symbol in _symbols(fact.node)}
    known |= {arg.lower() for fact in problem.facts for arg in fact.args if isinstance(arg, str)}
    labels = {symbol.text for symbol in _arguments(fact.node for fact in problem.facts)}
    for head in _heads(domain):
        known.update(symbol.text.lower() for symbol in _symbols(head.node))
    for symbol in _arguments(goal.node for goal in problem.goals):
        if symbol.text.lower() not in known and symbol.text.lower() != 'nil':
            message = f'{symbol.text} occurs in no fact of the initial state'
            hint = did_you_mean(symbol.text, labels)
            yield _at(problem.source, symbol, message + hint, Severity.WARNING)
