"""Where a car that only drives forward has room to turn round."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Frame, Row, Rows, frame_of
from motion_planner_node.robots.arcs import advance, wrap_angle
from motion_planner_node.robots.body import sufficient_clearance
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.motion import Pose
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.glance import SLACK, clearance_bounds
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.sweeps import word_is_free

#: A car looks ahead in steps [rad] on its sharpest arcs, and straight ones [turning radii], so many
#: at most.
BEND, AHEAD = 0.5, 0.7
STEPS = 96
#: Places that are as near as this, in turning radii and [rad], count as one.
SAME_PLACE, SAME_HEADING = 0.35, 0.3


@kernel
def _has_circle(frame: Frame, pose: Pose, circle: Rows) -> bool:
    """Whether there is room for a full circle from ``pose`` on; ``circle`` (1, 4) is overwritten."""
    circle[0, 1] = 2.0 * pi * frame.radius
    reach = frame.radius + sufficient_clearance(frame.body) + SLACK
    for side in range(2):
        turn = 1.0 - 2.0 * side
        x = pose[0] - turn * frame.radius * sin(pose[2])
        y = pose[1] + turn * frame.radius * cos(pose[2])
        if clearance_bounds(frame.shapes, x, y)[0] >= reach:
            return True
        circle[0, 0] = turn / frame.radius
        if word_is_free(frame.shapes, frame.body, pose, circle):
            return True
    return False


@kernel
def _leads_on(frame: Frame, start: Row, ahead: Rows, step: Rows) -> bool:
    """Whether the car gets from ``start`` (3,) to room for a circle, or can drive on for long.

    It looks straight ahead first; ``ahead`` (n, 3) and ``step`` (1, 4) are overwritten.
    """
    ahead[0] = start
    seen, taken = 1, 0
    waiting = np.zeros(len(ahead), np.int64)
    count = 1
    while count > 0 and taken < STEPS:
        count -= 1
        taken += 1
        here = ahead[waiting[count]]
        pose = (here[0], here[1], here[2])
        if _has_circle(frame, pose, step):
            return True
        for bend in (1.0, -1.0, 0.0):
            step[0, 0] = bend / frame.radius
            step[0, 1] = frame.radius * (BEND if bend != 0.0 else AHEAD)
            x, y, heading = advance(pose[0], pose[1], pose[2], step[0, 0], step[0, 1], 0.0, 0.0)
            is_new = True
            for k in range(seen):
                apart = hypot(ahead[k, 0] - x, ahead[k, 1] - y)
                turned = abs(wrap_angle(ahead[k, 2] - heading))
                if apart < SAME_PLACE * frame.radius and turned < SAME_HEADING:
                    is_new = False
                    break
            if is_new and word_is_free(frame.shapes, frame.body, pose, step):
                ahead[seen, 0], ahead[seen, 1], ahead[seen, 2] = x, y, heading
                waiting[count] = seen
                count, seen = count + 1, seen + 1
    return count > 0


@kernel
def _have_room(frame: Frame, rows: Rows) -> NDArray[np.bool_]:
    result = np.zeros(len(rows), np.bool_)
    ahead, step = np.empty((3 * STEPS + 1, 3)), np.zeros((1, 4))
    for i in range(len(rows)):
        result[i] = _leads_on(frame, rows[i], ahead, step)
    return result


class TurningRoom:
    """Where one robot can turn round in one scene.

    A robot that only drives forward may never get out of a place unless it gets to one with room for
    a full circle; others need no room.  A car that can drive on for long is taken to get to one.
    """

    def __init__(self, scene: Scene, robot: Robot) -> None:
        model = MODELS[robot.kind]
        self._is_everywhere = model.turns or model.reverses
        # Several threads may look at the same time: nothing of it is written to.
        self._frame = frame_of(scene.shapes, robot.body, robot.steering, robot.turning_radius)

    def at(self, rows: Rows) -> NDArray[np.bool_]:
        """From which free attitudes (n, 3) there is a way on, (n,): no dead ends."""
        if self._is_everywhere:
            return np.ones(len(rows), np.bool_)
        return _have_room(self._frame, np.ascontiguousarray(rows, np.float64))
