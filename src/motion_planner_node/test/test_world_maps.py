"""Clearance and collision among occupied cells, against shapely's boxes of the same cells."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely.affinity import rotate, translate

from motion_planner_node.robots.arcs import advance
from motion_planner_node.robots.body import body_of
from motion_planner_node.world import Scene
from motion_planner_node.world.map_edges import count_edges, map_edges
from motion_planner_node.world.model import Bounds, OccupancyMap, Polygon, World
from motion_planner_node.world.sweeps import chain_clearance, chain_is_free

SIDE = 12
BLOCK = Polygon('block', ((2.0, 2.0), (5.0, 2.5), (4.0, 6.0)))


@st.composite
def maps(draw: st.DrawFn) -> OccupancyMap:
    rows, columns = draw(st.integers(1, SIDE)), draw(st.integers(1, SIDE))
    share = draw(st.sampled_from([0.0, 0.1, 0.5, 1.0]))
    seed = draw(st.integers(0, 1000))
    cells = np.random.default_rng(seed).random((rows, columns)) < share
    yaw = draw(st.sampled_from([0.0, 0.3, -2.0, pi / 2]))
    x, y = draw(st.sampled_from([(0.0, 0.0), (-3.7, 2.2)]))
    outside = draw(st.booleans())
    content = cells.astype(np.uint8).tobytes()
    return OccupancyMap('the map', rows, columns, content, 0.7, x, y, yaw, outside)


def world_of(grid: OccupancyMap, *obstacles: Polygon) -> World:
    b = grid.bounds
    bounds = Bounds(b.x_min - 1.0, b.y_min - 2.0, b.x_max + 3.0, b.y_max + 1.5)
    return World('', '', bounds, {}, obstacles, {}, {}, grid)


def occupied(grid: OccupancyMap, bounds: Bounds) -> shapely.Geometry:
    """All that is occupied, cell by cell, and what is outside of the cells if it is."""
    boxes = [
        shapely.box(i, j, i + 1, j + 1)
        for j in range(grid.rows)
        for i in range(grid.columns)
        if grid.occupied[j, i]
    ]
    if grid.unknown_occupied:
        far = 10.0 * (bounds.x_max - bounds.x_min + bounds.y_max - bounds.y_min)
        cells = shapely.box(0, 0, grid.columns, grid.rows)
        boxes.append(shapely.box(-far, -far, far, far).difference(cells))
    shape = shapely.union_all(boxes)
    scaled = shapely.transform(shape, lambda points: points * grid.resolution)
    turned = rotate(scaled, grid.yaw, origin=(0, 0), use_radians=True)
    return translate(turned, grid.x, grid.y)


points = st.lists(st.tuples(st.floats(0, 1), st.floats(0, 1)), min_size=1, max_size=20)


def spread(world: World, shares: list[tuple[float, float]]) -> NDArray[np.float64]:
    b = world.bounds
    low, high = np.array([b.x_min, b.y_min]), np.array([b.x_max, b.y_max])
    return np.asarray(low + np.array(shares) * (high - low))


@settings(max_examples=200, deadline=None)
@given(maps(), points)
def test_clearance_is_the_distance_to_the_occupied_cells(
    grid: OccupancyMap, shares: list[tuple[float, float]]
) -> None:
    world = world_of(grid)
    b = world.bounds
    shape = occupied(grid, b)
    places = spread(world, shares)
    found = Scene(world).clearance(places)
    for (x, y), clearance in zip(places, found, strict=True):
        spot = shapely.Point(x, y)
        edge = min(x - b.x_min, b.x_max - x, y - b.y_min, b.y_max - y)
        if shape.is_empty or shape.distance(spot) > 1e-9:
            away = edge if shape.is_empty else min(edge, shape.distance(spot))
            assert clearance == pytest.approx(away, abs=1e-9)
        else:
            assert clearance <= 1e-9


@settings(max_examples=200, deadline=None)
@given(
    maps(),
    points,
    st.floats(-pi, pi),
    st.sampled_from([-0.5, 0.0, 0.5]),
    st.floats(-6, 6),
    st.floats(-3, 3),
    st.booleans(),
)
def test_motions_keep_clear_of_the_occupied_cells(
    grid: OccupancyMap,
    shares: list[tuple[float, float]],
    heading: float,
    bend: float,
    length: float,
    turn: float,
    is_disc: bool,
) -> None:
    """A map beside a polygon: samples bound the clearance from both sides."""
    world = world_of(grid, BLOCK)
    b = world.bounds
    shape = occupied(grid, b).union(shapely.Polygon(BLOCK.corners))
    corners = ((0.9, 0.3), (-0.4, 0.3), (-0.4, -0.3), (0.9, -0.3))
    body = body_of(() if is_disc else corners, 0.25, 0.0)
    start = np.array([*spread(world, shares)[0], heading])
    rows = np.array([[bend, length, 0, 0], [0, 0, 0, turn]])
    least, pose = np.inf, (float(start[0]), float(start[1]), heading)
    for row in rows:
        for share in np.linspace(0, 1, 60):
            x, y, angle = advance(*pose, row[0], share * row[1], row[2], share * row[3])
            c, s = cos(angle), sin(angle)
            if is_disc:
                outline: shapely.Geometry = shapely.Point(x, y)
            else:
                outline = shapely.Polygon(
                    [(x + c * p - s * q, y + s * p + c * q) for p, q in corners]
                )
            x0, y0, x1, y1 = outline.bounds
            edge = min(x0 - b.x_min, y0 - b.y_min, b.x_max - x1, b.y_max - y1)
            away = shape.distance(outline)
            least = min(least, edge, away)
        pose = advance(*pose, row[0], row[1], row[2], row[3])
    least -= 0.25 if is_disc else 0.0
    apart = (abs(length) * (1 + body.radius * abs(bend)) + abs(turn) * body.radius) / 118
    clearance = chain_clearance(Scene(world).shapes, body, start, rows)
    assert clearance <= max(least, 0.0) + 1e-8
    assert clearance >= least - apart - 1e-8
    if clearance > 1e-8:
        assert chain_is_free(Scene(world).shapes, body, start, rows)
    elif least < -1e-8:
        assert not chain_is_free(Scene(world).shapes, body, start, rows)


@settings(max_examples=100, deadline=None)
@given(maps())
def test_edges_are_the_boundary_of_the_cells(grid: OccupancyMap) -> None:
    edges = map_edges(grid)
    assert len(edges) == count_edges(grid, 1000)
    length = float(np.hypot(edges[:, 2] - edges[:, 0], edges[:, 3] - edges[:, 1]).sum())
    cells = np.pad(grid.occupied, 1, constant_values=int(grid.unknown_occupied)).astype(int)
    changes = np.abs(np.diff(cells, axis=0)).sum() + np.abs(np.diff(cells, axis=1)).sum()
    assert length == pytest.approx(changes * grid.resolution)


def test_the_map_has_a_name_among_the_obstacles() -> None:
    cells = np.zeros((10, 10), np.uint8)
    cells[5, 5] = 1
    grid = OccupancyMap(
        'the map', 10, 10, cells.tobytes(), 1.0, 0.0, 0.0, 0.0, unknown_occupied=False
    )
    scene = Scene(world_of(grid, BLOCK))
    assert scene.nearest_obstacle(7.0, 5.5) == ('the map', 1.0)
    assert scene.nearest_obstacle(5.5, 5.5) == ('the map', -0.5)
    assert scene.nearest_obstacle(4.0, 4.0)[0] == 'block'


def test_walls_of_a_map_part_the_free_space() -> None:
    cells = np.zeros((60, 60), np.uint8)
    cells[:, 30] = 1
    cells[28:32, 30] = 0
    grid = OccupancyMap(
        'the map', 60, 60, cells.tobytes(), 0.1, 0.0, 0.0, 0.0, unknown_occupied=True
    )
    scene = Scene(World('', '', grid.bounds, {}, (), {}, {}, grid))
    for radius, is_connected in ((0.15, True), (0.25, False)):
        space = scene.free_space(body_of((), radius, 0.0))
        assert (space.component_of(1.0, 3.0) == space.component_of(5.0, 3.0)) is is_connected
