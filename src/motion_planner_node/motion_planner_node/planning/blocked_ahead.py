"""A proof that a car that only drives forward cannot get away from its start.

After s metres, s at most a quarter of its sharpest circle of radius R, the heading has turned by at
most s / R. So the car is at least R sin(s / R) and at most s ahead of the start, and at most
R (1 - cos(s / R)) aside, whatever it does with the steering wheel. Where nothing of this front is
free, the car has not driven s metres, and all attitudes that it gets to are less far.
"""

from __future__ import annotations

from math import cos, pi, remainder, sin, tau
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code, Scope
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import Impossible, listed, wanted
from motion_planner_node.robots.body import necessary_clearance
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction.branch_and_prune import possible

Array = NDArray[np.float64]

#: Ways s that are tried, in equal steps up to a quarter of a circle.
WAYS = 16
#: Boxes ahead and aside that a front is covered with, and the places before it.
AHEAD, ASIDE = 24, 48
#: More than rounding moves a place [m] or a heading [rad].
SLACK = 1e-6


class Front(NamedTuple):
    """How far a car gets at most.

    way: [m] that it has not driven before it hits something.
    aside: [m] that it is aside by then at most.
    turned: [rad] that its heading has turned by then at most.
    places: (n, 2) where it would be, none of them free.
    """

    way: float
    aside: float
    turned: float
    places: Array


def front_of(start: Attitude, ground: Ground) -> Front | None:
    """The first front ahead of the car at ``start`` of which nothing is free, if there is one."""
    if not ground.needs_room_to_turn:
        return None
    radius = ground.robot.turning_radius
    needed = necessary_clearance(ground.robot.body)
    ways = np.arange(1, WAYS + 1) * (0.5 * pi * radius / WAYS)
    here = np.array([start.x, start.y])
    straight = here + np.outer(ways, (cos(start.heading), sin(start.heading)))
    for way in ways[ground.scene.clearance(straight) < needed].tolist():
        aside = radius * (1.0 - cos(way / radius))
        places, half = _boxes(start, radius * sin(way / radius), way, aside)
        if (ground.scene.clearance(places) + half < needed).all():
            return Front(way, aside, way / radius, places)
    return None


def held_back(problem: Problem, ground: Ground, front: Front) -> Impossible | None:
    """Whether the constraints cannot hold before the ``front`` of the problem's start."""
    return None if _may_be_met(problem, front) else _proof(problem, ground, front)


def blocked_ahead(problem: Problem, ground: Ground) -> Impossible | None:
    """Whether everything ahead is blocked before any place at which the constraints can hold."""
    front = front_of(problem.start, ground)
    return held_back(problem, ground, front) if front else None


def _boxes(start: Attitude, near: float, far: float, aside: float) -> tuple[Array, float]:
    """Middles (n, 2) and half the diagonal [m] of boxes over a rectangle as the car at ``start`` sees it.

    It reaches from ``near`` to ``far`` [m] ahead and ``aside`` [m] to both sides.
    """
    ahead = near + (np.arange(AHEAD) + 0.5) * ((far - near) / AHEAD)
    left = -aside + (np.arange(ASIDE) + 0.5) * (2.0 * aside / ASIDE)
    u, v = (grid.ravel() for grid in np.meshgrid(ahead, left))
    c, s = cos(start.heading), sin(start.heading)
    middles = np.column_stack((start.x + c * u - s * v, start.y + s * u + c * v))
    half = 0.5 * float(np.hypot((far - near) / AHEAD, 2.0 * aside / ASIDE))
    return middles, half + SLACK


def _may_be_met(problem: Problem, front: Front) -> bool:
    """Whether the constraints may be met before ``front``."""
    middles, half = _boxes(problem.start, 0.0, front.way, front.aside)
    heading = remainder(problem.start.heading, tau)
    for turn in (-tau, 0.0, tau):
        least = max(heading + turn - front.turned - SLACK, -pi)
        most = min(heading + turn + front.turned + SLACK, pi)
        if least > most:
            continue
        low = np.column_stack((middles - half, np.full(len(middles), least)))
        high = np.column_stack((middles + half, np.full(len(middles), most)))
        if possible(problem.program, low, high).any():
            return True
    return False


def _proof(problem: Problem, ground: Ground, front: Front) -> Impossible:
    near = [ground.scene.nearest_obstacle(x, y)[0] for x, y in front.places]
    names = sorted(set(near), key=lambda name: (-near.count(name), name))
    return Impossible(
        Code.UNREACHABLE,
        Scope.THIS_START,
        f'{problem.agent} cannot get away from its start: however it steers, {listed(names)} '
        f'stops it within {front.way:.4g} m, and nowhere before that {wanted(problem)} holds',
        f'{problem.agent} only drives forward: start with another heading',
    )
