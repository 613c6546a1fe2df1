"""Sets of sets.yaml written out for the peers, as one would by hand, with analytic Jacobians.

Values and derivatives are plain math, one number at a time: for three unknowns that is faster than
numpy arrays. CasADi differentiates by itself and gets relative angles as smooth equations (a cross
product of 0, a positive dot product), because IPOPT cannot do with the jump of a wrapped angle.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import atan2, hypot, inf, pi, remainder, tau
from typing import Any

from experiments.constraints.judge import Pose

#: A value and its derivatives by x, y and heading.
Slope = tuple[float, float, float, float]
#: What weighs as much as a radian [m], for peers that know a scale.
LENGTH = 50.0


@dataclass(frozen=True)
class Distance:
    """Distance [m] to a point, between ``low`` and ``high``."""

    at: tuple[float, float]
    low: float
    high: float

    def slope(self, x: float, y: float, heading: float) -> Slope:
        """The distance and its derivatives."""
        del heading
        dx, dy = x - self.at[0], y - self.at[1]
        length = hypot(dx, dy) or 1e-12
        return length, dx / length, dy / length, 0.0

    def smooth(self, casadi: Any, state: Any) -> list[tuple[Any, float, float]]:
        """Expressions for CasADi, each with its bounds."""
        dx, dy = state[0] - self.at[0], state[1] - self.at[1]
        return [(casadi.sqrt(dx * dx + dy * dy + 1e-12), self.low, self.high)]


@dataclass(frozen=True)
class RelativeAngle:
    """Heading minus bearing of a point, equal to ``angle`` [rad] modulo 2 pi."""

    at: tuple[float, float]
    angle: float
    low: float = 0.0
    high: float = 0.0

    def slope(self, x: float, y: float, heading: float) -> Slope:
        """The wrapped difference and its derivatives."""
        dx, dy = self.at[0] - x, self.at[1] - y
        square = dx * dx + dy * dy or 1e-24
        gap = remainder(heading - atan2(dy, dx) - self.angle, tau)
        return gap, -dy / square, dx / square, 1.0

    def smooth(self, casadi: Any, state: Any) -> list[tuple[Any, float, float]]:
        """Expressions for CasADi, each with its bounds."""
        dx, dy = (self.at[0] - state[0]) / LENGTH, (self.at[1] - state[1]) / LENGTH
        turned = state[2] - self.angle
        along, across = casadi.cos(turned), casadi.sin(turned)
        return [(along * dy - across * dx, 0.0, 0.0), (along * dx + across * dy, 0.0, inf)]


@dataclass(frozen=True)
class Heading:
    """A heading equal to ``angle`` [rad] modulo 2 pi."""

    angle: float
    low: float = 0.0
    high: float = 0.0

    def slope(self, x: float, y: float, heading: float) -> Slope:
        """The wrapped difference and its derivatives."""
        del x, y
        return remainder(heading - self.angle, tau), 0.0, 0.0, 1.0

    def smooth(self, casadi: Any, state: Any) -> list[tuple[Any, float, float]]:
        """Expressions for CasADi, each with its bounds."""
        turned = state[2] - self.angle
        return [(casadi.sin(turned), 0.0, 0.0), (casadi.cos(turned), 0.0, inf)]


Row = Distance | RelativeAngle | Heading

A, B, C = (200.0, 200.0), (500.0, 200.0), (350.0, 400.0)
P, Q, S = (100.0, 100.0), (300.0, 101.0), (500.0, 100.0)

#: Sets of sets.yaml in the peers' words.
FORMULATIONS: Mapping[str, tuple[Row, ...]] = {
    'worked_example': (Distance((50.0, 50.0), 10.0, 20.0),),
    'take_photo': (Distance(A, 50.0, 100.0), RelativeAngle(A, pi / 2)),
    'photo_from_75': (Distance(A, 75.0, 75.0), RelativeAngle(A, pi / 2)),
    'photo_with_a_heading': (
        Distance(A, 50.0, 100.0),
        RelativeAngle(A, pi / 2),
        Heading(pi / 6),
    ),
    'two_relative_angles': (
        RelativeAngle(A, 150.0 * pi / 180.0),
        RelativeAngle(B, 40.0 * pi / 180.0),
    ),
    'resection': (
        RelativeAngle(A, 3.077945044588987),
        RelativeAngle(B, 0.7217505543966423),
        RelativeAngle(C, -0.95970299357215),
    ),
    'trilateration': (
        Distance(A, 134.16407864998737, 134.16407864998737),
        Distance(B, 189.73665961010275, 189.73665961010275),
        Distance(C, 143.17821063276352, 143.17821063276352),
    ),
    'near_collinear_trilateration': (
        Distance(P, 206.15528128088303, 206.15528128088303),
        Distance(Q, 135.05924625881784, 135.05924625881784),
        Distance(S, 272.9468812791236, 272.9468812791236),
    ),
}


def missed(row: Row, value: float) -> float:
    """By how much ``value`` is below (negative) or above what the row allows."""
    if value < row.low:
        return value - row.low
    return value - row.high if value > row.high else 0.0


def violation(rows: Sequence[Row], pose: Pose) -> float:
    """By how much ``pose`` misses the rows at worst."""
    return max(abs(missed(row, row.slope(*pose)[0])) for row in rows)
