"""Paths of every model in an empty world: symmetric in length, exact at both ends, repeatable."""

from __future__ import annotations

from math import cos, hypot, pi, remainder, sin, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.paths import PathOutcome, plan_path
from motion_planner_node.robots.driving import end_of, shortest_between
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world import Scene
from motion_planner_node.world.model import Bounds, World

ROBOTS = [
    Robot('r', 8.0, 0.5, 5.0, 2.0),
    Robot('r', 8.0, 0.5, 5.0, 2.0, kind='reverse_car'),
    Robot('r', 0.0, 0.0, 5.0, 2.0, kind='differential', turning_speed=1.0),
    Robot('r', 0.0, 0.0, 5.0, 2.0, kind='omnidirectional', turning_speed=1.0),
]
SCENE = Scene(World('', '', Bounds(-500, -500, 500, 500), {}, (), {}))
places = st.floats(-150.0, 150.0)
attitudes = st.builds(Attitude, places, places, st.floats(-3.1, 3.1))


def path(robot: Robot, start: Attitude, goal: Attitude) -> Motion:
    result = plan_path(SCENE, robot, start, [goal], 0, lambda: False)
    assert result.outcome is PathOutcome.FOUND, result.reason
    assert result.motion is not None
    return result.motion


@pytest.mark.parametrize('robot', ROBOTS, ids=lambda robot: robot.kind)
@settings(max_examples=15, deadline=None)
@given(start=attitudes, goal=attitudes, turn=st.floats(-3.1, 3.1), mirrored=st.booleans())
def test_a_turned_or_mirrored_path_is_as_long(
    robot: Robot, start: Attitude, goal: Attitude, turn: float, mirrored: bool
) -> None:
    side = -1.0 if mirrored else 1.0

    def moved(item: Attitude) -> Attitude:
        x, y = item.x, side * item.y
        return Attitude(
            x * cos(turn) - y * sin(turn),
            x * sin(turn) + y * cos(turn),
            remainder(side * item.heading + turn, tau),
        )

    length = path(robot, start, goal).length
    # In an empty world nothing is shorter than the shortest word, and it is found.
    rows = np.array([[item.x, item.y, item.heading] for item in (start, goal)])
    shortest = float(shortest_between(rows[0], rows[1], robot)[0])
    assert length == pytest.approx(shortest, abs=1e-6)
    # Rounding may cost a car that only drives forward a full circle, or save it one.
    circle = tau * robot.turning_radius if robot.kind == 'car' else 0.0
    difference = abs(path(robot, moved(start), moved(goal)).length - length)
    assert min(difference, abs(difference - circle)) < 1e-5


@pytest.mark.parametrize('robot', ROBOTS, ids=lambda robot: robot.kind)
@settings(max_examples=15, deadline=None)
@given(start=attitudes, goal=attitudes)
def test_a_path_begins_and_ends_exactly_and_is_the_same_again(
    robot: Robot, start: Attitude, goal: Attitude
) -> None:
    motion = path(robot, start, goal)
    end = end_of(motion, robot)
    assert motion.start == start
    assert hypot(end.x - goal.x, end.y - goal.y) < 1e-8
    assert abs(remainder(end.heading - goal.heading, tau)) < 1e-9
    assert -pi < end.heading <= pi
    assert path(robot, start, goal) == motion
