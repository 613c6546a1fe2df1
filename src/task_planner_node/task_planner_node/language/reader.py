"""S-expressions with the position of every node: the reader below the mission language."""

from __future__ import annotations

import re
from dataclasses import dataclass

from task_planner_node.errors import MissionError
from task_planner_node.language.source import Source

MAX_DEPTH = 200
MAX_NODES = 2_000_000
DOMAIN_WORDS = frozenset({'defdomain', 'defproblem', 'make-problem', 'define'})
DEFINITION_WORDS = frozenset({'operator', ':operator', ':op', ':method', ':-'})
#: Lisp that stands around domains and problems in files for SHOP: never evaluated.
LISP_WORDS = frozenset(
    {'in-package', 'defpackage', 'use-package', 'require', 'load', 'declaim', 'export', 'import'}
    | {'defun', 'defmacro', 'defmethod', 'defgeneric', 'defclass', 'defstruct', 'defvar'}
    | {'defparameter', 'defconstant', 'eval-when', 'let', 'let*', 'progn', 'setf', 'setq'}
    | {
        'find-plans',
        'find-plans-stack',
        'def-problem-set',
        'make-problem-set',
        'do-problems',
        'shop-trace',
        'print',
    }
)
#: Marks that change what stands behind them, and the word that each of them abbreviates.
MARKS = {"'": 'quote', '`': 'backquote', ',': 'comma', ',@': 'comma-at', "#'": 'function'}
SKIPPING = frozenset({'#.', '#+', '#-'})
MAX_MARKS = 8

_TOKEN = re.compile(
    r"""\s*(?:;[^\n]*|(?P<block>\#\|)|(?P<open>\()|(?P<close>\))
    |(?P<mark>'|`|,@|,|\#'|\#\.|\#\+|\#-)
    |(?P<string>"(?:[^"\\]|\\.)*"?)
    |(?P<symbol>(?:\#\\.|\\.|\|[^|]*\||[^\s()"';`,|\\])+|[|\\])|$)""",
    re.VERBOSE | re.DOTALL,
)
_BLOCK = re.compile(r'\#\||\|\#')


@dataclass(slots=True)
class Symbol:
    """A word, a string with its quotes, or a mark; ``start`` and ``end`` are offsets into the source."""

    text: str
    start: int
    end: int


@dataclass(slots=True)
class ListNode:
    """A parenthesised list from its opening parenthesis at ``start`` to ``end``, exclusive."""

    children: list[Node]
    start: int
    end: int


Node = Symbol | ListNode


def first_word(node: Node) -> str:
    """The first symbol of a list in lower case, or an empty text."""
    if isinstance(node, ListNode) and node.children:
        first = node.children[0]
        if isinstance(first, Symbol):
            return first.text.lower()
    return ''


def read(source: Source) -> list[Node]:
    """Read all top-level expressions of ``source``; marks such as a quote are symbols, see unmarked().

    Raises MissionError for parentheses, strings and block comments that do not end, nesting beyond MAX_DEPTH and more
    than MAX_NODES words.
    """
    top: list[Node] = []
    stack: list[ListNode] = []
    definitions: list[ListNode] = []
    text = source.text
    place = count = 0
    while place < len(text):
        token = _TOKEN.match(text, place)
        kind = token.lastgroup if token else None
        if token is None or kind is None:
            place = token.end() if token else place + 1
            continue
        start, place = token.span(kind)
        count += 1
        if count > MAX_NODES:
            raise _error(source, start, place, f'more than {MAX_NODES} words and parentheses')
        if kind == 'block':
            place = _end_of_comment(source, start)
        elif kind == 'open':
            if len(stack) == MAX_DEPTH:
                raise _error(source, start, place, f'lists nest deeper than {MAX_DEPTH}')
            node = ListNode([], start, place)
            (stack[-1].children if stack else top).append(node)
            stack.append(node)
        elif kind == 'close':
            if not stack:
                raise _error(source, start, place, _stray(source, top))
            stack.pop().end = place
        else:
            if kind == 'string' and (place - start < 2 or text[place - 1] != '"'):
                raise _error(source, start, place, 'the string that begins here does not end')
            symbol = Symbol(text[start:place], start, place)
            if not stack:
                top.append(symbol)
                continue
            children = stack[-1].children
            children.append(symbol)
            if len(children) == 1 and symbol.text.lower() in DEFINITION_WORDS | DOMAIN_WORDS:
                _refuse_nested(source, stack)
                definitions.append(stack[-1])
    if stack:
        raise _unclosed(source, stack, definitions)
    return top


def _end_of_comment(source: Source, start: int) -> int:
    """Where the comment ``#| ... |#`` that begins at ``start`` ends; such comments nest."""
    depth = 0
    for mark in _BLOCK.finditer(source.text, start):
        depth += 1 if mark.group() == '#|' else -1
        if depth == 0:
            return mark.end()
    raise _error(
        source, start, start + 2, 'the comment that begins here does not end: |# is missing'
    )


def unmarked(source: Source, nodes: list[Node]) -> list[Node]:
    """The nodes with every mark joined to what stands behind it: ``'x`` becomes ``(quote x)``.

    ``#.x`` becomes x, ``#+`` drops the two nodes behind it and ``#-`` the first of them.  Raises MissionError
    for a mark with nothing behind it and for more than MAX_MARKS marks in a row.
    """
    if not source.has_marks:
        return nodes
    done: list[Node] = []
    marks = 0
    for node in reversed(nodes):
        if isinstance(node, ListNode):
            done.append(ListNode(unmarked(source, node.children), node.start, node.end))
            marks = 0
            continue
        if node.text not in MARKS and node.text not in SKIPPING:
            done.append(node)
            marks = 0
            continue
        marks += 1
        wanted = 2 if node.text in ('#+', '#-') else 1
        if len(done) < wanted:
            raise _error(source, node.start, node.end, f'nothing stands behind {node.text}')
        if marks > MAX_MARKS:
            raise _error(source, node.start, node.end, f'more than {MAX_MARKS} marks in a row')
        if node.text in ('#+', '#-'):
            done.pop()
            if node.text == '#+':
                done.pop()
        elif node.text != '#.':
            behind = done.pop()
            word = Symbol(MARKS[node.text], node.start, node.end)
            done.append(ListNode([word, behind], node.start, behind.end))
    return done[::-1]


def _refuse_nested(source: Source, stack: list[ListNode]) -> None:
    """A definition that begins inside another one: the outer one lacks a parenthesis."""
    inner = stack[-1]
    outer = next((node for node in stack[:-1] if first_word(node) in DEFINITION_WORDS), None)
    if outer is None and first_word(inner) in DOMAIN_WORDS and len(stack) > 1:
        around = next((n for n in stack[:-1] if first_word(n) in DOMAIN_WORDS), stack[0])
        outer = None if first_word(around) in LISP_WORDS else around
    if outer is not None:
        line, _ = source.position(inner.start)
        message = f'{_name(outer)} is not closed before {_name(inner)} on line {line}'
        raise _error(source, outer.start, inner.start, message + ": a ')' is missing")


def _unclosed(source: Source, stack: list[ListNode], definitions: list[ListNode]) -> MissionError:
    open_definitions = [node for node in stack if first_word(node) in DEFINITION_WORDS]
    if open_definitions:
        culprit = open_definitions[-1]
    else:
        odd = [
            node
            for node in definitions
            if first_word(node) == 'operator' and len(node.children) not in (5, 7)
        ]
        culprit = odd[-1] if odd else stack[0]
    missing = 'a parenthesis is' if len(stack) == 1 else f'{len(stack)} parentheses are'
    message = f'{_name(culprit)} is not closed: {missing} missing at the end of the text'
    return _error(source, culprit.start, len(source.text), message)


def _stray(source: Source, top: list[Node]) -> str:
    if not top:
        return "unexpected ')': nothing is open here"
    line, _ = source.position(top[-1].end - 1)
    return f"unexpected ')': {_name(top[-1])} was already closed on line {line}"


def _name(node: Node) -> str:
    """How a person knows a form: its first word and its name or head."""
    if isinstance(node, Symbol):
        return node.text
    parts: list[str] = []
    for child in node.children[:2]:
        if isinstance(child, ListNode):
            inner = child.children[:1]
            parts.extend(f'({part.text} ...)' for part in inner if isinstance(part, Symbol))
            break
        parts.append(child.text)
    return f'({" ".join(parts)} ...)' if parts else 'the list'


def _error(source: Source, start: int, end: int, message: str) -> MissionError:
    return MissionError([source.diagnostic(start, end, message)])
