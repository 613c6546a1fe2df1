"""The grammar as an LALR parser that makes the nodes of ``syntax``."""

from __future__ import annotations

from functools import lru_cache
from importlib.resources import files
from math import isinf
from typing import Any, TypeVar

from lark import Lark, Token, UnexpectedCharacters, UnexpectedToken

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
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
from motion_planner_node.language.syntax_errors import syntax_error

#: Deepest nesting of expressions that is read.
MAXIMUM_DEPTH = 100

#: Most commands and constraints in one text.
MAXIMUM_ITEMS = 64

_AnyNode = TypeVar('_AnyNode', bound='Expression | Item')


def parsed(text: str) -> Preconditions:
    """What ``text`` says; raises MotionPlannerError with a diagnostic at the first error."""
    try:
        result: Any = lalr_parser().parse(text)
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
def lalr_parser() -> Lark:
    """The parser, which takes tens of milliseconds to make."""
    grammar = files(__package__).joinpath('grammar.lark').read_text(encoding='utf-8')
    options: dict[str, Any] = {
        'parser': 'lalr',
        'lexer': 'contextual',
        'transformer': _Builder(),
        'maybe_placeholders': False,
    }
    return Lark(grammar, **options)


def _error(message: str, line: int, column: int, text: str) -> MotionPlannerError:
    code = Code.INVALID_PRECONDITIONS
    return MotionPlannerError.from_diagnostics([Diagnostic(message, line, column, text, code=code)])


def number(text: str, line: int, column: int) -> Number:
    """The number that is written as ``text``; raises MotionPlannerError when it is too large."""
    value = float(text)
    if isinf(value):
        raise _error(f'the number {text} is too large', line, column, text)
    return Number(value, line=line, column=column)


def label(text: str, line: int, column: int) -> Label:
    """The label or variable that is written as ``text``."""
    return Label(text, line=line, column=column)


def component(text: str, line: int, column: int) -> Property:
    """The property that is written as ``text``."""
    owner, _, name = text.partition('.')
    return Property(owner, name, line=line, column=column)


def _not_too_deep(node: _AnyNode) -> _AnyNode:
    if depth(node) > MAXIMUM_DEPTH:
        message = f'the expression has more than {MAXIMUM_DEPTH} levels'
        raise _error(message, node.line, node.column, '')
    return node


class _Builder:
    """Makes the nodes of ``syntax`` from the children of each rule, while the text is parsed."""

    def start(self, children: list[Any]) -> Preconditions:
        nodes = [node for node in children if not isinstance(node, Token)]
        statements = tuple(node for node in nodes if isinstance(node, Statement))
        items = tuple(node for node in nodes if not isinstance(node, Statement))
        if len(items) > MAXIMUM_ITEMS:
            message = f'there are more than {MAXIMUM_ITEMS} commands and constraints'
            item = items[MAXIMUM_ITEMS]
            raise _error(message, item.line, item.column, to_text(item))
        return Preconditions(statements, items)

    def statement(self, children: list[Any]) -> Statement:
        concept, label = children
        return Statement(str(concept), str(label), line=concept.line, column=concept.column)

    def alone(self, children: list[Any]) -> Item:
        (node,) = children
        if not isinstance(node, Call):
            _not_too_deep(node)
            message = 'expected a comparator (< <= > >= = !=), or a command such as setProperty'
            raise _error(message, node.line, node.column, to_text(node))
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
        return number(str(token), token.line, token.column)

    def constant(self, children: list[Any]) -> Expression:
        (token,) = children
        return Constant(str(token), line=token.line, column=token.column)

    def label(self, children: list[Any]) -> Expression:
        (token,) = children
        return label(str(token), token.line, token.column)

    def component(self, children: list[Any]) -> Expression:
        (token,) = children
        return component(str(token), token.line, token.column)

    def call(self, children: list[Any]) -> Expression:
        token, *arguments = children
        return Call(str(token), tuple(arguments), line=token.line, column=token.column)
