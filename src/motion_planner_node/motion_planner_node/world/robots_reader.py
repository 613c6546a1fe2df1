"""The robots of a world file; see docs/robots.md."""

from __future__ import annotations

from collections.abc import Container, Iterable
from math import hypot, pi, tan

from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.robots.body import Corners, distance_from_edge
from motion_planner_node.robots.model import Model
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.outlines import read_polygon
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.syntax import Mapping, Node, Place
from motion_planner_node.world.values import (
    SMALLEST_LENGTH,
    Faults,
    check_count,
    check_label,
    read_at_least,
    read_fields,
    read_mapping,
    read_number,
    read_text,
)

MOST_ROBOTS = 100
#: Corners of a footprint: every one of them is traced along every motion.
MOST_FOOTPRINT_CORNERS = 32
#: Arcs of a larger radius [m] are too straight for exact geometry.
LARGEST_TURNING_RADIUS = 1e5

#: Robots, each with the place where its start is written.
Starts = list[tuple[Robot, Place]]

_STEERING_KEYS = ('wheelbase', 'max_steering_angle')
_TURNING_KEYS = ('turning_speed',)
_OTHER_KEYS = ('radius', 'footprint', 'safety_margin', 'start')


def read_robots(
    node: Node, objects: Container[str], faults: Faults
) -> tuple[dict[str, Robot], Starts]:
    """The robots by label, none of which is that of an object, and those with a start."""
    robots: dict[str, Robot] = {}
    starts: Starts = []
    if not check_count(node, 'robots', MOST_ROBOTS, faults):
        return robots, starts
    for label, (place, value) in read_mapping(node, 'robots', faults).items():
        check_label(label, place, 'a robot', faults)
        if label in objects:
            faults.add(f'{label} is the name of an object, too', place, label)
        robot = _RobotReader(label, faults).read(value)
        if robot is None:
            continue
        robots[label] = robot
        if robot.start is not None and isinstance(value, Mapping):
            place = next(item.place for key, item in value.entries if key.text == 'start')
            starts.append((robot, place))
    return robots, starts


def check_starts(scene: Scene, starts: Starts, faults: Faults) -> None:
    """Note the robots that start in an obstacle or outside the map."""
    for robot, place in starts:
        start = robot.start
        if start is None or scene.is_free([[start.x, start.y, start.heading]], robot.body)[0]:
            continue
        name, clearance = scene.nearest_obstacle(start.x, start.y)
        where = f'{robot.label} starts at ({start.x:g}, {start.y:g}), {clearance:.3f} m from {name}'
        faults.add(f'{where}: {robot.lack}', place)


class _RobotReader:
    """Reads one robot; what is wrong goes to ``faults``."""

    def __init__(self, label: str, faults: Faults) -> None:
        self._label = label
        self._faults = faults
        self._fields: dict[str, Node] = {}

    def read(self, node: Node) -> Robot | None:
        model = self._model(node)
        if model is None:
            return None
        needed = (
            'model',
            'speed',
            *(_STEERING_KEYS if model.steers else ()),
            *(_TURNING_KEYS if model.turns else ()),
        )
        what = f'{self._label}, a robot of model {model.name},'
        self._fields = read_fields(node, what, needed, _OTHER_KEYS, self._faults)
        wheelbase = self._number('wheelbase', SMALLEST_LENGTH)
        angle = self._number('max_steering_angle', SMALLEST_LENGTH)
        margin = self._number('safety_margin', 0.0) if 'safety_margin' in self._fields else 0.0
        speed = self._number('speed', SMALLEST_LENGTH)
        turning_speed = self._number('turning_speed', SMALLEST_LENGTH)
        footprint, radius = self._body(node)
        start = self._start(self._fields['start']) if 'start' in self._fields else None
        if model.steers and not self._can_steer(wheelbase, angle, node):
            return None
        if radius is None or margin is None or speed is None:
            return None
        if model.turns and turning_speed is None:
            return None
        return Robot(
            self._label,
            wheelbase or 0.0,
            angle or 0.0,
            radius,
            speed,
            start,
            model.name,
            footprint,
            margin,
            turning_speed or 0.0,
        )

    def _model(self, node: Node) -> Model | None:
        """The model; where it is missing or unknown, the other keys are not looked at."""
        entries = read_mapping(node, self._label, Faults(''))
        if 'model' not in entries:
            read_fields(
                node,
                self._label,
                ('model',),
                ('speed', *_STEERING_KEYS, *_TURNING_KEYS, *_OTHER_KEYS),
                self._faults,
            )
            return None
        value = entries['model'][1]
        name = read_text(value, f'{self._label}: model', self._faults)
        if name is not None and name not in MODELS:
            known = ', '.join(MODELS)
            message = f'{self._label}: model {name} is not known; there are {known}'
            self._faults.add(message, value.place)
        return MODELS.get(name or '')

    def _number(self, key: str, least: float) -> float | None:
        if key not in self._fields:
            return None
        return read_at_least(self._fields[key], f'{self._label}: {key}', least, self._faults)

    def _can_steer(self, wheelbase: float | None, angle: float | None, node: Node) -> bool:
        """Whether both are there and make a turning radius that can be computed with."""
        if angle is not None and angle >= pi / 2:
            message = (
                f'{self._label}: max_steering_angle has to be less than pi/2 = 1.5708, '
                f'not {angle:g}'
            )
            self._faults.add(message, self._fields['max_steering_angle'].place)
            return False
        if wheelbase is None or angle is None:
            return False
        turning_radius = wheelbase / tan(angle)
        if SMALLEST_LENGTH <= turning_radius <= LARGEST_TURNING_RADIUS:
            return True
        message = (
            f'{self._label}: wheelbase / tan(max_steering_angle), the turning radius, has to be '
            f'from {SMALLEST_LENGTH:g} to {LARGEST_TURNING_RADIUS:g} m, not {turning_radius:g}'
        )
        self._faults.add(message, node.place)
        return False

    def _body(self, node: Node) -> tuple[Corners, float | None]:
        """The corners of the footprint, none for a disc, and the radius of the disc round all."""
        if ('radius' in self._fields) == ('footprint' in self._fields):
            message = f'{self._label} needs either radius, of a disc, or footprint, a polygon'
            self._faults.add(message, node.place)
            return (), None
        if 'radius' in self._fields:
            return (), self._number('radius', 0.0)
        outline = self._fields['footprint']
        name = f'{self._label}: footprint'
        polygon = read_polygon(outline, name, self._faults, MOST_FOOTPRINT_CORNERS)
        if polygon is None:
            return (), None
        corners = polygon.corners
        if not _holds_reference_point(corners):
            message = f'{name}: the reference point (0, 0) of the robot is outside of it'
            self._faults.add(message, outline.place)
            return (), None
        return corners, max(hypot(x, y) for x, y in corners)

    def _start(self, node: Node) -> Attitude | None:
        keys = ('x', 'y', 'heading')
        what = f'start of {self._label}'
        fields = read_fields(node, what, keys, (), self._faults)
        numbers = [
            read_number(fields[key], f'{what}: {key}', self._faults)
            for key in keys
            if key in fields
        ]
        if len(numbers) < len(keys) or None in numbers:
            return None
        x, y, heading = (float(number) for number in numbers if number is not None)
        return Attitude(x, y, float(wrap_angle(heading)))


def _edges(corners: Corners) -> Iterable[tuple[float, float, float, float]]:
    following = corners[1:] + corners[:1]
    return ((*a, *b) for a, b in zip(corners, following, strict=True))


def _holds_reference_point(corners: Corners) -> bool:
    """Whether (0, 0) is inside the polygon or on its outline."""
    if min(distance_from_edge(*edge) for edge in _edges(corners)) == 0.0:
        return True
    crossed = (
        (y0 > 0.0) != (y1 > 0.0) and x0 - y0 * (x1 - x0) / (y1 - y0) > 0.0
        for x0, y0, x1, y1 in _edges(corners)
    )
    return sum(crossed) % 2 == 1
