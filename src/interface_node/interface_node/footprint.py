"""The outline of a robot where it stands."""

from __future__ import annotations

from math import cos, sin, tau

from interface_node.plan import Attitude, Robot

#: Corners that a disc is drawn with.
DISC_CORNERS = 48

Outline = list[tuple[float, float]]


def disc_outline(x: float, y: float, radius: float) -> Outline:
    """Corners [m] on the circle round (x, y) of ``radius`` [m]."""
    turns = [tau * k / DISC_CORNERS for k in range(DISC_CORNERS)]
    return [(x + radius * cos(turn), y + radius * sin(turn)) for turn in turns]


def robot_outline(robot: Robot, attitude: Attitude) -> Outline:
    """Corners [m] in the map of the robot's footprint, or of its disc, at ``attitude``."""
    if not robot.footprint:
        return disc_outline(attitude.x, attitude.y, robot.radius)
    c, s = cos(attitude.heading), sin(attitude.heading)
    return [(attitude.x + c * x - s * y, attitude.y + s * x + c * y) for x, y in robot.footprint]
