"""The map's grid against shapely's answers, point by point."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from interface_node.occupancy import MAX_CELLS, occupancy
from interface_node.plan import Obstacle, Occupancy, World

corners = st.lists(
    st.tuples(st.integers(-3, 43), st.integers(-3, 33)), min_size=3, max_size=7, unique=True
).filter(lambda points: shapely.Polygon(points).is_valid)
obstacles = st.one_of(
    st.builds(lambda points: Obstacle('polygon', tuple(points)), corners),
    st.builds(
        lambda x, y, radius: Obstacle('disc', (), (x, y), radius),
        st.integers(0, 40),
        st.integers(0, 30),
        st.integers(1, 15),
    ),
)


@settings(max_examples=60, deadline=None)
@given(st.lists(obstacles, max_size=4), st.sampled_from([0.9, 1.3, 2.7]))
def test_a_cell_is_occupied_when_its_centre_lies_in_an_obstacle(
    things: list[Obstacle], resolution: float
) -> None:
    grid = occupancy(World('', 'r', (0.0, 0.0, 40.0, 30.0), obstacles=tuple(things)), resolution)
    rows, columns = grid.occupied.shape
    assert columns * resolution >= 40 > (columns - 1) * resolution
    assert rows * resolution >= 30 > (rows - 1) * resolution
    shapes = [
        shapely.Polygon(thing.corners)
        if thing.corners
        else shapely.Point(thing.center).buffer(thing.radius, quad_segs=256)
        for thing in things
    ]
    for row in range(rows):
        for column in range(columns):
            center = shapely.Point((column + 0.5) * resolution, (row + 0.5) * resolution)
            if any(shape.boundary.distance(center) < 1e-3 for shape in shapes):
                continue
            inside = any(shape.contains(center) for shape in shapes)
            assert bool(grid.occupied[row, column]) == inside


@settings(max_examples=50, deadline=None)
@given(st.floats(0.1, 1e12), st.floats(0.1, 1e12))
def test_no_map_is_too_large(width: float, height: float) -> None:
    grid = occupancy(World('', 'r', (0.0, 0.0, width, height)), 0.01)
    assert 1 <= grid.occupied.size <= MAX_CELLS


@pytest.mark.parametrize('yaw', [0.0, 0.4, -pi / 2])
@pytest.mark.parametrize('resolution', [0.25, 0.5, 2.0])
def test_the_map_of_the_world_is_in_the_grid(yaw: float, resolution: float) -> None:
    """Finer or coarser: where the map's cells have their centres, and where the grid's lie."""
    cells = np.random.default_rng(2).random((12, 9)) < 0.3
    own = Occupancy(0.5, (4.0, 5.0), cells, yaw)
    grid = occupancy(World('', 'r', (0.0, 0.0, 12.0, 12.0), map=own), resolution)
    assert grid.resolution == min(resolution, 0.5)
    centers = [
        (4.0 + cos(yaw) * x - sin(yaw) * y, 5.0 + sin(yaw) * x + cos(yaw) * y)
        for y, x in (np.argwhere(cells) + 0.5) * 0.5
    ]
    squares = shapely.union_all([shapely.Point(x, y).buffer(0.36) for x, y in centers])
    for x, y in centers:
        if 0 < x < 12 and 0 < y < 12:
            assert grid.occupied[int(y / grid.resolution), int(x / grid.resolution)]
    for row, column in np.argwhere(grid.occupied):
        spot = shapely.Point((column + 0.5) * grid.resolution, (row + 0.5) * grid.resolution)
        assert squares.distance(spot) <= grid.resolution * 0.71
