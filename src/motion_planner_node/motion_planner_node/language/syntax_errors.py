"""What is wrong with a text that breaks the grammar, in words."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError

_PARENTHESIS_OR_COMMENT = re.compile(r';[^\n]*|[()]')

_VALUE = frozenset({'NUMBER', 'PI', 'NAME', 'VARIABLE', 'PROPERTY', 'FUNCTION', 'MINUS', 'LPAR'})

_WORDS = {
    'COMPARATOR': 'a comparator (< <= > >= = !=)',
    'PLUS': 'an operator (+ - * /)',
    'STAR': 'an operator (+ - * /)',
    'COMMA': "','",
    'LPAR': "'('",
    'RPAR': "')'",
    'NAME': 'a name',
    'VARIABLE': 'a name',
    '$END': 'the end of the text',
}


def syntax_error(text: str, at: int, found: str, expected: Iterable[str]) -> MotionPlannerError:
    """The error for ``found`` (empty for the end) at index ``at``, where terminals were expected.

    Where a parenthesis was to be closed and never is, the error points at that parenthesis.
    """
    terminals = set(expected)
    if 'RPAR' in terminals and (opened := _unclosed(text, at)) is not None:
        what = f"'{printable(found)}' came first" if found else 'the text ended first'
        return error_at(text, opened, f"'(' is not closed: {what}", '(')
    if found == ')' and _is_surplus(text, at):
        return error_at(text, at, "')' closes nothing", found)
    what = f"unexpected '{printable(found)}'" if found else 'the text ends too early'
    return error_at(text, at, f'{what}: expected {in_words(terminals)}', found)


def error_at(text: str, at: int, message: str, found: str) -> MotionPlannerError:
    """An error with the line and column of index ``at``."""
    line = text.count('\n', 0, at) + 1
    column = at - text.rfind('\n', 0, at)
    return MotionPlannerError.from_diagnostics(
        [Diagnostic(message, line, column, printable(found), code=Code.INVALID_PRECONDITIONS)]
    )


def in_words(terminals: Iterable[str]) -> str:
    """The terminals of the grammar for people: ``a comparator (< <= > >= = !=) or ')'``."""
    names = set(terminals)
    words = []
    if 'NUMBER' in names:
        names -= _VALUE
        words.append('a number, a property or a function')
    words += [word for name, word in _WORDS.items() if name in names]
    return ' or '.join(dict.fromkeys(words)) or 'nothing more'


def printable(found: str) -> str:
    """``found`` shortened, and escaped where it cannot be printed."""
    shown = found if len(found) <= 40 else found[:37] + '...'
    return shown if shown.isprintable() else ascii(shown)[1:-1]


def parentheses(text: str) -> Iterator[tuple[int, str]]:
    """Index and character of each parenthesis outside comments."""
    for match in _PARENTHESIS_OR_COMMENT.finditer(text):
        if match.group() in '()':
            yield match.start(), match.group()


def _unclosed(text: str, at: int) -> int | None:
    """The innermost parenthesis open at ``at``, if some parenthesis of the text is never closed."""
    opened: list[int] = []
    innermost = None
    for index, character in parentheses(text):
        if index >= at and innermost is None:
            innermost = opened[-1] if opened else -1
        if character == '(':
            opened.append(index)
        elif opened:
            opened.pop()
    if innermost is None:
        innermost = opened[-1] if opened else -1
    return innermost if opened and innermost >= 0 else None


def _is_surplus(text: str, at: int) -> bool:
    opened = 0
    for index, character in parentheses(text):
        if index >= at:
            break
        opened += 1 if character == '(' else -1
    return opened <= 0
