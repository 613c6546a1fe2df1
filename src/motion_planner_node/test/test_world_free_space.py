from __future__ import annotations

from math import hypot

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.robots.body import body_of
from motion_planner_node.world import Scene
from motion_planner_node.world.grid import TRAVEL_CELLS, Grid
from motion_planner_node.world.model import Bounds, Circle, Obstacle, Polygon, World

RADIUS = 5.0
BODY = body_of((), RADIUS, 0.0)


WHOLE = Bounds(0, 0, 800, 600)


def scene_of(*obstacles: Obstacle, bounds: Bounds = WHOLE) -> Scene:
    return Scene(World('', '', bounds, {}, obstacles, {}))


def walls_with_gap(gap: float) -> tuple[Polygon, Polygon]:
    low = Polygon('low', ((400, 0), (410, 0), (410, 300), (400, 300)))
    high = Polygon('high', ((400, 300 + gap), (410, 300 + gap), (410, 600), (400, 600)))
    return low, high


@pytest.mark.parametrize(('gap', 'open_'), [(0.0, False), (9.0, False), (9.8, False), (10.2, True)])
def test_a_gap_narrower_than_the_robot_is_closed(gap: float, open_: bool) -> None:
    space = scene_of(*walls_with_gap(gap)).free_space(BODY)
    west, east = space.component_of(100, 100), space.component_of(700, 500)
    assert west >= 0
    assert east >= 0
    assert (west == east) is open_


shapes = st.one_of(
    st.builds(
        lambda x, y, r: Circle('disc', (x, y), r),
        st.floats(-20, 820), st.floats(-20, 620), st.floats(0.5, 90),
    ),
    st.builds(
        lambda x, y, w, h: Polygon('box', ((x, y), (x + w, y), (x + w, y + h), (x, y + h))),
        st.floats(-20, 820), st.floats(-20, 620), st.floats(0.5, 300), st.floats(0.5, 300),
    ),
)  # fmt: skip


@settings(max_examples=60, deadline=None)
@given(st.lists(shapes, max_size=4), st.lists(shapes, min_size=1, max_size=3))
def test_more_obstacles_close_what_they_close_in_a_world_that_has_them(
    before: list[Obstacle], more: list[Obstacle]
) -> None:
    expected = scene_of(*before, *more)
    scene = scene_of(*before)
    untouched = scene.free_space(BODY)._grid.open.copy()
    found = scene.with_more(more)
    assert np.array_equal(found.free_space(BODY)._grid.open, expected.free_space(BODY)._grid.open)
    travel = found.free_space(BODY)._travel_grid
    grids = (Grid(expected.shapes, RADIUS, most) for most in TRAVEL_CELLS)
    same = next(grid for grid in grids if grid.cell == travel.cell)
    assert np.array_equal(travel.framed, same.framed)
    points = np.random.default_rng(1).uniform([0, 0], [800, 600], (500, 2))
    assert np.array_equal(found.clearance(points), expected.clearance(points))
    assert np.array_equal(scene.free_space(BODY)._grid.open, untouched)


def test_every_free_place_is_in_an_open_cell() -> None:
    rng = np.random.default_rng(3)
    discs = [
        Circle(f'disc{i}', (float(x), float(y)), float(r))
        for i, (x, y, r) in enumerate(rng.uniform([0, 0, 5], [800, 600, 60], (25, 3)))
    ]
    scene = scene_of(*discs)
    points = rng.uniform([0, 0], [800, 600], (20000, 2))
    free = scene.clearance(points) >= RADIUS
    components = scene.free_space(BODY).components_of(points[:, 0], points[:, 1])
    assert free.any()
    assert (components[free] >= 0).all()


def test_neighbours_with_room_between_them_are_in_one_component() -> None:
    """Two free places are joined when the straight line between them is free all along."""
    rng = np.random.default_rng(4)
    discs = [
        Circle(f'disc{i}', (float(x), float(y)), 30.0)
        for i, (x, y) in enumerate(rng.uniform([0, 0], [800, 600], (40, 2)))
    ]
    scene = scene_of(*discs)
    space = scene.free_space(BODY)
    seen = 0
    for start, end in rng.uniform([0, 0], [800, 600], (2000, 2, 2)):
        line = start + np.linspace(0.0, 1.0, 200)[:, None] * (end - start)
        if (scene.clearance(line) >= RADIUS).all():
            seen += 1
            assert space.component_of(*start) == space.component_of(*end)
    assert seen > 100


def test_a_walled_in_place_is_a_component_of_its_own() -> None:
    ring = [
        Polygon('south', ((300, 200), (500, 200), (500, 210), (300, 210))),
        Polygon('north', ((300, 390), (500, 390), (500, 400), (300, 400))),
        Polygon('west', ((300, 200), (310, 200), (310, 400), (300, 400))),
        Polygon('east', ((490, 200), (500, 200), (500, 400), (490, 400))),
    ]
    space = scene_of(*ring).free_space(BODY)
    inside, outside = space.component_of(400, 300), space.component_of(100, 100)
    assert inside not in (-1, outside)
    assert space.component_of(320, 220) == inside
    assert space.component_of(480, 380) == inside
    assert space.component_of(305, 205) == -1
    assert space.component_of(600, 300) == outside
    assert np.isinf(space.distance_from(400, 300).at(100, 100))


def test_distance_in_the_open_is_the_straight_one() -> None:
    field = scene_of().free_space(BODY).distance_from(100, 100)
    xs, ys = np.meshgrid(np.linspace(10, 790, 40), np.linspace(10, 590, 30))
    straight = np.hypot(xs - 100, ys - 100)
    assert field.at(xs, ys).shape == xs.shape
    assert (field.at(xs, ys) >= straight).all()
    assert (field.at(xs, ys) <= 1.03 * straight + 8).all()


def test_distance_goes_round_a_wall() -> None:
    wall = Polygon('wall', ((400, 0), (410, 0), (410, 500), (400, 500)))
    field = scene_of(wall).free_space(BODY).distance_from(300, 100)
    true = hypot(95, 405) + 20 + hypot(85, 405)
    assert float(field.at(500, 100)) == pytest.approx(true, rel=0.03)


def test_fields_are_kept_and_places_outside_the_map_are_not_free() -> None:
    space = scene_of().free_space(BODY)
    assert space.distance_from(10, 20) is space.distance_from(10, 20)
    assert space.component_of(-1, 20) == -1
    assert space.component_of(float('nan'), 20) == -1
    assert space.component_of(2, 20) == -1


def test_a_robot_larger_than_the_map_is_nowhere_free() -> None:
    space = scene_of(bounds=Bounds(0, 0, 8, 1e4)).free_space(BODY)
    assert len(space.cells) == 0
    assert space.component_of(4, 50) == -1


def test_many_obstacles_close_the_same_cells_as_each_alone() -> None:
    """The cells are worked out block by block with the obstacles near each: none is forgotten."""
    rng = np.random.default_rng(5)
    obstacles: list[Obstacle] = [
        Circle(f'disc{i}', (float(x), float(y)), 12.0)
        for i, (x, y) in enumerate(rng.uniform([0, 0], [800, 600], (30, 2)))
    ]
    obstacles += [
        Polygon(f'block{i}', ((x, y), (x + 90, y + 5), (x + 40, y + 70)))
        for i, (x, y) in enumerate(rng.uniform([0, 0], [700, 500], (6, 2)).tolist())
    ]
    points = rng.uniform([0, 0], [800, 600], (20000, 2)).T
    alone = [scene_of(obstacle).free_space(BODY).components_of(*points) for obstacle in obstacles]
    together = scene_of(*obstacles).free_space(BODY).components_of(*points)
    closed = (np.array(alone) < 0).any(axis=0)
    assert (together[closed] < 0).all()


def test_a_wall_is_seen_on_a_map_of_any_size() -> None:
    wall = Polygon('wall', ((400, 0), (416, 0), (416, 3800), (400, 3800)))
    space = scene_of(wall, bounds=Bounds(0, 0, 4000, 4000)).free_space(BODY)
    around = hypot(300, 3700) + 16 + hypot(284, 3700)
    assert space.distance_from(100, 100).at(700, 100) == pytest.approx(around, rel=0.05)


@pytest.mark.parametrize('thickness', [0.1, 2.0, 6.0, 20.0])
def test_no_way_leads_through_a_thin_wall(thickness: float) -> None:
    """Walls from above and below in turn: whoever goes on has to go up and down."""
    walls = []
    for k in range(9):
        x, low, high = 80.0 * (k + 1), 0.0 if k % 2 else 60.0, 540.0 if k % 2 else 600.0
        corners = ((x, low), (x + thickness, low), (x + thickness, high), (x, high))
        walls.append(Polygon(f'wall{k}', corners))
    space = scene_of(*walls).free_space(BODY)
    assert float(space.distance_from(40, 300).at(770, 300)) > 8 * 480


@pytest.mark.parametrize('sides', [0, 6])
def test_no_more_cells_are_taken_than_it_takes(sides: int) -> None:
    """Thick obstacles need few cells."""
    blocks = [
        Circle(f'disc{k}', (100.0 * (k + 1), 100.0 * (k % 5 + 1)), 40.0) for k in range(sides)
    ]
    space = scene_of(*blocks).free_space(BODY)
    assert space.distance_from(10, 10).distances.size < 1.1 * TRAVEL_CELLS[0]
