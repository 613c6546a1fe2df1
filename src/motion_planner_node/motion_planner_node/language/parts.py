"""The elements of a text that does not parse as a whole, so that each can be read by itself."""

from __future__ import annotations

import re

from motion_planner_node.language.syntax_errors import parentheses

#: Elements that are read by themselves; a text with more is refused at its first error.
MOST_PARTS = 256

_COMMENT = re.compile(r';[^\n]*')
#: What joins a parenthesis to what is before or after it; a name makes it a call.
_JOINED_BEFORE = re.compile(r'[\w+*/<>=!,-]\s*$')
_JOINED_AFTER = re.compile(r'\s*[+*/<>=!,-]')


def elements(text: str) -> list[tuple[int, int]]:
    """Start and end of each parenthesised element of ``text``, and of what is between them.

    An operator or a name joins what is on its sides to one element. None where that is in
    doubt: parentheses that do not match, or too many elements.
    """
    text = _COMMENT.sub(lambda comment: ' ' * len(comment.group()), text)
    opened: list[int] = []
    pairs: list[tuple[int, int, int]] = []
    for index, character in parentheses(text):
        if character == '(':
            opened.append(index)
        elif not opened:
            return []
        else:
            start = opened.pop()
            pairs.append((len(opened), start, index + 1))
    if opened:
        return []
    outer = [(start, end) for level, start, end in pairs if level == 0]
    first, last, level = 0, len(text), 0
    if len(outer) == 1 and not (text[: outer[0][0]] + text[outer[0][1] :]).strip():
        first, last, level = outer[0][0] + 1, outer[0][1] - 1, 1
    inner = sorted((start, end) for depth, start, end in pairs if depth == level)
    parts: list[tuple[int, int]] = []
    bare = first
    for start, end in inner:
        before, after = text[max(first, start - 200) : start], text[end : min(last, end + 200)]
        if _JOINED_BEFORE.search(before) or _JOINED_AFTER.match(after):
            continue
        parts += [(bare, start), (start, end)]
        bare = end
    parts.append((bare, last))
    parts = [(start, end) for start, end in parts if text[start:end].strip()]
    return parts if len(parts) <= MOST_PARTS else []


def in_place(text: str, start: int, end: int) -> str:
    """The part of ``text`` from ``start`` to ``end`` in its own line and column."""
    before = text[:start]
    line_start = before.rfind('\n') + 1
    return '\n' * before.count('\n') + ' ' * (start - line_start) + text[start:end]
