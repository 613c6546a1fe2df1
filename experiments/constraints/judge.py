"""An independent judge of attitudes: reads constraints with Python's parser, computes with math.

It shares nothing with the motion planner, neither parser nor functions, so that an attitude that
both find right is right.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from typing import Any

from experiments.constraints.geometry import (
    CONDITIONS,
    Angle,
    Area,
    Somebody,
    Surroundings,
    functions,
)
from experiments.constraints.sets import ConstraintSet

Pose = tuple[float, float, float]

#: Bounds that leave everything in.
EVERYWHERE = (-math.inf, -math.inf, math.inf, math.inf)
#: The violation of <, > and != where both sides are equal: they allow no tolerance at all.
STRICTLY = 1.0

_OPERATIONS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda left, right: left + right,
    ast.Sub: lambda left, right: left - right,
    ast.Mult: lambda left, right: left * right,
    ast.Div: lambda left, right: left / right,
}
_COMPARATORS: dict[type[ast.cmpop], str] = {
    ast.Lt: '<',
    ast.LtE: '<=',
    ast.Gt: '>',
    ast.GtE: '>=',
    ast.Eq: '=',
    ast.NotEq: '!=',
}
_OPPOSITE = {'<=': '>', '>=': '<', '=': '!='}


class Judge:
    """Judges attitudes of ``agent`` on the map that ``world`` (the parsed world file) describes."""

    def __init__(self, world: Mapping[str, Any], agent: str) -> None:
        self._agent = agent
        self._bounds: tuple[float, float, float, float] = tuple(world['bounds'])
        self._known: dict[str, Any] = {'pi': math.pi}
        for label, fields in world['objects'].items():
            self._known[label] = Somebody(fields)
        for label, robot in world['robots'].items():
            if label != agent:
                self._known[label] = Somebody(robot['start'])
        for region in world['regions']:
            self._known[region['name']] = Area(region)
        obstacles = tuple(Area(obstacle) for obstacle in world['obstacles'])
        self._functions = functions(Surroundings(obstacles, self._bounds))

    def violation(self, constraints: ConstraintSet, pose: Pose, *, bounded: bool = True) -> float:
        """By how much ``pose`` misses the set at worst [m or rad].

        Leaving the map counts when ``bounded``.
        """
        x, y, heading = pose
        if not all(map(math.isfinite, pose)) or abs(heading) > math.pi:
            return math.inf
        x_min, y_min, x_max, y_max = self._bounds if bounded else EVERYWHERE
        missed = [0.0, x_min - x, x - x_max, y_min - y, y - y_max]
        known = {**self._known, self._agent: Somebody({'x': x, 'y': y, 'heading': heading})}
        missed += [self._missed(text, known) for text in constraints.constraints]
        return math.inf if any(map(math.isnan, missed)) else max(missed)

    def _missed(self, text: str, known: Mapping[str, Any]) -> float:
        python = text.replace('cos-and-sin', 'cos_and_sin')
        for comparator in ('<=', '>=', '!='):
            python = python.replace(comparator, comparator[0] + '\0')
        node = ast.parse(python.replace('=', '==').replace('\0', '='), mode='eval').body
        if isinstance(node, ast.Compare):
            left, right = node.left, node.comparators[0]
            values = [self._value(left, known), self._value(right, known)]
            angular = any(isinstance(value, Angle) for value in values) or any(
                isinstance(side, ast.Attribute) and side.attr == 'heading' for side in (left, right)
            )
            numbers = [_number(value) for value in values]
            return _violation(numbers[0] - numbers[1], _COMPARATORS[type(node.ops[0])], angular)
        negated = isinstance(node, ast.UnaryOp)
        call = node.operand if isinstance(node, ast.UnaryOp) else node
        assert isinstance(call, ast.Call)
        assert isinstance(call.func, ast.Name)
        comparator = CONDITIONS[call.func.id]
        value = self._value(call, known)
        comparator = _OPPOSITE[comparator] if negated else comparator
        return _violation(_number(value), comparator, isinstance(value, Angle))

    def _value(self, node: ast.expr, known: Mapping[str, Any]) -> Any:
        if isinstance(node, ast.Constant):
            assert isinstance(node.value, int | float)
            return float(node.value)
        if isinstance(node, ast.Name):
            return known[node.id]
        if isinstance(node, ast.Attribute):
            return float(self._value(node.value, known).fields[node.attr])
        if isinstance(node, ast.UnaryOp):
            assert isinstance(node.op, ast.USub)
            return -self._value(node.operand, known)
        if isinstance(node, ast.BinOp):
            operation = _OPERATIONS[type(node.op)]
            return operation(self._value(node.left, known), self._value(node.right, known))
        assert isinstance(node, ast.Call)
        assert isinstance(node.func, ast.Name)
        function = self._functions[node.func.id]
        return function(*(self._value(argument, known) for argument in node.args))


def _number(value: Angle | float) -> float:
    return value.radians if isinstance(value, Angle) else value


def _violation(gap: float, comparator: str, angular: bool) -> float:
    """By how much left minus right side, ``gap``, is not as ``comparator`` wants it."""
    if math.isnan(gap):
        return math.nan
    if comparator in {'=', '!='} and angular:
        gap = math.remainder(gap, math.tau)
    if comparator == '=':
        return abs(gap)
    if comparator == '!=':
        return 0.0 if gap else STRICTLY
    signed = gap if comparator in {'<', '<='} else -gap
    if comparator in {'<', '>'} and signed >= 0.0:
        return signed + STRICTLY
    return signed
