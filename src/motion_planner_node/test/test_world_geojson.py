"""Obstacles and regions out of GeoJSON files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from shapely.geometry import mapping

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.world import read_world
from motion_planner_node.world.model import Polygon, World
from motion_planner_node.world.obstacles import unused_name

SQUARE = [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]
CROSSED = [[0, 0], [4, 3], [2, 0], [0, 2], [0, 0]]
OBSTACLES = 'bounds: [0, 0, 50, 50]\nobstacles:\n  - geojson: shapes.geojson\n'
REGIONS = 'bounds: [0, 0, 50, 50]\nregions:\n  - geojson: shapes.geojson\n'


def feature(geometry: Any, **properties: Any) -> dict[str, Any]:
    return {'type': 'Feature', 'properties': properties, 'geometry': geometry}


def collection(*features: Any) -> dict[str, Any]:
    return {'type': 'FeatureCollection', 'features': list(features)}


def polygon(*rings: Any) -> dict[str, Any]:
    return {'type': 'Polygon', 'coordinates': list(rings)}


def read(directory: Path, content: Any, world: str = OBSTACLES) -> World:
    text = content if isinstance(content, str) else json.dumps(content, indent=1)
    (directory / 'shapes.geojson').write_text(text)
    return read_world(world, str(directory / 'world.yaml'))


def faults_of(directory: Path, content: Any, world: str = OBSTACLES) -> str:
    with pytest.raises(MotionPlannerError) as caught:
        read(directory, content, world)
    return '\n'.join(str(fault) for fault in caught.value.diagnostics)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.floats(1, 9), min_size=3, max_size=8))
def test_what_shapely_writes_is_read(
    tmp_path_factory: pytest.TempPathFactory, reaches: list[float]
) -> None:
    ring = shapely.Point(20, 20).buffer(10, quad_segs=2).exterior.coords
    corners = [
        (20 + (x - 20) * r / 9, 20 + (y - 20) * r / 9)
        for r, (x, y) in zip(reaches, ring, strict=False)
    ]
    shape = shapely.Polygon(corners)
    if not shape.is_valid or shape.area < 1e-3:
        return
    directory = tmp_path_factory.mktemp('shapes')
    (found,) = read(directory, collection(feature(mapping(shape)))).obstacles
    assert isinstance(found, Polygon)
    assert list(found.corners) == corners


def test_names_are_those_of_the_features(tmp_path: Path) -> None:
    two = {'type': 'MultiPolygon', 'coordinates': [[SQUARE], [SQUARE]]}
    content = collection(
        feature(polygon(SQUARE), name='hall'),
        feature(polygon(SQUARE)),
        feature(two, name='sheds', storeys=2),
        feature(two, name=None),
    )
    world = read(
        tmp_path, content, OBSTACLES + '  - {name: hall, polygon: [[5, 5], [6, 5], [6, 6]]}\n'
    )
    assert [obstacle.name for obstacle in world.obstacles] == [
        'hall_2',
        'obstacle1',
        'sheds',
        'sheds_2',
        'obstacle1_2',
        'obstacle1_3',
        'hall',
    ]


@pytest.mark.parametrize(
    'content',
    [polygon(SQUARE), feature(polygon(SQUARE)), json.dumps(polygon(SQUARE), indent='\t')],
)
def test_a_file_may_be_one_feature_or_one_geometry(tmp_path: Path, content: Any) -> None:
    assert len(read(tmp_path, content).obstacles) == 1


def test_a_third_coordinate_is_left_out(tmp_path: Path) -> None:
    high = [[x, y, 3.5] for x, y in SQUARE]
    (found,) = read(tmp_path, polygon(high)).obstacles
    assert isinstance(found, Polygon)
    assert found.corners == ((0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0))


def test_regions_need_names_of_their_own(tmp_path: Path) -> None:
    content = collection(
        feature(polygon(SQUARE), name='dock'), feature(polygon(SQUARE), name='yard')
    )
    assert list(read(tmp_path, content, REGIONS).regions) == ['dock', 'yard']
    assert 'has no property name' in faults_of(tmp_path, polygon(SQUARE), REGIONS)
    twice = collection(feature(polygon(SQUARE), name='dock'), feature(polygon(SQUARE), name='dock'))
    assert 'dock is the name of another region, too' in faults_of(tmp_path, twice, REGIONS)
    bad = feature(polygon(SQUARE), name='my dock')
    assert 'a region cannot be called "my dock"' in faults_of(tmp_path, bad, REGIONS)


@pytest.mark.parametrize(
    ('content', 'fault'),
    [
        (polygon(CROSSED), '/coordinates/0: the polygon crosses or touches itself'),
        (polygon(), '/coordinates has no ring'),
        (polygon([[0, 0], [1, 'a'], [2, 2]]), '/coordinates/0: corner 2: y has to be a number'),
        (polygon([[0, 0], [1], [2, 2]]), 'corner 2 has to be [x, y], not a list of 1'),
        ('{"type": "Polygon", "coordinates": [[[0, 0], [NaN, 0], [1, 1]]]}', 'has to be finite'),
        ({'type': 'Point', 'coordinates': [1, 2]}, '/ is a Point; Polygon and MultiPolygon'),
        (collection(feature({'type': 'LineString'})), '/features/0/geometry is a LineString'),
        (collection(feature(None)), '/features/0/geometry has to be an object, not nothing'),
        (collection(polygon(SQUARE)), '/features/0 is not a Feature'),
        (collection(), 'there is no polygon in the file'),
        ({'type': 'FeatureCollection'}, 'shapes.geojson:1:1: / lacks features'),
        ([1, 2], '/ has to be an object, not a list of 2'),
        ({'coordinates': []}, '/ lacks type'),
        ('{"type": ', 'did not find expected node content'),
        ('', 'the text is empty'),
        ('[' * 100, 'nested more than 16 levels deep'),
    ],
)
def test_faults_are_told_with_pointer_and_place(tmp_path: Path, content: Any, fault: str) -> None:
    told = faults_of(tmp_path, content)
    assert fault in told
    assert 'shapes.geojson:' in told


def test_the_line_is_that_in_the_file(tmp_path: Path) -> None:
    content = collection(feature(polygon(SQUARE)), feature(polygon(CROSSED)))
    text = json.dumps(content, indent=1)
    line = text[: text.rindex('"coordinates"')].count('\n') + 2
    assert f'shapes.geojson:{line}:' in faults_of(tmp_path, text)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(MotionPlannerError, match=r'world.yaml:3:14: the GeoJSON file .* cannot be'):
        read_world(OBSTACLES, str(tmp_path / 'world.yaml'))
    assert 'larger than' in faults_of(tmp_path, ' ' * (5 << 20))
    both = 'bounds: [0, 0, 9, 9]\nobstacles: [{geojson: a, polygon: []}]'
    assert 'needs either polygon or circle, or geojson' in faults_of(tmp_path, '', both)
    named = OBSTACLES + '    name: all\n'
    assert 'are in its features' in faults_of(tmp_path, polygon(SQUARE), named)


def test_no_number_behind_a_name_is_tried_twice() -> None:
    class Counted(dict[str, int]):
        asked = 0

        def __contains__(self, key: object) -> bool:
            Counted.asked += 1
            return super().__contains__(key)

    lines, numbers = Counted({'a_3': 1}), dict[str, int]()
    for _ in range(100):
        lines[unused_name('a', lines, numbers)] = 1
    assert set(lines) == {'a', *(f'a_{number}' for number in range(2, 102))}
    assert Counted.asked <= 3 * 100
