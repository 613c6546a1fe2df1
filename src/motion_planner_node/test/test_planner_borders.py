"""Goals on the very border of the map and of obstacles, and maps that leave no room."""

from __future__ import annotations

import pytest

from motion_planner_node.codes import Code, Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.body import TOUCH
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

WORLD = """
bounds: [0, 0, {size}, 40]
objects: {{corner: {{x: {size}, y: 40}}, side: {{x: 0, y: 20}}, wall: {{x: 24, y: 10}}}}
obstacles: [{{polygon: [[24, 5], [28, 5], [28, 15], [24, 15]]}}]
robots: {{bot: {{model: differential, radius: {radius}, speed: 1, turning_speed: 1}}}}
"""


def ask(constraint: str, radius: float, size: float = 40) -> GeometricAnswer:
    planner = MotionPlanner(read_world(WORLD.format(size=size, radius=radius), 'world.yaml'))
    labels = ''.join(f'(object {label})' for label in ('corner', 'side', 'wall'))
    text = f'((agent bot){labels}({constraint}))'
    return planner.satisfy(GeometricRequest(text, {'bot': Attitude(10.0, 10.0, 0.0)}))


@pytest.mark.parametrize('label', ['corner', 'side', 'wall'])
def test_a_place_on_a_border_is_for_points_and_near_it_is_for_discs(label: str) -> None:
    onto = ask(f'distance(bot, {label}) <= 1e-6', radius=0.0)
    assert onto.status is Status.FOUND, onto.message
    for constraint in (f'distance(bot, {label}) <= 0.99', f'distance(bot, {label}) = 0.5'):
        blocked = ask(constraint, radius=1.0)
        assert (blocked.status, blocked.code) == (Status.IMPOSSIBLE, Code.NO_FREE_DESTINATION)
        assert 'is blocked by' in blocked.message
    near = ask(f'distance(bot, {label}) <= 1.5', radius=1.0)
    assert near.status is Status.FOUND, near.message


def test_exactly_as_far_from_a_border_as_the_radius_is_never_too_near() -> None:
    answer = ask('distance(bot, side) <= 1', radius=1.0)
    # One single place: rounding may leave the question open, but no motion ends beyond the border by
    # more than what counts as a touch.
    assert answer.status is not Status.FOUND or answer.end['bot'].x >= 1.0 - TOUCH
    assert answer.message or answer.motion


@pytest.mark.parametrize('size', [30.0, 1e6])
def test_a_map_may_be_as_long_as_it_likes(size: float) -> None:
    assert ask('bot.x <= 20', radius=1.0, size=size).status is Status.FOUND


def test_a_robot_that_fills_the_map_starts_nowhere() -> None:
    answer = ask('bot.x <= 20', radius=21.0)
    assert (answer.status, answer.code) == (Status.IMPOSSIBLE, Code.START_IN_OBSTACLE)
    assert 'starts in an obstacle' in answer.message
