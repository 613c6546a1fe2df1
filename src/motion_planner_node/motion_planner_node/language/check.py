"""Finding all that is wrong with the meaning of geometric preconditions, at once."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from math import isfinite

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, Severity
from motion_planner_node.functions import COMPONENTS, FUNCTIONS, Kind
from motion_planner_node.language.contradictions import contradictions
from motion_planner_node.language.linear import linear
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    Call,
    Command,
    Constraint,
    Expression,
    Label,
    Negation,
    Node,
    Operation,
    Preconditions,
    Property,
    Statement,
    children,
)
from motion_planner_node.world.model import World

#: Comparators of constraints.
COMPARATORS = ('<', '<=', '>', '>=', '=')

#: Commands; the second is how the paper spells the first in its text.
COMMANDS = ('setProperty', 'setProprety')

_CONCEPTS = ('agent', 'object')


def check(preconditions: Preconditions, world: World | None = None) -> tuple[Diagnostic, ...]:
    """All errors of meaning, in the order of the text.

    Labels and fields are looked up in ``world`` where there is one; variables stand for any.
    """
    checker = _Checker(preconditions, world)
    checker.check_statements()
    for item in preconditions.items:
        if isinstance(item, Command):
            checker.check_command(item)
        else:
            checker.check_constraint(item)
    found = checker.diagnostics
    if not found:
        constraints = preconditions.constraints
        periodic = [is_periodic(constraint, preconditions.agents) for constraint in constraints]
        found += contradictions(constraints, periodic)
    return tuple(sorted(found, key=lambda diagnostic: (diagnostic.line, diagnostic.column)))


def is_periodic(constraint: Constraint, agents: Iterable[str]) -> bool:
    """Whether the constraint equates angles, which are the same modulo 2 pi."""
    if constraint.comparator != '=':
        return False
    sides = constraint.left, constraint.right
    return any(_is_heading(side, agents) or _gives_angle(side) for side in sides)


def _is_heading(side: Expression, agents: Iterable[str]) -> bool:
    return isinstance(side, Property) and side.name == 'heading' and side.owner in agents


def _gives_angle(side: Expression) -> bool:
    return (
        isinstance(side, Call)
        and side.name in FUNCTIONS
        and FUNCTIONS[side.name].result is Kind.ANGLE
    )


class _Checker:
    """Collects the diagnostics of one text."""

    def __init__(self, preconditions: Preconditions, world: World | None) -> None:
        self.diagnostics: list[Diagnostic] = []
        self._statements = preconditions.statements
        self._items = preconditions.items
        self._agents = preconditions.agents
        self._objects = preconditions.objects
        self._world = world

    def check_statements(self) -> None:
        """Concepts and labels of the statements."""
        for statement in self._statements:
            if statement.concept not in _CONCEPTS:
                self._unknown('statement', statement.concept, _CONCEPTS, statement)
            elif statement.label == 'pi':
                self._error("'pi' is a number, not a label", statement)
            elif statement.concept == 'object' and statement.label in self._agents:
                self._error(
                    f"'{statement.label}' is stated to be an agent and an object", statement
                )
            elif self._world and not statement.label.startswith('?'):
                self._check_label(statement, self._world)
        if self._items and not self._agents:
            self._error('no statement (agent ...) says which robot acts', self._items[0])

    def check_command(self, command: Command) -> None:
        """Name, number and kinds of the arguments of a direct assignment."""
        if command.name not in COMMANDS:
            if command.name in FUNCTIONS:
                self._error(f'expected a comparator after {to_text(command)}', command)
            else:
                self._unknown('command', command.name, COMMANDS[:1], command)
            return
        if len(command.arguments) != 2:
            self._error(_arity(command.name, 2, len(command.arguments)), command)
            return
        target, value = command.arguments
        if not isinstance(target, Property):
            message = f'{command.name} sets a component such as rover0.x, not {to_text(target)}'
            self._error(message, target)
        elif target.owner in self._objects:
            message = f"'{target.owner}' is an object: only components of an agent can be set"
            self._error(message, target)
        else:
            self._kind(target)
        self._expect(Kind.NUMBER, value)

    def check_constraint(self, constraint: Constraint) -> None:
        """Comparator, sides and whether the two go together."""
        left, right = self._kind(constraint.left), self._kind(constraint.right)
        if constraint.comparator not in COMPARATORS:
            known = ' '.join(COMPARATORS)
            message = f"unknown comparator '{constraint.comparator}'; known: {known}"
            self._error(message, constraint)
            return
        for side, kind in ((constraint.left, left), (constraint.right, right)):
            if kind in {Kind.PLACE, Kind.AGENT}:
                message = f"'{to_text(side)}' is not a number: expected a property or a function"
                self._error(message, side)
                return
        if left is None or right is None:
            return
        if Kind.ANGLE in {left, right} and constraint.comparator != '=':
            message = f"an angle cannot be compared with '{constraint.comparator}', only with '='"
            self._error(message, constraint)
        elif left is not right and not self._has_heading(constraint):
            number = constraint.left if left is Kind.NUMBER else constraint.right
            message = f'an angle is compared with a number: write cos-and-sin({to_text(number)})'
            self._error(message, number)

    def _has_heading(self, constraint: Constraint) -> bool:
        return any(_is_heading(side, self._agents) for side in (constraint.left, constraint.right))

    def _kind(self, node: Expression) -> Kind | None:
        """The kind of ``node``, None if something below it is wrong."""
        if isinstance(node, Label):
            return self._kind_of_label(node)
        if isinstance(node, Property):
            return self._kind_of_property(node)
        if isinstance(node, Call):
            return self._kind_of_call(node)
        good = [self._expect(Kind.NUMBER, operand) for operand in children(node)]
        if not all(good):
            return None
        if isinstance(node, Operation | Negation):
            divides = isinstance(node, Operation) and node.operator == '/'
            if divides and linear(children(node)[1]).constant == 0.0:
                self._error(f'division by zero in {to_text(node)}', node)
                return None
            number = linear(node).constant
            if number is not None and not isfinite(number):
                self._error(f'{to_text(node)} is too large a number', node)
                return None
        return Kind.NUMBER

    def _kind_of_label(self, node: Label) -> Kind | None:
        if node.name in self._agents:
            return Kind.AGENT
        if node.name in self._objects:
            return Kind.PLACE
        self._undeclared(node.name, node)
        return None

    def _kind_of_property(self, node: Property) -> Kind | None:
        if node.owner in self._agents:
            known: Iterable[str] = COMPONENTS
        elif node.owner not in self._objects:
            self._undeclared(node.owner, node)
            return None
        elif self._world is None or node.owner not in self._world.objects:
            return Kind.NUMBER
        else:
            known = self._world.objects[node.owner].fields
        if node.name in known:
            return Kind.NUMBER
        what = f"property of '{node.owner}'"
        self._unknown(what, node.name, known, node, Code.UNKNOWN_PROPERTY)
        return None

    def _kind_of_call(self, node: Call) -> Kind | None:
        if node.name in COMMANDS:
            self._error(f'{node.name} is a command and has no value', node)
            return None
        function = FUNCTIONS.get(node.name)
        if function is None:
            for argument in node.arguments:
                self._kind(argument)
            self._unknown('function', node.name, FUNCTIONS, node, Code.UNKNOWN_FUNCTION)
            return None
        if len(node.arguments) != len(function.arguments):
            self._error(_arity(node.name, len(function.arguments), len(node.arguments)), node)
            return None
        pairs = zip(function.arguments, node.arguments, strict=True)
        good = [self._expect(kind, argument, of=node.name) for kind, argument in pairs]
        return function.result if all(good) else None

    def _expect(self, wanted: Kind, node: Expression, of: str = '') -> bool:
        kind = self._kind(node)
        if kind is wanted or (wanted is Kind.PLACE and kind is Kind.AGENT):
            return True
        if kind is not None:
            where = f'{of} wants {wanted.value}' if of else f'expected {wanted.value}'
            what = 'an object' if kind is Kind.PLACE else kind.value
            self._error(f"{where}: '{to_text(node)}' is {what}", node)
        return False

    def _check_label(self, statement: Statement, world: World) -> None:
        label = statement.label
        if statement.concept == 'agent' and label not in world.robots:
            self._unknown('agent', label, world.robots, statement, Code.UNKNOWN_AGENT)
        elif statement.concept == 'object' and label not in world.objects:
            self._unknown('object', label, world.objects, statement, Code.UNKNOWN_OBJECT)

    def _undeclared(self, name: str, node: Node) -> None:
        stated = (*self._agents, *self._objects)
        hint = _hint(name, stated)
        message = f"'{name}' is not stated: write (agent {name}) or (object {name}){hint}"
        if '-' in name:
            message += '; a minus after a name needs a space'
        self._error(message, node)

    def _unknown(
        self,
        what: str,
        name: str,
        known: Iterable[str],
        node: Node,
        code: Code = Code.INVALID_PRECONDITIONS,
    ) -> None:
        names = sorted(known)
        listed = ', '.join(names[:8]) + (', ...' if len(names) > 8 else '')
        message = f"unknown {what} '{name}'{_hint(name, names)}; known: {listed or 'none'}"
        self._error(message, node, code)

    def _error(self, message: str, node: Node, code: Code = Code.INVALID_PRECONDITIONS) -> None:
        if isinstance(node, Statement):
            text = f'({node.concept} {node.label})'
        else:
            assert isinstance(node, Expression | Command | Constraint)
            text = to_text(node)
        self.diagnostics.append(
            Diagnostic(message, node.line, node.column, text, '', Severity.ERROR, code)
        )


def _hint(name: str, known: Iterable[str]) -> str:
    close = get_close_matches(name, list(known), n=1)
    return f" (did you mean '{close[0]}'?)" if close else ''


def _arity(name: str, wanted: int, given: int) -> str:
    return f'{name} takes {wanted} argument{"" if wanted == 1 else "s"}, not {given}'
