"""The independent checker itself: what it has to refuse, it refuses, and nothing else."""

from __future__ import annotations

import math

import pytest
import shapely

from tests.support.vehicle import Pose, Vehicle, motion_faults

CAR = {'model': 'car', 'wheelbase': 2.0, 'max_steering_angle': 0.5, 'radius': 1.0}
TRUCK = {
    'model': 'reverse_car',
    'wheelbase': 2.0,
    'max_steering_angle': 0.5,
    'footprint': [[-1, -1], [3, -1], [3, 1], [-1, 1]],
    'safety_margin': 0.5,
}
VACUUM = {'model': 'differential', 'radius': 0.5}
BUTLER = {'model': 'omnidirectional', 'footprint': [[-1, -0.5], [1, -0.5], [1, 0.5], [-1, 0.5]]}
BOUNDS = shapely.box(0, 0, 40, 40)
WALL = {'wall': shapely.box(20, 0, 22, 18)}
RADIUS = 2.0 / math.tan(0.5)
QUARTER = RADIUS * math.pi / 2


def faults(
    robot: dict[str, object], start: Pose, segments: list[list[float]], end: Pose
) -> list[str]:
    return list(motion_faults(Vehicle(robot), start, segments, end, WALL, BOUNDS))


@pytest.mark.parametrize(
    ('robot', 'start', 'segments', 'end'),
    [
        (CAR, (5, 5, 0), [[0.0, 7.0]], (12, 5, 0)),
        (CAR, (5, 5, 0), [[0.5, QUARTER]], (5 + RADIUS, 5 + RADIUS, math.pi / 2)),
        (CAR, (5, 15, 0), [[-0.5, QUARTER * 2]], (5, 15 - 2 * RADIUS, math.pi)),
        (TRUCK, (9, 9, 0), [[0.5, -QUARTER]], (9 - RADIUS, 9 + RADIUS, -math.pi / 2)),
        (VACUUM, (5, 5, 0), [[0, 0, 0, 2.0], [0, -1.0], [0, 0, 0, -2.0]], None),
        (BUTLER, (5, 5, 1), [[0, 2.0, math.pi / 2 - 1, 0], [0, 0, 0, 1.0]], (5, 7, 2)),
        (BUTLER, (5, 5, 0), [], (5, 5, 0)),
        # Touching is allowed.
        (BUTLER, (19.5, 10, math.pi / 2), [[0, 1.0]], (19.5, 11, math.pi / 2)),
        (CAR, (1, 20, math.pi / 2), [[0, 1.0]], (1, 21, math.pi / 2)),
    ],
)
def test_a_motion_by_the_textbook_is_accepted(
    robot: dict[str, object], start: Pose, segments: list[list[float]], end: Pose | None
) -> None:
    if end is None:
        end = (start[0] - math.cos(2.0), start[1] - math.sin(2.0), start[2])
    found = faults(robot, start, segments, end)
    assert found == []


@pytest.mark.parametrize(
    ('robot', 'start', 'segments', 'words'),
    [
        (CAR, (5, 5, 0), [[0.25, 7.0]], 'steering angle 0.25'),
        (CAR, (15, 5, 0), [[0.0, -7.0]], 'a segment of -7'),
        (CAR, (5, 5, 0), [[0.0, 7.0, 0.5, 0.0]], 'a slide'),
        (TRUCK, (5, 5, 0), [[0.0, 0.0, 0.0, 1.0]], 'a turn'),
        (VACUUM, (5, 5, 0), [[0.5, 1.0]], 'steering angle'),
        (VACUUM, (5, 5, 0), [[0.0, 0.0]], 'an empty segment'),
        (VACUUM, (5, 5, 0), [[0.0, 1.0, 0.0, 1.0]], 'a turn'),
        (BUTLER, (5, 5, 0), [[0.0, -1.0]], 'a segment of -1'),
        (CAR, (5, 5, 0), [[0.0, 14.01]], '0.9'),
        (CAR, (5, 5, 0), [[0.0, 20.0]], 'inside wall'),
        (CAR, (5, 39.5, 0), [[0.0, 5.0]], "from the map's edge"),
        (CAR, (5, 45, 0), [[0.0, 5.0]], 'leaves the map'),
        # Its front would touch the margin of the wall 11.5 m ahead.
        (TRUCK, (5, 5, 0), [[0.0, 11.6]], 'from wall, not 0.5'),
        # Its corner sweeps over the wall's corner while it turns.
        (BUTLER, (19.2, 10, math.pi / 2), [[0.0, 0.0, 0.0, -1.5]], 'inside wall'),
        (BUTLER, (19.2, 10, math.pi / 2), [[0.0, 0.6, -math.pi / 2, 0.0]], 'inside wall'),
    ],
)
def test_what_cannot_be_driven_is_refused(
    robot: dict[str, object], start: Pose, segments: list[list[float]], words: str
) -> None:
    driven = Vehicle(robot).drive(start, segments)
    end = (float(driven[-1, 0]), float(driven[-1, 1]), float(driven[-1, 2]))
    assert any(words in fault for fault in faults(robot, start, segments, end))


def test_an_end_that_is_elsewhere_is_refused() -> None:
    for end in ((12.00001, 5, 0), (12, 4.99999, 0), (12, 5, 1e-5)):
        assert any('not to' in fault for fault in faults(CAR, (5, 5, 0), [[0.0, 7.0]], end))
    assert faults(CAR, (5, 5, 0), [[0.0, 7.0]], (12, 5, math.tau)) == []
