"""Length, duration and clearance that answers tell, by shapely and by integration."""

from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest
import shapely
import yaml
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world
from tests.support.vehicle import SPACING, TOLERANCE, Rows, Vehicle

ROVER = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
TEXT = ROVER.read_text(encoding='utf-8')
RAW = yaml.safe_load(TEXT)
PLANNER = MotionPlanner(read_world(TEXT, 'world.yaml'))
CAR = RAW['robots']['rover0']
VEHICLE = Vehicle(CAR)
OBSTACLES = RAW['obstacles']
SIDES = [
    shapely.box(*RAW['bounds']).exterior,
    *(shapely.Polygon(item['polygon']) for item in OBSTACLES if 'polygon' in item),
]
DISCS = [item['circle'] for item in OBSTACLES if 'circle' in item]
LOCATIONS = sorted(RAW['objects'])[1:]
NEAR = '((agent rover0)(object {0})(distance(rover0, {0}) <= 40))'

attitudes = st.builds(
    Attitude, st.floats(10, 790), st.floats(10, 590), st.floats(-pi, pi, exclude_min=True)
)


def room(driven: Rows) -> float:
    """Least distance [m] of the car's disc from anything at attitudes (n, 3)."""
    places = shapely.points(driven[:, :2])
    least = min(float(shapely.distance(places, side).min()) for side in SIDES)
    for disc in DISCS:
        x, y = disc['center']
        away = np.hypot(driven[:, 0] - x, driven[:, 1] - y).min()
        least = min(least, float(away) - disc['radius'])
    return least - VEHICLE.radius


def check_figures(answer: GeometricAnswer) -> None:
    """Assert that the answer tells what is integrated and measured here."""
    assert answer.motion is not None
    start = answer.motion.start
    segments = [[segment.steering_angle, segment.length] for segment in answer.motion.segments]
    driven = VEHICLE.drive((start.x, start.y, start.heading), segments)
    length = float(np.hypot(*np.diff(driven[:, :2], axis=0).T).sum())
    # Chords of the spacing are shorter than arcs by less than this share.
    assert answer.length == pytest.approx(length, rel=2e-6, abs=TOLERANCE)
    assert answer.duration == pytest.approx(length / CAR['speed'], rel=2e-6, abs=TOLERANCE)
    # What is nearest lies between two samples, at most half a step from one of them.
    measured = room(driven)
    assert measured - 0.5 * SPACING - TOLERANCE <= answer.clearance <= measured + TOLERANCE


@settings(max_examples=40, deadline=None)
@given(attitudes, st.sampled_from(LOCATIONS), st.integers(0, 2**64 - 1))
def test_figures_of_motions_from_anywhere_are_right(start: Attitude, label: str, seed: int) -> None:
    state = {'rover0': start}
    answer = PLANNER.satisfy(GeometricRequest(NEAR.format(label), state, seed=seed))
    assume(answer.status is Status.FOUND)
    check_figures(answer)


def test_a_robot_that_stays_has_the_room_of_its_place() -> None:
    start = Attitude(20.0, 20.0, 0.0)
    request = GeometricRequest(NEAR.format('location0'), {'rover0': start})
    answer = PLANNER.satisfy(request)
    assert (answer.length, answer.duration) == (0.0, 0.0)
    assert answer.clearance == pytest.approx(20.0 - CAR['radius'])
    check_figures(answer)
