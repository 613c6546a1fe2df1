"""Lines of sight and descents among occupied cells, against shapely."""

from __future__ import annotations

from math import hypot

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motion_planner_node.world.model import Bounds, OccupancyMap, World
from motion_planner_node.world.shapes import Shapes, shapes_of
from motion_planner_node.world.sight import obstructions
from motion_planner_node.world.signed_distance import clearances_with_slopes

SIDE = 10


def _place(number: int) -> tuple[float, float]:
    """Anywhere, but hardly ever in line with the corners of cells."""
    x, y = np.random.default_rng(number).uniform(0.05, SIDE - 0.05, 2)
    return float(x), float(y)


places = st.integers(0, 1_000_000).map(_place)


def world_of(share: float, seed: int) -> tuple[Shapes, shapely.Geometry]:
    cells = (np.random.default_rng(seed).random((SIDE, SIDE)) < share).astype(np.uint8)
    grid = OccupancyMap('', SIDE, SIDE, cells.tobytes(), 1.0, 0, 0, 0, unknown_occupied=False)
    boxes = [shapely.box(i, j, i + 1, j + 1) for j, i in np.argwhere(cells)]
    world = World('', '', Bounds(0, 0, SIDE, SIDE), {}, (), {}, {}, grid)
    return shapes_of(world)[0], shapely.union_all(boxes)


@settings(max_examples=300, deadline=None)
@given(st.sampled_from([0.0, 0.05, 0.3]), st.integers(0, 200), places, places)
def test_cells_are_in_the_way_of_a_line_of_sight(
    share: float, seed: int, here: tuple[float, float], there: tuple[float, float]
) -> None:
    shapes, occupied = world_of(share, seed)
    line = shapely.LineString([here, there])
    assume(line.length > 1e-3 and not occupied.contains(shapely.Point(here)))
    hidden = line.intersection(occupied)
    (found,) = obstructions(shapes, np.array([[*here, *there]]), 2.0 * SIDE)
    if occupied.contains(shapely.Point(there)):
        parts = getattr(hidden, 'geoms', [hidden])
        assume(all(part.length == 0.0 or part.length > 1e-6 for part in parts))
        is_seen = len(parts) == 1 and parts[0].distance(shapely.Point(there)) < 1e-9
        assert (found[0] <= 0.0) == is_seen
        return
    assume(hidden.is_empty or hidden.length > 1e-6)
    if hidden.is_empty:
        away = 2.0 * SIDE if occupied.is_empty else line.distance(occupied)
        assert found[0] == pytest.approx(-away, abs=1e-9)
    else:
        assert found[0] > 0.0


@settings(max_examples=100, deadline=None)
@given(st.integers(0, 50), places)
def test_clearance_grows_along_its_slope(seed: int, place: tuple[float, float]) -> None:
    shapes, _ = world_of(0.2, seed)
    ((value, by_x, by_y),) = clearances_with_slopes(shapes, np.array([place]))
    assert hypot(by_x, by_y) == pytest.approx(1.0)
    step = min(abs(value), 1e-4) / 2
    ahead = np.array([[place[0] + step * by_x, place[1] + step * by_y]])
    assert clearances_with_slopes(shapes, ahead)[0, 0] >= value + 0.5 * step


def test_on_the_rim_of_a_cell_the_clearance_grows_along_its_normal() -> None:
    cells = np.zeros((SIDE, SIDE), np.uint8)
    cells[4, 4] = 1
    grid = OccupancyMap('', SIDE, SIDE, cells.tobytes(), 1.0, 0, 0, 0, unknown_occupied=False)
    shapes, _ = shapes_of(World('', '', Bounds(0, 0, SIDE, SIDE), {}, (), {}, {}, grid))
    points = np.array([[4.0, 4.5], [5.0, 4.5], [4.5, 4.0], [4.5, 5.0]])
    found = clearances_with_slopes(shapes, points)
    assert np.abs(found).tolist() == [[0, 1, 0], [0, 1, 0], [0, 0, 1], [0, 0, 1]]
    assert np.sign(found).tolist() == [[0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]]
