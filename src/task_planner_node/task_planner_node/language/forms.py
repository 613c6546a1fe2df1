"""The top level of a text: the definitions in it, also where Lisp stands around them."""

from __future__ import annotations

from task_planner_node.language.reader import (
    DOMAIN_WORDS,
    LISP_WORDS,
    MARKS,
    SKIPPING,
    Node,
    Symbol,
    first_word,
    read,
)
from task_planner_node.language.reading import Reading, children_of

#: Lisp whose absence may change what a domain means.
FUNCTION_WORDS = frozenset({'defun', 'defmacro', 'defmethod', 'defgeneric'})


def read_forms(reading: Reading) -> list[Node]:
    """The definitions in the text, in order, marks still in them.

    Lisp such as ``(in-package ...)`` is left out, but domains and problems inside of it are not.
    Raises MissionError for what cannot be read at all.
    """
    nodes = read(reading.source)
    reading.spelling.learn(nodes)
    forms: list[Node] = []
    skipped = 0
    for node in nodes:
        if skipped:
            skipped -= 1
        elif isinstance(node, Symbol) and node.text in SKIPPING:
            skipped = {'#.': 0, '#-': 1, '#+': 2}[node.text]
        elif isinstance(node, Symbol) and node.text in MARKS:
            continue
        elif _is_lisp(first_word(node)):
            inner = _definitions_in(node)
            if first_word(node) in FUNCTION_WORDS and not inner:
                name = reading.source.excerpt(node.start, node.end)
                reading.warn(node, f'{name} is left out: Lisp is not evaluated')
            forms.extend(inner)
        else:
            forms.append(node)
    return forms


def _is_lisp(word: str) -> bool:
    """Whether a form that begins so is Lisp: a word of Lisp, or one of a package, as ``asdf:load-system``."""
    return word in LISP_WORDS or ':' in word[1:]


def _definitions_in(node: Node) -> list[Node]:
    found: list[Node] = []
    agenda = [node]
    while agenda:
        form = agenda.pop()
        if first_word(form) in DOMAIN_WORDS:
            found.append(form)
        else:
            agenda.extend(reversed(children_of(form)))
    return found
