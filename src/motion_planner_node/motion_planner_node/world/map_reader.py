"""Occupancy maps in the format of ROS's map_server: a YAML file that names a picture."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.world.files import LONGEST_PATH, directory_of, read_file
from motion_planner_node.world.map_edges import count_edges
from motion_planner_node.world.map_image import LONGEST_SIDE, ImageError, Picture, read_picture
from motion_planner_node.world.model import OccupancyMap
from motion_planner_node.world.syntax import LONGEST_TEXT, Mapping, Node, Place, Scalar, read_tree
from motion_planner_node.world.values import (
    LARGEST_NUMBER,
    SMALLEST_LENGTH,
    Faults,
    kind_of,
    read_at_least,
    read_fields,
    read_mapping,
    read_number,
    read_numbers,
    read_text,
)

#: The largest picture file [bytes]: one of the most pixels, uncompressed, with room to spare.
LARGEST_FILE = 512 << 20
#: The most straight edges between free and occupied cells.
MOST_EDGES = 4_000_000
#: What a cell has to exceed to be occupied and fall below to be free, where nothing is said.
OCCUPIED_THRESHOLD, FREE_THRESHOLD = 0.65, 0.196
#: How answers call the map.
MAP_NAME = 'the occupancy map'

FREE, OCCUPIED, UNKNOWN = 0, 1, 2
_REQUIRED = ('image', 'resolution', 'origin')
_KNOWN = (*_REQUIRED, 'negate', 'occupied_thresh', 'free_thresh', 'mode')
_MODES = ('trinary', 'scale', 'raw')
_TRUTH = {'0': False, '1': True, 'false': False, 'true': True}


@dataclass(frozen=True, slots=True)
class _Rules:
    """What brightness means: thresholds from 0 to 1, and map_server's mode."""

    negate: bool = False
    occupied: float = OCCUPIED_THRESHOLD
    free: float = FREE_THRESHOLD
    mode: str = 'trinary'


def read_map(node: Node, directory: str, faults: Faults) -> OccupancyMap | None:
    """The map that the key ``map`` of a world names: its file, or file and unknown.

    None, and faults with the lines of the file that is wrong, when it cannot be used.
    """
    unknown_occupied = True
    if isinstance(node, Mapping):
        fields = read_fields(node, 'map', ('file',), ('unknown',), faults)
        if 'unknown' in fields:
            unknown_occupied = _unknown(fields['unknown'], faults)
        if 'file' not in fields:
            return None
        node = fields['file']
    name = read_text(node, 'the file of the map', faults, LONGEST_PATH)
    if name is None:
        return None
    file = read_file(directory, name, LONGEST_TEXT, 'the map', node.place, faults)
    if file is None:
        return None
    own = Faults(file.path)
    root = read_tree(file.content.decode('utf-8', errors='replace'), file.path)
    result = _MapReader(file.path, own).read(root, unknown_occupied=unknown_occupied)
    faults.include(own)
    return result


def _unknown(node: Node, faults: Faults) -> bool:
    if not isinstance(node, Scalar) or node.text not in {'occupied', 'free'}:
        message = f'map: unknown has to be occupied or free, not {kind_of(node)}'
        faults.add(message, node.place)
        return True
    return node.text == 'occupied'


class _MapReader:
    """Reads one file of map_server; what is wrong goes to ``faults``."""

    def __init__(self, path: str, faults: Faults) -> None:
        self._path = path
        self._faults = faults

    def read(self, root: Node, *, unknown_occupied: bool) -> OccupancyMap | None:
        entries = read_mapping(root, 'the map', self._faults)
        for key, (place, _) in entries.items():
            close = get_close_matches(key, _KNOWN, 1) if key not in _KNOWN else []
            if close:
                message = f'the map has no {key[:40]}; did you mean {close[0]}?'
                self._faults.add(message, place, key)
        fields = {key: value for key, (_, value) in entries.items()}
        if isinstance(root, Mapping):
            for key in _REQUIRED:
                if key not in fields:
                    self._faults.add(f'the map lacks {key}', root.place)
        resolution = self._resolution(fields)
        origin = self._origin(fields)
        rules = self._rules(fields)
        picture = self._picture(fields['image']) if 'image' in fields else None
        if resolution is None or not origin or rules is None or picture is None:
            return None
        kinds = _kinds(picture, rules)[::-1]
        place = fields['image'].place
        grid = map_of(kinds, resolution, origin, unknown_occupied=unknown_occupied)
        return check_map(grid, self._faults, place)

    def _resolution(self, fields: dict[str, Node]) -> float | None:
        if 'resolution' not in fields:
            return None
        return read_at_least(fields['resolution'], 'resolution', SMALLEST_LENGTH, self._faults)

    def _origin(self, fields: dict[str, Node]) -> list[float]:
        if 'origin' not in fields:
            return []
        return read_numbers(fields['origin'], 'origin', ('x', 'y', 'yaw'), self._faults)

    def _rules(self, fields: dict[str, Node]) -> _Rules | None:
        negate = self._negate(fields['negate']) if 'negate' in fields else False
        occupied = self._threshold(fields, 'occupied_thresh', OCCUPIED_THRESHOLD)
        free = self._threshold(fields, 'free_thresh', FREE_THRESHOLD)
        mode = self._mode(fields['mode']) if 'mode' in fields else 'trinary'
        if negate is None or occupied is None or free is None or mode is None:
            return None
        if free > occupied:
            key = 'free_thresh' if 'free_thresh' in fields else 'occupied_thresh'
            message = f'free_thresh {free:g} is more than occupied_thresh {occupied:g}'
            self._faults.add(message, fields[key].place)
            return None
        return _Rules(negate, occupied, free, mode)

    def _negate(self, node: Node) -> bool | None:
        if not isinstance(node, Scalar) or node.text.lower() not in _TRUTH:
            self._faults.add(f'negate has to be 0 or 1, not {kind_of(node)}', node.place)
            return None
        return _TRUTH[node.text.lower()]

    def _threshold(self, fields: dict[str, Node], key: str, default: float) -> float | None:
        if key not in fields:
            return default
        number = read_number(fields[key], key, self._faults)
        if number is not None and not 0.0 <= number <= 1.0:
            self._faults.add(f'{key} has to be from 0 to 1, not {number:g}', fields[key].place)
            return None
        return number

    def _mode(self, node: Node) -> str | None:
        if not isinstance(node, Scalar) or node.text not in _MODES:
            message = f'mode has to be {", ".join(_MODES[:-1])} or {_MODES[-1]}, not'
            self._faults.add(f'{message} {kind_of(node)}', node.place)
            return None
        return node.text

    def _picture(self, node: Node) -> Picture | None:
        name = read_text(node, 'image', self._faults, LONGEST_PATH)
        if name is None:
            return None
        directory = directory_of(self._path)
        file = read_file(directory, name, LARGEST_FILE, 'the picture', node.place, self._faults)
        if file is None:
            return None
        try:
            return read_picture(file.content)
        except ImageError as error:
            self._faults.add(f'the picture {file.path} {error}', node.place, name)
            return None


def _kinds(picture: Picture, rules: _Rules) -> NDArray[np.uint8]:
    """FREE, OCCUPIED or UNKNOWN for each pixel, as map_server decides."""
    levels, white = picture.levels, picture.white
    if picture.alpha is not None and rules.mode == 'trinary':
        levels, white = levels + picture.alpha, white + 255
    shade = np.arange(white + 1) / white
    if rules.mode == 'raw':
        kinds = kinds_of_percents(np.round(shade * 255.0), rules.occupied, rules.free)
    else:
        dark = shade if rules.negate else 1.0 - shade
        kinds = np.full(white + 1, UNKNOWN, np.uint8)
        if rules.mode == 'scale':
            middle = 0.5 * (rules.occupied + rules.free)
            kinds[:] = np.where(dark >= middle, OCCUPIED, FREE)
        kinds[dark < rules.free] = FREE
        kinds[dark > rules.occupied] = OCCUPIED
    found = kinds[levels]
    if picture.alpha is not None and rules.mode == 'scale':
        found[picture.alpha < 255] = UNKNOWN
    return np.asarray(found)


def kinds_of_percents(
    percents: NDArray[np.float64],
    occupied: float = OCCUPIED_THRESHOLD,
    free: float = FREE_THRESHOLD,
) -> NDArray[np.uint8]:
    """FREE, OCCUPIED or UNKNOWN for probabilities from 0 to 100; what is no such is unknown."""
    kinds = np.full(percents.shape, UNKNOWN, np.uint8)
    kinds[(percents >= 0.0) & (percents < 100.0 * free)] = FREE
    kinds[(percents <= 100.0) & (percents > 100.0 * occupied)] = OCCUPIED
    return kinds


def map_of(
    kinds: NDArray[np.uint8],
    resolution: float,
    origin: list[float],
    *,
    unknown_occupied: bool,
) -> OccupancyMap:
    """The map of cells (rows, columns), row 0 at the ``origin`` x, y [m], yaw [rad]."""
    table = np.array([0, 1, int(unknown_occupied)], np.uint8)
    rows, columns = kinds.shape
    x, y, yaw = origin
    cells = table[kinds].tobytes()
    turned = float(wrap_angle(yaw))
    return OccupancyMap(MAP_NAME, rows, columns, cells, resolution, x, y, turned, unknown_occupied)


def check_map(grid: OccupancyMap, faults: Faults, place: Place) -> OccupancyMap | None:
    """The map itself; None, and a fault at ``place``, when it is too small or too large."""
    size = f'{grid.columns} x {grid.rows} cells of {grid.resolution:g} m'
    if min(grid.rows, grid.columns) < 1 or not grid.resolution >= SMALLEST_LENGTH:
        faults.add(f'the map has {size}: no area', place)
    elif max(grid.rows, grid.columns) > LONGEST_SIDE:
        faults.add(f'the map has {size}, more than {LONGEST_SIDE} on a side', place)
    elif not all(
        isfinite(value) and abs(value) <= LARGEST_NUMBER
        for value in (grid.resolution, grid.yaw, *_extent(grid))
    ):
        faults.add(f'the map of {size} reaches beyond {LARGEST_NUMBER:g} m', place)
    elif count_edges(grid, MOST_EDGES) > MOST_EDGES:
        message = f'the map of {size} has more than {MOST_EDGES} edges between free and occupied'
        faults.add(f'{message} cells', place)
    else:
        return grid
    return None


def _extent(grid: OccupancyMap) -> tuple[float, float, float, float]:
    bounds = grid.bounds
    return bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max
