"""Missions of every model of robots and every kind of footprint, judged by the textbook."""

from __future__ import annotations

import itertools
from math import cos, hypot, sin, tau

import pytest
import shapely
import yaml
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.world import read_world
from tests.support.vehicle import ABILITIES, Vehicle, motion_faults, outline_of

YARD = """
bounds: [0, 0, 80, 60]
objects:
  tree: {x: 70, y: 10}
  gate: {x: 70, y: 50}
  shed: {x: 10, y: 50}
obstacles:
  - {name: wall, polygon: [[30, 0], [32, 0], [32, 35], [30, 35]]}
  - {name: house, polygon: [[45, 25], [55, 25], [55, 60], [45, 60]]}
  - {name: pond, circle: {center: [42, 15], radius: 4}}
  - {name: nook, polygon: [[60, 30], [75, 30], [75, 32], [62, 32], [62, 40], [60, 40]]}
robots:
"""
COMMANDS = {
    'car': 'wheelbase: 2, max_steering_angle: 0.5',
    'reverse_car': 'wheelbase: 2, max_steering_angle: 0.5',
    'differential': 'turning_speed: 1',
    'omnidirectional': 'turning_speed: 1',
}
SHAPES = {
    'disc': 'radius: 1.5',
    'box': 'footprint: [[-1, -0.8], [3, -0.8], [3, 0.8], [-1, 0.8]], safety_margin: 0.3',
    'arrow': ('footprint: [[-1, -1], [0, -0.3], [2.5, -1], [3, 0], [2.5, 1], [0, 0.3], [-1, 1]]'),
}
WANTED = (
    '((agent {robot})(object {place})(distance({robot}, {place}) >= 3)'
    '(distance({robot}, {place}) <= 6)(rel_angle({robot}, {place}) = cos-and-sin(pi/2)))'
)
START = Attitude(10.0, 10.0, 1.0)


def robot_line(label: str, model: str, shape: str) -> str:
    return f'  {label}: {{model: {model}, {COMMANDS[model]}, {SHAPES[shape]}, speed: 2}}\n'


class Yard:
    """The yard, or another world, with some robots, a planner in it, and who judges its motions."""

    def __init__(self, *robots: str, world: str = YARD) -> None:
        text = world + ''.join(robots)
        raw = yaml.safe_load(text)
        self.planner = MotionPlanner(read_world(text, 'yard.yaml'))
        self._robots = raw['robots']
        self._obstacles = {entry['name']: outline_of(entry) for entry in raw['obstacles']}
        self._bounds = shapely.box(*raw['bounds'])

    def faults(self, answer: GeometricAnswer) -> list[str]:
        assert answer.motion is not None, answer.message
        start, end = answer.motion.start, answer.end[answer.agent]
        segments = [
            [s.steering_angle, s.length, s.direction, s.turn] for s in answer.motion.segments
        ]
        faults = motion_faults(
            Vehicle(self._robots[answer.agent]),
            (start.x, start.y, start.heading),
            segments,
            (end.x, end.y, end.heading),
            self._obstacles,
            self._bounds,
        )
        return list(faults)


def star(radii: list[float], turn: float, x: float = 0.0, y: float = 0.0) -> list[list[float]]:
    """Corners all round a point, at these distances: a simple polygon, seldom convex."""
    angles = [turn + tau * number / len(radii) for number in range(len(radii))]
    return [
        [round(x + radius * cos(angle), 3), round(y + radius * sin(angle), 3)]
        for radius, angle in zip(radii, angles, strict=True)
    ]


def stars(least: float, most: float) -> st.SearchStrategy[tuple[list[float], float]]:
    """Distances and turns of stars."""
    return st.tuples(
        st.lists(st.floats(least, most), min_size=4, max_size=8), st.floats(0.0, tau / 4)
    )


places = st.tuples(st.floats(3.0, 57.0), st.floats(3.0, 37.0))
obstacles = st.lists(st.tuples(places, stars(1.0, 8.0)), min_size=2, max_size=5)
attitudes = st.tuples(places, st.floats(-3.1, 3.1))
planners = st.sampled_from(['default', 'rrt_connect', 'cell_rrt'])


@pytest.mark.parametrize('model', COMMANDS)
@settings(max_examples=6, deadline=None)
@given(stars(0.4, 2.5), st.sampled_from([0, 0.3]), obstacles, attitudes, places, planners)
def test_motions_among_random_polygons_are_faultless(
    model: str,
    footprint: tuple[list[float], float],
    margin: float,
    around: list[tuple[tuple[float, float], tuple[list[float], float]]],
    start: tuple[tuple[float, float], float],
    goal: tuple[float, float],
    planner: str,
) -> None:
    """Whatever its outline, a robot gets through what is in its way, by its own commands alone."""
    document = {
        'bounds': [0, 0, 60, 40],
        'objects': {'goal': dict(zip('xy', goal, strict=True))},
        'obstacles': [
            {'name': f'star{number}', 'polygon': star(*shape, *place)}
            for number, (place, shape) in enumerate(around)
        ],
    }
    shape = f'footprint: {star(*footprint)}, safety_margin: {margin}'
    robot = f'  r: {{model: {model}, {COMMANDS[model]}, {shape}, speed: 2}}\n'
    yard = Yard(robot, world=yaml.safe_dump(document) + 'robots:\n')
    (x, y), heading = start
    request = GeometricRequest(
        '((agent r)(object goal)(distance(r, goal) <= 4))',
        {'r': Attitude(x, y, heading)},
        planner=planner,
        seed=len(around),
    )
    answer = yard.planner.satisfy(request)
    assume(answer.motion is not None)
    assert yard.faults(answer) == []
    end = answer.end['r']
    assert hypot(end.x - goal[0], end.y - goal[1]) <= 4.0 + 1e-6
    assert answer.clearance >= margin - 1e-6


def test_every_model_is_known_to_the_textbook() -> None:
    assert set(ABILITIES) == set(COMMANDS) == set(MODELS)


@pytest.mark.parametrize(('model', 'shape'), itertools.product(COMMANDS, SHAPES))
def test_a_mission_is_driven_without_a_fault(model: str, shape: str) -> None:
    yard = Yard(robot_line('r', model, shape))
    robot = yard.planner.world.robots['r']
    state, before = {'r': START}, START
    for place in ('tree', 'gate', 'shed'):
        request = GeometricRequest(WANTED.format(robot='r', place=place), state)
        answer = yard.planner.satisfy(request)
        assert answer.motion is not None, answer.message
        assert answer.motion.start == before
        assert yard.faults(answer) == []
        assert answer.duration == robot.duration(answer.motion) >= answer.length / 2.0
        assert answer.clearance >= robot.safety_margin - 1e-6
        state, before = dict(answer.end), answer.end['r']


@pytest.mark.parametrize('model', ['differential', 'omnidirectional'])
def test_a_robot_that_only_has_to_turn_turns_on_the_spot(model: str) -> None:
    yard = Yard(robot_line('r', model, 'box'))
    here = '(r.x = 10)(r.y = 10)'
    answer = yard.planner.satisfy(
        GeometricRequest(f'((agent r){here}(r.heading = -2))', {'r': START})
    )
    assert yard.faults(answer) == []
    assert answer.length <= 1e-6
    assert answer.duration == pytest.approx(3.0, abs=1e-5)


def test_robots_of_different_models_move_in_one_world_as_each_does_alone() -> None:
    fleet = {'a': ('car', 'disc'), 'b': ('differential', 'box'), 'c': ('omnidirectional', 'arrow')}
    together = Yard(*(robot_line(label, *kind) for label, kind in fleet.items()))
    for label, kind in fleet.items():
        request = GeometricRequest(WANTED.format(robot=label, place='gate'), {label: START})
        answer = together.planner.satisfy(request)
        assert together.faults(answer) == []
        alone = Yard(robot_line(label, *kind)).planner.satisfy(request)
        assert (alone.motion, alone.end) == (answer.motion, answer.end)
        assert together.planner.satisfy(request).motion == answer.motion
