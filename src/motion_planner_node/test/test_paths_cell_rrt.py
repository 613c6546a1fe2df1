"""CELL-RRT's own traits: cells that know the obstacles lead a tree of three-valued commands."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import cos, hypot, remainder, sin, tan, tau
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.paths import PathBudget, cell_rrt
from motion_planner_node.paths.cells import Cell, Decomposition
from motion_planner_node.paths.edges import Rows
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.stopping import never
from motion_planner_node.world import Scene
from motion_planner_node.world.model import Bounds, Polygon, World

CAR = Robot('car', 2.0, 0.5, 1.0, 1.0)
FORK = Robot('fork', 2.0, 0.5, 1.0, 1.0, kind='reverse_car')
SIDE = cell_rrt.CELL_SIDE * CAR.turning_radius
START, GOAL = Attitude(6.0, 6.0, 0.4), Attitude(54.0, 20.0, -1.2)
MAP = 120.0
#: Lower left corner, width and height [m].
Wall = tuple[float, float, float, float]
#: In the way to the goal.
BLOCK: tuple[Wall, ...] = ((24, 0, 12, 36),)
#: Open to the side of the start; what is wanted is behind it.
TRAP: tuple[Wall, ...] = ((60, 0, 12, 72), (24, 60, 48, 12))
BEHIND = Attitude(100.0, 20.0, -1.2)


def scene_of(walls: Sequence[Wall]) -> Scene:
    obstacles = tuple(
        Polygon(f'wall{k}', ((a, b), (a + w, b), (a + w, b + h), (a, b + h)))
        for k, (a, b, w, h) in enumerate(walls)
    )
    robots = {robot.label: robot for robot in (CAR, FORK)}
    return Scene(World('', '', Bounds(0, 0, MAP, MAP), {}, obstacles, robots))


def query_of(walls: Sequence[Wall], seed: int, robot: Robot = CAR, goal: Attitude = GOAL) -> Query:
    goals = np.array([[goal.x, goal.y, goal.heading]])
    budget = PathBudget(iterations=20_000)
    return Query(scene_of(walls), robot, START, goals, (seed,), budget, never)


def decomposition(walls: Sequence[Wall]) -> Decomposition:
    free = scene_of(walls).free_space(CAR.body)
    return Decomposition(free, free.component_of(START.x, START.y), SIDE)


def room_of(walls: Sequence[Wall], clearance: float) -> shapely.Geometry:
    """Where the start leads to, by shapely: all that keeps ``clearance`` [m]."""
    solid = shapely.union_all([shapely.box(a, b, a + w, b + h) for a, b, w, h in walls])
    room = shapely.box(0, 0, MAP, MAP).difference(solid).buffer(-clearance)
    parts = [part for part in shapely.get_parts(room) if part.distance(shapely.Point(6, 6)) == 0]
    return parts[0]


def square(cells: Decomposition, cell: Cell) -> shapely.Polygon:
    only = np.zeros(cells.shape, np.bool_)
    only[cell] = True
    return shapely.box(*cells.box(only))


walls = st.lists(
    st.tuples(*[st.integers(9, 40)] * 2, st.integers(1, 20), st.integers(1, 20)), max_size=4
)


@settings(max_examples=6, deadline=None)
@given(walls)
def test_cells_are_open_as_far_as_the_car_can_be_in_them(chosen: list[Wall]) -> None:
    cells = decomposition(chosen)
    grain = scene_of(chosen).free_space(CAR.body).resolution
    inner, outer = room_of(chosen, CAR.radius), room_of(chosen, CAR.radius - 1.5 * grain)
    for cell in np.ndindex(*cells.shape):
        row, column = cell
        area, box = SIDE**2, square(cells, (row, column))
        # Fine cells are counted where their middles are.
        least = inner.intersection(box.buffer(-grain)).area / area
        most = outer.intersection(box.buffer(grain)).area / area
        assert least - 1e-9 <= cells.open[cell] <= most + 1e-9
        assert cells.weights[cell] >= 1.0
    assert cells.open.max() > 0.0


@settings(max_examples=6, deadline=None)
@given(
    st.lists(
        st.one_of(
            st.tuples(*[st.integers(9, 50)] * 2, st.just(1), st.integers(20, 60)),
            st.tuples(*[st.integers(9, 50)] * 2, st.integers(20, 60), st.just(1)),
        ),
        min_size=1,
        max_size=4,
    )
)
def test_a_lead_crosses_no_wall_however_thin(chosen: list[Wall]) -> None:
    scene = scene_of(chosen)
    rows = np.array([[START.x, START.y, 0.0], [110.0, 110.0, 0.0]])
    if not scene.is_free(rows, CAR.body).all():
        return
    cells = decomposition(chosen)
    lead = cells.lead(rows[:1], rows[1:])
    assert lead[0] == cells.cell_of(START.x, START.y)
    assert lead[-1] == cells.cell_of(110.0, 110.0)
    room = room_of(chosen, CAR.radius - 1.5 * scene.free_space(CAR.body).resolution)
    way = shapely.union_all([square(cells, cell).buffer(0.5) for cell in lead]).intersection(room)
    ends = [shapely.Point(row[:2]) for row in rows]
    assert any(all(part.distance(end) < 1e-9 for end in ends) for part in shapely.get_parts(way))


def test_a_thin_wall_takes_no_lead_in_vain(monkeypatch: pytest.MonkeyPatch) -> None:
    leads = 0
    whole = Decomposition.corridor

    def corridor(cells: Decomposition, lead: list[Cell], width: int) -> NDArray[np.bool_]:
        nonlocal leads
        leads += 1
        return whole(cells, lead, width)

    monkeypatch.setattr(Decomposition, 'corridor', corridor)
    assert cell_rrt.cell_rrt(query_of([(24, 0, 2, 36)], 0)) is not None
    assert leads == 1


def tree_of(query: Query, monkeypatch: pytest.MonkeyPatch) -> tuple[Rows | None, list[Rows]]:
    """The path, and all pieces that were driven when the tree grew."""
    driven: list[Rows] = []
    drive = cell_rrt._step

    def step(frame: Any, row: Rows, piece: Rows) -> tuple[bool, float, float, float]:
        result = drive(frame, row, piece)
        driven.append(np.concatenate((row, piece[0], result)))
        return result

    with monkeypatch.context() as patch:
        patch.setattr(cell_rrt, '_step', step)
        return cell_rrt.cell_rrt(query), driven


def after(row: NDArray[np.float64], steering: float, length: float) -> tuple[float, float, float]:
    """Where a car gets that holds a steering angle [rad], by its equations in closed form."""
    x, y, heading = row
    if steering == 0.0:
        return x + length * cos(heading), y + length * sin(heading), heading
    radius = CAR.wheelbase / tan(steering)
    turned = heading + length / radius
    return (
        x + radius * (sin(turned) - sin(heading)),
        y - radius * (cos(turned) - cos(heading)),
        turned,
    )


@pytest.mark.parametrize('robot', [CAR, FORK], ids=lambda robot: robot.label)
def test_the_tree_grows_by_three_steering_angles_held_for_some_steps(
    robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    query = query_of(BLOCK, 1, robot)
    path, driven = tree_of(query, monkeypatch)
    step, most = cell_rrt.STEP * query.reach, robot.max_steering_angle
    bends = np.array([-1.0, 0.0, 1.0]) / robot.turning_radius
    bend, length, direction, turn = np.array(driven)[:, 3:7].T
    assert set(bend) == set(bends)
    assert set(length) == ({step} if robot is CAR else {-step, step})
    assert not direction.any()
    assert not turn.any()
    assert path is not None
    assert path[0].tolist() == [START.x, START.y, START.heading]
    assert path[-1].tolist() == [GOAL.x, GOAL.y, GOAL.heading]
    for here, there in pairwise(path[:-1]):
        gaps = []
        for steering in (-most, 0.0, most):
            for steps in range(1, cell_rrt.LONGEST_COMMAND + 1):
                for way in {float(value) for value in length}:
                    x, y, heading = after(here, steering, steps * way)
                    aside = remainder(heading - there[2], tau)
                    gaps.append(hypot(x - there[0], y - there[1], aside))
        assert min(gaps) < 1e-6


def test_the_same_seed_grows_the_same_tree_and_another_one_another(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    grown = [tree_of(query_of(BLOCK, seed), monkeypatch) for seed in (1, 1, 2)]
    paths = [path for path, _ in grown if path is not None]
    trees = [np.array(driven) for _, driven in grown]
    assert np.array_equal(paths[0], paths[1])
    assert np.array_equal(trees[0], trees[1])
    assert not np.array_equal(trees[0][:50], trees[2][:50])


def test_the_tree_stays_in_the_corridor_of_its_lead(monkeypatch: pytest.MonkeyPatch) -> None:
    corridors = []
    whole = Decomposition.corridor

    def corridor(cells: Decomposition, lead: list[Cell], width: int) -> NDArray[np.bool_]:
        corridors.append((cells, lead, whole(cells, lead, width)))
        return corridors[-1][2]

    monkeypatch.setattr(Decomposition, 'corridor', corridor)
    path = cell_rrt.cell_rrt(query_of(BLOCK, 3))
    assert path is not None
    cells, lead, inside = corridors[-1]
    assert set(lead) <= set(zip(*(each.tolist() for each in np.nonzero(inside)), strict=True))
    assert 0 < inside.sum() < (cells.open > 0.0).sum()
    assert all(inside[cells.cell_of(x, y)] for x, y, _ in path[:-1].tolist())


def test_cells_that_lead_save_most_of_the_tree(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without them a tree that is drawn to the goal fills the trap before it."""

    def steps() -> int:
        grown = [tree_of(query_of(TRAP, seed, goal=BEHIND), monkeypatch) for seed in (0, 1)]
        assert all(path is not None for path, _ in grown)
        return sum(len(driven) for _, driven in grown)

    led = steps()
    monkeypatch.setattr(Decomposition, 'corridor', lambda cells, _lead, _width: cells.open > 0.0)
    assert 2 * led < steps()


def test_after_a_lead_in_vain_another_one_is_followed_in_a_wider_corridor(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    leads: list[list[Cell]] = []
    widths: list[int] = []
    whole = Decomposition.corridor

    def corridor(cells: Decomposition, lead: list[Cell], width: int) -> NDArray[np.bool_]:
        leads.append(lead)
        widths.append(width)
        return whole(cells, lead, width)

    def in_vain(_tree: object, _seed: int, _iterations: int) -> None:
        return None

    monkeypatch.setattr(Decomposition, 'corridor', corridor)
    monkeypatch.setattr(cell_rrt._Tree, 'grow', in_vain)
    query = query_of(BLOCK, 1)
    assert cell_rrt.cell_rrt(query) is None
    assert query.efforts == ['8 leads of CELL-RRT, 20000 iterations each']
    assert widths == list(range(1, cell_rrt.LEADS + 1))
    assert leads[0] != leads[1]
    assert {lead[0] for lead in leads} == {leads[0][0]}
    assert {lead[-1] for lead in leads} == {leads[0][-1]}
