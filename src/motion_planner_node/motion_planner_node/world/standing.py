"""Robots that stand still while another one drives: obstacles on its way, for as long."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
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


def with_standing(world: World, standing: Mapping[str, Attitude]) -> World:
    """The world with the robots ``standing`` in it as obstacles, under the same revision."""
    outlines = (
        outline_of(world.robots[label], attitude) for label, attitude in sorted(standing.items())
    )
    # A robot without extent is in nobody's way.
    solid = (shape for shape in outlines if isinstance(shape, Polygon) or shape.radius > 0.0)
    return replace(world, obstacles=(*world.obstacles, *solid))
