"""The lattice search's memory: what has too little room goes on in a larger one as if nothing was."""

from __future__ import annotations

import numpy as np
import pytest

from motion_planner_node.paths.edges import frame_of
from motion_planner_node.paths.field import field_of
from motion_planner_node.paths.lattice import (
    FULL,
    GOES_ON,
    Grain,
    Task,
    attitudes,
    enlarged,
    expanded,
    grow,
    last_of_best,
    new_lattice,
    plant,
    way_to,
)
from motion_planner_node.paths.lattice_end import moves_of
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Circle, World
from motion_planner_node.world.scene import Scene

CAR = Robot('car', wheelbase=1.0, max_steering_angle=0.5, radius=1.0, speed=1.0)
TREES = tuple(
    Circle(f'{x} {y}', (x, y), 3.0) for x in (20.0, 32.0, 44.0) for y in (12.0, 24.0, 36.0)
)
SCENE = Scene(World('', '', Bounds(0.0, 0.0, 60.0, 48.0), {}, TREES, {'car': CAR}))


@pytest.mark.parametrize('rooms', [(40, 5000), (50, 100, 5000)])
def test_a_search_that_runs_out_of_room_goes_on_in_a_larger_one(rooms: tuple[int, ...]) -> None:
    frame = frame_of(SCENE.shapes, CAR.body, CAR.steering, CAR.turning_radius)
    start, goal = np.array([[4.0, 24.0, 0.0]]), np.array([56.0, 24.0, 0.0])
    field = field_of(SCENE.free_space(CAR.body).distance_from(56.0, 24.0))
    grain = Grain(np.zeros(2), 0.35 * CAR.turning_radius, 24, 1.1)
    moves = moves_of(CAR, 0.4 * CAR.turning_radius, 0.3, (1.0,))
    task = Task(goal, 1.0, moves, np.abs(moves[:, 1]), any_word=True)

    whole = new_lattice(rooms[-1], np.inf, 200)
    plant(whole, frame, field, grain, task, start, np.zeros(1))
    state = grow(whole, frame, field, grain, task, 1000)

    parts = new_lattice(rooms[0], np.inf, 200)
    plant(parts, frame, field, grain, task, start, np.zeros(1))
    for room in rooms[1:]:
        assert grow(parts, frame, field, grain, task, 1000) == FULL
        parts = enlarged(parts, room)
    assert grow(parts, frame, field, grain, task, 1000 - expanded(parts)) in (state, GOES_ON)

    assert attitudes(parts) == attitudes(whole) > rooms[-2]
    count = attitudes(whole)
    assert (parts.rows[:count] == whole.rows[:count]).all()
    assert (parts.links[:count] == whole.links[:count]).all()
    last = last_of_best(whole)
    assert last == last_of_best(parts) >= 0
    assert way_to(parts, last)[1].tolist() == way_to(whole, last)[1].tolist()
