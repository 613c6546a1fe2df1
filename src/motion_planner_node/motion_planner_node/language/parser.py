"""Reading geometric preconditions."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from importlib.resources import files
from math import isinf
from typing import Any, TypeVar

from lark import Lark, Token, UnexpectedCharacters, UnexpectedToken

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.language.parts import elements, in_place
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    COMMANDS,
    Call,
    Command,
    Condition,
    Constant,
    Constraint,
    Expression,
    Item,
    Label,
    Negation,
    Number,
    Operation,
    Preconditions,
    Property,
    Statement,
    depth,
)
from motion_planner_node.language.syntax_errors import error_at, parentheses, syntax_error

#: Longest text that is read [bytes in UTF-8].
MAXIMUM_SIZE = 64 * 1024

#: Deepest nesting of parentheses, and of expressions, that is read.
MAXIMUM_DEPTH = 100

#: Most commands and constraints in one text.
MAXIMUM_ITEMS = 64

_AnyNode = TypeVar('_AnyNode', bound='Expression | Item')


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
        return _parse(text), ()
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
            part = _parse(in_place(text, start, end))
        except MotionPlannerError as error:
            errors += error.diagnostics
            continue
        statements += part.statements
        items += part.items
    return Preconditions(tuple(statements), tuple(items)), tuple(errors) or first.diagnostics


def _parse(text: str) -> Preconditions:
    try:
        result: Any = _parser().parse(text)
    except UnexpectedToken as failure:
        error: Any = failure
        if error.token.type == '$END':
            raise syntax_error(text, len(text), '', error.expected) from None
        raise syntax_error(text, error.token.start_pos, error.token, error.expected) from None
    except UnexpectedCharacters as failure:
        error = failure
        at = error.pos_in_stream
        raise syntax_error(text, at, text[at], error.allowed) from None
    preconditions: Preconditions = result
    return preconditions


@lru_cache(maxsize=1)
def _parser() -> Lark:
    grammar = files(__package__).joinpath('grammar.lark').read_text(encoding='utf-8')
    options: dict[str, Any] = {
        'parser': 'lalr',
        'lexer': 'contextual',
        'transformer': _Builder(),
        'maybe_placeholders': False,
    }
    return Lark(grammar, **options)


def _refuse_deep_parentheses(text: str) -> None:
    if text.count('(') <= MAXIMUM_DEPTH:
        return
    opened = 0
    for index, character in parentheses(text):
        opened += 1 if character == '(' else -1
        if opened > MAXIMUM_DEPTH:
            message = f'parentheses are nested deeper than {MAXIMUM_DEPTH} levels'
            raise error_at(text, index, message, '(')


def _error(message: str, token: Any, text: str) -> MotionPlannerError:
    code = Code.INVALID_PRECONDITIONS
    return MotionPlannerError.from_diagnostics(
        [Diagnostic(message, token.line, token.column, text, code=code)]
    )


def _not_too_deep(node: _AnyNode) -> _AnyNode:
    if depth(node) > MAXIMUM_DEPTH:
        message = f'the expression has more than {MAXIMUM_DEPTH} levels'
        raise _error(message, node, '')
    return node


class _Builder:
    """Makes the nodes of ``syntax`` from the children of each rule, while the text is parsed."""

    def start(self, children: list[Any]) -> Preconditions:
        nodes = [node for node in children if not isinstance(node, Token)]
        statements = tuple(node for node in nodes if isinstance(node, Statement))
        items = tuple(node for node in nodes if not isinstance(node, Statement))
        if len(items) > MAXIMUM_ITEMS:
            message = f'there are more than {MAXIMUM_ITEMS} commands and constraints'
            raise _error(message, items[MAXIMUM_ITEMS], to_text(items[MAXIMUM_ITEMS]))
        return Preconditions(statements, items)

    def statement(self, children: list[Any]) -> Statement:
        concept, label = children
        return Statement(str(concept), str(label), line=concept.line, column=concept.column)

    def alone(self, children: list[Any]) -> Item:
        (node,) = children
        if not isinstance(node, Call):
            _not_too_deep(node)
            message = 'expected a comparator (< <= > >= = !=), or a command such as setProperty'
            raise _error(message, node, to_text(node))
        if node.name not in COMMANDS:
            return _not_too_deep(Condition(node, line=node.line, column=node.column))
        command = Command(node.name, node.arguments, line=node.line, column=node.column)
        return _not_too_deep(command)

    def comparison(self, children: list[Any]) -> Constraint:
        left, comparator, right = children
        return _not_too_deep(
            Constraint(left, str(comparator), right, line=left.line, column=left.column)
        )

    def addition(self, children: list[Any]) -> Expression:
        left, operator, right = children
        return Operation(str(operator), left, right, line=left.line, column=left.column)

    multiplication = addition

    def negation(self, children: list[Any]) -> Expression:
        sign, operand = children
        return Negation(operand, line=sign.line, column=sign.column)

    def number(self, children: list[Any]) -> Expression:
        (token,) = children
        value = float(token)
        if isinf(value):
            raise _error(f'the number {token} is too large', token, str(token))
        return Number(value, line=token.line, column=token.column)

    def constant(self, children: list[Any]) -> Expression:
        (token,) = children
        return Constant(str(token), line=token.line, column=token.column)

    def label(self, children: list[Any]) -> Expression:
        (token,) = children
        return Label(str(token), line=token.line, column=token.column)

    def component(self, children: list[Any]) -> Expression:
        (token,) = children
        owner, _, name = token.partition('.')
        return Property(owner, name, line=token.line, column=token.column)

    def call(self, children: list[Any]) -> Expression:
        token, *arguments = children
        return Call(str(token), tuple(arguments), line=token.line, column=token.column)
