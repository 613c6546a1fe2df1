"""Reading geometric preconditions."""

from __future__ import annotations

from collections.abc import Sequence

from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.language.forms import parsed_by_form
from motion_planner_node.language.grammar import MAXIMUM_DEPTH
from motion_planner_node.language.parts import elements, in_place
from motion_planner_node.language.syntax import Item, Preconditions, Statement
from motion_planner_node.language.syntax_errors import error_at, parentheses

#: Longest text that is read [bytes in UTF-8].
MAXIMUM_SIZE = 64 * 1024


def parse(text: str) -> Preconditions:
    """Read a text in the paper's language (Table 1), ground or with variables.

    Raises MotionPlannerError with a diagnostic (line, column, offending text, what was expected)
    for each element that breaks the grammar, or one when parentheses do not match or the text is
    longer than 64 KiB, nested deeper than 100 levels or holds more than 64 commands and constraints.
    """
    preconditions, errors = read(text)
    if errors:
        raise MotionPlannerError.from_diagnostics(errors)
    return preconditions


def read(text: str) -> tuple[Preconditions, tuple[Diagnostic, ...]]:
    """What can be read of ``text``, and what is wrong with the rest.

    After an error, reading goes on at the next element, where the parentheses show which it is.
    """
    try:
        if len(text) > MAXIMUM_SIZE or len(text.encode('utf-8', 'replace')) > MAXIMUM_SIZE:
            raise error_at(text, 0, f'the text is longer than {MAXIMUM_SIZE} bytes', '')
        _refuse_deep_parentheses(text)
        return parsed_by_form(text), ()
    except MotionPlannerError as error:
        parts = elements(text) if len(text) <= MAXIMUM_SIZE else []
        if len(parts) < 2:
            return Preconditions(), error.diagnostics
        return _read_parts(text, parts, error)


def _read_parts(
    text: str, parts: Sequence[tuple[int, int]], first: MotionPlannerError
) -> tuple[Preconditions, tuple[Diagnostic, ...]]:
    statements: list[Statement] = []
    items: list[Item] = []
    errors: list[Diagnostic] = []
    for start, end in parts:
        try:
            part = parsed_by_form(in_place(text, start, end))
        except MotionPlannerError as error:
            errors += error.diagnostics
            continue
        statements += part.statements
        items += part.items
    return Preconditions(tuple(statements), tuple(items)), tuple(errors) or first.diagnostics


def _refuse_deep_parentheses(text: str) -> None:
    if text.count('(') <= MAXIMUM_DEPTH:
        return
    opened = 0
    for index, character in parentheses(text):
        opened += 1 if character == '(' else -1
        if opened > MAXIMUM_DEPTH:
            message = f'parentheses are nested deeper than {MAXIMUM_DEPTH} levels'
            raise error_at(text, index, message, '(')
