"""Occupancy maps in map_server's format, and all that can be wrong with them."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.world import map_reader, read_world
from motion_planner_node.world.model import Bounds, OccupancyMap

MAP = 'image: map.pgm\nresolution: 0.5\norigin: [1.0, 2.0, 0.0]\n'
# Top row first: black, white, and map_saver's grey for what it does not know.
GREYS = np.array([[0, 254, 205], [254, 254, 0]], np.uint8)


def grid_of(directory: Path, world: str = 'map: map.yaml\n') -> OccupancyMap:
    found = read_world(world, str(directory / 'world.yaml')).map
    assert found is not None
    return found


def faults_of(directory: Path, world: str = 'map: map.yaml\n') -> str:
    with pytest.raises(MotionPlannerError) as caught:
        read_world(world, str(directory / 'world.yaml'))
    return '\n'.join(str(fault) for fault in caught.value.diagnostics)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / 'map.yaml').write_text(MAP)
    Image.fromarray(GREYS).save(tmp_path / 'map.pgm')
    return tmp_path


@pytest.mark.parametrize('name', ['map.pgm', 'map.png', 'map.bmp'])
def test_a_picture_becomes_cells_the_bottom_row_first(folder: Path, name: str) -> None:
    Image.fromarray(GREYS).save(folder / name)
    (folder / 'map.yaml').write_text(MAP.replace('map.pgm', name))
    grid = grid_of(folder)
    assert grid.occupied.tolist() == [[0, 0, 1], [1, 0, 1]]
    assert (grid.resolution, grid.x, grid.y, grid.yaw) == (0.5, 1.0, 2.0, 0.0)
    assert read_world('map: map.yaml', str(folder / 'w')).bounds == Bounds(1.0, 2.0, 2.5, 3.0)


def test_unknown_space_is_free_when_the_world_says_so(folder: Path) -> None:
    grid = grid_of(folder, 'map: {file: map.yaml, unknown: free}')
    assert grid.occupied.tolist() == [[0, 0, 1], [1, 0, 0]]
    assert not grid.unknown_occupied
    assert 'unknown has to be occupied or free' in faults_of(
        folder, 'map: {file: map.yaml, unknown: maybe}'
    )


@pytest.mark.parametrize(
    'content',
    [
        b'P2\n# by hand\n3 2\n# grey\n255\n0 254 205\n254 254 0\n',
        b'P2 3 2 65535 0 65278 52685 65278 65278 0 ',
        b'P5\n# by hand\n3 2\n255\n' + GREYS.tobytes(),
        b'P5 3 2 65535\n' + (GREYS.astype('>u2') * 257).tobytes(),
    ],
)
def test_all_kinds_of_pgm_are_read(folder: Path, content: bytes) -> None:
    (folder / 'map.pgm').write_bytes(content)
    assert grid_of(folder).occupied.tolist() == [[0, 0, 1], [1, 0, 1]]


@pytest.mark.parametrize(
    ('extra', 'expected'),
    [
        ('negate: 1', [[1, 1, 0], [0, 1, 1]]),
        ('negate: false', [[0, 0, 1], [1, 0, 1]]),
        ('free_thresh: 0.25', [[0, 0, 1], [1, 0, 0]]),
        ('free_thresh: 0.1\noccupied_thresh: 0.15', [[0, 0, 1], [1, 0, 1]]),
        ('mode: scale', [[0, 0, 1], [1, 0, 0]]),
        ('mode: scale\nfree_thresh: 0.1\noccupied_thresh: 0.2', [[0, 0, 1], [1, 0, 1]]),
        ('mode: raw', [[1, 1, 0], [0, 1, 1]]),
    ],
)
def test_thresholds_and_modes_are_those_of_map_server(
    folder: Path, extra: str, expected: list[list[int]]
) -> None:
    (folder / 'map.yaml').write_text(f'{MAP}{extra}\n')
    assert grid_of(folder).occupied.tolist() == expected


def test_transparent_pixels(folder: Path) -> None:
    """As map_server: a fourth channel of brightness in trinary mode, unknown in scale mode."""
    pixels = np.full((1, 3, 4), 255, np.uint8)
    pixels[0, 0] = 0, 0, 0, 255
    pixels[0, 1, 3] = 0
    Image.fromarray(pixels).save(folder / 'map.png')
    for extra, expected in (('', [[1, 1, 0]]), ('mode: scale\n', [[1, 1, 0]])):
        (folder / 'map.yaml').write_text(MAP.replace('map.pgm', 'map.png') + extra)
        assert grid_of(folder).occupied.tolist() == expected
    assert grid_of(folder, 'map: {file: map.yaml, unknown: free}').occupied.tolist() == [[1, 0, 0]]


def test_a_map_stands_beside_everything_else(folder: Path) -> None:
    world = read_world(
        'bounds: [0, 0, 5, 5]\nmap: map.yaml\nobjects: {tree: {x: 0.5, y: 0.5}}\n'
        'obstacles: [{circle: {center: [4, 4], radius: 0.5}}]\n',
        str(folder / 'world.yaml'),
    )
    assert world.bounds == Bounds(0.0, 0.0, 5.0, 5.0)
    assert world.map is not None
    assert len(world.obstacles) == 1


def test_the_revision_is_that_of_the_content(folder: Path) -> None:
    revisions = [read_world('map: map.yaml', str(folder / 'world.yaml')).revision]
    Image.fromarray(GREYS).save(folder / 'other.png')
    (folder / 'map.yaml').write_text(MAP.replace('map.pgm', 'other.png'))
    assert read_world('map: map.yaml', str(folder / 'world.yaml')).revision == revisions[0]
    Image.fromarray(np.flipud(GREYS)).save(folder / 'other.png')
    for text in (MAP, MAP.replace('0.5', '0.6'), MAP.replace('2.0', '2.5')):
        (folder / 'map.yaml').write_text(text.replace('map.pgm', 'other.png'))
        revisions.append(read_world('map: map.yaml', str(folder / 'world.yaml')).revision)
    assert len(set(revisions)) == 4


@pytest.mark.parametrize(
    ('text', 'fault'),
    [
        ('resolution: 0.5\norigin: [0, 0, 0]\n', 'map.yaml:1:1: the map lacks image'),
        ('image: map.pgm\n', 'the map lacks resolution'),
        (MAP.replace('0.5', '0'), 'map.yaml:2:13: resolution has to be at least 0.001, not 0'),
        (MAP.replace('0.5', '.nan'), 'resolution has to be finite'),
        (MAP.replace('0.5', '1e7'), 'reaches beyond 1e+07 m'),
        (MAP.replace(', 0.0]', ']'), 'origin has to be [x, y, yaw], not a list of 2'),
        (MAP + 'negate: 2\n', 'map.yaml:4:9: negate has to be 0 or 1, not 2'),
        (MAP + 'occupied_thresh: 65\n', 'occupied_thresh has to be from 0 to 1, not 65'),
        (MAP + 'ocupied_thresh: 0.6\n', 'did you mean occupied_thresh?'),
        (MAP + 'free_thresh: 0.7\n', 'free_thresh 0.7 is more than occupied_thresh 0.65'),
        (MAP + 'mode: grey\n', 'mode has to be trinary, scale or raw, not grey'),
        (MAP.replace('map.pgm', 'none.pgm'), 'map.yaml:1:8: the picture'),
        (MAP.replace('map.pgm', '..'), 'cannot be read: Is a directory'),
        ('[1, 2', 'map.yaml:2:1: not YAML'),
        ('- image', 'the map has to be keys and values'),
    ],
)
def test_faults_in_a_map_are_told_with_their_place(folder: Path, text: str, fault: str) -> None:
    (folder / 'map.yaml').write_text(text)
    assert fault in faults_of(folder)


def test_pictures_that_are_none(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = (folder / 'map.pgm').read_bytes()
    Image.fromarray(np.zeros((50, 50), np.uint8)).save(folder / 'map.png')
    damaged = (folder / 'map.png').read_bytes()
    for content, fault in (
        (b'', 'is not a PNG, PGM or BMP picture'),
        (b'hello', 'is not a PNG, PGM or BMP picture'),
        (whole[:-3], 'is damaged'),
        (damaged[:-30], 'is damaged'),
        (b'P5 0 0 255\n', 'the picture'),
        (b'P5 -3 2 255\n', 'the picture'),
        (b'P5 99999 99999 255\n', 'has more than the 10000 x 10000 pixels'),
        (b'P5 10001 1 255\n' + bytes(10001), 'has more than the 10000 x 10000 pixels'),
    ):
        (folder / 'map.pgm').write_bytes(content)
        assert fault in faults_of(folder), content[:20]
    monkeypatch.setattr(map_reader, 'MOST_EDGES', 3)
    (folder / 'map.pgm').write_bytes(whole)
    assert 'more than 3 edges' in faults_of(folder)


def test_names_of_files_may_have_long_directories(folder: Path) -> None:
    deep = folder / '/'.join(['d' * 60] * 4)
    deep.mkdir(parents=True)
    Image.fromarray(GREYS).save(deep / 'map.pgm')
    (deep / 'map.yaml').write_text(MAP.replace('map.pgm', f'{deep}/map.pgm'))
    assert grid_of(folder, f'map: {deep}/map.yaml').occupied.tolist() == [[0, 0, 1], [1, 0, 1]]
    assert 'is longer than 4096 characters' in faults_of(folder, f'map: {"d/" * 2048}m')


def test_files_that_are_none(folder: Path) -> None:
    os.mkfifo(folder / 'pipe')
    (folder / 'loop').symlink_to(folder / 'loop')
    for name, fault in (
        ('pipe', 'is not a regular file'),
        ('/dev/zero', 'is not a regular file'),
        ('loop', 'cannot be read: Too many levels of symbolic links'),
        ('none.yaml', 'world.yaml:1:6: the map'),
        ('"a\\0b"', 'the map'),
    ):
        assert fault in faults_of(folder, f'map: {name}')
    for name in ('pipe', 'loop', '/dev/zero'):
        (folder / 'map.yaml').write_text(MAP.replace('map.pgm', name))
        assert 'map.yaml:1:8: the picture' in faults_of(folder)


def test_what_a_world_with_a_map_refuses(folder: Path) -> None:
    assert 'outside the bounds [10, 10, 20, 20]' in faults_of(
        folder, 'bounds: [10, 10, 20, 20]\nmap: map.yaml'
    )
    assert 'tree is at (9, 9), outside the bounds [1, 2, 2.5, 3]' in faults_of(
        folder, 'map: map.yaml\nobjects: {tree: {x: 9, y: 9}}'
    )
    robot = 'model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 0.1, speed: 1'
    start = 'start: {x: 1.25, y: 2.75, heading: 0}'
    assert 'from the occupancy map' in faults_of(
        folder, f'map: map.yaml\nrobots: {{rover: {{{robot}, {start}}}}}'
    )
    name = 'obstacles: [{name: the occupancy map, circle: {center: [1, 1], radius: 1}}]'
    assert 'is taken by the map itself' in faults_of(folder, f'map: map.yaml\n{name}')


def test_a_map_that_comes_along() -> None:
    grid = OccupancyMap('the map', 2, 2, bytes(4), 0.5, 0.0, 0.0, 0.0, unknown_occupied=True)
    world = read_world('objects: {tree: {x: 0.5, y: 0.5}}', 'world.yaml', grid=grid)
    assert (world.map, world.bounds) == (grid, Bounds(0.0, 0.0, 1.0, 1.0))
    for bad, fault in (
        (OccupancyMap('the map', 0, 2, b'', 0.5, 0.0, 0.0, 0.0, unknown_occupied=True), 'no area'),
        (
            OccupancyMap('the map', 2, 2, bytes(4), 0.0, 0.0, 0.0, 0.0, unknown_occupied=True),
            'no area',
        ),
        (
            OccupancyMap('the map', 2, 2, bytes(4), float('nan'), 0, 0, 0, unknown_occupied=True),
            'no area',
        ),
        (
            OccupancyMap('the map', 2, 2, bytes(4), 0.5, float('inf'), 0, 0, unknown_occupied=True),
            'beyond',
        ),
        (
            OccupancyMap('the map', 1, 10001, bytes(10001), 0.5, 0, 0, 0, unknown_occupied=True),
            '10000 on a side',
        ),
    ):
        with pytest.raises(MotionPlannerError, match=fault):
            read_world('objects: {}', 'world.yaml', grid=bad)
    with pytest.raises(MotionPlannerError, match='another one came along'):
        read_world('map: map.yaml', 'world.yaml', grid=grid)
