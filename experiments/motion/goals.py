"""Sets of attitudes in a form of their own, and the texts that describe them to the motion planner.

The reference samples and tests these sets by a few formulas: it never reads the texts.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
AGENT = 'robot'

FREE, FIXED, TOWARDS = range(3)


@dataclass(frozen=True)
class Ring:
    """Places whose distance from an object is from ``low`` to ``high`` [m]."""

    label: str
    x: float
    y: float
    low: float
    high: float


@dataclass(frozen=True)
class Goal:
    """Attitudes in the intersection of rings, with headings of a kind.

    ``kind`` is FREE, FIXED (``angle`` is the heading) or TOWARDS (``angle`` is the heading less the
    bearing of the object of the first ring); headings may deviate by ``width`` [rad].
    """

    rings: tuple[Ring, ...]
    kind: int
    angle: float = 0.0
    width: float = 0.0

    @property
    def text(self) -> str:
        """The set in the language of geometric preconditions."""
        parts = [f'(agent {AGENT})', *(f'(object {ring.label})' for ring in self.rings)]
        for ring in self.rings:
            distance = f'distance({AGENT}, {ring.label})'
            if ring.low == ring.high:
                parts.append(f'({distance} = {ring.low!r})')
                continue
            if ring.low > 0.0:
                parts.append(f'({distance} >= {ring.low!r})')
            parts.append(f'({distance} <= {ring.high!r})')
        first = self.rings[0].label
        if self.kind == FIXED:
            parts.append(f'({AGENT}.heading = {self.angle!r})')
        elif self.kind == TOWARDS and self.width:
            parts.append(f'(field_of_view({AGENT}, {first}, {2.0 * self.width!r}))')
        elif self.kind == TOWARDS:
            parts.append(f'(rel_angle({AGENT}, {first}) = cos-and-sin({self.angle!r}))')
        return f'({"".join(parts)})'

    @property
    def numbers(self) -> tuple[Array, Array]:
        """The rings (k, 4) as x, y, low, high, and kind, angle and width, for compiled code."""
        rings = [(ring.x, ring.y, ring.low, ring.high) for ring in self.rings]
        width = math.pi if self.kind == FREE else self.width
        return np.array(rings), np.array([self.kind, self.angle, width])

    def sample(self, random: np.random.Generator, count: int) -> Array:
        """Attitudes of the set (n, 3), n at most ``count``, spread evenly over the first ring."""
        first = self.rings[0]
        radius = np.sqrt(random.uniform(first.low**2, first.high**2, count))
        bearing = random.uniform(-math.pi, math.pi, count)
        x, y = first.x + radius * np.cos(bearing), first.y + radius * np.sin(bearing)
        turned = random.uniform(-1.0, 1.0, count) * (math.pi if self.kind == FREE else self.width)
        base = np.full(count, self.angle)
        if self.kind == TOWARDS:
            base += bearing + math.pi
        heading = np.mod(base + turned + math.pi, math.tau) - math.pi
        rows = np.column_stack([x, y, heading])
        keep = np.ones(count, bool)
        for ring in self.rings[1:]:
            away = np.hypot(x - ring.x, y - ring.y)
            keep &= (ring.low <= away) & (away <= ring.high)
        return rows[keep]
