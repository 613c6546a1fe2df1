"""Reeds-Shepp paths: the shortest ways of a car that also drives backwards, without obstacles.

J. A. Reeds and L. A. Shepp, "Optimal paths for a car that goes both forwards and backwards",
Pacific Journal of Mathematics 145 (1990); numbers in brackets are its formulas.

Each family below is one formula for the lengths of its pieces.  The others follow from it by
symmetry: driving everything the other way (time flip) and exchanging left and right (reflection).
Lengths come signed, so all signs of one kind of path are one family, and every path of a family
ends where it should: the shortest of them all is the shortest path.
"""

from __future__ import annotations

from math import acos, asin, atan2, cos, hypot, inf, pi, sin, sqrt

import numpy as np

from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.kernel import kernel

#: Turns of the pieces of each family: 1 is left, 0 straight, -1 right.
TURNS = np.array(
    [
        [1, 0, 1, 0, 0],
        [1, 0, -1, 0, 0],
        [1, -1, 1, 0, 0],
        [1, -1, 1, -1, 0],
        [1, -1, 1, -1, 0],
        [1, -1, 0, 1, 0],
        [1, -1, 0, -1, 0],
        [1, 0, -1, 1, 0],
        [-1, 0, -1, 1, 0],
        [1, -1, 0, 1, -1],
    ]
)

#: Which of t, u, v, -u, -pi/2 and 0 is the length of each piece, in turning radii.
_T, _U, _V, _MINUS_U, _QUARTER, _NONE = range(6)
PARTS = np.array(
    [
        [_T, _U, _V, _NONE, _NONE],
        [_T, _U, _V, _NONE, _NONE],
        [_T, _U, _V, _NONE, _NONE],
        [_T, _U, _MINUS_U, _V, _NONE],
        [_T, _U, _U, _V, _NONE],
        [_T, _QUARTER, _U, _V, _NONE],
        [_T, _QUARTER, _U, _V, _NONE],
        [_V, _U, _QUARTER, _T, _NONE],
        [_V, _U, _QUARTER, _T, _NONE],
        [_T, _QUARTER, _U, _QUARTER, _V],
    ]
)

#: Four symmetries of each family.
WORDS = 4 * len(TURNS)

Lengths = tuple[float, float, float]


@kernel
def _equal_middles(u: float, v: float, xi: float, eta: float, phi: float) -> Lengths:
    """The outer lengths of four arcs in turns whose inner ones are ``u`` and ``v`` (8.6)."""
    delta = u - v
    a, b = sin(u) - sin(delta), cos(u) - cos(delta) - 1.0
    outer = atan2(eta * a - xi * b, xi * a + eta * b)
    if 2.0 * (cos(delta) - cos(v) - cos(u)) + 3.0 < 0.0:
        outer += pi
    return wrap_angle(outer), u, wrap_angle(outer - u + v - phi)


@kernel
def family_lengths(family: int, x: float, y: float, phi: float) -> Lengths:
    """Lengths t, u, v of a path of ``family`` from (0, 0, 0) to (x, y, phi), turning radius 1.

    Infinite when there is none.
    """
    none = (inf, inf, inf)
    if family in (0, 2, 5, 7):
        # Both ends turn to the left: the centre of the last circle as seen from that of the first.
        xi, eta = x - sin(phi), y - 1.0 + cos(phi)
    else:
        xi, eta = x + sin(phi), y - 1.0 - cos(phi)
    rho, theta = hypot(xi, eta), atan2(eta, xi)
    if family == 0:  # (8.1)
        return wrap_angle(theta), rho, wrap_angle(phi - theta)
    if family == 1:  # (8.2)
        if rho < 2.0:
            return none
        u = sqrt(rho * rho - 4.0)
        t = theta + atan2(2.0, u)
        return wrap_angle(t), u, wrap_angle(t - phi)
    if family == 2:  # (8.3) and (8.4)
        if rho > 4.0:
            return none
        u = -2.0 * asin(0.25 * rho)
        t = theta + 0.5 * u + pi
        return wrap_angle(t), u, wrap_angle(phi - t + u)
    if family == 3:  # (8.7)
        if rho > 2.0:
            return none
        u = acos(0.25 * (2.0 + rho))
        return _equal_middles(u, -u, xi, eta, phi)
    if family == 4:  # (8.8)
        share = (20.0 - rho * rho) / 16.0
        if not 0.0 <= share <= 1.0:
            return none
        u = -acos(share)
        return _equal_middles(u, u, xi, eta, phi)
    if rho < 2.0:
        return none
    if family in (5, 7):  # (8.9)
        r = sqrt(rho * rho - 4.0)
        t = theta + atan2(r, -2.0)
        return wrap_angle(t), 2.0 - r, wrap_angle(phi - 0.5 * pi - t)
    if family in (6, 8):  # (8.10)
        t = atan2(xi, -eta)
        return wrap_angle(t), 2.0 - rho, wrap_angle(t + 0.5 * pi - phi)
    u = 4.0 - sqrt(rho * rho - 4.0)  # (8.11)
    t = atan2((4.0 - u) * xi - 2.0 * eta, -2.0 * xi + (u - 4.0) * eta)
    return wrap_angle(t), u, wrap_angle(t - phi)
