"""No car that drives at random gets to where a proof by turning room says that none can."""

from __future__ import annotations

from math import pi, tan, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Scope, Status
from motion_planner_node.errors import Stopped
from motion_planner_node.language import parse
from motion_planner_node.paths.reach import STRIDE, strides, sweeps
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning import confined as proofs
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import read_problem
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, World
from motion_planner_node.world.scene import Scene
from tests.support.random_drives import Drives, Wall, walls_of

CAR = Robot('car', 4.0, 0.5, 1.0, 2.0)
BEND = tan(0.5) / 4.0
SIDE = 40.0
DRIVES = Drives(CAR.radius, BEND, step=0.2, number=80, steps=300, held=(2, 40))
NOWHERE = np.empty((0, 3))

walls = st.lists(
    st.tuples(*[st.floats(0.0, SIDE)] * 2, *[st.floats(0.5, 20.0)] * 2), min_size=2, max_size=7
)
starts = st.builds(
    Attitude, st.floats(1.5, SIDE - 1.5), st.floats(1.5, SIDE - 1.5), st.floats(-pi, pi)
)


def pen(side: float, gap: float = 2.6) -> list[Wall]:
    """list[Wall] round a square in the middle, with a gap in the right one at the top."""
    low, high = 0.5 * (SIDE - side), 0.5 * (SIDE + side)
    return [
        (low - 1.0, low - 1.0, side + 2.0, 1.0),
        (low - 1.0, high, side + 2.0, 1.0),
        (low - 1.0, low, 1.0, side),
        (high, low, 1.0, side - gap),
    ]


def world_of(walls: list[Wall]) -> World:
    bounds = Bounds(0.0, 0.0, SIDE, SIDE)
    return World('', '', bounds, {}, walls_of(walls), {'car': CAR})


def go_on() -> None:
    """Never stop."""


@pytest.fixture(autouse=True, scope='module')
def _proofs_everywhere() -> object:
    """No look ahead decides whether a proof is worth while."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Ground, 'can_turn_round', lambda _, rows, __: np.zeros(len(rows), bool))
        yield


@settings(max_examples=40, deadline=None)
@given(st.one_of(walls, st.builds(pen, st.floats(4.0, 16.0))), starts, st.integers(0, 99))
def test_no_random_drive_leaves_where_a_car_is_confined(
    walls: list[Wall], start: Attitude, seed: int
) -> None:
    world = world_of(walls)
    ground = Ground(Scene(world), CAR)
    if ground.trouble(start):
        return
    view = proofs._view(ground, start)
    reach = proofs._reach(ground, view, np.zeros((1, 3), np.int64), go_on)
    if reach is None:
        return
    for x, y, heading in DRIVES.attitudes(world, [start], seed):
        is_here = (reach.low[:, :2] <= (x, y)).all(axis=1) & (reach.high[:, :2] >= (x, y)).all(
            axis=1
        )
        middle = 0.5 * (reach.low[is_here, 2] + reach.high[is_here, 2])
        half = 0.5 * (reach.high[is_here, 2] - reach.low[is_here, 2])
        assert (np.abs(np.remainder(heading - middle + pi, tau) - pi) <= half).any()


@settings(max_examples=30, deadline=None)
@given(
    st.one_of(walls, st.builds(pen, st.floats(4.0, 16.0))),
    st.lists(starts, min_size=4, max_size=4),
    starts,
    st.integers(0, 99),
)
def test_no_random_drive_gets_to_where_nobody_can(
    walls: list[Wall], beginnings: list[Attitude], goal: Attitude, seed: int
) -> None:
    world = world_of(walls)
    ground = Ground(Scene(world), CAR)
    sides = [
        f'(car.{name} >= {value - near})(car.{name} <= {value + near})'
        for name, value, near in (
            ('x', goal.x, 1.0),
            ('y', goal.y, 1.0),
            ('heading', goal.heading, 0.2),
        )
    ]
    preconditions = parse(f'((agent car){"".join(sides)})')
    impossible = []
    for start in beginnings:
        problem = read_problem(world, preconditions, {'car': start})
        is_blocked = ground.trouble(start)
        if not is_blocked and proofs.unapproachable(problem, ground, NOWHERE, go_on):
            impossible.append(start)
    if impossible:
        passed = DRIVES.attitudes(world, impossible, seed)
        off = np.abs(passed - (goal.x, goal.y, goal.heading)) - (1.0, 1.0, 0.2)
        assert not (off <= -1e-6).all(axis=1).any()


@pytest.mark.parametrize('turned', [-STRIDE, -0.1, 0.0, 0.13, STRIDE])
def test_the_bounds_of_a_stride_hold_for_whatever_is_steered(turned: float) -> None:
    parts = 6
    random = np.random.default_rng(3)
    steps = 600
    for _ in range(200):
        # The heading at the start of a cell's range, and turns that add up to ``turned``.
        heading = random.uniform(-0.5, 0.5) * tau / strides(parts).shape[0]
        knots = np.clip(turned / STRIDE + np.cumsum(random.normal(size=8)), -1.0, 1.0)
        turns = np.repeat(knots, steps // 8) * STRIDE / steps
        turns += (turned - turns.sum()) / steps
        if np.abs(turns).max() > STRIDE / steps:
            continue
        headings = heading + np.cumsum(turns) - 0.5 * turns
        x = np.cumsum(np.cos(headings)) * STRIDE / steps
        y = np.cumsum(np.sin(headings)) * STRIDE / steps
        width = tau / strides(parts).shape[0]
        offset = round((heading + turned) / width) + strides(parts).shape[1] // 2
        ends = np.arange(1, parts + 1) * steps // parts - 1
        low_x, high_x, low_y, high_y = strides(parts)[0, offset].T
        assert (low_x <= x[ends] + 1e-5).all()
        assert (x[ends] <= high_x + 1e-5).all()
        assert (low_y <= y[ends] + 1e-5).all()
        assert (y[ends] <= high_y + 1e-5).all()
        low_x, high_x, low_y, high_y = sweeps(parts)[0].T
        part = np.arange(steps) * parts // steps
        assert ((low_x[part] <= x + 1e-5) & (x <= high_x[part] + 1e-5)).all()
        assert ((low_y[part] <= y + 1e-5) & (y <= high_y[part] + 1e-5)).all()


@pytest.mark.parametrize(('side', 'heading'), [(8.0, pi), (10.0, 1.8), (14.0, pi)])
def test_a_car_in_a_pen_is_told_that_it_cannot_turn(side: float, heading: float) -> None:
    planner = MotionPlanner(world_of(pen(side)))
    start = {'car': Attitude(20.0, 20.0, heading)}
    answer = planner.satisfy(GeometricRequest('((agent car)(car.x >= 36))', start))
    assert (answer.status, answer.code) == (Status.IMPOSSIBLE, Code.UNREACHABLE)
    assert answer.scope is Scope.THIS_START
    assert 'wall' in answer.message


def test_a_place_that_nobody_can_turn_into_is_told() -> None:
    planner = MotionPlanner(world_of([]))
    start = {'car': Attitude(20.0, 20.0, 0.0)}
    answer = planner.satisfy(GeometricRequest('((agent car)(car.x <= 3)(car.heading = 0))', start))
    assert (answer.status, answer.code) == (Status.IMPOSSIBLE, Code.UNREACHABLE)
    assert 'no room to turn into it' in answer.message
    other = GeometricRequest('((agent car)(car.x <= 3)(car.heading = pi))', start)
    assert planner.satisfy(other).status is Status.FOUND


def test_a_proof_is_broken_off() -> None:
    world = world_of(pen(14.0))
    ground = Ground(Scene(world), CAR)
    problem = read_problem(
        world, parse('((agent car)(car.x >= 36))'), {'car': Attitude(20.0, 20.0, pi)}
    )

    def stop() -> None:
        raise Stopped

    with pytest.raises(Stopped):
        proofs.confined(problem, ground, stop)
