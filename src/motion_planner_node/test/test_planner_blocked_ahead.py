"""Nothing that is called unreachable from a start is reached by a car that drives at random."""

from __future__ import annotations

from math import hypot, pi, tan

from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Scope, Status
from motion_planner_node.language import parse
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning.blocked_ahead import blocked_ahead
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import read_problem
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, World, WorldObject
from motion_planner_node.world.scene import Scene
from tests.support.random_drives import Drives, Wall, walls_of

CAR = Robot('car', 8.0, 0.5, 1.0, 2.0)
BEND = tan(0.5) / 8.0
SIDE = 60.0
DRIVES = Drives(CAR.radius, BEND, step=0.25, number=60, steps=400, held=(4, 60))

boxes = st.tuples(*[st.floats(0.0, SIDE)] * 2, *[st.floats(1.0, 25.0)] * 2)
starts = st.builds(Attitude, st.floats(2.0, 58.0), st.floats(2.0, 58.0), st.floats(-pi, pi))


def world_of(walls: list[Wall], x: float, y: float) -> World:
    post = {'post': WorldObject('post', {'x': x, 'y': y})}
    return World('', '', Bounds(0.0, 0.0, SIDE, SIDE), post, walls_of(walls), {'car': CAR})


@settings(max_examples=60, deadline=None)
@given(
    st.lists(boxes, max_size=4),
    starts,
    st.floats(0.0, SIDE),
    st.floats(0.0, SIDE),
    st.integers(0, 99),
)
def test_no_random_drive_refutes_the_proof(
    walls: list[Wall], start: Attitude, x: float, y: float, seed: int
) -> None:
    world = world_of(walls, x, y)
    text = '((agent car)(object post)(distance(car, post) <= 6))'
    problem = read_problem(world, parse(text), {'car': start})
    ground = Ground(Scene(world), CAR)
    if ground.trouble(start) or blocked_ahead(problem, ground) is None:
        return
    reached = DRIVES.attitudes(world, [start], seed)
    assert all(hypot(a - x, b - y) > 6.0 for a, b, _ in reached)


def test_a_car_that_faces_a_wall_is_told_so() -> None:
    world = world_of([], 10.0, 30.0)
    text = '((agent car)(object post)(distance(car, post) <= 6))'
    start = {'car': Attitude(52.0, 30.0, 0.2)}
    planner = MotionPlanner(world)
    answer = planner.satisfy(GeometricRequest(text, start))
    assert (answer.status, answer.code) == (Status.IMPOSSIBLE, Code.UNREACHABLE)
    assert answer.scope is Scope.THIS_START
    assert "however it steers, the map's edge stops it within" in answer.message
    assert 'distance(car, post) <= 6' in answer.message
    (advice,) = planner.advise(AdviceRequest((text,), start)).candidates
    assert advice.impossible
    assert (advice.code, advice.scope) == (answer.code, answer.scope)
    assert advice.message == answer.message


def test_what_is_on_the_way_to_the_wall_is_not_called_unreachable() -> None:
    world = world_of([], 56.0, 30.0)
    text = '((agent car)(object post)(distance(car, post) <= 1))'
    start = {'car': Attitude(52.0, 30.0, 0.0)}
    assert MotionPlanner(world).satisfy(GeometricRequest(text, start)).status is Status.FOUND
