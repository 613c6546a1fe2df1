"""A new world while requests run: each finishes in the world that it began in, and none mixes."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

from motion_planner_node.codes import Code, Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world
from motion_planner_node.world.model import OccupancyMap

TEXT = """
objects: {tree: {x: 30, y: 30}, gate: {x: 8, y: 32}}
robots:
  rover0: {model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 0.5, speed: 2.0}
"""
SIDE = 40


def planner_with(*walls: range) -> MotionPlanner:
    """Free ground but for the cells of row 20 in these columns."""
    cells = bytearray(SIDE * SIDE)
    for wall in walls:
        for column in wall:
            cells[20 * SIDE + column] = 1
    grid = OccupancyMap('the map', SIDE, SIDE, bytes(cells), 1.0, 0, 0, 0, unknown_occupied=True)
    return MotionPlanner(read_world(TEXT, 'test.yaml', grid=grid))


def request(number: int, revision: str = '') -> GeometricRequest:
    label = 'tree' if number % 2 else 'gate'
    text = f'((agent rover0)(object {label})(distance(rover0, {label}) <= 3))'
    start = {'rover0': Attitude(5.0 + number, 5.0, 0.0)}
    return GeometricRequest(text, start=start, seed=number, world_revision=revision)


def said(answer: GeometricAnswer) -> tuple[object, ...]:
    return answer.status, answer.code, answer.world_revision, answer.motion, answer.length


def test_requests_finish_in_their_own_world() -> None:
    gaps = [(range(35),), (range(5, 40),), (range(15), range(25, 40))]
    expected = [
        [said(planner.satisfy(request(number))) for number in range(6)]
        for planner in (planner_with(*gap) for gap in gaps)
    ]
    assert all(answer[0] is Status.FOUND for answers in expected for answer in answers)
    assert len({answers[0] for answers in expected}) == 3

    planners = [planner_with(*gap) for gap in gaps]
    revisions = {planner.world.revision for planner in planners}
    assert len(revisions) == 3
    held = [planners[0]]

    def ask(number: int) -> tuple[int, tuple[object, ...]]:
        planner = held[0]
        held[0] = planners[(planners.index(planner) + 1) % 3]
        return planners.index(planner), said(planner.satisfy(request(number % 6)))

    with ThreadPoolExecutor(4) as threads:
        answers = list(threads.map(ask, range(24)))
    for number, (which, answer) in enumerate(answers):
        assert answer == expected[which][number % 6]
    assert {which for which, _ in answers} == {0, 1, 2}


def test_a_request_for_another_map_is_refused() -> None:
    before, after = planner_with(range(35)), planner_with(range(34))
    assert before.world.revision != after.world.revision
    answer = after.satisfy(request(1, before.world.revision))
    assert answer.code is Code.WORLD_CHANGED
    assert after.satisfy(request(1, after.world.revision)).status is Status.FOUND
