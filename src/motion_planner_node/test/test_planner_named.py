"""The planner that a request names, or else the parameter, is the one that looks for paths."""

from __future__ import annotations

from math import hypot

import pytest

from motion_planner_node.codes import Code, Status
from motion_planner_node.parameters import Parameters
from motion_planner_node.paths import PLANNERS
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world

WORLD = read_world(
    """
bounds: [0, 0, 100, 60]
objects: {dock: {x: 75, y: 15}, yard: {x: 25, y: 40}}
obstacles: [{polygon: [[48, 0], [52, 0], [52, 45], [48, 45]]}]
robots: {car: {model: car, wheelbase: 1.5, max_steering_angle: 0.5, radius: 1, speed: 1}}
""",
    'wall.yaml',
)
START = Attitude(25.0, 15.0, 0.0)
#: On the other side of the wall, and on this one.
BEHIND, HERE = (
    f'((agent car)(object {label})(distance(car, {label}) <= 3))' for label in ('dock', 'yard')
)
#: No shorter way leads round the end of the wall.
ROUND = 2.0 * hypot(50.0 - 25.0, 46.0 - 15.0) - 3.0


def ask(planner: MotionPlanner, text: str, name: str) -> GeometricAnswer:
    return planner.satisfy(GeometricRequest(text, {'car': START}, seed=3, planner=name))


@pytest.mark.parametrize('first', ['direct', 'default'])
def test_a_request_is_answered_by_the_planner_that_it_names(first: str) -> None:
    planner = MotionPlanner(WORLD)
    names = [first, *({'direct', 'default'} - {first})] * 2
    answers: dict[str, list[GeometricAnswer]] = {name: [] for name in names}
    for name in names:
        answers[name].append(ask(planner, BEHIND, name))
    for name, (once, again) in answers.items():
        assert once == again == ask(MotionPlanner(WORLD), BEHIND, name)
    blocked, found = answers['direct'][0], answers['default'][0]
    assert (blocked.status, blocked.code) == (Status.UNKNOWN, Code.NO_PATH)
    assert found.status is Status.FOUND
    assert found.length > ROUND


def test_the_parameter_names_the_planner_of_requests_that_name_none() -> None:
    planner = MotionPlanner(WORLD, Parameters(planner='direct'))
    assert ask(planner, BEHIND, '').code is Code.NO_PATH
    assert ask(planner, BEHIND, 'default') == ask(MotionPlanner(WORLD), BEHIND, '')
    assert ask(planner, BEHIND, '').code is Code.NO_PATH
    assert ask(planner, HERE, '').status is Status.FOUND


def test_planners_of_one_motion_planner_find_ways_of_their_own() -> None:
    planner = MotionPlanner(WORLD)
    names = ('default', 'rrt_connect', 'bit_star')
    found = {name: ask(planner, BEHIND, name) for name in names}
    assert {answer.status for answer in found.values()} == {Status.FOUND}
    assert len({answer.motion for answer in found.values()}) == len(names)
    assert ask(planner, BEHIND, '') == found['default']


def test_a_planner_that_does_not_exist_is_refused_with_the_list() -> None:
    answer = ask(MotionPlanner(WORLD), HERE, 'teleport')
    assert (answer.status, answer.code) == (Status.ERROR, Code.UNSUPPORTED)
    assert "'teleport'" in answer.message
    assert all(name in answer.message for name in PLANNERS)
