"""A car shut in a pen: what it can get to is found, and what it cannot get to does not take long."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.paths import PathOutcome, plan_path
from motion_planner_node.paths.edges import frame_of
from motion_planner_node.paths.shortening import CHUNK, HUBS, best_subsequence
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.stopping import never
from motion_planner_node.world.model import Bounds, World, WorldObject
from motion_planner_node.world.scene import Scene

#: Turning radius 14.6 m, in a pen of 34 m: the car hits a wall sooner or later.
CAR = Robot('car', 8.0, 0.5, 1.0, 2.0)
PEN = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 34.0, 34.0),
    objects={'post': WorldObject('post', {'x': 30.0, 'y': 30.0})},
    obstacles=(),
    robots={'car': CAR},
)
SCENE = Scene(PEN)
START = Attitude(6.0, 6.0, 0.0)
#: In the corner behind the car, looking into it.
BEHIND = Attitude(2.0, 4.0, -2.5)
attitudes = st.builds(Attitude, st.floats(2.0, 32.0), st.floats(2.0, 32.0), st.floats(-pi, pi))


@settings(max_examples=8, deadline=None)
@given(attitudes)
def test_a_destination_is_found_beside_one_that_cannot_be_reached(goal: Attitude) -> None:
    alone = plan_path(SCENE, CAR, START, [goal], 0, never)
    both = plan_path(SCENE, CAR, START, [BEHIND, goal], 0, never)
    assert (both.outcome is PathOutcome.FOUND) or alone.outcome is not PathOutcome.FOUND
    assert both.goal_index != 0


def test_what_cannot_be_reached_is_given_up_after_one_look_at_all_there_is() -> None:
    questions = 0

    def count() -> bool:
        nonlocal questions
        questions += 1
        return False

    text = '((agent car)(object post)(distance(car, post) >= 36)(car.heading = -2.5))'
    answer = MotionPlanner(PEN).satisfy(GeometricRequest(text, {'car': START}), count)
    assert answer.code is Code.NO_PATH
    assert 'all that there are' in answer.message
    assert questions < 400


def test_long_paths_are_made_shorter_with_looks_at_the_clock() -> None:
    frame = frame_of(SCENE.shapes, CAR.body, CAR.steering, CAR.turning_radius)
    size = 3000
    x = np.linspace(2.0, 32.0, size)
    rows = np.column_stack((x, np.full_like(x, 17.0), np.zeros_like(x)))
    looks = 0

    def count() -> None:
        nonlocal looks
        looks += 1

    path, edges = best_subsequence(frame, rows, x - 2.0, count)
    assert path.tolist() == [rows[0].tolist(), rows[-1].tolist()]
    assert edges.tolist() == [30.0]
    hubs = HUBS * sqrt(size)
    assert looks >= hubs * (hubs - 1) / 2 / (CHUNK + hubs)
