"""Terms, and the expressions in ``call``, ``eval``, ``assign``, costs and sorting: from nodes to the model."""

from __future__ import annotations

import re
from typing import Any

from task_planner_node.language.functions.evaluation import FORMS, HIGHER
from task_planner_node.language.functions.library import FUNCTIONS
from task_planner_node.language.model import (
    Application,
    Atom,
    Dotted,
    Pattern,
    Term,
    Variable,
    chain,
)
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, is_nil
from task_planner_node.language.suggestions import did_you_mean

NUMBER = re.compile(r'[+-]?(\d+\.?|\d*\.\d+(e[+-]?\d+)?|\d+\.?e[+-]?\d+)', re.IGNORECASE)
MAX_DIGITS = 300
RESERVED_CHARACTERS = frozenset('|#\\')
CONSTANTS: dict[str, int] = {'most-positive-fixnum': 2**62 - 1, 'most-negative-fixnum': -(2**62)}
#: Tests of equality that may stand behind ``:test``; there is only one equality here.
EQUALITIES = frozenset({'eq', 'eql', 'equal', 'equalp'})
NOT_LISP = 'Lisp is not evaluated: docs/htn.md lists the functions and says how to register one'


def read_term(reading: Reading, node: Node) -> Term:
    """Read one term; what has no variables and no calls in it is ground."""
    if isinstance(node, Symbol):
        return _read_symbol(reading, node)
    word = first_word(node)
    if word in ('call', 'eval', 'comma'):
        return read_expression(reading, node)
    if word in ('quote', 'backquote'):
        return read_term(reading, _only(reading, node))
    if word in ('function', 'comma-at'):
        raise reading.refuse(node, f'{word} cannot stand here')
    return _read_list(reading, node)


def _only(reading: Reading, node: ListNode) -> Node:
    if len(node.children) != 2:
        raise reading.refuse(node, f'({first_word(node)} ...) takes exactly one expression')
    return node.children[1]


def _read_list(reading: Reading, node: ListNode) -> Term:
    children = node.children
    tail: Term = ()
    if len(children) >= 2 and _is_dot(children[-2]):
        if len(children) == 2:
            raise reading.refuse(children[0], "an element has to stand before the '.'")
        tail = read_term(reading, children[-1])
        children = children[:-2]
    return make_list(tuple(read_term(reading, child) for child in children), tail)


def make_list(items: tuple[Any, ...], tail: Term = ()) -> Term:
    """The list of terms before a tail: ground if they all are."""
    if isinstance(tail, Pattern):
        items, tail = items + tail.items, () if tail.tail is None else tail.tail
    elif isinstance(tail, tuple):
        items, tail = items + tail, ()
    elif isinstance(tail, Dotted):
        items, tail = items + tail.items, tail.tail
    if isinstance(tail, (Variable, Application)):
        return Pattern(items, tail)
    if any(isinstance(item, (Variable, Pattern, Application)) for item in items):
        return Pattern(items, None if isinstance(tail, tuple) else tail)
    return chain(items, tail)


def _is_dot(node: Node) -> bool:
    return isinstance(node, Symbol) and node.text == '.'


def _read_symbol(reading: Reading, node: Symbol) -> Term:
    text = node.text
    if text.startswith('"'):
        return text
    if text == '.':
        raise reading.refuse(node, "a '.' can only stand before the last element of a list")
    if text.startswith('?'):
        _refuse_reserved(reading, node)
        return reading.variable(text)
    if NUMBER.fullmatch(text):
        return _read_number(reading, node)
    return () if text.lower() == 'nil' else read_name(reading, node)


def _read_number(reading: Reading, node: Symbol) -> int | float:
    text = node.text.rstrip('.')
    if len(text) <= MAX_DIGITS:
        if text.lstrip('+-').isdigit():
            return int(text)
        value = float(text)
        if abs(value) != float('inf'):
            return value
    raise reading.refuse(node, 'this number is too large')


def read_name(reading: Reading, node: Symbol) -> str:
    """The name that a symbol is, in its first spelling and without the name of a Lisp package."""
    known = reading.names.get(node.text)
    if known is not None:
        return known
    _refuse_reserved(reading, node)
    text = node.text
    if '::' in text:
        text = text.rsplit('::', 1)[1] or text
    name = reading.names[node.text] = reading.spelling.of(text)
    return name


def _refuse_reserved(reading: Reading, node: Symbol) -> None:
    text = node.text.removeprefix('#:')
    if not text or not RESERVED_CHARACTERS.isdisjoint(text):
        raise reading.refuse(node, f'{node.text} is no symbol: |, # and \\ are not supported')
    node.text = text


def read_atom(reading: Reading, node: Node, what: str) -> Atom:
    """Read ``(name argument ...)``; ``what`` is said in errors, for example ``a task``."""
    if not isinstance(node, ListNode) or not node.children:
        raise reading.refuse(node, f'expected {what}, such as (name argument ...)')
    name = node.children[0]
    if not isinstance(name, Symbol) or is_nil(name) or name.text[0] in '?"':
        raise reading.refuse(name, f'{what} begins with a name')
    if NUMBER.fullmatch(name.text) or name.text == '.':
        raise reading.refuse(name, f'{what} begins with a name, and not with {name.text}')
    for child in node.children[1:]:
        if _is_dot(child):
            raise reading.refuse(child, f"{what} has a fixed number of arguments: no '.' here")
    terms = tuple(read_term(reading, child) for child in node.children[1:])
    return Atom(read_name(reading, name), terms, node)


def read_expression(reading: Reading, node: Node) -> Term:
    """Read what is computed: a constant, a variable, ``(quote term)``, or a function and its arguments."""
    if isinstance(node, Symbol):
        text = node.text.lower()
        if text in CONSTANTS:
            return CONSTANTS[text]
        if len(text) > 2 and text[0] == text[-1] == '*':
            raise reading.refuse(node, f'{node.text} is a variable of Lisp: {NOT_LISP}')
        return _read_symbol(reading, node)
    if is_nil(node):
        return ()
    word = first_word(node)
    if word in ('quote', 'backquote'):
        return read_term(reading, _only(reading, node))
    if word == 'comma' or (word == 'eval' and len(node.children) == 2):
        return read_expression(reading, _only(reading, node))
    if word in ('call', 'eval', 'funcall'):
        return _read_application(reading, ListNode(node.children[1:], node.start, node.end))
    return _read_application(reading, node)


def _read_application(reading: Reading, node: ListNode) -> Term:
    if not node.children:
        raise reading.refuse(node, 'the name of a function is missing')
    name = read_function(reading, node.children[0])
    if name in HIGHER:
        return _read_higher(reading, node, name)
    children = _without_test(node.children[1:])
    least, most = FORMS.get(name, (0, None))
    if name in FUNCTIONS:
        least, most = FUNCTIONS[name].least, FUNCTIONS[name].most
    _check_count(reading, node, name, len(children), least, most)
    return Application(name, tuple(read_expression(reading, child) for child in children), node)


def _without_test(children: list[Node]) -> list[Node]:
    """The arguments without ``:test #'equal``."""
    if len(children) >= 2:
        word, test = children[-2:]
        inner = test.children[-1] if isinstance(test, ListNode) and test.children else test
        texts = [part.text.lower() if isinstance(part, Symbol) else '' for part in (word, inner)]
        if texts[0] == ':test' and texts[1] in EQUALITIES:
            return children[:-2]
    return children


def _read_higher(reading: Reading, node: ListNode, name: str) -> Term:
    arguments = node.children[1:]
    least, most = HIGHER[name]
    _check_count(reading, node, name, len(arguments), least, most)
    if name == 'sort':
        arguments = [arguments[1], arguments[0]]
    function = read_function(reading, arguments[0])
    if function not in FUNCTIONS:
        raise reading.refuse(arguments[0], f'{function} cannot be passed to {name}')
    terms = tuple(read_expression(reading, child) for child in arguments[1:])
    return Application(name, (function, *terms), node)


def _check_count(
    reading: Reading, node: Node, name: str, count: int, least: int, most: int | None
) -> None:
    if count < least or (most is not None and count > most):
        wanted = str(least) if least == most else f'at least {least}' if most is None else None
        message = f'{name} takes {wanted or f"{least} to {most}"} arguments, not {count}'
        raise reading.refuse(node, message)


def read_function(reading: Reading, node: Node) -> str:
    """The name of a known function: bare, quoted, or behind ``#'``; raises Refused for anything else."""
    word = first_word(node)
    if word in ('function', 'quote') and isinstance(node, ListNode):
        node = _only(reading, node)
    if not isinstance(node, Symbol) or node.text[0] in '?"':
        what = f'({word} ...)' if word else 'this'
        raise reading.refuse(node, f'{what} is no function: {NOT_LISP}')
    name = node.text.lower().rsplit('::', 1)[-1]
    if name in FUNCTIONS or name in FORMS or name in HIGHER:
        return name
    hint = did_you_mean(name, [*FUNCTIONS, *FORMS, *HIGHER]) or f'. {NOT_LISP}'
    raise reading.refuse(node, f'{node.text} is no function of a domain{hint}')
