"""World files: YAML with ``bounds``, ``objects``, ``obstacles``, ``robots``, ``regions``; see docs/world.md."""

from __future__ import annotations

from dataclasses import replace

from motion_planner_node.world.model import Bounds, World, WorldObject
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

    def __init__(self, source: str) -> None:
        self._source = source
        self._faults = Faults(source)

    def read(self, root: Node) -> World:
        parts = read_fields(
            root,
            'the world',
            ('bounds',),
            ('objects', 'obstacles', 'robots', 'regions'),
            self._faults,
        )
        given = {key: node for key, node in parts.items() if not is_nothing(node)}
        bounds = self._bounds(given['bounds']) if 'bounds' in given else None
        objects = self._objects(given['objects'], bounds) if 'objects' in given else {}
        obstacles = read_obstacles(given['obstacles'], self._faults) if 'obstacles' in given else ()
        robots, starts = (
            read_robots(given['robots'], objects, self._faults) if 'robots' in given else ({}, [])
        )
        taken = {*objects, *robots}
        regions = read_regions(given['regions'], taken, self._faults) if 'regions' in given else {}
        if bounds is None:
            if 'bounds' in parts and 'bounds' not in given:
                self._faults.add('bounds are empty', parts['bounds'].place)
            raise self._faults.error()
        world = World(self._source, '', bounds, objects, obstacles, robots, regions)
        if starts:
            check_starts(Scene(world), starts, self._faults)
        if self._faults:
            raise self._faults.error()
        return replace(world, revision=revision_of(world))

    def _bounds(self, node: Node) -> Bounds | None:
        numbers = read_numbers(node, 'bounds', ('x_min', 'y_min', 'x_max', 'y_max'), self._faults)
        if not numbers:
            return None
        bounds = Bounds(*numbers)
        width, height = bounds.x_max - bounds.x_min, bounds.y_max - bounds.y_min
        if min(width, height) < SMALLEST_LENGTH:
            message = f'bounds enclose no area: {width:g} m by {height:g} m'
            self._faults.add(message, node.place)
            return None
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
            message = (
                f'{label} is at ({x:g}, {y:g}), outside the bounds [{bounds.x_min:g}, '
                f'{bounds.y_min:g}, {bounds.x_max:g}, {bounds.y_max:g}]'
            )
            self._faults.add(message, place)


def read_world(text: str, source: str) -> World:
    """The world that ``text`` describes; ``source`` names the file in errors.

    Raises MotionPlannerError (NO_WORLD) with a diagnostic, line and column for every fault.
    """
    return _WorldReader(source).read(read_tree(text, source))
