"""How near the estimates of advice come to the motions that are found."""

from __future__ import annotations

from math import hypot, pi
from pathlib import Path

import numpy as np
import pytest

from motion_planner_node.codes import Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

ROVER = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
PHOTO = (
    '((agent rover0)(object {0})(distance(rover0, {0}) >= 50)(distance(rover0, {0}) <= 100)'
    '(rel_angle(rover0, {0}) = cos-and-sin(pi/2)))'
)
TEXTS = (
    PHOTO,
    '((agent rover0)(object {0})(distance(rover0, {0}) <= 40))',
    '((agent rover0)(object {0})(distance(rover0, {0}) = 75)(rover0.heading = pi/2))',
)
WALL = """
bounds: [0, 0, 100, 60]
objects: {{goal: {{x: 60, y: 5}}}}
obstacles: [{{polygon: [[48, 0], [50, 0], [50, 50], [48, 50]]}}]
robots: {{robot: {{{model}, radius: 1, speed: 1}}}}
"""
MODELS = (
    'model: car, wheelbase: 1, max_steering_angle: 0.5',
    'model: reverse_car, wheelbase: 1, max_steering_angle: 0.5',
    'model: differential, turning_speed: 1',
    'model: omnidirectional, turning_speed: 1',
)


def costs(planner: MotionPlanner, text: str, agent: str, start: Attitude) -> tuple[float, float]:
    """The estimate of advice, and the length of the motion that is found; 0 where none is."""
    state = {agent: start}
    (candidate,) = planner.advise(AdviceRequest((text,), state)).candidates
    answer = planner.satisfy(GeometricRequest(text, state))
    return candidate.estimate, answer.length if answer.status is Status.FOUND else 0.0


def test_estimates_in_the_rovers_world_are_about_right() -> None:
    planner = MotionPlanner(read_world(ROVER.read_text(encoding='utf-8'), 'world.yaml'))
    random = np.random.default_rng(7)
    ratios = []
    for number in range(90):
        x, y, heading = random.uniform((20.0, 20.0, -pi), (780.0, 580.0, pi))
        label = f'location{random.integers(1, 9)}'
        text = TEXTS[number % len(TEXTS)].format(label)
        estimate, length = costs(planner, text, 'rover0', Attitude(x, y, heading))
        if length > 0.0:
            ratios.append(estimate / length)
    assert len(ratios) >= 60
    low, median, high = np.percentile(ratios, (5, 50, 95))
    assert 0.95 <= median <= 1.05
    assert 0.8 <= low <= high <= 1.25


@pytest.mark.parametrize('model', MODELS)
def test_estimates_go_round_a_wall(model: str) -> None:
    planner = MotionPlanner(read_world(WALL.format(model=model), 'wall.yaml'))
    text = '((agent robot)(object goal)(distance(robot, goal) <= 2))'
    for y in (5.0, 20.0, 40.0):
        start = Attitude(40.0, y, 0.5 * pi)
        estimate, length = costs(planner, text, 'robot', start)
        straight = hypot(60.0 - start.x, 5.0 - y) - 2.0
        # Up to the end of the wall, and down again.
        assert abs(estimate - length) <= 0.05 * length < 0.5 * (length - straight)
