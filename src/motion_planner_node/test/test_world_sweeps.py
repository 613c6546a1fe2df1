"""Bodies that drive, slide and turn, against shapely and dense samples."""

from __future__ import annotations

from math import cos, hypot, pi, sin

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import Body, body_of
from motion_planner_node.robots.motion import Pose
from motion_planner_node.world.model import Bounds, Circle, Obstacle, Polygon, World
from motion_planner_node.world.shapes import Shapes, shapes_of
from motion_planner_node.world.sweeps import chain_clearance, chain_is_free, is_free_at

BOUNDS = Bounds(-30.0, -30.0, 130.0, 130.0)
FOOTPRINTS = [
    ((4.0, 1.5), (-1.0, 1.5), (-1.0, -1.5), (4.0, -1.5)),
    ((3.0, 0.0), (-2.0, 2.0), (-2.0, -2.0)),
    ((2.0, 2.0), (0.5, 1.0), (-3.0, 2.0), (-3.0, -2.0), (2.0, -2.0)),
    ((0.2, 9.0), (-0.2, 9.0), (-0.2, -9.0), (0.2, -9.0)),
]

bodies = st.one_of(
    st.builds(body_of, st.sampled_from(FOOTPRINTS), st.just(0.0), st.sampled_from([0.0, 0.5])),
    st.builds(body_of, st.just(()), st.sampled_from([0.0, 1.0, 4.0]), st.sampled_from([0.0, 0.5])),
)
places = st.floats(0, 100)
turns = st.sampled_from([-1.0, 1.0])
pieces = st.one_of(
    st.tuples(turns.map(lambda side: side / 12.0), st.floats(-90, 90), st.just(0.0), st.just(0.0)),
    st.tuples(st.just(0.0), st.floats(-90, 90), st.just(0.0), st.just(0.0)),
    st.tuples(st.just(0.0), st.floats(0, 60), st.floats(-pi, pi), st.just(0.0)),
    st.tuples(st.just(0.0), st.just(0.0), st.just(0.0), st.floats(-2 * pi, 2 * pi)),
)
chains = st.lists(pieces, min_size=1, max_size=3).map(lambda rows: np.array(rows).reshape(-1, 4))
starts = st.tuples(places, places, st.floats(-pi, pi)).map(np.array)


@st.composite
def polygons(draw: st.DrawFn) -> Polygon:
    x, y, turn = draw(places), draw(places), draw(st.floats(0, 2 * pi))
    count = draw(st.integers(3, 7))
    reaches = [draw(st.floats(0.5, 20.0)) for _ in range(count)]
    angles = [turn + 2 * pi * i / count for i in range(count)]
    corners = ((x + r * cos(a), y + r * sin(a)) for r, a in zip(reaches, angles, strict=True))
    return Polygon('polygon', tuple(corners))


circles = st.builds(Circle, st.just('circle'), st.tuples(places, places), st.floats(0.2, 12.0))
obstacles = st.lists(st.one_of(polygons(), circles), max_size=6)


def world_of(*obstacles: Obstacle, bounds: Bounds = BOUNDS) -> World:
    return World('', '', bounds, {}, obstacles, {})


def footprint(body: Body, x: float, y: float, heading: float) -> shapely.Geometry:
    """The body at an attitude: a point for a disc, which has its radius added apart."""
    if not len(body.corners):
        return shapely.Point(x, y)
    c, s = cos(heading), sin(heading)
    return shapely.Polygon([(x + c * a - s * b, y + s * a + c * b) for a, b in body.corners])


def room(world: World, body: Body, attitude: Pose) -> float:
    """Distance of a body from everything by shapely; 0 or less where it overlaps."""
    shape = footprint(body, *attitude)
    radius = 0.0 if len(body.corners) else body.radius
    b = world.bounds
    x_min, y_min, x_max, y_max = shape.bounds
    least = min(x_min - b.x_min, y_min - b.y_min, b.x_max - x_max, b.y_max - y_max)
    for obstacle in world.obstacles:
        if isinstance(obstacle, Circle):
            away = shape.distance(shapely.Point(obstacle.center)) - obstacle.radius
        else:
            away = shape.distance(shapely.Polygon(obstacle.corners))
        least = min(least, away)
    return float(least - radius)


def samples(
    body: Body, start: NDArray[np.float64], rows: NDArray[np.float64], count: int
) -> tuple[list[Pose], float]:
    """Attitudes along a chain, and how far [m] any point of the body is from a sample of it."""
    pose = pose_of(start)
    found, apart = [pose], 0.0
    for bend, length, direction, turn in rows:
        for i in range(1, count + 1):
            share = i / count
            found.append(advance(*pose, bend, share * length, direction, share * turn))
        way = abs(length) + body.radius * (abs(bend * length) + abs(turn))
        apart = max(apart, 0.5 * way / count)
        pose = found[-1]
    return found, apart


def pose_of(row: NDArray[np.float64]) -> Pose:
    return float(row[0]), float(row[1]), float(row[2])


def shapes_in(world: World) -> Shapes:
    return shapes_of(world)[0]


@settings(max_examples=150, deadline=None)
@given(obstacles, bodies, starts)
def test_a_body_stands_where_it_overlaps_nothing(
    things: list[Obstacle], body: Body, start: NDArray[np.float64]
) -> None:
    world = world_of(*things)
    pose = pose_of(start)
    margin = body.margin - (0.0 if len(body.corners) else body.radius)
    true = room(world, body, pose)
    if abs(true - margin) > 1e-8:
        assert is_free_at(shapes_in(world), body, pose) == (true >= margin)


@settings(max_examples=300, deadline=None)
@given(obstacles, bodies, starts, chains)
def test_a_chain_is_as_free_as_its_samples(
    things: list[Obstacle],
    body: Body,
    start: NDArray[np.float64],
    rows: NDArray[np.float64],
) -> None:
    """Samples bound the least distance from above, and less their spacing from below."""
    world = world_of(*things)
    shapes = shapes_in(world)
    attitudes, apart = samples(body, start, rows, 60)
    least = min(room(world, body, attitude) for attitude in attitudes)
    clearance = chain_clearance(shapes, body, start, rows)
    assert clearance <= max(least, 0.0) + 1e-8
    assert clearance >= least - apart - 1e-8
    margin = body.margin - (0.0 if len(body.corners) else body.radius)
    if abs(clearance - margin) > 1e-8:
        assert chain_is_free(shapes, body, start, rows) == (clearance > margin)


@pytest.mark.parametrize('count', [3, 40, 2000])
def test_the_index_changes_no_answer(count: int) -> None:
    """However many obstacles there are: those near each chain alone give the same."""
    rng = np.random.default_rng(count)
    size = 120.0 / count**0.5
    things: list[Obstacle] = []
    for number in range(count):
        x, y, width, height = (float(v) for v in rng.uniform([0, 0, 0.1, 0.1], [100, 100, 1, 1]))
        width, height = width * size / 4, height * size / 4
        corners = ((x, y), (x + width, y), (x + width, y + height), (x, y + height))
        circle = Circle(str(number), (x, y), width)
        things.append(circle if number % 3 == 0 else Polygon(str(number), corners))
    world = world_of(*things)
    shapes = shapes_in(world)
    body = body_of(((0.8, 0.3), (-0.2, 0.3), (-0.2, -0.3), (0.8, -0.3)), 0.0, 0.1)
    free = 0
    for _ in range(200):
        start = rng.uniform([0, 0, -pi], [100, 100, pi])
        bend = float(rng.choice([-0.1, 0.0, 0.1]))
        rows = np.array([[bend, rng.uniform(-20, 20), 0, 0], [0, 0, 0, rng.uniform(-3, 3)]])
        end = advance(*start, *rows[0])
        reach = abs(rows[0, 1]) + body.radius + 1.0
        near = world_of(
            *(
                thing
                for thing in things
                if hypot(*(np.array(_middle(thing)) - start[:2])) < reach + size
                or hypot(*(np.array(_middle(thing)) - end[:2])) < reach
            )
        )
        is_free = chain_is_free(shapes, body, start, rows)
        free += is_free
        assert is_free == chain_is_free(shapes_in(near), body, start, rows)
    assert 0 < free < 200


def _middle(thing: Obstacle) -> tuple[float, float]:
    return thing.center if isinstance(thing, Circle) else thing.corners[0]


def test_an_obstacle_between_the_corners_of_a_footprint_is_seen() -> None:
    """Small, inside the footprint and far from its reference point: no edges meet."""
    body = body_of(((10.0, 3.0), (-1.0, 3.0), (-1.0, -3.0), (10.0, -3.0)), 0.0, 0.0)
    start, nothing = np.array([20.0, 50.0, 0.0]), np.zeros((0, 4))
    pole = Polygon('pole', ((28.0, 50.0), (28.1, 50.0), (28.0, 50.1)))
    for thing in (pole, Circle('pin', (28.0, 50.0), 0.01)):
        shapes = shapes_in(world_of(thing))
        assert not chain_is_free(shapes, body, start, nothing)
        assert chain_clearance(shapes, body, start, nothing) == 0.0
        assert chain_is_free(shapes, body, np.array([30.0, 50.0, 0.0]), nothing)


def test_a_corner_that_swings_out_is_seen() -> None:
    """The ends of the turn are free, and so is the reference point all the time."""
    body = body_of(((5.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (5.0, -1.0)), 0.0, 0.0)
    wall = Polygon('wall', ((40.0, 55.0), (60.0, 55.0), (60.0, 56.0), (40.0, 56.0)))
    shapes = shapes_in(world_of(wall))
    start = np.array([50.0, 50.05, 0.0])
    half_turn = np.array([[0.0, 0.0, 0.0, pi]])
    assert chain_is_free(shapes, body, start, np.zeros((0, 4)))
    assert not chain_is_free(shapes, body, start, half_turn)
    assert chain_is_free(shapes, body, start, -half_turn)
    higher = np.array([50.0, 55.0 - hypot(5.0, 1.0) - 1e-6, 0.0])
    assert chain_is_free(shapes, body, higher, half_turn)
