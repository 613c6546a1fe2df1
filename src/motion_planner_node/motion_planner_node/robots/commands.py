"""Whether a segment is a command that a robot can carry out."""

from __future__ import annotations

from math import isfinite

from motion_planner_node.robots.motion import Segment
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot


def trouble_with(segment: Segment, robot: Robot) -> str:
    """What is wrong with ``segment`` for ``robot``, as the end of a sentence; '' when nothing is."""
    model = MODELS[robot.kind]
    numbers = (segment.steering_angle, segment.length, segment.direction, segment.turn)
    if not all(isfinite(number) for number in numbers):
        return f'has a number that is not finite: {numbers}'
    angle, most = segment.steering_angle, robot.max_steering_angle if model.steers else 0.0
    if angle not in (-most, 0.0, most):
        allowed = f'-{most:g}, 0 or {most:g}' if model.steers else '0'
        return f'has the steering angle {angle:g}; a {model.name} has {allowed}'
    if segment.length < 0.0 and not model.reverses:
        return f'is driven backwards, {segment.length:g} m; a {model.name} does not do so'
    if segment.direction and not model.slides:
        return f'slides in the direction {segment.direction:g}; a {model.name} does not do so'
    if segment.turn and not model.turns:
        return f'turns on the spot by {segment.turn:g}; a {model.name} does not do so'
    if segment.turn and (segment.length or angle or segment.direction):
        return 'turns on the spot and drives at the same time'
    return ''
