"""World files: YAML with ``bounds``, ``objects``, ``obstacles``, ``robots``, ``regions``; see docs/world.md."""

from __future__ import annotations

from dataclasses import replace
from math import pi, tan

from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, World, WorldObject
from motion_planner_node.world.obstacles import read_obstacles, read_regions
from motion_planner_node.world.revision import revision_of
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.syntax import Mapping, Node, Place, read_tree
from motion_planner_node.world.values import (
    SMALLEST_LENGTH,
    Faults,
    check_count,
    check_field,
    check_label,
    is_nothing,
    read_at_least,
    read_fields,
    read_mapping,
    read_number,
    read_numbers,
    read_text,
)

MOST_OBJECTS = 10_000
MOST_ROBOTS = 100
#: Arcs of a larger radius [m] are too straight for exact geometry.
LARGEST_TURNING_RADIUS = 1e5


class _WorldReader:
    """Reads the parts of one world; what is wrong goes to ``faults``."""

    def __init__(self, source: str) -> None:
        self._source = source
        self._faults = Faults(source)
        self._starts: list[tuple[Robot, Place]] = []

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
        robots = self._robots(given['robots'], objects) if 'robots' in given else {}
        taken = {*objects, *robots}
        regions = read_regions(given['regions'], taken, self._faults) if 'regions' in given else {}
        if bounds is None:
            if 'bounds' in parts and 'bounds' not in given:
                self._faults.add('bounds are empty', parts['bounds'].place)
            raise self._faults.error()
        world = World(self._source, '', bounds, objects, obstacles, robots, regions)
        self._check_starts(world)
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

    def _robots(self, node: Node, objects: dict[str, WorldObject]) -> dict[str, Robot]:
        robots: dict[str, Robot] = {}
        if not check_count(node, 'robots', MOST_ROBOTS, self._faults):
            return robots
        for label, (place, value) in read_mapping(node, 'robots', self._faults).items():
            check_label(label, place, 'a robot', self._faults)
            if label in objects:
                self._faults.add(f'{label} is the name of an object, too', place, label)
            robot = self._robot(label, value)
            if robot is not None:
                robots[label] = robot
        return robots

    def _robot(self, label: str, node: Node) -> Robot | None:
        numbers = ('wheelbase', 'max_steering_angle', 'radius', 'speed')
        fields = read_fields(node, label, ('model', *numbers), ('start',), self._faults)
        if 'model' in fields:
            model = read_text(fields['model'], f'{label}: model', self._faults)
            if model not in (None, 'car'):
                message = f'{label}: model {model} is not known; car is'
                self._faults.add(message, fields['model'].place)
        wheelbase = self._field(fields, label, 'wheelbase', SMALLEST_LENGTH)
        angle = self._field(fields, label, 'max_steering_angle', SMALLEST_LENGTH)
        radius = self._field(fields, label, 'radius', 0.0)
        speed = self._field(fields, label, 'speed', SMALLEST_LENGTH)
        start = self._start(fields['start'], label) if 'start' in fields else None
        if angle is not None and angle >= pi / 2:
            message = (
                f'{label}: max_steering_angle has to be less than pi/2 = 1.5708, not {angle:g}'
            )
            self._faults.add(message, fields['max_steering_angle'].place)
            return None
        if wheelbase is None or angle is None or radius is None or speed is None:
            return None
        turning_radius = wheelbase / tan(angle)
        if not SMALLEST_LENGTH <= turning_radius <= LARGEST_TURNING_RADIUS:
            message = (
                f'{label}: wheelbase / tan(max_steering_angle), the turning radius, has to be from '
                f'{SMALLEST_LENGTH:g} to {LARGEST_TURNING_RADIUS:g} m, not {turning_radius:g}'
            )
            self._faults.add(message, node.place)
            return None
        robot = Robot(label, wheelbase, angle, radius, speed, start)
        if start is not None:
            self._starts.append((robot, fields['start'].place))
        return robot

    def _field(self, fields: dict[str, Node], label: str, key: str, least: float) -> float | None:
        if key not in fields:
            return None
        return read_at_least(fields[key], f'{label}: {key}', least, self._faults)

    def _start(self, node: Node, label: str) -> Attitude | None:
        keys = ('x', 'y', 'heading')
        fields = read_fields(node, f'start of {label}', keys, (), self._faults)
        numbers = [
            read_number(fields[key], f'start of {label}: {key}', self._faults)
            for key in keys
            if key in fields
        ]
        if len(numbers) < len(keys) or None in numbers:
            return None
        x, y, heading = (float(number) for number in numbers if number is not None)
        return Attitude(x, y, float(wrap_angle(heading)))

    def _check_starts(self, world: World) -> None:
        if not self._starts:
            return
        scene = Scene(world)
        for robot, place in self._starts:
            if robot.start is None:
                continue
            name, clearance = scene.nearest_obstacle(robot.start.x, robot.start.y)
            attitude = (robot.start.x, robot.start.y, robot.start.heading)
            if not scene.is_free([attitude], robot.body)[0]:
                where = f'({robot.start.x:g}, {robot.start.y:g})'
                message = (
                    f'{robot.label} starts at {where}, {clearance:.3f} m from {name}: '
                    f'less than its radius of {robot.radius:g} m'
                )
                self._faults.add(message, place)


def read_world(text: str, source: str) -> World:
    """The world that ``text`` describes; ``source`` names the file in errors.

    Raises MotionPlannerError (NO_WORLD) with a diagnostic, line and column for every fault.
    """
    return _WorldReader(source).read(read_tree(text, source))
