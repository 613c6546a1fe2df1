"""Robots in world files: every model, footprints, margins, and what is wrong with them."""

from __future__ import annotations

from math import hypot

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.robots.body import TOUCH, body_of
from motion_planner_node.world import read_world
from motion_planner_node.world.model import World

FLEET = """\
bounds: [0, 0, 80, 60]
obstacles:
  - {name: wall, polygon: [[30, 0], [32, 0], [32, 20], [30, 20]]}
robots:
  rover: {model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 1, speed: 2}
  truck: {model: reverse_car, wheelbase: 3, max_steering_angle: 0.5, speed: 2, safety_margin: 0.25,
          footprint: [[-1, -1], [4, -1], [4, 1], [-1, 1]]}
  vacuum: {model: differential, radius: 0.5, speed: 1, turning_speed: 2,
           start: {x: 5, y: 5, heading: 0}}
  butler: {model: omnidirectional, radius: 0.5, speed: 1, turning_speed: 2, safety_margin: 0.5}
"""


def fleet(old: str = '', new: str = '') -> World:
    assert old in FLEET
    return read_world(FLEET.replace(old, new, 1), 'world.yaml')


def faults(old: str, new: str) -> tuple[Diagnostic, ...]:
    with pytest.raises(MotionPlannerError) as caught:
        fleet(old, new)
    return caught.value.diagnostics


def test_robots_of_different_models_share_a_world() -> None:
    robots = fleet().robots
    assert {label: robot.kind for label, robot in robots.items()} == {
        'rover': 'car',
        'truck': 'reverse_car',
        'vacuum': 'differential',
        'butler': 'omnidirectional',
    }
    truck, vacuum = robots['truck'], robots['vacuum']
    assert truck.footprint == ((-1.0, -1.0), (4.0, -1.0), (4.0, 1.0), (-1.0, 1.0))
    assert truck.radius == hypot(4, 1)
    assert (truck.safety_margin, truck.turning_speed) == (0.25, 0.0)
    assert truck.turning_radius == pytest.approx(5.4915, abs=1e-4)
    assert (vacuum.wheelbase, vacuum.turning_radius, vacuum.turning_speed) == (0.0, 0.0, 2.0)
    assert robots['butler'].body.margin == pytest.approx(1.0)
    assert robots['rover'].extent == 'its radius of 1 m'
    assert truck.extent == 'its footprint of 4 corners and its safety margin of 0.25 m'


def test_what_a_robot_is_like_belongs_to_the_revision() -> None:
    changes = [
        ('model: differential', 'model: omnidirectional'),
        ('safety_margin: 0.25', 'safety_margin: 0.26'),
        ('[4, 1], [-1, 1]', '[4, 1.5], [-1, 1]'),
        ('turning_speed: 2', 'turning_speed: 3'),
    ]
    revisions = {fleet(old, new).revision for old, new in changes}
    assert len(revisions | {fleet().revision}) == len(changes) + 1


@pytest.mark.parametrize(
    ('old', 'new', 'place', 'words'),
    [
        ('model: car', 'modle: car', (5, 10), 'rover lacks model'),
        ('model: differential', 'model: legs', (8, 19), 'model legs is not known; there are car'),
        (', turning_speed: 2,', ',', (8, 11), 'of model differential, lacks turning_speed'),
        ('{model: differential', '{wheelbase: 1, model: differential', (8, 12), 'no wheelbase'),
        ('wheelbase: 1, ', 'wheelbase: 1, turning_speed: 1, ', (5, 37), 'has no turning_speed'),
        ('radius: 1, ', '', (5, 10), 'rover needs either radius, of a disc, or footprint'),
        ('radius: 1, ', 'radius: 1, footprint: [], ', (5, 10), 'rover needs either radius'),
        ('safety_margin: 0.25', 'safety_margin: -1', (6, 95), 'at least 0, not -1'),
        ('safety_margin: 0.25', 'safety_margin: .nan', (6, 95), 'has to be finite'),
        ('turning_speed: 2', 'turning_speed: 0', (8, 71), 'at least 0.001, not 0'),
        ('[4, 1], [-1, 1]', '[4, one], [-1, 1]', (7, 46), 'truck: footprint: corner 3: y has'),
        ('[-1, -1], [4, -1], ', '', (7, 22), 'a polygon needs 3 corners, this has 2'),
        ('[4, 1], [-1, 1]', '[-1, 1], [5, 2]', (7, 22), 'crosses or touches itself'),
        ('[4, 1], [-1, 1]', '[3, -1], [2, -1]', (7, 22), 'encloses no area'),
        ('[[-1, -1], [4, -1]', '[[1, -1], [4, -1], [4, 1], [1, 1], [3, 0]', (7, 22), 'crosses'),
        ('-1, -1], [4, -1], [4, 1], [-1,', '1, -1], [4, -1], [4, 1], [1,', (7, 22), 'reference'),
        ('[4, 1], ', '[4, 1], ' + '[1, 1], ' * 29, (7, 22), '33 corners of truck: footprint'),
        ('[[-1, -1], [4, -1], [4, 1], [-1, 1]]', '3', (7, 22), 'a list of [x, y], not 3'),
        ('x: 5, y: 5', 'x: 0.25, y: 5', (9, 19), 'less than its radius of 0.5 m'),
        ('safety_margin: 0.5', 'safety_margin: 0.5, start: {x: 0.75, y: 9, heading: 0}', (10, 104),
         'less than its radius of 0.5 m and its safety margin of 0.5 m'),
    ],
)  # fmt: skip
def test_a_fault_of_a_robot_is_told_with_its_place(
    old: str, new: str, place: tuple[int, int], words: str
) -> None:
    found = faults(old, new)
    assert words in found[0].message, [str(fault) for fault in found]
    assert (found[0].line, found[0].column) == place


def test_the_reference_point_may_be_on_the_outline() -> None:
    truck = fleet('[-1, -1], [4, -1], [4, 1], [-1, 1]', '[0, -1], [4, -1], [4, 1], [0, 1]')
    assert truck.robots['truck'].body.inner_radius == 0.0


numbers = st.floats(-5.0, 5.0)


@settings(max_examples=60)
@given(st.lists(st.tuples(numbers, numbers), min_size=3, max_size=8), st.floats(0.0, 2.0))
def test_a_body_is_between_its_two_discs(
    points: list[tuple[float, float]], safety_margin: float
) -> None:
    hull = shapely.convex_hull(shapely.MultiPoint([*points, (0.0, 0.0)]))
    if hull.area < 1e-3:
        return
    corners = tuple((float(x), float(y)) for x, y in hull.exterior.coords[:-1])
    body = body_of(corners, 0.0, safety_margin)
    origin = shapely.Point(0.0, 0.0)
    assert body.inner_radius == pytest.approx(hull.exterior.distance(origin), abs=1e-12)
    assert body.radius == pytest.approx(hull.hausdorff_distance(origin), abs=1e-12)
    assert body.margin == max(safety_margin - TOUCH, TOUCH)
