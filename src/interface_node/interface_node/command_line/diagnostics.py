"""Diagnostics as compilers write them: place, severity, message, source line and a caret."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from unicodedata import combining, east_asian_width

from interface_node.command_line.console import Console
from interface_node.command_line.missions import Source
from interface_node.plan import Diagnostic

_WIDEST = 100


def place(diagnostic: Diagnostic) -> str:
    """``file:line:column`` as far as they are known."""
    parts = [diagnostic.source]
    if diagnostic.line:
        parts.append(str(diagnostic.line))
        if diagnostic.column:
            parts.append(str(diagnostic.column))
    return ':'.join(part for part in parts if part)


def excerpt(diagnostic: Diagnostic, text: str) -> tuple[str, ...]:
    """The line of ``text`` that a diagnostic is about and a caret below it; nothing without a place.

    Long lines are cut to a window around the column; what does not print is replaced, so that the
    caret stands below its character.
    """
    lines = text.split('\n', diagnostic.line) if diagnostic.line else []
    if not 0 < diagnostic.line <= len(lines):
        return ()
    line = lines[diagnostic.line - 1].rstrip('\r')
    column = min(diagnostic.column, len(line) + 1)
    first = max(0, column - _WIDEST // 2) if len(line) > _WIDEST else 0
    shown = ''.join(_printable(c) for c in line[first : first + _WIDEST])
    if not column:
        return (shown,)
    offset = column - 1 - first
    padding = sum(_width(c) for c in shown[:offset])
    span = sum(_width(c) for c in shown[offset : offset + _underlined(diagnostic, line, column)])
    return (shown, ' ' * padding + '^' + '~' * (span - 1))


def write_diagnostics(
    console: Console, diagnostics: Iterable[Diagnostic], sources: Iterable[Source]
) -> None:
    """Write all of them to ``err``, with excerpts of those ``sources`` that they are about."""
    known = {source.path: source for source in sources}
    for diagnostic in diagnostics:
        source = known.get(diagnostic.source)
        where = place(replace(diagnostic, source=source.shown) if source else diagnostic)
        severity, style = ('warning:', 'yellow') if diagnostic.warning else ('error:', 'red')
        message = f'{console.styled_err(severity, style)} {diagnostic.message}'
        console.note(f'{console.styled_err(where + ":", "bold")} {message}' if where else message)
        for line in excerpt(diagnostic, source.text) if source else ():
            console.note(f'    {line}')


def _underlined(diagnostic: Diagnostic, line: str, column: int) -> int:
    """Characters to underline: the offending text when it stands in the line, else one."""
    offending = diagnostic.text.partition('\n')[0].rstrip()
    return max(1, len(offending)) if line.startswith(offending, column - 1) else 1


def _printable(character: str) -> str:
    if character == '\t':
        return ' '
    return character if character.isprintable() else '\N{REPLACEMENT CHARACTER}'


def _width(character: str) -> int:
    if combining(character):
        return 0
    return 2 if east_asian_width(character) in 'WF' else 1
