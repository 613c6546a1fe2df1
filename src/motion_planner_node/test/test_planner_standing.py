"""Robots that stand are in the way of the one that drives, and of nothing else."""

from __future__ import annotations

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Scope, Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world import read_world
from motion_planner_node.world.model import Circle, Polygon
from motion_planner_node.world.standing import outline_of

CORRIDOR = """
bounds: [0, 0, 40, 20]
objects:
  goal: {x: 36, y: 10}
  cell: {x: 36, y: 2}
obstacles:
  - {name: south, polygon: [[15, 0], [25, 0], [25, 8], [15, 8]]}
  - {name: north, polygon: [[15, 12], [25, 12], [25, 20], [15, 20]]}
  - {name: bars, polygon: [[32, 0], [32.5, 0], [32.5, 5], [40, 5], [40, 5.5], [32, 5.5]]}
robots:
  driver: {model: differential, radius: 0.5, safety_margin: 0.1, speed: 1, turning_speed: 1}
  cart:
    model: differential
    footprint: [[-1, -1.5], [1, -1.5], [1, 1.5], [-1, 1.5]]
    speed: 1
    turning_speed: 1
  point: {model: differential, radius: 0, speed: 1, turning_speed: 1}
"""
PLANNER = MotionPlanner(read_world(CORRIDOR, 'corridor.yaml'))
HERE = Attitude(4.0, 10.0, 0.0)


def ask(label: str, distance: float, **others: Attitude) -> GeometricAnswer:
    text = f'((agent driver)(object {label})(distance(driver, {label}) <= {distance:g}))'
    return PLANNER.satisfy(GeometricRequest(text, {'driver': HERE, **others}))


def test_a_cart_across_the_corridor_is_not_driven_through() -> None:
    assert ask('goal', 1.0).status is Status.FOUND
    blocked = ask('goal', 1.0, cart=Attitude(20.0, 10.0, 0.0))
    assert (blocked.status, blocked.code) == (Status.IMPOSSIBLE, Code.UNREACHABLE)
    assert 'cart' in blocked.message + blocked.advice
    assert blocked.scope is Scope.THIS_START, 'the cart may drive away'


def test_what_is_impossible_without_others_is_so_wherever_they_go() -> None:
    for others in ({}, {'cart': Attitude(8.0, 4.0, 0.0)}):
        walled = ask('cell', 1.0, **others)
        assert (walled.status, walled.code) == (Status.IMPOSSIBLE, Code.UNREACHABLE)
        assert walled.scope is Scope.CONNECTED_STARTS


def test_a_destination_under_a_cart_lasts_as_long_as_the_cart_stands_there() -> None:
    taken = ask('goal', 0.5, cart=Attitude(36.0, 10.0, 0.0))
    assert (taken.code, taken.scope) == (Code.NO_FREE_DESTINATION, Scope.THIS_START)
    assert ask('goal', 0.5, cart=Attitude(8.0, 4.0, 0.0)).status is Status.FOUND


def test_a_robot_without_extent_is_in_nobodys_way() -> None:
    alone = ask('goal', 1.0)
    accompanied = ask('goal', 1.0, point=Attitude(20.0, 10.0, 0.0))
    assert accompanied.motion == alone.motion


def test_a_robot_that_touches_another_cannot_start() -> None:
    answer = ask('goal', 1.0, cart=Attitude(4.0, 11.0, 0.0))
    assert answer.code is Code.START_IN_OBSTACLE
    assert 'cart' in answer.message


@settings(max_examples=12, deadline=None)
@given(st.floats(5.5, 34.0), st.floats(2.0, 18.0), st.floats(-pi, pi))
def test_every_motion_keeps_clear_of_a_cart_anywhere(x: float, y: float, heading: float) -> None:
    cart = Attitude(x, y, heading)
    answer = ask('goal', 1.0, cart=cart)
    assert answer.status in {Status.FOUND, Status.IMPOSSIBLE}
    if answer.motion is None:
        return
    place = np.array([HERE.x, HERE.y])
    course = HERE.heading
    for segment in answer.motion.segments:
        course += segment.turn
        steps = np.linspace(0.0, segment.length, 60)[:, None]
        points = place + steps * np.array([cos(course), sin(course)])
        for point in points:
            # In the cart's own frame: the distance from a rectangle of 2 m by 3 m.
            away, bearing = hypot(*(point - (x, y))), atan2(point[1] - y, point[0] - x)
            ahead, left = away * cos(bearing - heading), away * sin(bearing - heading)
            gap = hypot(max(abs(ahead) - 1.0, 0.0), max(abs(left) - 1.5, 0.0))
            assert gap >= 0.6 - 1e-6
        place = points[-1]


@pytest.mark.parametrize('turn', [0.0, pi / 2, -2.0])
def test_outlines_stand_where_the_robots_do(turn: float) -> None:
    robots = PLANNER.world.robots
    at = Attitude(7.0, 3.0, turn)
    disc = outline_of(robots['driver'], at)
    assert disc == Circle('driver', (7.0, 3.0), 0.5)
    outline = outline_of(robots['cart'], at)
    assert isinstance(outline, Polygon)
    assert isinstance(robots['cart'], Robot)
    corner = complex(1.0, 1.5) * complex(cos(turn), sin(turn)) + complex(7.0, 3.0)
    np.testing.assert_allclose(outline.corners[2], (corner.real, corner.imag))
