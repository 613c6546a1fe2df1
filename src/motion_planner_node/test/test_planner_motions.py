"""FOUND answers, checked by shapely and by arcs of this file: none of the planner's own geometry."""

from __future__ import annotations

import os
import subprocess
import sys
from math import cos, hypot, pi, remainder, sin, tan, tau
from pathlib import Path

import numpy as np
import pytest
import shapely
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Status
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.ways import DETOUR
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

PACKAGE = Path(__file__).resolve().parents[1]
ROVER = PACKAGE.parent / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
TEXT = ROVER.read_text(encoding='utf-8')
PLANNER = MotionPlanner(read_world(TEXT, 'world.yaml'))
RAW = yaml.safe_load(TEXT)
CAR = RAW['robots']['rover0']
OBJECTS = {label: (fields['x'], fields['y']) for label, fields in RAW['objects'].items()}
LOCATIONS = sorted(OBJECTS)[1:]
OBSTACLES = shapely.union_all(
    [
        shapely.Polygon(item['polygon'])
        if 'polygon' in item
        else shapely.Point(item['circle']['center']).buffer(item['circle']['radius'], 256)
        for item in RAW['obstacles']
    ]
)
PHOTO = (
    '((agent rover0)(object {0})(distance(rover0, {0}) >= 50)(distance(rover0, {0}) <= 100)'
    '(rel_angle(rover0, {0}) = cos-and-sin(pi/2)))'
)
START = {'rover0': Attitude(20.0, 20.0, 0.0)}

attitudes = st.builds(
    Attitude, st.floats(10, 790), st.floats(10, 590), st.floats(-pi, pi, exclude_min=True)
)


def driven(answer: GeometricAnswer, spacing: float = 0.5) -> list[tuple[float, float, float]]:
    """Attitudes along the motion by the car model's closed solution on circles and lines."""
    motion = answer.motion
    assert motion is not None
    x, y, heading = motion.start.x, motion.start.y, motion.start.heading
    rows = [(x, y, heading)]
    for segment in motion.segments:
        assert segment.length > 0.0
        assert segment.steering_angle in {
            -CAR['max_steering_angle'],
            0.0,
            CAR['max_steering_angle'],
        }
        curvature = tan(segment.steering_angle) / CAR['wheelbase']
        count = int(segment.length / spacing) + 1
        for number in range(1, count + 1):
            way = segment.length * number / count
            if curvature:
                turned = heading + curvature * way
                row = (
                    x + (sin(turned) - sin(heading)) / curvature,
                    y - (cos(turned) - cos(heading)) / curvature,
                    turned,
                )
            else:
                row = (x + way * cos(heading), y + way * sin(heading), heading)
            rows.append(row)
        x, y, heading = rows[-1]
    return rows


def check_found(answer: GeometricAnswer, start: Attitude, label: str) -> None:
    """Assert that the car gets where it says without touching anything, and may take its photo."""
    assert answer.status is Status.FOUND
    assert answer.motion is not None
    assert answer.motion.start == start
    rows = driven(answer)
    end = answer.end['rover0']
    assert hypot(rows[-1][0] - end.x, rows[-1][1] - end.y) < 1e-7
    assert abs(remainder(rows[-1][2] - end.heading, tau)) < 1e-9
    assert -pi < end.heading <= pi
    points = shapely.points([row[:2] for row in rows])
    assert shapely.distance(points, OBSTACLES).min() >= CAR['radius'] - 1e-3
    x_min, y_min, x_max, y_max = RAW['bounds']
    inside = shapely.box(x_min, y_min, x_max, y_max).buffer(-CAR['radius'] + 1e-6)
    assert shapely.covers(inside, points).all()
    dx, dy = OBJECTS[label][0] - end.x, OBJECTS[label][1] - end.y
    assert 50.0 - 1e-6 <= hypot(dx, dy) <= 100.0 + 1e-6
    forward = (dx * cos(end.heading) + dy * sin(end.heading)) / hypot(dx, dy)
    left = (-dx * sin(end.heading) + dy * cos(end.heading)) / hypot(dx, dy)
    assert abs(forward) < 1e-6
    assert abs(left + 1.0) < 1e-6
    assert all(residual.satisfied for residual in answer.residuals)
    assert len(answer.residuals) == 3
    assert answer.length == pytest.approx(sum(segment.length for segment in answer.motion.segments))


def photo(label: str, start: Attitude, *, alternative: int = 0, seed: int = 0) -> GeometricRequest:
    text, state = PHOTO.format(label), {'rover0': start}
    return GeometricRequest(text, state, alternative=alternative, seed=seed)


def test_the_whole_tour_of_the_paper_is_driven() -> None:
    here = START['rover0']
    for label in LOCATIONS:
        answer = PLANNER.satisfy(photo(label, here))
        check_found(answer, here, label)
        here = answer.end['rover0']


@pytest.mark.parametrize('seed', range(1, 9))
def test_no_tour_ends_in_a_dead_end(seed: int) -> None:
    here = START['rover0']
    for label in LOCATIONS:
        answer = PLANNER.satisfy(photo(label, here, seed=seed))
        assert answer.status is Status.FOUND, answer.message
        here = answer.end['rover0']


@settings(max_examples=25, deadline=None)
@given(attitudes, st.sampled_from(LOCATIONS), st.integers(0, 2**64 - 1))
def test_whatever_is_found_from_anywhere_is_right(start: Attitude, label: str, seed: int) -> None:
    answer = PLANNER.satisfy(photo(label, start, seed=seed))
    if answer.status is Status.FOUND:
        check_found(answer, start, label)
    else:
        assert answer.code in {Code.START_IN_OBSTACLE, Code.NO_PATH, Code.UNREACHABLE}
        if answer.code is Code.START_IN_OBSTACLE:
            point = shapely.Point(start.x, start.y)
            assert shapely.distance(point, OBSTACLES) < CAR['radius'] + 1e-3


@settings(max_examples=12, deadline=None)
@given(attitudes, st.sampled_from(LOCATIONS), st.integers(0, 2**64 - 1))
def test_no_way_is_much_longer_because_others_end_in_dead_ends(
    start: Attitude, label: str, seed: int
) -> None:
    request = photo(label, start, seed=seed)
    careless = MotionPlanner(PLANNER.world)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Ground, 'can_turn_round', lambda _, states, __: np.ones(len(states), bool))
        shortest = careless.satisfy(request)
    answer = MotionPlanner(PLANNER.world).satisfy(request)
    assert answer.code is shortest.code
    # Neither search is exact.
    assert answer.length <= 1.1 * DETOUR * shortest.length


@pytest.mark.parametrize(
    'parameters', [Parameters(), Parameters(alternative_distance=55.0, alternative_heading=1.5)]
)
def test_alternatives_are_right_and_really_differ(parameters: Parameters) -> None:
    planner = MotionPlanner(PLANNER.world, parameters)
    ends: list[Attitude] = []
    for alternative in range(8):
        answer = planner.satisfy(photo('location6', START['rover0'], alternative=alternative))
        if answer.code is Code.NO_MORE_ALTERNATIVES:
            break
        check_found(answer, START['rover0'], 'location6')
        end = answer.end['rover0']
        for other in ends:
            assert (
                hypot(end.x - other.x, end.y - other.y) >= parameters.alternative_distance
                or abs(remainder(end.heading - other.heading, tau))
                >= parameters.alternative_heading
            )
        ends.append(end)
    assert len(ends) >= 3


def test_another_seed_looks_elsewhere() -> None:
    ends = {
        PLANNER.satisfy(photo('location5', START['rover0'], alternative=2, seed=seed)).end['rover0']
        for seed in range(4)
    }
    assert len(ends) == 4


def test_alternatives_run_out() -> None:
    text = (
        '((agent rover0)(object location8)(rover0.x = location8.x - 30)'
        '(rover0.y = location8.y + 60)(rover0.heading = pi))'
    )
    answers = [PLANNER.satisfy(GeometricRequest(text, START, alternative=k)) for k in range(3)]
    assert [answer.code for answer in answers] == [
        Code.NONE,
        Code.NO_MORE_ALTERNATIVES,
        Code.NO_MORE_ALTERNATIVES,
    ]
    assert '1' in answers[1].message


def test_an_answer_does_not_depend_on_what_was_asked_before() -> None:
    request = photo('location2', START['rover0'], alternative=3, seed=7)
    in_order = MotionPlanner(PLANNER.world)
    for alternative in range(3):
        in_order.satisfy(photo('location2', START['rover0'], alternative=alternative, seed=7))
    forgetful = MotionPlanner(PLANNER.world, Parameters(cache_size=1))
    forgetful.satisfy(request)
    forgetful.satisfy(photo('location4', START['rover0']))
    alone = MotionPlanner(PLANNER.world).satisfy(request)
    assert in_order.satisfy(request) == alone
    assert forgetful.satisfy(request) == alone
    assert alone.motion != in_order.satisfy(photo('location2', START['rover0'], seed=7)).motion


SCRIPT = """
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world
import sys
planner = MotionPlanner(read_world(open(sys.argv[1], encoding='utf-8').read(), 'world.yaml'))
start = {'rover0': Attitude(20.0, 20.0, 0.0)}
for alternative in (4, 0):
    print(planner.satisfy(GeometricRequest(sys.argv[2], start, alternative=alternative, seed=3)))
print(planner.advise(AdviceRequest((sys.argv[2],), start)))
"""


def test_fresh_processes_give_the_same_answers_bit_for_bit() -> None:
    def run(hash_seed: str) -> str:
        environment = os.environ | {'PYTHONPATH': str(PACKAGE), 'PYTHONHASHSEED': hash_seed}
        environment['PYTHONPATH'] += os.pathsep + os.environ.get('PYTHONPATH', '')
        command = [sys.executable, '-c', SCRIPT, str(ROVER), PHOTO.format('location4')]
        return subprocess.run(
            command, env=environment, check=True, capture_output=True, text=True, timeout=120
        ).stdout

    first = run('1')
    assert 'Segment' in first
    assert run('2') == first


def test_the_first_alternative_is_not_much_longer_than_the_shortest_of_many() -> None:
    for label in LOCATIONS:
        lengths = [
            PLANNER.satisfy(photo(label, START['rover0'], alternative=k)).length for k in range(4)
        ]
        assert lengths[0] <= 1.05 * min(lengths)
