"""Alternatives: the same for the same request, and really different from each other."""

from __future__ import annotations

from math import hypot, remainder, tau

import numpy as np
import pytest

from motion_planner_node.codes import Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Polygon, World, WorldObject

WALL = Polygon('wall', ((330.0, 180.0), (370.0, 180.0), (370.0, 420.0), (330.0, 420.0)))
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 600.0, 600.0),
    objects={'o': WorldObject('o', {'x': 300.0, 'y': 300.0})},
    obstacles=(WALL,),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
STATE = {'r': Attitude(60.0, 300.0, 0.0)}
PHOTO = (
    '(agent r)(object o)(distance(r, o) >= 50)(distance(r, o) <= 100)'
    '(rel_angle(r, o) = cos-and-sin(pi/2))'
)


def ends(count: int) -> list[Attitude]:
    planner = MotionPlanner(WORLD)
    answers = [planner.satisfy(GeometricRequest(PHOTO, STATE, alternative=k)) for k in range(count)]
    assert all(answer.status is Status.FOUND for answer in answers)
    return [answer.end['r'] for answer in answers]


def test_the_first_alternatives_are_on_other_sides() -> None:
    first, *others = ends(4)
    for index, end in enumerate(others):
        for other in (first, *others[:index]):
            apart = hypot(end.x - other.x, end.y - other.y)
            turned = abs(remainder(end.heading - other.heading, tau))
            assert apart >= 60.0 or turned >= 1.4
    bearings = [np.arctan2(end.y - 300.0, end.x - 300.0) for end in (first, *others)]
    assert max(abs(remainder(b - bearings[0], tau)) for b in bearings) > 1.5


def test_many_alternatives_fill_the_ring_without_repetition() -> None:
    found = ends(14)
    lengths = [hypot(end.x - 300.0, end.y - 300.0) for end in found]
    assert max(lengths) - min(lengths) > 25.0
    for index, end in enumerate(found):
        for other in found[:index]:
            turned = abs(remainder(end.heading - other.heading, tau))
            assert hypot(end.x - other.x, end.y - other.y) >= 10.0 or turned >= 0.75


@pytest.mark.parametrize('alternative', [1, 3])
def test_an_alternative_does_not_depend_on_who_asked_before(alternative: int) -> None:
    asked = GeometricRequest(PHOTO, STATE, alternative=alternative)
    alone = MotionPlanner(WORLD).satisfy(asked)
    assert alone.end['r'] == ends(alternative + 1)[alternative]
