"""Where a car that only drives forward has room to turn round."""

from __future__ import annotations

from math import pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Frame, Rows, frame_of
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.sweeps import word_is_free

#: Turning radii that a car may drive ahead before it looks for room to turn.
RUN_UPS = (0.0, 1.0, 2.0, 4.0, 8.0)


@kernel
def _have_room(frame: Frame, rows: Rows) -> NDArray[np.bool_]:
    result = np.zeros(len(rows), np.bool_)
    pieces = np.zeros((2, 4))
    for i in range(len(rows)):
        pose = (rows[i, 0], rows[i, 1], rows[i, 2])
        for k in range(2 * len(RUN_UPS)):
            pieces[0, 1] = RUN_UPS[k // 2] * frame.radius
            pieces[1, 0] = (1.0 - 2.0 * (k % 2)) / frame.radius
            pieces[1, 1] = 2.0 * pi * frame.radius
            if word_is_free(frame.shapes, frame.body, pose, pieces):
                result[i] = True
                break
    return result


def turning_room(scene: Scene, robot: Robot, rows: Rows) -> NDArray[np.bool_]:
    """At which free attitudes (n, 3) there is room for a full circle, at once or straight ahead, (n,).

    A robot that only drives forward may never get out of a place without; others need no room.
    """
    model = MODELS[robot.kind]
    if model.turns or model.reverses:
        return np.ones(len(rows), np.bool_)
    frame = frame_of(scene.shapes, robot.body, robot.steering, robot.turning_radius)
    return _have_room(frame, np.ascontiguousarray(rows, np.float64))
