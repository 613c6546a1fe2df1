"""Pieces of motions in closed form: arcs, the solution of the paper's car model, slides, turns."""

from __future__ import annotations

from math import ceil, cos, inf, nextafter, pi, sin

from motion_planner_node.robots.kernel import kernel

_ALMOST_PI = nextafter(pi, 0.0)


@kernel
def wrap_angle(angle: float) -> float:
    """``angle`` [rad] in (-pi, pi]; an angle that is there already is not changed."""
    if -pi < angle <= pi:
        return angle
    wrapped = angle - 2.0 * pi * ceil((angle - pi) / (2.0 * pi))
    return min(max(wrapped, -_ALMOST_PI), pi)


@kernel
def other_way(turn: float) -> float:
    """The turn [rad] to the same heading the other way round; infinite for no turn at all."""
    return inf if turn == 0.0 else (turn - 2.0 * pi if turn > 0.0 else turn + 2.0 * pi)


@kernel
def advance(
    x: float,
    y: float,
    heading: float,
    curvature: float,
    length: float,
    direction: float = 0.0,
    turn: float = 0.0,
) -> tuple[float, float, float]:
    """The attitude (x, y [m], unwrapped heading [rad]) after a piece of a motion.

    The piece is an arc of signed ``length`` [m] at ``curvature`` [1/m], a slide in ``direction``
    [rad] from the heading, or a ``turn`` [rad] on the spot.  The chord of an arc has the heading of
    its middle, which stays accurate for tiny arcs.
    """
    half_turn = 0.5 * curvature * length
    chord = length if half_turn == 0.0 else length * (sin(half_turn) / half_turn)
    middle = heading + half_turn + direction
    return x + chord * cos(middle), y + chord * sin(middle), heading + 2.0 * half_turn + turn
