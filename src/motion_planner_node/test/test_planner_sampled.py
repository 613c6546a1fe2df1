"""Motions as poses: what is refused, and that poses are where and when they should be."""

from __future__ import annotations

import re
from itertools import pairwise
from math import inf, nan

import numpy as np
import pytest

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.sampled import sampled
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.world import read_world

WORLD = read_world(
    """
bounds: [0, 0, 80, 60]
robots:
  rover: {model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 1, speed: 2}
  truck: {model: reverse_car, wheelbase: 3, max_steering_angle: 0.5, speed: 2, radius: 1}
  vacuum: {model: differential, radius: 0.5, speed: 1, turning_speed: 2}
  butler: {model: omnidirectional, radius: 0.5, speed: 1, turning_speed: 2}
""",
    'world.yaml',
)
HERE = Attitude(10.0, 10.0, 0.0)


def motion(agent: str, *segments: Segment) -> Motion:
    return Motion(agent, HERE, segments)


def test_poses_come_at_the_speeds_of_the_robot() -> None:
    turned, driven = Segment(0.0, 0.0, turn=-1.0), Segment(0.0, -3.0)
    rows = sampled(WORLD, motion('vacuum', turned, driven), WORLD.revision, 0.5)
    assert rows.shape[1] == 4
    assert rows[0].tolist() == [10.0, 10.0, 0.0, 0.0]
    assert rows[-1, 3] == pytest.approx(1.0 / 2.0 + 3.0 / 1.0)
    assert (np.diff(rows[:, 3]) > 0.0).all()
    for (x0, y0, h0, t0), (x1, y1, h1, t1) in pairwise(rows.tolist()):
        assert np.hypot(x1 - x0, y1 - y0) <= 1.0 * (t1 - t0) + 1e-9
        assert abs(h1 - h0) <= 2.0 * (t1 - t0) + 1e-9
    assert len(sampled(WORLD, motion('rover'), '', 1.0)) == 1


@pytest.mark.parametrize(
    ('agent', 'segment', 'words'),
    [
        ('rover', Segment(0.25, 1.0), 'segment 1 has the steering angle 0.25; a car has -0.5, 0'),
        ('rover', Segment(0.5, -1.0), 'driven backwards, -1 m; a car does not'),
        ('rover', Segment(0.0, 1.0, direction=0.5), 'slides in the direction 0.5'),
        ('rover', Segment(0.0, 0.0, turn=0.5), 'turns on the spot by 0.5; a car does not'),
        ('rover', Segment(0.0, nan), 'not finite'),
        ('rover', Segment(0.0, 1e8), 'longer than 1e+07'),
        ('truck', Segment(0.0, 0.0, turn=0.5), 'turns on the spot by 0.5; a reverse_car'),
        ('vacuum', Segment(0.5, 1.0), 'has the steering angle 0.5; a differential has 0'),
        ('vacuum', Segment(0.0, 1.0, turn=0.5), 'turns on the spot and drives at the same time'),
        ('vacuum', Segment(0.0, 1.0, direction=0.5), 'slides'),
        ('butler', Segment(0.0, -1.0), 'driven backwards'),
    ],
)
def test_what_the_robot_cannot_do_is_refused(agent: str, segment: Segment, words: str) -> None:
    with pytest.raises(MotionPlannerError, match=re.escape(words)) as refused:
        sampled(WORLD, motion(agent, segment), '', 1.0)
    assert refused.value.code is Code.UNSUPPORTED


@pytest.mark.parametrize('spacing', [0.0, -1.0, nan, inf, 1e-9, 5e-324])
def test_a_spacing_without_sense_is_refused(spacing: float) -> None:
    with pytest.raises(MotionPlannerError) as refused:
        sampled(WORLD, motion('rover', Segment(0.0, 20.0)), '', spacing)
    assert refused.value.code is Code.UNSUPPORTED


def test_too_many_turns_are_too_many_poses() -> None:
    with pytest.raises(MotionPlannerError, match='poses') as refused:
        sampled(WORLD, motion('vacuum', Segment(0.0, 0.0, turn=1e7)), '', 1.0)
    assert refused.value.code is Code.UNSUPPORTED


def test_other_worlds_agents_and_places_are_refused() -> None:
    for agent, revision, code in (
        ('rover', 'other', Code.WORLD_CHANGED),
        ('ghost', '', Code.UNKNOWN_AGENT),
    ):
        with pytest.raises(MotionPlannerError) as refused:
            sampled(WORLD, motion(agent), revision, 1.0)
        assert refused.value.code is code
    with pytest.raises(MotionPlannerError) as refused:
        sampled(WORLD, Motion('rover', Attitude(inf, 0.0, 0.0)), '', 1.0)
    assert refused.value.code is Code.INVALID_START
