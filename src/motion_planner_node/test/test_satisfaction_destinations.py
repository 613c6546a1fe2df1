"""Destinations: the start's own first, different ones after it, the same for the same seed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from motion_planner_node.functions import Array
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import compile_program, destinations, possible_cells
from motion_planner_node.world.model import Bounds, World, WorldObject

BOUNDS = Bounds(0.0, 0.0, 800.0, 600.0)
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={
        'a': WorldObject('a', {'x': 400.0, 'y': 300.0}),
        'edge': WorldObject('edge', {'x': 400.0, 'y': 2.0}),
    },
    obstacles=(),
    robots={'r': Robot('r', 8.0, 0.5, 5.0, 2.0)},
)
START = Attitude(100.0, 100.0, 0.0)
TAKE_PHOTO = (
    '(distance(r, {0}) >= 50)(distance(r, {0}) <= 100)(rel_angle(r, {0}) = cos-and-sin(pi/2))'
)


def found(text: str, count: int, *, seed: int = 3, start: Attitude = START) -> Array:
    preconditions = parse('(agent r)(object a)(object edge)' + text)
    program = compile_program(preconditions, WORLD, {'r': start})
    return destinations(program, start, BOUNDS, np.random.default_rng(seed), count)


def test_the_descent_from_the_start_comes_first() -> None:
    first, *_ = found(TAKE_PHOTO.format('a'), 20)
    bearing = math.atan2(200.0, 300.0)
    expected = [400.0 - 100.0 * math.cos(bearing), 300.0 - 100.0 * math.sin(bearing)]
    assert first[:2] == pytest.approx(expected, abs=1e-6)


def test_a_start_that_satisfies_everything_is_the_first_destination() -> None:
    start = Attitude(400.0, 370.0, 0.0)
    assert found(TAKE_PHOTO.format('a'), 5, start=start)[0].tolist() == [400.0, 370.0, 0.0]


def test_the_same_seed_gives_the_same_bits() -> None:
    first, second = found(TAKE_PHOTO.format('a'), 64), found(TAKE_PHOTO.format('a'), 64)
    assert first.tobytes() == second.tobytes()
    other = found(TAKE_PHOTO.format('a'), 64, seed=4)
    assert first[0].tobytes() == other[0].tobytes()
    assert first.tobytes() != other.tobytes()


def test_destinations_lie_all_round_and_at_all_distances() -> None:
    states = found(TAKE_PHOTO.format('a'), 256)
    assert len(states) == 256
    dx, dy = states[:, 0] - 400.0, states[:, 1] - 300.0
    bearing = np.floor((np.arctan2(dy, dx) + np.pi) / (2.0 * np.pi) * 12.0).astype(int) % 12
    ring = np.clip(np.floor((np.hypot(dx, dy) - 50.0) / 10.0).astype(int), 0, 4)
    assert len(set(zip(bearing.tolist(), ring.tolist(), strict=True))) >= 58


def test_the_first_few_are_far_apart() -> None:
    states = found(TAKE_PHOTO.format('a'), 8)
    apart = np.hypot(*(states[:, None, :2] - states[None, :, :2]).transpose(2, 0, 1))
    assert apart[~np.eye(8, dtype=bool)].min() > 40.0


def test_only_different_destinations_are_given() -> None:
    assert found('(r.x = 10)(r.y = 20)(r.heading = 3)', 50).shape == (1, 3)


def test_destinations_near_the_edge_stay_on_the_map() -> None:
    states = found(TAKE_PHOTO.format('edge') + '(r.heading = cos-and-sin(0))', 20)
    assert len(states) == 20
    assert (states[:, 1] >= 0.0).all()
    start = Attitude(400.0, 1.0, 0.0)
    assert len(found('(distance(r, edge) = 30)', 20, start=start)) == 20


def test_without_constraints_the_robot_stays() -> None:
    assert found('', 10).tolist() == [[100.0, 100.0, 0.0]]
    assert found('(a.x = 400)', 10).tolist() == [[100.0, 100.0, 0.0]]


def test_possible_cells_cover_the_destinations_closely() -> None:
    text = '(agent r)(object a)(distance(r, a) >= 50)(distance(r, a) <= 60)'
    cells = possible_cells(compile_program(parse(text), WORLD, {'r': START}), BOUNDS)
    x_lo, y_lo, x_hi, y_hi = cells.T
    area = float(((x_hi - x_lo) * (y_hi - y_lo)).sum())
    ring = math.pi * (60.0**2 - 50.0**2)
    assert ring <= area <= 1.6 * ring
