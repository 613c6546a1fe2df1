"""Polygons with holes, beside shapely's."""

from __future__ import annotations

import json
from math import pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.functions.surroundings import surroundings_of
from motion_planner_node.world import Scene, read_world
from motion_planner_node.world.holes import chain
from motion_planner_node.world.model import Bounds, Polygon, World

Ring = list[tuple[float, float]]
BOUNDS = Bounds(0.0, 0.0, 100.0, 100.0)
SQUARE = [[10, 10], [40, 10], [40, 40], [10, 40], [10, 10]]


def square(x: float, y: float, side: float) -> list[list[float]]:
    return [[x, y], [x + side, y], [x + side, y + side], [x, y + side], [x, y]]


def star(x: float, y: float, reaches: list[float]) -> Ring:
    angles = np.arange(len(reaches)) * 2.0 * pi / len(reaches)
    return [
        (float(x + r * np.cos(a)), float(y + r * np.sin(a)))
        for r, a in zip(reaches, angles, strict=True)
    ]


def reaches(low: float, high: float) -> st.SearchStrategy[list[float]]:
    return st.lists(st.floats(low, high), min_size=3, max_size=7)


@st.composite
def rings(draw: st.DrawFn) -> tuple[Ring, list[Ring]]:
    """An outline and holes well inside of it, in either direction."""
    outline = star(50.0, 50.0, draw(st.lists(st.floats(38.0, 45.0), min_size=5, max_size=9)))
    places = [(40.0, 50.0), (60.0, 45.0), (50.0, 62.0)]
    chosen = draw(st.lists(st.sampled_from(places), min_size=1, max_size=3, unique=True))
    holes = [star(x, y, draw(reaches(2.0, 7.0))) for x, y in chosen]
    return outline, [hole[::-1] if draw(st.booleans()) else hole for hole in holes]


def world_of(outline: Ring, holes: list[Ring]) -> World:
    hall = Polygon('hall', tuple(outline), tuple(tuple(hole) for hole in holes))
    return World('', '', BOUNDS, {}, (hall,), {}, {'hall': hall})


def read(directory: Path, *found: Any) -> World:
    content = {'type': 'Polygon', 'coordinates': list(found)}
    (directory / 'shapes.geojson').write_text(json.dumps(content))
    text = 'bounds: [0, 0, 100, 100]\nobstacles:\n  - geojson: shapes.geojson\n'
    return read_world(text, str(directory / 'world.yaml'))


@settings(max_examples=40, deadline=None)
@given(rings(), st.integers(0, 2**32 - 1))
def test_clearance_is_the_distance_from_the_ring(shape: tuple[Ring, list[Ring]], seed: int) -> None:
    world, peer = world_of(*shape), shapely.Polygon(*shape)
    assume(peer.is_valid)
    points = np.random.default_rng(seed).uniform(0.0, 100.0, (40, 2))
    points[:20] = np.random.default_rng(seed + 1).uniform(30.0, 70.0, (20, 2))
    found = Scene(world).clearance(points)
    distances = surroundings_of(world).region('hall').values(*points.T)
    for (x, y), clearance, distance in zip(points, found, distances, strict=True):
        point = shapely.Point(x, y)
        away = peer.boundary.distance(point) * (-1.0 if peer.contains(point) else 1.0)
        assert distance == pytest.approx(away, abs=1e-9)
        rim = min(x, y, 100.0 - x, 100.0 - y)
        assert clearance == pytest.approx(min(away, rim), abs=1e-9)


@settings(max_examples=40, deadline=None)
@given(rings(), st.integers(0, 2**32 - 1))
def test_lines_of_sight_end_at_the_ring(shape: tuple[Ring, list[Ring]], seed: int) -> None:
    world, peer = world_of(*shape), shapely.Polygon(*shape)
    assume(peer.is_valid)
    ends = np.random.default_rng(seed).uniform(30.0, 70.0, (30, 4))
    found = surroundings_of(world).sight.values(*ends.T)
    for (x0, y0, x1, y1), obstruction in zip(ends, found, strict=True):
        if peer.contains(shapely.Point(x1, y1)):
            continue  # An obstacle that holds the point does not hide it.
        line = shapely.LineString([(x0, y0), (x1, y1)])
        if peer.intersects(line):
            assert obstruction >= 0.0
        else:
            assert obstruction == pytest.approx(-peer.distance(line), abs=1e-9)


@settings(max_examples=40, deadline=None)
@given(rings())
def test_the_chain_encloses_the_same(shape: tuple[Ring, list[Ring]]) -> None:
    outline, holes = shape
    peer = shapely.Polygon(outline, holes)
    assume(peer.is_valid)
    corners = np.array(chain(Polygon('hall', tuple(outline), tuple(map(tuple, holes)))))
    following = np.roll(corners, -1, axis=0)
    # Shoelace formula: holes are passed in the other direction, ways to them count nothing.
    crossed = corners[:, 0] * following[:, 1] - following[:, 0] * corners[:, 1]
    assert abs(0.5 * crossed.sum()) == pytest.approx(peer.area)
    assert {tuple(corner) for corner in corners} == {*outline, *(c for h in holes for c in h)}


def test_a_hole_is_read_and_is_free(tmp_path: Path) -> None:
    world = read(tmp_path, SQUARE, square(20, 20, 10))
    (hall,) = world.obstacles
    assert isinstance(hall, Polygon)
    assert hall.holes == (((20.0, 20.0), (30.0, 20.0), (30.0, 30.0), (20.0, 30.0)),)
    assert Scene(world).clearance([[25, 25], [15, 25], [5, 25]]).tolist() == [5.0, -5.0, 5.0]
    assert world.revision != read(tmp_path, SQUARE).revision


@pytest.mark.parametrize(
    ('holes', 'fault'),
    [
        ([SQUARE], '/coordinates/1: the hole crosses or touches /coordinates/0'),
        ([square(35, 20, 10)], '/coordinates/1: the hole crosses or touches /coordinates/0'),
        ([square(30, 20, 10)], '/coordinates/1: the hole crosses or touches /coordinates/0'),
        ([square(60, 60, 10)], '/coordinates/1: the hole is outside of /coordinates/0'),
        ([square(5, 5, 50)], '/coordinates/1: the hole is outside of /coordinates/0'),
        (
            [square(15, 15, 10), square(20, 20, 10)],
            '/coordinates/2: the hole crosses or touches /coordinates/1',
        ),
        (
            [square(15, 15, 20), square(20, 20, 5)],
            '/coordinates/2: the hole is inside /coordinates/1, another one',
        ),
        (
            [square(20, 20, 5), square(15, 15, 20)],
            '/coordinates/1: the hole is inside /coordinates/2, another one',
        ),
        ([[[20, 20], [30, 32], [30, 20], [20, 30]]], '/coordinates/1: the polygon crosses'),
        ([[[20, 20], [30, 30]]], '/coordinates/1: a polygon needs 3 corners'),
    ],
)
def test_holes_that_cannot_be(tmp_path: Path, holes: list[Any], fault: str) -> None:
    with pytest.raises(MotionPlannerError) as caught:
        read(tmp_path, SQUARE, *holes)
    (diagnostic,) = caught.value.diagnostics
    assert fault in str(diagnostic)


def test_corners_of_holes_count(tmp_path: Path) -> None:
    ring = shapely.Point(25, 25).buffer(10, quad_segs=250).exterior.coords[:-2]
    with pytest.raises(MotionPlannerError, match='0 has 1003 corners with its holes: at most 1000'):
        read(tmp_path, SQUARE, list(map(list, ring)))
