"""The independent checker itself: what it has to refuse, it refuses, and nothing else."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from PIL import Image

from tests.support.occupancy import occupied_boxes
from tests.support.preconditions import Preconditions
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


DOMAIN = """
(defdomain d (
(Operator (!watch ?r ?o ?z)   ; comments (with parentheses
  ((at ?r)(thing ?o))
  ((agent ?r)(object ?o)(region ?z)
   (distance(?r, ?o) <= 5)
   (visible(?r, ?o))
   (angle_between(bearing(?r, ?o), ?o.faces + pi) <= deg(10))
   (inside(?r, ?z)))
  ((seen ?o)))
))
"""
YARD = {
    'bounds': (0, 0, 20, 20),
    'objects': {'dial': {'x': 10, 'y': 10, 'faces': math.pi}},
    'regions': [{'name': 'bay', 'polygon': [[0, 0], [8, 0], [8, 20], [0, 20]]}],
    'obstacles': [{'polygon': [[7, 0], [7.5, 0], [7.5, 9], [7, 9]]}],
}


@pytest.mark.parametrize(
    ('place', 'missed'),
    [
        ((6, 10, 0), []),
        ((4.9, 10, 0), ['distance']),
        ((8.1, 10, 0), ['inside']),
        ((6, 11.5, 0), ['angle_between']),
        ((6, 8, 0), ['visible', 'angle_between']),
    ],
)
def test_preconditions_are_read_from_the_domain(place: Pose, missed: list[str]) -> None:
    asked = Preconditions(DOMAIN, YARD)
    found = list(asked.faults(['!watch', 'robo', 'dial', 'bay'], 'robo', {'robo': place}))
    assert [fault.split('(')[0] for fault in found] == missed


def test_another_agent_than_the_stated_one_must_not_move() -> None:
    asked = Preconditions(DOMAIN, YARD)
    assert list(asked.faults(['!watch', 'robo', 'dial', 'bay'], 'other', {'other': (6, 10, 0)}))


def test_boxes_cover_just_the_occupied_cells_of_a_map(tmp_path: Path) -> None:
    random = np.random.default_rng(4)
    blocked = random.random((9, 13)) < 0.4
    Image.fromarray(np.where(blocked, 0, 254).astype(np.uint8)[::-1]).save(tmp_path / 'm.png')
    fields = 'image: m.png\nresolution: 0.5\norigin: [1.0, -2.0, 0.0]\nnegate: 0\n'
    (tmp_path / 'm.yaml').write_text(fields + 'free_thresh: 0.2\n', encoding='utf-8')
    extent, boxes = occupied_boxes(tmp_path / 'm.yaml')
    assert extent.bounds == (1.0, -2.0, 7.5, 2.5)
    for row, column in np.ndindex(blocked.shape):
        center = shapely.Point(1.25 + 0.5 * column, -1.75 + 0.5 * row)
        assert sum(part.contains(center) for part in boxes) == int(blocked[row, column])
