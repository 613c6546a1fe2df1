"""Where the robot meets the preconditions already, it stays, and nothing is searched for."""

from __future__ import annotations

from math import hypot, pi, remainder, tau

import pytest

from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning import pool
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, World, WorldObject

PHOTO = """((agent r)(object o) (distance(r, o) >= 50) (distance(r, o) <= 100)
 (rel_angle(r, o) = cos-and-sin(pi/2)))"""
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 400.0, 400.0),
    objects={'o': WorldObject('o', {'x': 200.0, 'y': 200.0})},
    obstacles=(),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
#: East of the object, looking away from it by a right angle: it is on the right.
START = Attitude(275.0, 200.0, -pi / 2)


def answered(alternative: int, start: Attitude = START) -> GeometricAnswer:
    request = GeometricRequest(PHOTO, {'r': start}, alternative=alternative)
    return MotionPlanner(WORLD).satisfy(request)


def test_it_stays_without_a_search(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_arguments: object, **_options: object) -> None:
        raise AssertionError('destinations were searched for')

    monkeypatch.setattr(pool, 'destinations_by_travel', refuse)
    answer = answered(0)
    assert answer.motion == Motion('r', START)
    assert answer.end == {'r': START}
    assert all(residual.satisfied for residual in answer.residuals)
    with pytest.raises(AssertionError):
        answered(0, Attitude(275.0, 200.0, 1.0))


def test_other_alternatives_lead_elsewhere() -> None:
    ends = [answered(alternative).end['r'] for alternative in range(3)]
    assert ends[0] == START
    for number, end in enumerate(ends):
        for other in ends[:number]:
            apart = hypot(end.x - other.x, end.y - other.y)
            assert apart >= 10.0 or abs(remainder(end.heading - other.heading, tau)) >= 0.75
