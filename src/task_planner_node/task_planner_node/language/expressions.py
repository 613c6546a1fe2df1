"""Terms, conditions and tasks: from nodes of the reader to the model."""

from __future__ import annotations

from collections.abc import Iterator

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.language.model import (
    And,
    Atom,
    Condition,
    Not,
    Or,
    Ordered,
    Pattern,
    TaskNetwork,
    Term,
    Unordered,
    Variable,
)
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.source import Source

UNSUPPORTED = frozenset(
    {'call', 'eval', 'assign', 'assign*', 'forall', 'exists', 'imply', 'setof', 'enforce', 'quote'}
    | {'first', ':first', 'sort-by', ':sort-by', ':immediate', ':protection', ':task'}
)
RESERVED_CHARACTERS = frozenset('\'`,"|#')


class Refused(Exception):
    """A form that is not in the language; the diagnostic says where and why."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


def refuse(source: Source, node: Node, message: str) -> Refused:
    """The error for ``node``."""
    return Refused(source.diagnostic(node.start, node.end, message, Severity.ERROR))


def is_nil(node: Node) -> bool:
    """Whether the node is ``nil`` or ``()``."""
    if isinstance(node, Symbol):
        return node.text.lower() == 'nil'
    return not node.children


def elements(source: Source, node: Node, what: str) -> list[Node]:
    """The children of a list that is expected as ``what``; none for nil."""
    if is_nil(node):
        return []
    if isinstance(node, Symbol):
        raise refuse(source, node, f'expected {what}, a list, and not the symbol {node.text}')
    return node.children


def read_term(source: Source, node: Node) -> Term:
    """Read one term; lists without variables become tuples."""
    if isinstance(node, Symbol):
        return _read_symbol(source, node)
    children = node.children
    tail: Variable | None = None
    if len(children) >= 2 and _is_dot(children[-2]):
        last = read_term(source, children[-1])
        if isinstance(last, Variable):
            tail = last
            children = children[:-2]
        elif last == ():
            children = children[:-2]
        else:
            raise refuse(source, children[-1], "only a variable or nil can stand behind a '.'")
    items = tuple(read_term(source, child) for child in children)
    if tail is None and not any(isinstance(item, (Variable, Pattern)) for item in items):
        return items
    if tail is not None and not items:
        return tail
    return Pattern(items, tail)


def _is_dot(node: Node) -> bool:
    return isinstance(node, Symbol) and node.text == '.'


def _read_symbol(source: Source, node: Symbol) -> Term:
    text = node.text
    if text == '.':
        raise refuse(source, node, "a '.' can only stand before the last element of a list")
    if not RESERVED_CHARACTERS.isdisjoint(text):
        raise refuse(
            source, node, f'{text} is no symbol: quotes, commas, | and # are not supported'
        )
    if text.lower() == 'nil':
        return ()
    if text.startswith('?'):
        return Variable(text)
    return text


def read_atom(source: Source, node: Node, what: str) -> Atom:
    """Read ``(name argument ...)``; ``what`` is said in errors, for example ``a task``."""
    if not isinstance(node, ListNode) or not node.children:
        raise refuse(source, node, f'expected {what}, such as (name argument ...)')
    name = node.children[0]
    if not isinstance(name, Symbol) or name.text.startswith('?') or is_nil(name):
        raise refuse(source, name, f'{what} begins with a name')
    if name.text.lower() in UNSUPPORTED:
        raise refuse(source, node, f'({name.text} ...) is not supported yet')
    if name.text.startswith(':'):
        raise refuse(source, node, f'{name.text} cannot stand here: expected {what}')
    _read_symbol(source, name)
    arguments = tuple(read_term(source, child) for child in node.children[1:])
    return Atom(name.text, arguments, node)


def read_condition(source: Source, node: Node) -> Condition:
    """Read a logical expression: a literal, a list of expressions, and, or, not."""
    if is_nil(node):
        return And(())
    if isinstance(node, Symbol):
        raise refuse(
            source, node, f'expected preconditions, a list, and not the symbol {node.text}'
        )
    word = first_word(node)
    if not word:
        return And(tuple(read_condition(source, child) for child in node.children))
    if word in ('and', 'or'):
        parts = tuple(read_condition(source, child) for child in node.children[1:])
        return And(parts) if word == 'and' else Or(parts)
    if word == 'not':
        if len(node.children) != 2:
            raise refuse(source, node, '(not ...) takes exactly one expression')
        return Not(read_condition(source, node.children[1]), node)
    return read_atom(source, node, 'a literal')


def read_tasks(source: Source, node: Node) -> TaskNetwork:
    """Read a task list: a list of tasks, (:ordered ...), (:unordered ...), nested, or one task."""
    if is_nil(node):
        return Ordered(())
    if isinstance(node, Symbol):
        raise refuse(source, node, f'expected tasks, a list, and not the symbol {node.text}')
    word = first_word(node)
    if word in (':ordered', ':unordered'):
        parts = tuple(read_tasks(source, child) for child in node.children[1:])
        return Ordered(parts) if word == ':ordered' else Unordered(parts)
    if word:
        return read_atom(source, node, 'a task')
    return Ordered(tuple(read_tasks(source, child) for child in node.children))


def tasks_of(network: TaskNetwork) -> Iterator[Atom]:
    """All tasks of a network in the order of the text."""
    if isinstance(network, Atom):
        yield network
    else:
        for item in network.items:
            yield from tasks_of(item)


def atoms_of(condition: Condition, positive: bool = True) -> Iterator[tuple[Atom, bool]]:
    """All literals of a condition, each with whether it has to hold."""
    if isinstance(condition, Atom):
        yield condition, positive
    elif isinstance(condition, Not):
        yield from atoms_of(condition.condition, not positive)
    else:
        for part in condition.conditions:
            yield from atoms_of(part, positive)


def variables_of(term: object) -> Iterator[str]:
    """The names of the variables of a term or an atom, in order, repeated ones repeated."""
    if isinstance(term, Variable):
        yield term.name
    elif isinstance(term, Atom):
        for argument in term.args:
            yield from variables_of(argument)
    elif isinstance(term, Pattern):
        for item in term.items:
            yield from variables_of(item)
        if term.tail is not None:
            yield term.tail.name
