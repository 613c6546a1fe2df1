"""Clearance and collision against brute force with another library's geometry."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.robots.driving import sample
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world import MAP_EDGE, Scene
from motion_planner_node.world.model import Bounds, Circle, Obstacle, Polygon, World
from motion_planner_node.world.signed_distance import clearances_with_slopes

CAR = Robot('rover', wheelbase=8.0, max_steering_angle=0.5, radius=5.0, speed=2.0)
BOUNDS = Bounds(-20.0, -10.0, 120.0, 110.0)
SPACING = 0.02


def world_of(*obstacles: Obstacle, bounds: Bounds = BOUNDS) -> World:
    return World('', '', bounds, {}, obstacles, {'rover': CAR})


@st.composite
def polygons(draw: st.DrawFn) -> Polygon:
    """Star-shaped and often not convex."""
    x, y = draw(st.floats(0, 100)), draw(st.floats(0, 100))
    count = draw(st.integers(3, 8))
    turn = draw(st.floats(0, 2 * pi))
    corners = []
    for i in range(count):
        reach = draw(st.floats(1.0, 25.0))
        angle = turn + 2 * pi * i / count
        corners.append((x + reach * cos(angle), y + reach * sin(angle)))
    return Polygon('polygon', tuple(corners))


circles = st.builds(
    Circle, st.just('circle'), st.tuples(st.floats(0, 100), st.floats(0, 100)), st.floats(0.5, 20)
)
worlds = st.lists(st.one_of(polygons(), circles), max_size=4).map(lambda o: world_of(*o))
attitudes = st.builds(Attitude, st.floats(-20, 120), st.floats(-10, 110), st.floats(-pi, pi))
steering_angles = st.sampled_from([-0.5, 0.0, 0.5])
motions = st.builds(
    Motion,
    st.just('rover'),
    attitudes,
    st.lists(st.builds(Segment, steering_angles, st.floats(0.01, 90.0)), max_size=3).map(tuple),
)


def true_clearances(world: World, points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Signed distances by shapely, discs by their centres."""
    b = world.bounds
    x, y = points[:, 0], points[:, 1]
    result = np.minimum.reduce([x - b.x_min, b.x_max - x, y - b.y_min, b.y_max - y])
    spots = shapely.points(points[:, :2])
    for obstacle in world.obstacles:
        if isinstance(obstacle, Circle):
            distance = np.hypot(x - obstacle.center[0], y - obstacle.center[1]) - obstacle.radius
        else:
            polygon = shapely.Polygon(obstacle.corners)
            distance = shapely.distance(spots, polygon.exterior)
            distance = np.where(shapely.contains(polygon, spots), -distance, distance)
        result = np.minimum(result, distance)
    return np.asarray(result)


@settings(deadline=None)
@given(worlds, st.lists(st.tuples(st.floats(-40, 140), st.floats(-30, 130)), min_size=1))
def test_clearance_is_the_distance_to_the_nearest_boundary(
    world: World, points: list[tuple[float, float]]
) -> None:
    array = np.array(points)
    assert Scene(world).clearance(array) == pytest.approx(true_clearances(world, array), abs=1e-9)


@settings(max_examples=400, deadline=None)
@given(worlds, motions)
def test_motion_is_free_exactly_when_all_its_points_are(world: World, motion: Motion) -> None:
    least = true_clearances(world, sample(motion, CAR, SPACING)).min()
    free = Scene(world).motion_is_free(motion, CAR)
    if free:
        assert least >= CAR.radius - 1e-8
    else:
        assert least < CAR.radius + SPACING / 2


def test_single_arcs_are_free_exactly_when_all_their_points_are() -> None:
    rng = np.random.default_rng(8)
    world = world_of(
        Polygon('block', ((20, 20), (60, 10), (70, 40), (45, 30), (30, 60))),
        Polygon('thin', ((80, 70), (81, 70), (81, 110), (80, 110))),
        Circle('disc', (20, 90), 8.0),
    )
    scene = Scene(world)
    outcomes = set()
    for _ in range(3000):
        start = Attitude(*(float(v) for v in rng.uniform([-15, -5, -pi], [115, 105, pi])))
        angle = float(rng.choice([-0.5, 0.0, 0.5]))
        motion = Motion('rover', start, (Segment(angle, float(rng.uniform(0.1, 95.0))),))
        least = true_clearances(world, sample(motion, CAR, 0.2)).min()
        free = scene.motion_is_free(motion, CAR)
        outcomes.add((angle, free))
        assert free == (least >= CAR.radius) or abs(least - CAR.radius) < 0.1
    assert len(outcomes) == 6


@pytest.mark.parametrize('heading', [0.0, 0.7, -0.4, pi - 0.2])
def test_a_long_wall_is_not_driven_through(heading: float) -> None:
    """All corners are far from the crossing: only the edges themselves are met."""
    wall = Polygon('wall', ((50, -500), (50.5, -500), (50.5, 500), (50, 500)))
    scene = Scene(world_of(wall, bounds=Bounds(-1000, -1000, 1000, 1000)))
    start = Attitude(50 - 40 * cos(heading), 50 - 40 * sin(heading), heading)
    assert not scene.motion_is_free(Motion('rover', start, (Segment(0.0, 80.0),)), CAR)
    assert scene.motion_is_free(Motion('rover', start, (Segment(0.0, 25.0),)), CAR)


@settings(max_examples=100, deadline=None)
@given(polygons(), attitudes, steering_angles, st.floats(1.0, 95.0), st.floats(-1e-6, 1e-6))
def test_the_least_distance_of_an_arc_is_exact(
    polygon: Polygon, start: Attitude, steering_angle: float, length: float, change: float
) -> None:
    """A disc as large as the distance found by refinement fits, and one a little larger not."""
    assume(abs(change) > 1e-8)
    world = world_of(polygon, bounds=Bounds(-1e4, -1e4, 1e4, 1e4))
    motion = Motion('rover', start, (Segment(steering_angle, length),))
    points = sample(motion, CAR, length / 1000)
    outline = shapely.Polygon(polygon.corners)
    distances = shapely.distance(outline, shapely.points(points[:, :2]))
    nearest = int(np.argmin(distances))
    first, last = max(nearest - 1, 0), min(nearest + 1, len(points) - 1)
    near = Motion(
        'rover',
        Attitude(*points[first]),
        (Segment(steering_angle, length * (last - first) / (len(points) - 1)),),
    )
    close = sample(near, CAR, near.length / 4000)
    least = shapely.distance(outline, shapely.points(close[:, :2])).min()
    assume(least > 0.01)
    car = Robot('rover', 8.0, 0.5, radius=float(least + change), speed=1.0)
    assert Scene(world).motion_is_free(motion, car) is (change < 0)


@settings(deadline=None)
@given(worlds, attitudes)
def test_nearest_obstacle_has_the_clearance(world: World, attitude: Attitude) -> None:
    name, clearance = Scene(world).nearest_obstacle(attitude.x, attitude.y)
    point = np.array([[attitude.x, attitude.y]])
    alone = world_of(*(o for o in world.obstacles if o.name == name))
    assert clearance == pytest.approx(true_clearances(alone, point)[0], abs=1e-9)
    assert name in {MAP_EDGE, 'polygon', 'circle'}


def test_a_disc_may_touch() -> None:
    wall = Polygon('wall', ((50, 0), (60, 0), (60, 100), (50, 100)))
    scene = Scene(world_of(wall))
    along_the_wall = Motion('rover', Attitude(45, 10, pi / 2), (Segment(0.0, 80.0),))
    assert scene.motion_is_free(along_the_wall, CAR)
    places = np.array([[45, 10, 0], [45.001, 10, 0], [-15, 0, 0], [-15.001, 0, 0]])
    assert scene.is_free(places, CAR.body).tolist() == [True, False, True, False]


def test_a_point_robot_does_not_pass_through_a_corner() -> None:
    point = Robot('rover', 8.0, 0.5, radius=0.0, speed=1.0)
    diamond = Polygon('diamond', ((50, 50), (60, 40), (70, 50), (60, 60)))
    through = Motion('rover', Attitude(10, 50, 0.0), (Segment(0.0, 90.0),))
    past = Motion('rover', Attitude(10, 60.01, 0.0), (Segment(0.0, 90.0),))
    assert not Scene(world_of(diamond)).motion_is_free(through, point)
    assert Scene(world_of(diamond)).motion_is_free(past, point)


@pytest.mark.parametrize('turned', [False, True])
@pytest.mark.parametrize(
    ('point', 'normal'),
    [((40, 30), (-1, 0)), ((60, 30), (1, 0)), ((50, 20), (0, -1)), ((50, 50), (0, 1))],
)
def test_on_an_edge_the_clearance_grows_along_its_normal(
    point: tuple[int, int], normal: tuple[int, int], turned: bool
) -> None:
    corners = ((40.0, 20.0), (60.0, 20.0), (60.0, 50.0), (40.0, 50.0))
    block = Polygon('block', corners[::-1] if turned else corners)
    found = clearances_with_slopes(Scene(world_of(block)).shapes, np.array([point], dtype=float))
    assert found[0].tolist() == [0.0, *normal]
