"""Paths against a checker that shares nothing with the planner but the car's equations."""

from __future__ import annotations

import os
import subprocess
import sys
from itertools import pairwise
from math import cos, hypot, pi, remainder, sin, sqrt, tan, tau
from pathlib import Path

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from motion_planner_node.errors import Stopped
from motion_planner_node.paths import PathBudget, PathOutcome, PathResult, plan_path
from motion_planner_node.planner import warm_up
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world import Scene, read_world
from motion_planner_node.world.model import Bounds, Circle, Obstacle, Polygon, World

PACKAGE = Path(__file__).parents[1]
ROVER = PACKAGE.parent / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
CAR = Robot('rover0', wheelbase=8.0, max_steering_angle=0.5, radius=5.0, speed=2.0)
SPACING = 0.05


def go_on() -> bool:
    return False


@pytest.fixture(scope='module')
def rover() -> Scene:
    warm_up()
    return Scene(read_world(ROVER.read_text(), 'world.yaml'))


def scene_of(*obstacles: Obstacle) -> Scene:
    return Scene(World('', '', Bounds(0, 0, 800, 600), {}, obstacles, {'rover0': CAR}))


def drive(motion: Motion, car: Robot) -> tuple[NDArray[np.float64], Attitude]:
    """Points (n, 2) on the motion, circles drawn from their centres, and where it ends."""
    x, y, heading = motion.start.x, motion.start.y, motion.start.heading
    points = [(x, y)]
    for segment in motion.segments:
        steps = np.linspace(0.0, segment.length, max(2, int(segment.length / SPACING)))
        if segment.steering_angle == 0.0:
            xs, ys = x + steps * cos(heading), y + steps * sin(heading)
            end = heading
        else:
            radius = car.wheelbase / tan(segment.steering_angle)
            headings = heading + steps / radius
            xs = x + radius * (np.sin(headings) - sin(heading))
            ys = y - radius * (np.cos(headings) - cos(heading))
            end = float(headings[-1])
        points += list(zip(xs, ys, strict=True))
        x, y, heading = float(xs[-1]), float(ys[-1]), end
    return np.array(points), Attitude(x, y, heading)


def check(scene: Scene, car: Robot, motion: Motion, goal: Attitude) -> None:
    assert motion.agent == car.label
    angles = [segment.steering_angle for segment in motion.segments]
    assert set(angles) <= {-car.max_steering_angle, 0.0, car.max_steering_angle}
    assert all(a != b for a, b in pairwise(angles))
    assert all(segment.length > 0.0 for segment in motion.segments)
    points, end = drive(motion, car)
    assert hypot(end.x - goal.x, end.y - goal.y) < 1e-8
    assert abs(remainder(end.heading - goal.heading, tau)) < 1e-9
    bounds = scene.world.bounds
    inner = shapely.box(bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max).exterior
    spots = shapely.points(points)
    assert shapely.distance(inner, spots).min() >= car.radius - 1e-7
    for obstacle in scene.world.obstacles:
        if isinstance(obstacle, Polygon):
            assert shapely.distance(shapely.Polygon(obstacle.corners), spots).min() >= (
                car.radius - 1e-7
            )
        else:
            away = np.hypot(*(points - obstacle.center).T) - obstacle.radius
            assert away.min() >= car.radius - 1e-7


def random_free(scene: Scene, rng: np.random.Generator) -> Attitude:
    bounds = scene.world.bounds
    while True:
        low, high = [bounds.x_min, bounds.y_min, -pi], [bounds.x_max, bounds.y_max, pi]
        row = rng.uniform(low, high)
        if scene.is_free([row], CAR.body)[0]:
            return Attitude(*(float(value) for value in row))


def test_no_motion_ever_collides(rover: Scene) -> None:
    rng = np.random.default_rng(11)
    found = 0
    for seed in range(120):
        start, goal = random_free(rover, rng), random_free(rover, rng)
        result = plan_path(rover, CAR, start, [goal], seed, go_on)
        if result.motion is not None:
            found += 1
            assert result.outcome is PathOutcome.FOUND
            assert result.motion.start == start
            assert result.goal_index == 0
            check(rover, CAR, result.motion, goal)
        else:
            assert result.outcome is PathOutcome.NO_PATH
            assert result.reason
    assert found >= 90


def test_narrow_mazes_are_driven_without_touching() -> None:
    rng = np.random.default_rng(12)
    found = 0
    for seed in range(12):
        discs = [
            Circle(f'disc{i}', (float(x), float(y)), 14.0)
            for i, (x, y) in enumerate(rng.uniform([60, 60], [740, 540], (60, 2)))
        ]
        scene = scene_of(*discs)
        goal = Attitude(770.0, 570.0, 0.3)
        result = plan_path(scene, CAR, Attitude(20.0, 20.0, 0.7), [goal], seed, go_on)
        if result.motion is not None:
            found += 1
            check(scene, CAR, result.motion, goal)
    assert found >= 6


def test_in_the_open_the_motion_is_the_shortest_there_is() -> None:
    start, goal = Attitude(100, 100, 0.0), Attitude(400, 100, 0.0)
    motion = plan_path(scene_of(), CAR, start, [goal], 1, go_on).motion
    assert motion is not None
    assert [(s.steering_angle, s.length) for s in motion.segments] == [(0.0, 300.0)]


def test_a_detour_is_little_longer_than_a_taut_string() -> None:
    wall = Polygon('wall', ((400, 0), (410, 0), (410, 400), (400, 400)))
    start, goal = Attitude(300, 100, 1.2), Attitude(500, 100, -1.2)
    motion = plan_path(scene_of(wall), CAR, start, [goal], 1, go_on).motion
    assert motion is not None
    taut = 2 * sqrt(100**2 + 300**2 - 5**2) + 10
    assert taut <= motion.length <= 1.03 * taut


def test_the_nearest_of_several_goals_is_driven_to(rover: Scene) -> None:
    start = Attitude(20.0, 20.0, 0.0)
    far, near = Attitude(700, 560, 0.0), Attitude(60, 40, 0.5)
    blocked = Attitude(280, 350, 0.0)
    result = plan_path(rover, CAR, start, [blocked, far, near], 1, go_on)
    assert result.goal_index == 2
    assert result.motion is not None
    check(rover, CAR, result.motion, near)


@pytest.mark.parametrize(
    ('start', 'goal', 'outcome', 'words'),
    [
        (Attitude(403, 50, 0), Attitude(20, 20, 0), PathOutcome.START_IN_OBSTACLE, '-3.000 m from'),
        (Attitude(20, 20, 0), Attitude(413, 50, 0), PathOutcome.GOAL_IN_OBSTACLE, '3.000 m from'),
        (Attitude(20, 20, 0), Attitude(2, 50, 0), PathOutcome.GOAL_IN_OBSTACLE, "the map's edge"),
        (Attitude(20, 20, 0), Attitude(600, 50, 0), PathOutcome.UNREACHABLE, 'walled off'),
        (Attitude(7, 300, pi), Attitude(200, 300, 0), PathOutcome.NO_PATH, 'all that there are'),
    ],
)
def test_failures_are_told_apart(
    start: Attitude, goal: Attitude, outcome: PathOutcome, words: str
) -> None:
    wall = Polygon('wall', ((400, 0), (410, 0), (410, 600), (400, 600)))
    result = plan_path(scene_of(wall), CAR, start, [goal], 1, go_on)
    assert result.outcome is outcome
    assert result.motion is None
    assert result.goal_index == -1
    assert words in result.reason
    assert plan_path(scene_of(wall), CAR, start, [], 1, go_on).motion is None


def test_a_start_that_touches_a_wall_can_be_left() -> None:
    wall = Polygon('wall', ((400, 0), (410, 0), (410, 300), (400, 300)))
    start, goal = Attitude(395, 100, pi / 2), Attitude(700, 100, 0)
    result = plan_path(scene_of(wall), CAR, start, [goal], 1, go_on)
    assert result.motion is not None
    check(scene_of(wall), CAR, result.motion, goal)


def test_facing_west_exactly_is_as_good_as_any_heading() -> None:
    wall = Polygon('wall', ((400, 0), (410, 0), (410, 300), (400, 300)))
    for west in (pi, -pi, 3 * pi):
        start, goal = Attitude(700, 100, west), Attitude(100, 100, west)
        result = plan_path(scene_of(wall), CAR, start, [goal], 1, go_on)
        assert result.motion is not None
        check(scene_of(wall), CAR, result.motion, goal)


def test_it_stops_when_told() -> None:
    asked = 0

    def after_a_while() -> bool:
        nonlocal asked
        asked += 1
        return asked > 20

    facing_the_edge = Attitude(7, 300, pi)
    with pytest.raises(Stopped):
        plan_path(
            scene_of(),
            CAR,
            facing_the_edge,
            [Attitude(9, 20, 0)],
            1,
            after_a_while,
            planner='rrt_connect',
        )
    assert asked == 21


def test_an_error_in_should_stop_comes_out() -> None:
    asked = 0

    def broken() -> bool:
        nonlocal asked
        asked += 1
        if asked > 5:
            raise KeyError('broken')
        return False

    with pytest.raises(KeyError, match='broken'):
        plan_path(
            scene_of(),
            CAR,
            Attitude(7, 300, pi),
            [Attitude(9, 20, 0)],
            1,
            broken,
            planner='rrt_connect',
        )


def test_iterations_bound_the_search() -> None:
    asked = 0

    def count() -> bool:
        nonlocal asked
        asked += 1
        return False

    goal = Attitude(200, 300, 0)
    budget = PathBudget(iterations=50)
    plan_path(
        scene_of(),
        CAR,
        Attitude(7, 300, pi),
        [goal],
        1,
        count,
        budget,
        planner='rrt_connect',
    )
    assert 40 <= asked <= 60


TASK = (Attitude(20.0, 20.0, 0.0), Attitude(600.0, 420.0, 2.0))

SCRIPT = """
import sys
sys.path.insert(0, sys.argv[1])
from pathlib import Path
from motion_planner_node.paths import plan_path
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import Scene, read_world
scene = Scene(read_world(Path(sys.argv[2]).read_text(), ''))
car = scene.world.robots['rover0']
start, goal = Attitude(20.0, 20.0, 0.0), Attitude(600.0, 420.0, 2.0)
for seed in range(int(sys.argv[3]), 4):
    result = plan_path(scene, car, start, [goal], seed, lambda: False)
print(result)
"""


def test_the_same_question_has_the_same_answer_everywhere(rover: Scene) -> None:
    """In this process, in fresh ones, and whatever was asked before."""
    car = rover.world.robots['rover0']
    answers = {repr(plan_path(rover, car, TASK[0], [TASK[1]], 3, go_on))}
    plan_path(rover, car, Attitude(400, 350, pi), [Attitude(20, 300, 1.0)], 9, go_on)
    answers.add(repr(plan_path(rover, car, TASK[0], [TASK[1]], 3, go_on)))
    for first_seed in ('3', '1'):
        command = [sys.executable, '-c', SCRIPT, str(PACKAGE), str(ROVER), first_seed]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        answers.add(done.stdout.strip())
    assert len(answers) == 1
    (answer,) = answers
    assert 'FOUND' in answer
    other = plan_path(rover, car, TASK[0], [TASK[1]], 4, go_on)
    assert isinstance(other, PathResult)


def test_it_runs_where_no_cache_can_be_written(tmp_path: Path) -> None:
    """The caches of package and user are shut by a plain file in place of each directory."""
    copy = tmp_path / 'motion_planner_node'
    source = PACKAGE / 'motion_planner_node'
    for path in source.rglob('*.py'):
        target = copy / path.relative_to(source)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(path.read_bytes())
    (copy / '__pycache__').write_text('')
    (tmp_path / 'file').write_text('')
    script = (
        'import sys; sys.path.insert(0, sys.argv[1])\n'
        'from motion_planner_node.robots import arcs, kernel\n'
        'print(arcs.wrap_angle(7.0), kernel.__file__.startswith(sys.argv[1]))\n'
    )
    environment = {**os.environ, 'XDG_CACHE_HOME': str(tmp_path / 'file')}
    environment.pop('NUMBA_CACHE_DIR', None)
    environment['PYTHONDONTWRITEBYTECODE'] = '1'
    done = subprocess.run(
        [sys.executable, '-c', script, str(tmp_path)],
        capture_output=True,
        text=True,
        check=True,
        env=environment,
    )
    value, own = done.stdout.split()
    assert float(value) == pytest.approx(7.0 - 2.0 * pi)
    assert own == 'True'
