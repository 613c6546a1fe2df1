"""The picture shows what it should, and its labels keep out of the way."""

from __future__ import annotations

from dataclasses import replace
from io import BytesIO
from math import pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.collections import LineCollection
from matplotlib.image import imread
from matplotlib.patches import Circle, Polygon

from interface_node.history import Improvement
from interface_node.picture import draw, write_picture
from interface_node.picture.labels import place_labels
from interface_node.plan import Obstacle, Occupancy, Plan, World


def test_everything_is_drawn(sample_plan: Plan) -> None:
    (axes,) = draw(sample_plan).axes
    texts = {text.get_text() for text in axes.texts}
    assert texts >= {'base', 'tree', 'gate', '1', '2', '4'}
    assert '3' not in texts, 'a purely symbolic action has no place on a map'
    assert sum(isinstance(patch, Circle) for patch in axes.patches) == 1
    wall = next(patch for patch in axes.patches if isinstance(patch, Polygon))
    assert [tuple(corner) for corner in wall.get_xy()[:-1]] == [
        (30.0, 0.0),
        (33.0, 0.0),
        (33.0, 10.0),
        (30.0, 10.0),
    ]
    assert {line.get_gid() for line in axes.lines} >= {'base', 'tree', 'gate'}
    way, views = (
        list(lines.get_segments())
        for lines in axes.collections
        if isinstance(lines, LineCollection)
    )
    driven = np.array(way)
    assert tuple(driven[0, 0]) == (10.0, 10.0)
    last = sample_plan.steps[-1].end
    assert last is not None
    np.testing.assert_allclose(driven[-1, 1], (last.x, last.y), atol=1e-9)
    assert [tuple(view[1]) for view in views] == [(40.0, 40.0), (70.0, 15.0)]
    assert axes.get_title(loc='left') == 'small: 4 actions, 36 m'


def test_the_curve_of_the_best_length_is_there_when_there_were_several(sample_plan: Plan) -> None:
    (axes,) = draw(replace(sample_plan, improvements=(Improvement(0.5, 36.0),))).axes
    assert not axes.child_axes
    told = (Improvement(0.5, 44.0), Improvement(2.0, 36.0))
    plan = replace(sample_plan, improvements=told, planning_time=3.0)
    (axes,) = draw(plan).axes
    (curve,) = axes.child_axes
    line = curve.lines[0]
    np.testing.assert_array_equal(line.get_xydata(), [(0.5, 44.0), (2.0, 36.0), (3.0, 36.0)])
    assert write_picture(plan) == write_picture(plan)


def test_a_footprint_is_drawn_where_the_robot_stands(sample_plan: Plan) -> None:
    assert sample_plan.world is not None
    robots = tuple(
        replace(robot, footprint=((-1.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-1.0, 1.0)))
        for robot in sample_plan.world.robots
    )
    plan = replace(sample_plan, world=replace(sample_plan.world, robots=robots))
    (axes,) = draw(plan).axes
    outlines = [
        patch.get_xy()[:-1]
        for patch in axes.patches
        if isinstance(patch, Polygon) and not patch.get_fill()
    ]
    assert len(outlines) == 3
    np.testing.assert_allclose(outlines[0], [(9, 9), (12, 9), (12, 11), (9, 11)])


def test_regions_and_the_map_are_drawn(sample_plan: Plan) -> None:
    assert sample_plan.world is not None
    regions = (
        Obstacle('dock', ((60.0, 0.0), (80.0, 0.0), (80.0, 9.0))),
        Obstacle('yard', (), (20.0, 40.0), 8.0),
    )
    cells = np.zeros((5000, 30), np.bool_)
    cells[7, 3] = True
    world = replace(
        sample_plan.world, regions=regions, map=Occupancy(0.01, (5.0, 6.0), cells, pi / 2)
    )
    (axes,) = draw(replace(sample_plan, world=world)).axes
    assert {text.get_text() for text in axes.texts} >= {'dock', 'yard'}
    legend = axes.get_legend()
    assert legend is not None
    assert 'region' in {text.get_text() for text in legend.get_texts()}
    (image,) = axes.images
    pixels = np.asarray(image.get_array())
    assert max(pixels.shape) <= 2000
    ((row, column),) = np.argwhere(pixels[..., 3] > 0)
    left, right, low, high = image.get_extent()
    place = ((column + 0.5) / pixels.shape[1], (row + 0.5) / pixels.shape[0])
    at = (left + place[0] * (right - left), low + place[1] * (high - low))
    drawn = axes.transData.inverted().transform(image.get_transform().transform(at))
    np.testing.assert_allclose(drawn, (5.0 - 0.075, 6.0 + 0.035), atol=0.03)
    assert axes.get_xlim() == (world.bounds[0], world.bounds[2])


def test_the_picture_is_a_png_of_some_size_and_always_the_same(sample_plan: Plan) -> None:
    first = write_picture(sample_plan)
    pixels = imread(BytesIO(first))
    assert pixels.shape[:2] == (1200, 1600)
    assert pixels.std() > 0.02
    assert write_picture(sample_plan) == first


def test_without_a_plan_the_world_is_drawn(sample_plan: Plan) -> None:
    (axes,) = draw(replace(sample_plan, outcome='NO_PLAN', steps=())).axes
    assert axes.get_title(loc='left') == 'small: NO_PLAN'
    assert len(axes.patches) == 2


@pytest.mark.parametrize('bounds', [(0.0, 0.0, 1.0, 1e4), (-1e9, 0.0, 1e9, 1.0)])
def test_worlds_of_odd_shapes_are_drawn(
    sample_plan: Plan, bounds: tuple[float, float, float, float]
) -> None:
    write_picture(replace(sample_plan, world=World('', 'r', bounds), steps=()))


def test_a_name_with_dollars_is_no_formula(sample_plan: Plan) -> None:
    world = World('', 'r', (0.0, 0.0, 9.0, 9.0), {r'$\frac$': (5.0, 5.0)})
    write_picture(replace(sample_plan, mission=r'$\no$', world=world, steps=()))


def test_a_plan_without_a_world_cannot_be_drawn(sample_plan: Plan) -> None:
    with pytest.raises(ValueError, match='without a world'):
        draw(replace(sample_plan, world=None))


@settings(max_examples=40, deadline=None)
@given(
    st.lists(st.tuples(st.integers(1, 14), st.integers(1, 14)), min_size=1, max_size=3, unique=True)
)
def test_labels_with_room_overlap_neither_each_other_nor_the_edge(
    places: list[tuple[int, int]],
) -> None:
    anchors = [(x * 75.0, y * 15.0 + 300) for x, y in places]
    sizes = [(80.0, 20.0)] * len(anchors)
    centers = place_labels(anchors, sizes, 14.0, np.empty((0, 2)), (0.0, 0.0, 1200.0, 1200.0))
    for index, (x, y) in enumerate(centers):
        assert 40 <= x <= 1160
        assert 10 <= y <= 1190
        for other_x, other_y in centers[:index]:
            assert abs(x - other_x) >= 80 or abs(y - other_y) >= 20
