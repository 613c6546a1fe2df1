"""Finding all that is wrong with the meaning of geometric preconditions, at once."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches
from math import isfinite

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, Severity
from motion_planner_node.functions import COMPONENTS, FUNCTIONS, Kind
from motion_planner_node.language.conditions import NOT, comparison, unwrapped
from motion_planner_node.language.contradictions import contradictions
from motion_planner_node.language.linear import linear
from motion_planner_node.language.printer import to_text
from motion_planner_node.language.syntax import (
    COMMANDS,
    Call,
    Command,
    Condition,
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
from motion_planner_node.robots.motion import ANGULAR_COMPONENTS
from motion_planner_node.world.model import World

#: Comparators of constraints.
COMPARATORS = ('<', '<=', '>', '>=', '=', '!=')

_CONCEPTS = ('agent', 'object', 'region')

#: What also does where something else is wanted: a number is an angle in radians.
_CONVERTED = frozenset({(Kind.PLACE, Kind.AGENT), (Kind.ANGLE, Kind.NUMBER)})

_NOT_COMPARED = frozenset({Kind.PLACE, Kind.AGENT, Kind.REGION})


def check(preconditions: Preconditions, world: World | None = None) -> tuple[Diagnostic, ...]:
    """All errors of meaning, in the order of the text.

    Labels and fields are looked up in ``world`` where there is one; variables stand for any.
    """
    checker = _Checker(preconditions, world)
    checker.check_statements()
    for item in preconditions.items:
        if isinstance(item, Command):
            checker.check_command(item)
        elif isinstance(item, Condition):
            checker.check_condition(item)
        else:
            checker.check_constraint(item)
    found = checker.diagnostics
    if not found:
        plain = [
            (item, *compared(item, preconditions.agents)) for item in preconditions.constraints
        ]
        found += contradictions(plain)
    return tuple(sorted(found, key=lambda diagnostic: (diagnostic.line, diagnostic.column)))


def compared(item: Constraint | Condition, agents: Iterable[str]) -> tuple[Constraint, bool]:
    """The comparison that ``item`` asks for, and whether it equates angles, modulo 2 pi."""
    plain = comparison(item, isinstance(item, Constraint) and _is_angular(item, agents))
    return plain, plain.comparator == '=' and _is_angular(plain, agents)


def _is_angular(constraint: Constraint, agents: Iterable[str]) -> bool:
    sides = constraint.left, constraint.right
    return any(_is_heading(side, agents) or _gives_angle(side) for side in sides)


def _is_heading(side: Expression, agents: Iterable[str]) -> bool:
    return isinstance(side, Property) and side.name in ANGULAR_COMPONENTS and side.owner in agents


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
        self._regions = preconditions.regions
        self._world = world

    def check_statements(self) -> None:
        """Concepts and labels of the statements."""
        for statement in self._statements:
            if statement.concept not in _CONCEPTS:
                self._unknown('statement', statement.concept, _CONCEPTS, statement)
            elif statement.label == 'pi':
                self._error("'pi' is a number, not a label", statement)
            elif (other := self._other_concept(statement)) is not None:
                message = f"'{statement.label}' is stated to be an {other} and a"
                message += f'{"n" if statement.concept == "object" else ""} {statement.concept}'
                self._error(message, statement)
            elif self._world and not statement.label.startswith('?'):
                self._check_label(statement, self._world)
        if self._items and not self._agents:
            self._error('no statement (agent ...) says which robot acts', self._items[0])

    def check_command(self, command: Command) -> None:
        """Name, number and kinds of the arguments of a direct assignment."""
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

    def check_condition(self, condition: Condition) -> None:
        """What stands alone has to be a condition, and can be negated unless it is an equality."""
        call, negated = unwrapped(condition.call)
        function = FUNCTIONS.get(call.name)
        if call.name == NOT:
            self._error('not(...) takes one condition, such as inside(?r, ?z)', condition)
            return
        if function is None:
            known = [*COMMANDS[:1], NOT, *FUNCTIONS]
            self._unknown('command or condition', call.name, known, condition)
            return
        self._kind(call)
        if not function.condition:
            self._error(f'expected a comparator after {to_text(call)}', condition)
        elif negated and function.condition == '=':
            message = f'{to_text(condition)} would exclude a single value: name a range instead'
            if function.result is Kind.ANGLE:
                message += ', as with not(field_of_view(...)) or angle_between(...)'
            self._error(message, condition)

    def check_constraint(self, constraint: Constraint) -> None:
        """Comparator, sides and whether the two go together."""
        left, right = self._kind(constraint.left), self._kind(constraint.right)
        if constraint.comparator not in COMPARATORS:
            known = ' '.join(COMPARATORS)
            message = f"unknown comparator '{constraint.comparator}'; known: {known}"
            self._error(message, constraint)
            return
        for side, kind in ((constraint.left, left), (constraint.right, right)):
            if kind in _NOT_COMPARED:
                message = f"'{to_text(side)}' is not a number: expected a property or a function"
                self._error(message, side)
                return
            if kind is Kind.CONDITION:
                message = f'{to_text(side)} is a condition: it stands alone and is not compared'
                self._error(message, side)
                return
        if left is None or right is None:
            return
        if Kind.ANGLE in {left, right} and constraint.comparator not in {'=', '!='}:
            message = (
                f"an angle cannot be compared with '{constraint.comparator}', only with '=' and "
                "'!=': angle_between(...) gives a number"
            )
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
        if node.name in self._regions:
            return Kind.REGION
        self._undeclared(node.name, node)
        return None

    def _kind_of_property(self, node: Property) -> Kind | None:
        if node.owner in self._agents:
            car = self._world.robots.get(node.owner) if self._world else None
            known: Iterable[str] = car.components if car else COMPONENTS
        elif node.owner in self._regions:
            known = ()
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
        if node.name == NOT:
            self._error('not(...) stands alone, round a condition such as inside(?r, ?z)', node)
            return None
        function = FUNCTIONS.get(node.name)
        if function is None:
            for argument in node.arguments:
                self._kind(argument)
            self._unknown('function', node.name, FUNCTIONS, node, Code.UNKNOWN_FUNCTION)
            return None
        kinds = function.kinds(len(node.arguments))
        if kinds is None:
            least = 'at least ' if function.repeats else ''
            wanted = len(function.arguments)
            self._error(_arity(node.name, wanted, len(node.arguments), least), node)
            return None
        pairs = zip(kinds, node.arguments, strict=True)
        good = [self._expect(kind, argument, of=node.name) for kind, argument in pairs]
        return function.gives if all(good) else None

    def _expect(self, wanted: Kind, node: Expression, of: str = '') -> bool:
        kind = self._kind(node)
        if kind is wanted or (wanted, kind) in _CONVERTED:
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
        elif statement.concept == 'region' and label not in world.regions:
            self._unknown('region', label, world.regions, statement, Code.UNKNOWN_OBJECT)

    def _other_concept(self, statement: Statement) -> str | None:
        """An earlier concept of ``_CONCEPTS`` that the same label is stated to be, too."""
        stated = {'agent': self._agents, 'object': self._objects, 'region': self._regions}
        earlier = _CONCEPTS[: _CONCEPTS.index(statement.concept)]
        return next((name for name in earlier if statement.label in stated[name]), None)

    def _undeclared(self, name: str, node: Node) -> None:
        stated = (*self._agents, *self._objects, *self._regions)
        hint = _hint(name, stated)
        message = f"'{name}' is not stated: write (agent {name}), (object {name}) or (region {name}){hint}"
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
            assert isinstance(node, Expression | Command | Constraint | Condition)
            text = to_text(node)
        self.diagnostics.append(
            Diagnostic(message, node.line, node.column, text, '', Severity.ERROR, code)
        )


def _hint(name: str, known: Iterable[str]) -> str:
    close = get_close_matches(name, list(known), n=1)
    return f" (did you mean '{close[0]}'?)" if close else ''


def _arity(name: str, wanted: int, given: int, least: str = '') -> str:
    return f'{name} takes {least}{wanted} argument{"" if wanted == 1 else "s"}, not {given}'
