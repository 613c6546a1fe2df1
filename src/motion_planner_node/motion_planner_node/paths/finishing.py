"""From a path to a motion: exact segments, checked against the world once more."""

from __future__ import annotations

import numpy as np

from motion_planner_node.paths.edges import Rows, free_word
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.driving import integrate
from motion_planner_node.robots.motion import Motion, Segment, merged
from motion_planner_node.robots.steering import MOST_PIECES


def motion_along(query: Query, path: Rows) -> Motion | None:
    """The motion along ``path`` (n, 3), each edge planned from where the one before ended.

    None when it is not free as a whole, by the exact check with the clearance that is needed.
    """
    robot, here = query.robot, query.attitude
    segments: list[Segment] = []
    pieces = np.zeros((MOST_PIECES, 4))
    for row in path[1:]:
        pose = np.array([here.x, here.y, here.heading], np.float64)
        if free_word(query.frame, pose, row, np.inf, pieces)[1] < 0:
            return None
        edge = robot.segments_of(pieces)
        segments += edge
        here = integrate(here, edge, robot)
    motion = Motion(robot.label, query.attitude, merged(segments))
    return motion if query.scene.motion_is_free(motion, robot) else None


def first_valid(query: Query, paths: list[Rows]) -> tuple[Motion | None, int]:
    """The motion along the first of ``paths`` that is free, and to which goal (-1 for another)."""
    for path in paths:
        motion = motion_along(query, path)
        if motion is not None:
            at_end = np.flatnonzero((query.goals == path[-1]).all(axis=1))
            return motion, int(at_end[0]) if len(at_end) else -1
    return None, -1
