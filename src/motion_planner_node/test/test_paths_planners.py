"""Every planner and every robot against shapely and the textbook's equations of motion."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from math import cos, hypot, inf, pi, remainder, sin, tan, tau

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.paths import (
    PLANNERS,
    PathBudget,
    PathOutcome,
    lattice_end,
    plan_path,
    portfolio,
)
from motion_planner_node.paths import planner as planning
from motion_planner_node.paths.finishing import motion_along
from motion_planner_node.paths.improving import refined, simplified
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world import Scene
from motion_planner_node.world.model import Bounds, Circle, Obstacle, Polygon, World

CAR = Robot('car', 2.0, 0.5, 1.0, 1.0)
BOX = ((1.6, 0.8), (-1.2, 0.8), (-1.2, -0.8), (1.6, -0.8))
ROBOTS = (
    CAR,
    Robot('van', 2.0, 0.5, 2.0, 1.0, footprint=BOX, safety_margin=0.2),
    Robot('fork', 2.0, 0.5, 1.0, 1.0, kind='reverse_car'),
    Robot('tank', 0.0, 0.0, 2.0, 1.0, kind='differential', footprint=BOX, turning_speed=1.0),
    Robot('hover', 0.0, 0.0, 2.0, 1.0, kind='omnidirectional', footprint=BOX, turning_speed=1.0),
)
WALL = Polygon('wall', ((29, 0), (31, 0), (31, 34), (29, 34)))
TREES = tuple(
    Circle(f'tree{k}', (12.0 + 9 * (k % 5), 12.0 + 12 * (k // 5)), 2.0) for k in range(15)
)
WORLDS: dict[str, tuple[Obstacle, ...]] = {'wall': (WALL,), 'trees': TREES}
START, GOALS = Attitude(5.0, 5.0, 0.4), (Attitude(54.0, 44.0, pi), Attitude(54.0, 6.0, 0.0))
BUDGET = PathBudget(iterations=600)


def scene_of(*obstacles: Obstacle) -> Scene:
    robots = {robot.label: robot for robot in ROBOTS}
    return Scene(World('', '', Bounds(0, 0, 60, 50), {}, obstacles, robots))


def never() -> bool:
    return False


def poses_of(motion: Motion, robot: Robot) -> NDArray[np.float64]:
    """Poses (n, 3) by the equations of motion, in small steps by the midpoint rule."""
    poses = [(motion.start.x, motion.start.y, motion.start.heading)]
    for segment in motion.segments:
        assert segment.steering_angle in (0.0, robot.max_steering_angle, -robot.max_steering_angle)
        bend = tan(segment.steering_angle) / robot.wheelbase if segment.steering_angle else 0.0
        steps = max(2, int(max(abs(segment.length) / 0.02, abs(segment.turn) / 0.01)))
        length, turn = segment.length / steps, segment.turn / steps + bend * segment.length / steps
        for _ in range(steps):
            x, y, heading = poses[-1]
            course = heading + 0.5 * turn + segment.direction
            poses.append((x + length * cos(course), y + length * sin(course), heading + turn))
    return np.array(poses)


def faults(scene: Scene, robot: Robot, motion: Motion, goal: Attitude | None) -> list[str]:
    """What is wrong with ``motion``, by shapely."""
    poses = poses_of(motion, robot)
    found = []
    x, y, heading = poses[-1]
    if goal and hypot(x - goal.x, y - goal.y) > 1e-2:
        found.append(f'ends at ({x}, {y})')
    if goal and abs(remainder(heading - goal.heading, tau)) > 1e-3:
        found.append(f'ends with heading {heading}')
    bounds = scene.world.bounds
    edge = shapely.box(bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max).exterior
    solids = [
        shapely.Polygon(item.corners)
        if isinstance(item, Polygon)
        else shapely.Point(item.center).buffer(item.radius, 256)
        for item in scene.world.obstacles
    ]
    for x, y, heading in poses[::5]:
        c, s = cos(heading), sin(heading)
        corners = [(x + c * a - s * b, y + s * a + c * b) for a, b in robot.footprint]
        body = shapely.Polygon(corners) if corners else shapely.Point(x, y)
        needed = robot.safety_margin + (0.0 if corners else robot.radius)
        if any(body.distance(solid) < needed - 1e-3 for solid in (*solids, edge)):
            found.append(f'too close at ({x}, {y}, {heading})')
    return found


@pytest.mark.parametrize('world', WORLDS)
@pytest.mark.parametrize('planner', PLANNERS)
def test_every_planner_is_right_twice(planner: str, world: str) -> None:
    scene = scene_of(*WORLDS[world])
    budget = BUDGET if planner in {'rrt_star', 'prm_star'} else PathBudget()
    results = [plan_path(scene, CAR, START, GOALS, 7, never, budget, planner) for _ in range(2)]
    assert results[0] == results[1]
    motion = results[0].motion
    if motion is None:
        assert planner == 'direct'
        assert results[0].outcome is PathOutcome.NO_PATH
        assert (
            results[0].reason
            == 'no path found: none of the shortest motions to 2 destinations is free'
        )
    else:
        assert faults(scene, CAR, motion, GOALS[results[0].goal_index]) == []


@pytest.mark.parametrize('robot', ROBOTS, ids=lambda robot: robot.label)
@pytest.mark.parametrize('planner', ['default', 'rrt_connect', 'cell_rrt'])
def test_every_robot_gets_round_a_wall(robot: Robot, planner: str) -> None:
    scene = scene_of(WALL)
    result = plan_path(scene, robot, START, [GOALS[1]], 3, never, planner=planner)
    assert result.motion is not None, result.reason
    assert faults(scene, robot, result.motion, GOALS[1]) == []
    taut = 2.0 * hypot(24.0, 29.0)
    assert result.motion.length < (1.4 * taut if planner == 'default' else 3.0 * taut)


def test_unknown_names_are_refused_with_the_list() -> None:
    with pytest.raises(MotionPlannerError, match='bit_star, prm_star, cell_rrt'):
        plan_path(scene_of(), CAR, START, GOALS, 1, never, planner='teleport')


def test_a_simplifier_that_breaks_paths_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    def through_the_wall(query: Query, path: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([path[0], (30.0, 20.0, 0.0), path[-1]])

    scene = scene_of(WALL)
    honest = plan_path(scene, CAR, START, [GOALS[1]], 1, never)
    assert honest.motion is not None
    monkeypatch.setattr(planning, 'simplified', through_the_wall)
    monkeypatch.setattr(planning, 'refined', through_the_wall)
    result = plan_path(scene, CAR, START, [GOALS[1]], 1, never)
    assert result.motion is not None
    assert faults(scene, CAR, result.motion, GOALS[1]) == []
    assert result.motion.length > honest.motion.length


def test_a_path_that_is_not_free_is_left_to_the_exact_check() -> None:
    rows = np.array([[goal.x, goal.y, goal.heading] for goal in (START, GOALS[1])])
    query = Query(
        scene_of(WALL), CAR, START, rows[1:], (1,), PathBudget(), never, lambda near: near
    )
    assert motion_along(query, rows) is None
    assert np.array_equal(simplified(query, rows), rows)
    assert np.array_equal(refined(query, rows), rows)


def test_a_region_gives_better_ends() -> None:
    """All attitudes beyond the wall that look east are wanted; only far ones are named."""
    far = Attitude(55.0, 45.0, 0.0)

    def region(rows: NDArray[np.float64]) -> NDArray[np.float64]:
        near = rows.copy()
        near[:, 0], near[:, 2] = np.maximum(near[:, 0], 33.0), 0.0
        return near[scene.is_free(near, CAR.body)]

    scene = scene_of(WALL)
    plain = plan_path(scene, CAR, START, [far], 1, never).motion
    better = plan_path(scene, CAR, START, [far], 1, never, region=region)
    assert plain is not None
    assert better.motion is not None
    assert better.goal_index == -1
    assert faults(scene, CAR, better.motion, None) == []
    assert better.motion.length < 0.85 * plain.length


class Polls:
    """Counts how often a search asks whether to stop, and says so from the ``most``-th time on."""

    def __init__(self, most: float = inf) -> None:
        self.count = 0
        self._most = most

    def __call__(self) -> bool:
        self.count += 1
        return self.count >= self._most


@pytest.mark.parametrize('planner', [name for name in PLANNERS if name != 'direct'])
def test_every_planner_can_be_stopped_at_every_poll(planner: str) -> None:
    """The first ones, one in the middle of the search and the last one of all."""
    scene, budget, polls = scene_of(WALL), PathBudget(iterations=150), Polls()
    plan_path(scene, CAR, START, [GOALS[1]], 1, polls, budget, planner)
    every = polls.count
    assert every > 3
    if planner in {'rrt_star', 'bit_star', 'prm_star'}:
        assert every > budget.iterations
    for most in (1, 2, 3, every // 2, every):
        polls = Polls(most)
        with pytest.raises(Stopped):
            plan_path(scene, CAR, START, [GOALS[1]], 1, polls, budget, planner)
        assert polls.count == most


def test_the_lattice_looks_at_the_clock_every_few_hundred_attitudes(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A shut door that is nearly open costs the whole budget, and asks often meanwhile."""
    monkeypatch.setattr(portfolio, 'rrt_connect', lambda _: None)
    door = (
        Polygon('a', ((29, 0), (31, 0), (31, 20), (29, 20))),
        Polygon('b', ((29, 22.0001), (31, 22.0001), (31, 50), (29, 50))),
    )
    polls, budget = Polls(), PathBudget(attitudes=3000)
    result = plan_path(scene_of(*door), CAR, START, [Attitude(54, 6, 0.0)], 1, polls, budget)
    looked_at = [int(word) for word in result.reason.split() if word.isdigit()]
    assert result.motion is None or result.outcome is PathOutcome.FOUND
    assert polls.count * lattice_end.CHUNK >= sum(looked_at[1:])


def test_who_cannot_leave_is_told_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Facing the edge of the map a car that only drives forward is lost; no sampling is tried."""

    def sampled(_: Query) -> None:
        raise AssertionError('no sampling is needed')

    monkeypatch.setattr(portfolio, 'rrt_connect', sampled)
    polls = Polls()
    result = plan_path(scene_of(), CAR, Attitude(2.0, 25.0, pi), [GOALS[0]], 1, polls)
    assert result.outcome is PathOutcome.NO_PATH
    assert 'all that there are' in result.reason
    assert polls.count < 100
    lost = plan_path(scene_of(), CAR, START, [Attitude(2.0, 25.0, 0.0)], 1, polls)
    assert lost.outcome is PathOutcome.NO_PATH


def test_parallel_searches_do_not_disturb_each_other() -> None:
    scene = scene_of(*TREES)
    tasks = [
        (planner, seed) for planner in ('default', 'rrt_connect', 'cell_rrt') for seed in (1, 2)
    ]

    def run(task: tuple[str, int]) -> object:
        return plan_path(scene, CAR, START, GOALS, task[1], never, planner=task[0])

    alone = [run(task) for task in tasks]
    with ThreadPoolExecutor(3) as pool:
        assert list(pool.map(run, tasks)) == alone
