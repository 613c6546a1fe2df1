"""Robots that stand still while another one drives: obstacles on its way, for as long."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, sin

from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Circle, Obstacle, Polygon, World


def outline_of(robot: Robot, attitude: Attitude) -> Obstacle:
    """The disc or footprint of a robot where it stands, named as the robot.

    Its own safety margin is not part of it: the one that drives keeps its own.
    """
    if not robot.footprint:
        return Circle(robot.label, (attitude.x, attitude.y), robot.radius)
    c, s = cos(attitude.heading), sin(attitude.heading)
    corners = tuple(
        (attitude.x + c * x - s * y, attitude.y + s * x + c * y) for x, y in robot.footprint
    )
    return Polygon(robot.label, corners)


def outlines_of(world: World, standing: Mapping[str, Attitude]) -> list[Obstacle]:
    """The robots of ``world`` that are ``standing`` somewhere, as obstacles."""
    outlines = (
        outline_of(world.robots[label], attitude) for label, attitude in sorted(standing.items())
    )
    # A robot without extent is in nobody's way.
    return [shape for shape in outlines if isinstance(shape, Polygon) or shape.radius > 0.0]
