"""An independent judge of attitudes: reads constraints with Python's parser, computes with math.

It shares nothing with the motion planner, neither parser nor functions, so that an attitude that
both find right is right.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from experiments.constraints.sets import ConstraintSet

Pose = tuple[float, float, float]

#: Bounds that leave everything in.
EVERYWHERE = (-math.inf, -math.inf, math.inf, math.inf)
#: Added to the violation of < and >, which allow no tolerance at all.
STRICTLY = 1.0


@dataclass(frozen=True)
class Angle:
    """A number of radians that is compared modulo 2 pi."""

    radians: float


@dataclass(frozen=True)
class Somebody:
    """An agent or an object: its fields by name."""

    fields: Mapping[str, float]

    @property
    def at(self) -> tuple[float, float]:
        """Where it is."""
        return self.fields['x'], self.fields['y']


def _bearing(one: Somebody, other: Somebody) -> float:
    (x, y), (to_x, to_y) = one.at, other.at
    return math.atan2(to_y - y, to_x - x) if (x, y) != (to_x, to_y) else math.nan


FUNCTIONS: dict[str, Callable[..., Any]] = {
    'distance': lambda one, other: math.dist(one.at, other.at),
    'rel_angle': lambda one, other: Angle(one.fields['heading'] - _bearing(one, other)),
    'cos_and_sin': Angle,
    'deg': math.radians,
}

OPERATIONS: dict[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: lambda left, right: left + right,
    ast.Sub: lambda left, right: left - right,
    ast.Mult: lambda left, right: left * right,
    ast.Div: lambda left, right: left / right,
}


class Judge:
    """Judges attitudes of ``agent`` on the map that ``world`` (the parsed world file) describes."""

    def __init__(self, world: Mapping[str, Any], agent: str) -> None:
        self._agent = agent
        self._bounds: tuple[float, float, float, float] = tuple(world['bounds'])
        self._others = {label: Somebody(fields) for label, fields in world['objects'].items()}
        for label, robot in world['robots'].items():
            if label != agent:
                self._others[label] = Somebody(robot['start'])

    def violation(self, constraints: ConstraintSet, pose: Pose, *, bounded: bool = True) -> float:
        """By how much ``pose`` misses the set at worst [m or rad].

        Leaving the map counts when ``bounded``.
        """
        x, y, heading = pose
        if not all(map(math.isfinite, pose)) or abs(heading) > math.pi:
            return math.inf
        x_min, y_min, x_max, y_max = self._bounds if bounded else EVERYWHERE
        missed = [0.0, x_min - x, x - x_max, y_min - y, y - y_max]
        known = {**self._others, self._agent: Somebody({'x': x, 'y': y, 'heading': heading})}
        missed += [self._missed(text, known) for text in constraints.constraints]
        return math.inf if any(map(math.isnan, missed)) else max(missed)

    def _missed(self, text: str, known: Mapping[str, Somebody]) -> float:
        python = text.replace('cos-and-sin', 'cos_and_sin')
        for comparator in ('<=', '>=', '!='):
            python = python.replace(comparator, comparator[0] + '\0')
        python = python.replace('=', '==').replace('\0', '=')
        comparison = ast.parse(python, mode='eval').body
        assert isinstance(comparison, ast.Compare)
        left, right = comparison.left, comparison.comparators[0]
        values = self._value(left, known), self._value(right, known)
        angular = any(isinstance(value, Angle) for value in values) or any(
            isinstance(side, ast.Attribute) and side.attr == 'heading' for side in (left, right)
        )
        numbers = [value.radians if isinstance(value, Angle) else value for value in values]
        gap: float = numbers[0] - numbers[1]
        (operator,) = comparison.ops
        if isinstance(operator, ast.Eq):
            return abs(math.remainder(gap, math.tau) if angular else gap)
        if isinstance(operator, ast.Lt | ast.Gt):
            signed = gap if isinstance(operator, ast.Lt) else -gap
            return signed if signed < 0.0 else max(signed, math.ulp(0.0)) + STRICTLY
        assert isinstance(operator, ast.LtE | ast.GtE)
        return gap if isinstance(operator, ast.LtE) else -gap

    def _value(self, node: ast.expr, known: Mapping[str, Somebody]) -> Any:
        if isinstance(node, ast.Constant):
            assert isinstance(node.value, int | float)
            return float(node.value)
        if isinstance(node, ast.Name):
            return math.pi if node.id == 'pi' else known[node.id]
        if isinstance(node, ast.Attribute):
            return float(self._value(node.value, known).fields[node.attr])
        if isinstance(node, ast.UnaryOp):
            assert isinstance(node.op, ast.USub)
            return -self._value(node.operand, known)
        if isinstance(node, ast.BinOp):
            operation = OPERATIONS[type(node.op)]
            return operation(self._value(node.left, known), self._value(node.right, known))
        assert isinstance(node, ast.Call)
        assert isinstance(node.func, ast.Name)
        function = FUNCTIONS[node.func.id]
        return function(*(self._value(argument, known) for argument in node.args))
