"""Operators: the paper's form, SHOP's ``:operator`` and SHOP3's ``:op``, from nodes to the model."""

from __future__ import annotations

import re

from task_planner_node.language.conditions import read_condition
from task_planner_node.language.effects import read_effects, read_signed_effects
from task_planner_node.language.model import NOTHING, Atom, GeometricText, Operator, Term
from task_planner_node.language.reader import MARKS, ListNode, Node, Symbol, unmarked
from task_planner_node.language.reading import Reading, is_nil
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import NUMBER, read_atom, read_expression

PAPER_FIELDS = 'head, symbolic preconditions, geometric preconditions, symbolic effects'
SHOP_FIELDS = 'head, preconditions, delete list, add list and optionally a cost'
KEYWORDS = (
    ':precond',
    ':geometric',
    ':behaviour',
    ':delete',
    ':add',
    ':geometric-effects',
    ':cost',
)
SPELLINGS = {':precondition': ':precond', ':preconditions': ':precond', ':behavior': ':behaviour'}
COMMENT = re.compile(r';[^\n]*|#\|.*?\|#', re.DOTALL)
#: A variable in geometric text: a hyphen belongs to it only before a letter.
VARIABLE = re.compile(r'\?[A-Za-z_][A-Za-z0-9_]*(?:-[A-Za-z][A-Za-z0-9_]*)*')


def read_head(reading: Reading, node: Node, operator: bool) -> Atom:
    """Read the head of an operator, or else that of a method or an axiom."""
    head = read_atom(reading, node, 'a head')
    if operator and not head.name.startswith('!'):
        message = f"the name of an operator begins with '!': !{head.name}"
        raise reading.refuse(node, message)
    if not operator and head.name.startswith('!'):
        message = f'{head.name} names an operator: a method cannot define it'
        raise reading.refuse(node, message)
    return head


def read_paper_operator(reading: Reading, node: ListNode) -> Operator:
    """Read ``(Operator head symbolic geometric [behaviour] effects [reference])``, marks still in it."""
    fields = _unmarked_but(reading, node, (2, 3, 5) if len(node.children) == 7 else (2,))
    if len(fields) not in (4, 6):
        raise reading.refuse(
            node,
            f'an Operator has 4 fields ({PAPER_FIELDS}), or 6 with behaviour constraints before and '
            f'a reference to geometric effects after the effects; this one has {len(fields)}',
        )
    head = read_head(reading, fields[0], operator=True)
    condition = read_condition(reading, fields[1])
    geometric = _read_geometric(reading, fields[2], 'geometric preconditions')
    behaviour = reference = None
    effects = fields[3]
    if len(fields) == 6:
        behaviour = _read_geometric(reading, fields[3], 'behaviour constraints')
        effects = fields[4]
        reference = _read_geometric(reading, fields[5], 'a reference to geometric effects')
    deletes, adds = read_signed_effects(reading, effects, 'the symbolic effects')
    return Operator(
        head, condition, geometric, deletes, adds, behaviour=behaviour, reference=reference
    )


def _unmarked_but(reading: Reading, node: ListNode, geometric: tuple[int, ...]) -> list[Node]:
    """The fields behind the first word, marks joined except in the geometric ones."""
    fields: list[Node] = []
    plain = [child for i, child in enumerate(node.children[1:]) if i not in geometric]
    joined = iter(unmarked(reading.source, plain))
    for i, child in enumerate(node.children[1:]):
        fields.append(child if i in geometric else next(joined, child))
    return fields


def _read_geometric(reading: Reading, node: Node, what: str) -> GeometricText | None:
    if is_nil(node):
        return None
    if not isinstance(node, ListNode):
        raise reading.refuse(node, f'expected {what}, a list')
    raw = reading.source.text[node.start : node.end]
    text = COMMENT.sub(_blank, raw)
    return GeometricText(VARIABLE.sub(lambda name: reading.spelling.of(name.group()), text), node)


def _blank(comment: re.Match[str]) -> str:
    return ''.join('\n' if character == '\n' else ' ' for character in comment.group())


def read_shop_operator(reading: Reading, node: ListNode) -> Operator:
    """Read ``(:operator head [preconditions] delete-list add-list [cost])``.

    Without preconditions, as in SHOP 1, a cost has to be a number.
    """
    fields = node.children[1:]
    count = len(fields)
    if count == 3 or (count == 4 and _is_number(fields[3])):
        fields = [fields[0], ListNode([], node.start, node.start), *fields[1:]]
    if len(fields) not in (4, 5):
        message = f'an :operator has {SHOP_FIELDS}; this one has {count} fields'
        raise reading.refuse(node, message)
    head = read_head(reading, fields[0], operator=True)
    condition = read_condition(reading, fields[1])
    deletes = read_effects(reading, fields[2], 'the delete list')
    adds = read_effects(reading, fields[3], 'the add list')
    cost = read_cost(reading, fields[4]) if len(fields) == 5 else 1.0
    return Operator(head, condition, None, deletes, adds, cost)


def _is_number(node: Node) -> bool:
    return isinstance(node, Symbol) and NUMBER.fullmatch(node.text) is not None


def read_op(reading: Reading, node: ListNode) -> Operator:
    """Read ``(:op head keyword field ...)``, marks still in it: the fields of Definition 1 by name, in any order."""
    fields = _fields_by_name(reading, node)
    if len(node.children) < 2:
        raise reading.refuse(node, 'an :op has a head')
    head = read_head(reading, unmarked(reading.source, node.children[1:2])[0], operator=True)

    def field(name: str) -> Node | None:
        return unmarked(reading.source, fields[name])[0] if name in fields else None

    condition, delete, add, cost = (field(k) for k in (':precond', ':delete', ':add', ':cost'))
    geometric = {
        name: _read_geometric(reading, fields[name][0], what) if name in fields else None
        for name, what in (
            (':geometric', 'geometric preconditions'),
            (':behaviour', 'behaviour constraints'),
            (':geometric-effects', 'a reference to geometric effects'),
        )
    }
    return Operator(
        head,
        NOTHING if condition is None else read_condition(reading, condition),
        geometric[':geometric'],
        () if delete is None else read_effects(reading, delete, 'the delete list'),
        () if add is None else read_effects(reading, add, 'the add list'),
        1.0 if cost is None else read_cost(reading, cost),
        geometric[':behaviour'],
        geometric[':geometric-effects'],
    )


def _fields_by_name(reading: Reading, node: ListNode) -> dict[str, list[Node]]:
    """The fields behind the head by keyword, each with the marks before it."""
    fields: dict[str, list[Node]] = {}
    name = ''
    marks: list[Node] = []
    for child in node.children[2:]:
        word = child.text.lower() if isinstance(child, Symbol) else ''
        if name and word in MARKS:
            marks.append(child)
        elif name:
            fields[name] = [*marks, child]
            name, marks = '', []
        else:
            name = SPELLINGS.get(word, word)
            if name not in KEYWORDS:
                text = reading.source.excerpt(child.start, child.end)
                hint = did_you_mean(word, KEYWORDS)
                raise reading.refuse(child, f'{text} is no keyword of an :op{hint}')
            if name in fields:
                raise reading.refuse(child, f'{word} is given twice')
    if name:
        raise reading.refuse(node, f'nothing stands behind {name}')
    return fields


def read_cost(reading: Reading, node: Node) -> Term:
    """Read a cost: a number that is not negative, or an expression."""
    cost = read_expression(reading, node)
    if isinstance(cost, (str, tuple)) or (isinstance(cost, (int, float)) and cost < 0):
        raise reading.refuse(node, 'the cost of an operator is a number, not negative')
    return cost


def variables_in(text: str) -> list[tuple[str, int]]:
    """The variables in geometric text, each with its offset."""
    return [(match.group(), match.start()) for match in VARIABLE.finditer(text)]


def geometric_fields(operator: Operator) -> list[tuple[GeometricText, str]]:
    """The geometric fields that an operator has, each with its name."""
    fields = (
        (operator.geometric, 'the geometric preconditions'),
        (operator.behaviour, 'the behaviour constraints'),
        (operator.reference, 'the reference to geometric effects'),
    )
    return [(field, what) for field, what in fields if field is not None]
