"""Motions as poses, for those who follow or draw them."""

from __future__ import annotations

from math import isfinite

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.problem import check_revision
from motion_planner_node.robots.commands import trouble_with
from motion_planner_node.robots.driving import steps_of, timed_sample
from motion_planner_node.robots.motion import Motion
from motion_planner_node.world.model import World

#: Poses of one path at most.
MOST_POSES = 100_000
#: What a segment may be long [m], and turn [rad], at most.
LONGEST_SEGMENT = 1e7


def sampled(world: World, motion: Motion, revision: str, spacing: float) -> NDArray[np.float64]:
    """Attitudes along ``motion`` and their times [s] from its start, (n, 4); see `driving.timed_sample`.

    :raises MotionPlannerError: WORLD_CHANGED when the world has another ``revision``; UNKNOWN_AGENT;
        INVALID_START; UNSUPPORTED for a ``spacing`` [m] that is not positive, a segment that is no
        command of the robot, or more than ``MOST_POSES``
    """
    check_revision(world, revision)
    robot = world.robots.get(motion.agent)
    if robot is None:
        raise MotionPlannerError(
            Code.UNKNOWN_AGENT,
            f'the motion is of agent {motion.agent}; the world has no such robot',
        )
    start = motion.start
    if not all(isfinite(number) for number in (start.x, start.y, start.heading)):
        raise MotionPlannerError(Code.INVALID_START, 'the start of the motion is not finite')
    if not (isfinite(spacing) and spacing > 0.0):
        raise MotionPlannerError(
            Code.UNSUPPORTED, f'poses {spacing:g} m apart make no sense: give a positive spacing'
        )
    for number, segment in enumerate(motion.segments, 1):
        trouble = trouble_with(segment, robot)
        if not trouble and max(abs(segment.length), abs(segment.turn)) > LONGEST_SEGMENT:
            trouble = f'is longer than {LONGEST_SEGMENT:g}'
        if trouble:
            raise MotionPlannerError(Code.UNSUPPORTED, f'segment {number} {trouble}')
    if sum(abs(item.length) for item in motion.segments) / spacing > MOST_POSES or (
        sum(steps_of(item.length, item.turn, spacing) for item in motion.segments) >= MOST_POSES
    ):
        raise MotionPlannerError(
            Code.UNSUPPORTED, f'more than {MOST_POSES} poses: give a wider spacing'
        )
    return timed_sample(motion, robot, spacing)
