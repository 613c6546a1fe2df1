"""Goals for compiled code: whether an attitude is in one, and which heading it wants at a place."""

from __future__ import annotations

from math import atan2, hypot, pi, tau
from typing import NamedTuple

from experiments.motion.geometry import Array, compiled


class Aim(NamedTuple):
    """A goal as `goals.Goal.numbers` gives it, and attitudes (m, 3) of it that are free.

    rings: (k, 4) x, y, low, high [m]
    kind: (3,) the kind of headings, the angle and the width [rad]
    """

    rings: Array
    kind: Array
    samples: Array


@compiled
def in_goal(aim: Aim, x: float, y: float, slack: float) -> bool:
    """Whether a place is in all rings, or as near as ``slack`` [m] to it."""
    for k in range(len(aim.rings)):
        away = hypot(x - aim.rings[k, 0], y - aim.rings[k, 1])
        if away < aim.rings[k, 2] - slack or away > aim.rings[k, 3] + slack:
            return False
    return True


@compiled
def wanted_heading(aim: Aim, x: float, y: float) -> float:
    """The middle of the headings [rad] that the goal wants at a place."""
    if aim.kind[0] == 2.0:
        return float(aim.kind[1] + atan2(aim.rings[0, 1] - y, aim.rings[0, 0] - x))
    return float(aim.kind[1])


@compiled
def heading_error(aim: Aim, x: float, y: float, heading: float) -> float:
    """By how much [rad] a heading at a place misses what the goal wants, 0 when it does not."""
    off = abs((heading - wanted_heading(aim, x, y) + pi) % tau - pi)
    return float(max(off - aim.kind[2], 0.0))
