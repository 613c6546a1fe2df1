"""Occupancy grids as messages: with set_world, on a topic, and back with get_world."""

from __future__ import annotations

import signal
from array import array
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from math import cos, pi, sin
from pathlib import Path

import numpy as np
import pytest
from geohtn_msgs import msg, srv
from geometry_msgs.msg import Point, Pose, Quaternion
from nav_msgs.msg import MapMetaData, OccupancyGrid
from PIL import Image
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Header

from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.map_conversions import map_from_msg, map_to_msg
from motion_planner_node.world.model import OccupancyMap
from tests.support.motion_planner import DEADLINE, Asker, start_node, wait_until_ready

ROBOT = (
    'robots: {rover0: {model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 0.5, speed: 1}}\n'
)
TEXT = f'objects: {{tree: {{x: 15, y: 10}}}}\n{ROBOT}'
NEAR = '((agent rover0)(object tree)(distance(rover0, tree) <= 2))'
START = msg.AgentState(agent='rover0', x=4.0, y=10.0, heading=0.0)


def grid_of(*walls: int, size: int = 20) -> OccupancyGrid:
    """Free cells of one metre, but for columns that are walls."""
    cells = np.zeros((size, size), np.int8)
    cells[:, list(walls)] = 100
    return OccupancyGrid(
        header=Header(frame_id='map'),
        info=MapMetaData(resolution=1.0, width=size, height=size),
        data=array('b', cells.tobytes()),
    )


@pytest.mark.parametrize('yaw', [0.0, 0.5, pi])
def test_a_map_comes_back_as_it_went(yaw: float) -> None:
    cells = np.random.default_rng(4).integers(0, 2, (7, 5)).astype(np.uint8)
    grid = OccupancyMap('', 7, 5, cells.tobytes(), 0.05, 1.5, -2.0, yaw, unknown_occupied=True)
    back = map_from_msg(map_to_msg(grid))
    assert back.cells == grid.cells
    assert (back.rows, back.columns, back.resolution) == (7, 5, 0.05)
    assert (back.x, back.y, back.yaw) == pytest.approx((1.5, -2.0, yaw))


def test_cells_are_occupied_free_or_unknown() -> None:
    values = [0, 19, 20, 50, 65, 66, 100, 101, 127, -1, -128]
    grid = OccupancyGrid(info=MapMetaData(resolution=1.0, width=len(values), height=1))
    grid.data = array('b', values)
    assert map_from_msg(grid).occupied.tolist() == [[0, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1]]


def _resize(grid: OccupancyGrid) -> None:
    grid.info.width = 21


def _rename(grid: OccupancyGrid) -> None:
    grid.header.frame_id = 'odom'


def _tilt(grid: OccupancyGrid) -> None:
    grid.info.origin = Pose(orientation=Quaternion(x=sin(0.2), w=cos(0.2)))


def _lose(grid: OccupancyGrid) -> None:
    grid.info.origin = Pose(position=Point(x=float('nan')))


@pytest.mark.parametrize(
    ('spoil', 'fault'),
    [
        (_resize, 'has 400 cells and says that it has 21 x 20'),
        (_rename, 'is in the frame odom, not in map'),
        (_tilt, 'is not level'),
        (_lose, 'that is not finite'),
    ],
)
def test_grids_that_cannot_be_used_are_refused(
    spoil: Callable[[OccupancyGrid], None], fault: str
) -> None:
    grid = grid_of()
    spoil(grid)
    with pytest.raises(MotionPlannerError, match=fault):
        map_from_msg(grid)


@pytest.fixture
def asker() -> Iterator[Asker]:
    asker = Asker()
    yield asker
    asker.close()


@contextmanager
def node(*arguments: str) -> Iterator[None]:
    with start_node(*arguments) as process:
        wait_until_ready(process)
        yield
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=DEADLINE) == 0


def near(asker: Asker, revision: str = '') -> msg.GeometricAnswer:
    request = msg.GeometricRequest(
        action=['!go', 'rover0', 'tree'],
        agent='rover0',
        start=[START],
        preconditions=NEAR,
        world_revision=revision,
        seed=1,
    )
    return asker.call(srv.SatisfyPreconditions, '/satisfy_preconditions', request=request).answer


def set_world(asker: Asker, text: str, **fields: object) -> srv.SetWorld.Response:
    return asker.call(srv.SetWorld, '/set_world', source='world.yaml', yaml=text, **fields)


def test_a_map_comes_with_the_world(asker: Asker, tmp_path: Path) -> None:
    cells = np.full((20, 20), 254, np.uint8)
    cells[:, 10] = 0
    Image.fromarray(cells).save(tmp_path / 'wall.png')
    (tmp_path / 'wall.yaml').write_text('image: wall.png\nresolution: 1.0\norigin: [0, 0, 0]\n')
    with node():
        named = set_world(asker, f'map: wall.yaml\n{TEXT}', directory=str(tmp_path))
        assert named.accepted
        assert near(asker).status == msg.GeometricAnswer.IMPOSSIBLE
        held = asker.call(srv.GetWorld, '/get_world').world
        assert (held.x_max, held.y_max) == (20.0, 20.0)
        assert np.array(held.map[0].data).reshape(20, 20)[:, 10].tolist() == [100] * 20
        assert not set_world(asker, f'map: wall.yaml\n{TEXT}').accepted

        sent = set_world(asker, TEXT, map=[grid_of(10)])
        assert sent.revision == named.revision
        opened = set_world(asker, TEXT, map=[grid_of()])
        assert opened.revision != named.revision
        assert near(asker, opened.revision).status == msg.GeometricAnswer.FOUND
        assert near(asker, named.revision).code == msg.GeometricAnswer.WORLD_CHANGED
        refused = set_world(asker, TEXT, map=[grid_of(size=0)])
        assert not refused.accepted
        assert 'no area' in refused.diagnostics[0].message


def test_a_map_comes_on_a_topic(asker: Asker) -> None:
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    with node('--ros-args', '-p', 'map_topic:=/map'):
        refused = set_world(asker, TEXT)
        assert refused.diagnostics[0].message == 'no map has come on the topic /map yet'
        publisher = asker.node.create_publisher(OccupancyGrid, '/map', latched)
        publisher.publish(grid_of(10))
        revisions = [accepted_by(asker)]
        assert near(asker).status == msg.GeometricAnswer.IMPOSSIBLE
        publisher.publish(grid_of())
        asker.spin_until(lambda: held(asker).revision != revisions[0])
        assert near(asker, revisions[0]).code == msg.GeometricAnswer.WORLD_CHANGED
        assert near(asker, held(asker).revision).status == msg.GeometricAnswer.FOUND
        spoilt = grid_of(10)
        spoilt.header.frame_id = 'odom'
        before = held(asker).revision
        publisher.publish(spoilt)
        publisher.publish(grid_of(5, 10))
        asker.spin_until(lambda: held(asker).revision != before)
        assert len(held(asker).map) == 1


def accepted_by(asker: Asker) -> str:
    """The revision of the world, once the map has reached the node."""
    answers: list[srv.SetWorld.Response] = []

    def is_accepted() -> bool:
        answers.append(set_world(asker, TEXT))
        return bool(answers[-1].accepted)

    asker.spin_until(is_accepted)
    return str(answers[-1].revision)


def held(asker: Asker) -> msg.World:
    return asker.call(srv.GetWorld, '/get_world').world
