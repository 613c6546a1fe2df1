"""S-expressions with the position of every node: the reader below the mission language."""

from __future__ import annotations

import re
from dataclasses import dataclass

from task_planner_node.errors import MissionError
from task_planner_node.language.source import Source

MAX_DEPTH = 200
DOMAIN_WORDS = frozenset({'defdomain', 'defproblem'})
DEFINITION_WORDS = frozenset({'operator', ':operator', ':op', ':method', ':-'})

_TOKEN = re.compile(r'\s+|;[^\n]*|(?P<open>\()|(?P<close>\))|(?P<symbol>[^\s();"]+)|(?P<string>")')


@dataclass(slots=True)
class Symbol:
    """A word; ``start`` and ``end`` are offsets into the source."""

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
    """Read all top-level expressions of ``source``.

    Raises MissionError for parentheses that do not match, strings, and nesting beyond MAX_DEPTH.
    """
    top: list[Node] = []
    stack: list[ListNode] = []
    definitions: list[ListNode] = []
    for token in _TOKEN.finditer(source.text):
        kind = token.lastgroup
        if kind is None:
            continue
        start, end = token.span()
        if kind == 'open':
            if len(stack) == MAX_DEPTH:
                raise _error(source, start, end, f'lists nest deeper than {MAX_DEPTH}')
            node = ListNode([], start, end)
            (stack[-1].children if stack else top).append(node)
            stack.append(node)
        elif kind == 'close':
            if not stack:
                raise _error(source, start, end, _stray(source, top))
            stack.pop().end = end
        elif kind == 'string':
            raise _error(source, start, end, 'strings are not part of the language')
        else:
            symbol = Symbol(token.group(), start, end)
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


def _refuse_nested(source: Source, stack: list[ListNode]) -> None:
    """A definition that begins inside another one: the outer one lacks a parenthesis."""
    inner = stack[-1]
    outer = next((node for node in stack[:-1] if first_word(node) in DEFINITION_WORDS), None)
    if outer is None and first_word(inner) in DOMAIN_WORDS and len(stack) > 1:
        outer = stack[0]
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
