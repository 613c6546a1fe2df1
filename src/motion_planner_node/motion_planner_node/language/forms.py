"""Texts of one form, which differ in labels and numbers only: one is parsed, the others are filled in.

Planners ask for the same preconditions of ever other objects. What kinds of words a text consists of
tells the grammar all it looks at, so each form is parsed once, with words that stand for any.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import fields
from functools import lru_cache
from typing import Any

from lark.lexer import PatternStr

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.language.grammar import component, label, lalr_parser, number, parsed
from motion_planner_node.language.syntax import (
    Label,
    Node,
    Number,
    Preconditions,
    Property,
    Statement,
)

#: Forms that are kept, and words of the longest one: those that operators have, not whole files.
_FORMS, _LONGEST = 512, 400
#: Words of a form that stand for all of their kind.
_SAMPLES = {'NAME': 'a', 'VARIABLE': '?a', 'PROPERTY': 'a.b', 'NUMBER': '0'}

#: Nodes of one word that a form leaves open, and what makes them of it.
_LEAVES: dict[type[Any], Callable[[str, int, int], Node]] = {
    Number: number,
    Label: label,
    Property: component,
}

#: A word of a text: what it is, its line and its column.
Word = tuple[str, int, int]
#: Of each word what it is, or its kind where any of that kind will do.
Form = tuple[str, ...]
_Filler = Callable[[list[Word]], Any]


def parsed_by_form(text: str) -> Preconditions:
    """As `grammar.parsed`, faster where a text of the same form has been read before."""
    words, form = _scanned(text)
    fill = _filled(form) if 0 < len(form) <= _LONGEST else None
    if fill is None:
        return parsed(text)
    preconditions: Preconditions = fill(words)
    return preconditions


def _scanned(text: str) -> tuple[list[Word], Form]:
    """The words of ``text`` and its form, which is empty where something is no word."""
    words: list[Word] = []
    form: list[str] = []
    at, line, before = 0, 1, -1
    for match in _words().finditer(text):
        start, end = match.span()
        if start != at:
            return [], ()
        at = end
        kind, word = match.lastgroup, match.group()
        if kind == 'SPACE':
            if '\n' in word:
                line += word.count('\n')
                before = text.rindex('\n', start, end)
        elif kind != 'COMMENT':
            words.append((word, line, start - before))
            form.append(kind if kind in _SAMPLES else word)
    return (words, tuple(form)) if at == len(text) else ([], ())


@lru_cache(maxsize=1)
def _words() -> re.Pattern[str]:
    """Matches any word, as the parser's lexer does where all of them are allowed."""
    # Nothing else begins with a mark, so these can come first: most words are marks.
    terminals = sorted(
        lalr_parser().terminals,
        key=lambda t: (
            not isinstance(t.pattern, PatternStr),
            -t.priority,
            -t.pattern.max_width,
            -len(t.pattern.value),
            t.name,
        ),
    )
    return re.compile('|'.join(f'(?P<{t.name}>{t.pattern.to_regexp()})' for t in terminals))


@lru_cache(maxsize=_FORMS)
def _filled(form: Form) -> _Filler | None:
    """Makes the preconditions from the words of a text of this form; None where it cannot be read."""
    samples = [_SAMPLES.get(kind, kind) for kind in form]
    text = ' '.join(samples)
    words, again = _scanned(text)
    if again != form:
        return None
    try:
        sample = parsed(text)
    except MotionPlannerError:
        return None
    return _filler(sample, {column: index for index, (_, _, column) in enumerate(words)})


def _filler(node: Any, at: dict[int, int]) -> _Filler:
    """Makes what ``node`` is of other words; ``at`` tells the words by their columns."""
    if isinstance(node, str):
        # Named in the form.
        return lambda _: node
    if isinstance(node, tuple):
        fillers = [_filler(part, at) for part in node]
        return lambda words: tuple([fill(words) for fill in fillers])
    kind = type(node)
    index = at[node.column] if isinstance(node, Node) else -1
    if kind is Statement:
        return _statement(index)
    if kind in _LEAVES:
        leaf = _LEAVES[kind]
        return lambda words: leaf(*words[index])
    parts = [_filler(getattr(node, name), at) for name in _parts_of(kind)]
    if index < 0:
        return lambda words: kind(*[fill(words) for fill in parts])

    def fill(words: list[Word]) -> Any:
        _, line, column = words[index]
        return kind(*[fill(words) for fill in parts], line=line, column=column)

    return fill


def _parts_of(kind: type[Any]) -> list[str]:
    """What nodes of this kind are made of beside their place."""
    return [field.name for field in fields(kind) if not field.kw_only]


def _statement(index: int) -> _Filler:
    def fill(words: list[Word]) -> Statement:
        concept, line, column = words[index]
        return Statement(concept, words[index + 1][0], line=line, column=column)

    return fill
