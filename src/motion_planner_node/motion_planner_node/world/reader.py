"""World files: YAML, or what a program sends; see docs/world.md."""

from __future__ import annotations

from dataclasses import replace

from motion_planner_node.world.files import directory_of
from motion_planner_node.world.map_reader import check_map, read_map
from motion_planner_node.world.model import Bounds, OccupancyMap, World, WorldObject
from motion_planner_node.world.obstacles import read_obstacles, read_regions
from motion_planner_node.world.revision import revision_of
from motion_planner_node.world.robots_reader import check_starts, read_robots
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.syntax import Mapping, Node, Place, read_tree
from motion_planner_node.world.values import (
    SMALLEST_LENGTH,
    Faults,
    check_count,
    check_field,
    check_label,
    is_nothing,
    read_fields,
    read_mapping,
    read_number,
    read_numbers,
)

MOST_OBJECTS = 10_000


class _WorldReader:
    """Reads the parts of one world; what is wrong goes to ``faults``."""

    def __init__(self, source: str, directory: str) -> None:
        self._source = source
        self._directory = directory
        self._faults = Faults(source)

    def read(self, root: Node, grid: OccupancyMap | None) -> World:
        parts = read_fields(
            root,
            'the world',
            (),
            ('bounds', 'map', 'objects', 'obstacles', 'robots', 'regions'),
            self._faults,
        )
        given = {key: node for key, node in parts.items() if not is_nothing(node)}
        for key in ('bounds', 'map'):
            if key in parts and key not in given:
                verb = 'are' if key == 'bounds' else 'is'
                self._faults.add(f'{key} {verb} empty', parts[key].place)
        grid = self._map(root, given, grid)
        bounds = self._bounds(given['bounds'], grid) if 'bounds' in given else None
        if grid is not None and 'bounds' not in given:
            bounds = grid.bounds
        elif isinstance(root, Mapping) and 'bounds' not in parts and 'map' not in parts:
            self._faults.add('the world lacks bounds', root.place)
        objects = self._objects(given['objects'], bounds) if 'objects' in given else {}
        obstacles = (
            read_obstacles(given['obstacles'], self._directory, self._faults)
            if 'obstacles' in given
            else ()
        )
        robots, starts = (
            read_robots(given['robots'], objects, self._faults) if 'robots' in given else ({}, [])
        )
        taken = {*objects, *robots}
        regions = (
            read_regions(given['regions'], self._directory, taken, self._faults)
            if 'regions' in given
            else {}
        )
        if bounds is None:
            raise self._faults.error()
        world = World(self._source, '', bounds, objects, obstacles, robots, regions, grid)
        if starts:
            check_starts(Scene(world), starts, self._faults)
        if self._faults:
            raise self._faults.error()
        return replace(world, revision=revision_of(world))

    def _map(
        self, root: Node, given: dict[str, Node], grid: OccupancyMap | None
    ) -> OccupancyMap | None:
        if grid is None:
            if 'map' not in given:
                return None
            return read_map(given['map'], self._directory, self._faults)
        if 'map' in given:
            message = 'the world names a map, and another one came along with it'
            self._faults.add(message, given['map'].place)
        return check_map(grid, self._faults, root.place)

    def _bounds(self, node: Node, grid: OccupancyMap | None) -> Bounds | None:
        numbers = read_numbers(node, 'bounds', ('x_min', 'y_min', 'x_max', 'y_max'), self._faults)
        if not numbers:
            return None
        bounds = Bounds(*numbers)
        width, height = bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min
        if min(width, height) < SMALLEST_LENGTH:
            message = f'bounds enclose no area: {width:g} m by {height:g} m'
            self._faults.add(message, node.place)
            return None
        if grid is not None and not _overlap(bounds, grid.bounds):
            message = f'the map, {_words(grid.bounds)}, is outside the bounds {_words(bounds)}'
            self._faults.add(message, node.place)
        return bounds

    def _objects(self, node: Node, bounds: Bounds | None) -> dict[str, WorldObject]:
        objects: dict[str, WorldObject] = {}
        if not check_count(node, 'objects', MOST_OBJECTS, self._faults):
            return objects
        for label, (place, value) in read_mapping(node, 'objects', self._faults).items():
            check_label(label, place, 'an object', self._faults)
            entries = read_mapping(value, label, self._faults)
            fields: dict[str, float] = {}
            for name, (key, item) in entries.items():
                check_field(name, key, label, self._faults)
                number = read_number(item, f'{label}.{name}', self._faults)
                if number is not None:
                    fields[name] = number
            missing = [name for name in ('x', 'y') if name not in entries]
            if missing and isinstance(value, Mapping):
                self._faults.add(f'{label} lacks {" and ".join(missing)}', value.place)
            if bounds and 'x' in fields and 'y' in fields:
                self._check_inside(bounds, label, fields['x'], fields['y'], value.place)
            objects[label] = WorldObject(label, fields)
        return objects

    def _check_inside(self, bounds: Bounds, label: str, x: float, y: float, place: Place) -> None:
        if not (bounds.x_min <= x <= bounds.x_max and bounds.y_min <= y <= bounds.y_max):
            message = f'{label} is at ({x:g}, {y:g}), outside the bounds {_words(bounds)}'
            self._faults.add(message, place)


def _words(bounds: Bounds) -> str:
    return f'[{bounds.x_min:g}, {bounds.y_min:g}, {bounds.x_max:g}, {bounds.y_max:g}]'


def _overlap(a: Bounds, b: Bounds) -> bool:
    beside = a.x_max <= b.x_min or b.x_max <= a.x_min
    return not (beside or a.y_max <= b.y_min or b.y_max <= a.y_min)


def read_world(
    text: str, source: str, directory: str = '', grid: OccupancyMap | None = None
) -> World:
    """The world that ``text`` describes; ``source`` names the file in errors.

    Files that the text names are looked for from ``directory`` on, or where none is given from
    that of ``source``.  ``grid`` is a map to add to a world that names none.
    Raises MotionPlannerError (NO_WORLD) with a diagnostic, line and column for every fault.
    """
    reader = _WorldReader(source, directory or directory_of(source))
    return reader.read(read_tree(text, source), grid)
