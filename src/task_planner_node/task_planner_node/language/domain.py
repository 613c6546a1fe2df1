"""Reading a domain: operators of the paper and of SHOP2, methods and axioms."""

from __future__ import annotations

import math
import re

from task_planner_node.errors import Diagnostic, MissionError
from task_planner_node.language.expressions import (
    Refused,
    elements,
    is_nil,
    read_atom,
    read_condition,
    read_tasks,
    refuse,
)
from task_planner_node.language.model import (
    Atom,
    Axiom,
    Branch,
    Domain,
    GeometricText,
    Method,
    Operator,
)
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word, read
from task_planner_node.language.source import Source
from task_planner_node.language.suggestions import did_you_mean

FORMS = ('operator', ':operator', ':method', ':-', 'defdomain', 'defproblem')
PAPER_FIELDS = 'head, symbolic preconditions, geometric preconditions, symbolic effects'
SHOP_FIELDS = 'head, preconditions, delete list, add list and optionally a cost'
COMMENT = re.compile(r';[^\n]*')


def read_domain(source: Source) -> Domain:
    """Read ``(defdomain name (form ...))`` or bare forms; a defproblem in the same text is left alone.

    Raises MissionError with every definition that cannot be read.
    """
    name = ''
    forms: list[Node] = []
    errors: list[Diagnostic] = []
    seen = False
    for node in read(source):
        try:
            if first_word(node) == 'defdomain':
                if seen:
                    raise refuse(source, node, 'a text holds one domain: this is the second')
                seen = True
                name, inner = _read_defdomain(source, node)
                forms.extend(inner)
            elif first_word(node) != 'defproblem':
                forms.append(node)
        except Refused as refused:
            errors.append(refused.diagnostic)
    operators: list[Operator] = []
    methods: list[Method] = []
    axioms: list[Axiom] = []
    for form in forms:
        try:
            word = first_word(form)
            if word == 'operator':
                operators.append(_read_paper_operator(source, form))
            elif word == ':operator':
                operators.append(_read_shop_operator(source, form))
            elif word == ':method':
                methods.append(_read_method(source, form))
            elif word == ':-':
                axioms.append(_read_axiom(source, form))
            else:
                raise refuse(source, form, _unknown_form(word))
        except Refused as refused:
            errors.append(refused.diagnostic)
    if not errors and not operators and not methods and not seen:
        errors.append(
            Diagnostic('the domain defines no operator and no method', source=source.name)
        )
    if errors:
        raise MissionError(errors)
    return Domain(source, name, tuple(operators), tuple(methods), tuple(axioms))


def _unknown_form(word: str) -> str:
    if word == ':op':
        return '(:op ...) is not supported yet: use (:operator ...)'
    if not word:
        return 'expected a definition: (Operator ...), (:operator ...), (:method ...) or (:- ...)'
    return f'unknown form ({word} ...)' + did_you_mean(word, FORMS)


def _children(node: Node) -> list[Node]:
    return node.children if isinstance(node, ListNode) else []


def _read_defdomain(source: Source, node: Node) -> tuple[str, list[Node]]:
    children = _children(node)
    if len(children) != 3 or not isinstance(children[1], Symbol):
        raise refuse(source, node, 'a domain is written (defdomain name (definition ...))')
    return children[1].text, elements(source, children[2], 'the definitions of the domain')


def _read_head(source: Source, node: Node, operator: bool) -> Atom:
    head = read_atom(source, node, 'a head')
    if operator and not head.name.startswith('!'):
        raise refuse(source, node, f"the name of an operator begins with '!': !{head.name}")
    if not operator and head.name.startswith('!'):
        raise refuse(source, node, f'{head.name} names an operator: a method cannot define it')
    return head


def _read_paper_operator(source: Source, node: Node) -> Operator:
    fields = _children(node)[1:]
    if len(fields) not in (4, 6):
        raise refuse(
            source,
            node,
            f'an Operator has 4 fields ({PAPER_FIELDS}), or 6 with behaviour constraints before and '
            f'a reference to geometric effects after the effects; this one has {len(fields)}',
        )
    head = _read_head(source, fields[0], operator=True)
    condition = read_condition(source, fields[1])
    geometric = _read_geometric(source, fields[2])
    if len(fields) == 6:
        for field, what in ((fields[3], 'behaviour constraints'), (fields[5], 'geometric effects')):
            if not is_nil(field):
                raise refuse(source, field, f'{what} are not supported yet: leave the field empty')
    effects = fields[3] if len(fields) == 4 else fields[4]
    adds: list[Atom] = []
    deletes: list[Atom] = []
    for effect in elements(source, effects, 'the symbolic effects'):
        if first_word(effect) == 'not':
            children = _children(effect)
            if len(children) != 2:
                raise refuse(source, effect, '(not ...) takes exactly one literal')
            deletes.append(read_atom(source, children[1], 'a literal'))
        else:
            adds.append(read_atom(source, effect, 'a literal'))
    return Operator(head, condition, geometric, tuple(deletes), tuple(adds))


def _read_geometric(source: Source, node: Node) -> GeometricText | None:
    if is_nil(node):
        return None
    if not isinstance(node, ListNode):
        raise refuse(source, node, 'expected geometric preconditions, a list')
    raw = source.text[node.start : node.end]
    text = COMMENT.sub(lambda comment: ' ' * len(comment.group()), raw)
    return GeometricText(text, node)


def _read_shop_operator(source: Source, node: Node) -> Operator:
    fields = _children(node)[1:]
    if len(fields) not in (4, 5):
        count = f'this one has {len(fields)} fields'
        raise refuse(source, node, f'an :operator has {SHOP_FIELDS}; {count}')
    head = _read_head(source, fields[0], operator=True)
    condition = read_condition(source, fields[1])
    deletes, adds = (
        tuple(read_atom(source, effect, 'a literal') for effect in elements(source, field, what))
        for field, what in ((fields[2], 'the delete list'), (fields[3], 'the add list'))
    )
    cost = _read_cost(source, fields[4]) if len(fields) == 5 else 1.0
    return Operator(head, condition, None, deletes, adds, cost)


def _read_cost(source: Source, node: Node) -> float:
    if isinstance(node, Symbol):
        try:
            cost = float(node.text)
        except ValueError:
            cost = math.nan
        if math.isfinite(cost) and cost >= 0:
            return cost
    raise refuse(source, node, 'the cost of an operator is a finite number, not negative')


def _read_method(source: Source, node: Node) -> Method:
    fields = _children(node)[1:]
    if not fields:
        raise refuse(
            source, node, 'a method is written (:method head [name] preconditions tasks ...)'
        )
    head = _read_head(source, fields[0], operator=False)
    branches: list[Branch] = []
    rest = fields[1:]
    while rest:
        name = ''
        first = rest[0]
        if isinstance(first, Symbol) and not is_nil(first):
            name = first.text
            rest = rest[1:]
        if len(rest) < 2:
            raise refuse(source, rest[0] if rest else first, 'a branch has preconditions and tasks')
        branches.append(Branch(name, read_condition(source, rest[0]), read_tasks(source, rest[1])))
        rest = rest[2:]
    if not branches:
        raise refuse(source, node, 'a method needs preconditions and tasks: () () for none')
    return Method(head, tuple(branches))


def _read_axiom(source: Source, node: Node) -> Axiom:
    fields = _children(node)[1:]
    if not fields:
        raise refuse(source, node, 'an axiom is written (:- head body ...)')
    head = _read_head(source, fields[0], operator=False)
    bodies = [field for field in fields[1:] if isinstance(field, ListNode) or is_nil(field)]
    if not bodies:
        raise refuse(source, node, 'an axiom needs a body: () when it always holds')
    return Axiom(head, tuple(read_condition(source, body) for body in bodies))
