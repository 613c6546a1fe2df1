"""The motion planner's world as the interface takes it from a message."""

from __future__ import annotations

from array import array
from math import pi, sin

import pytest
from geohtn_msgs import msg
from geometry_msgs.msg import Point, Pose, Quaternion
from nav_msgs.msg import MapMetaData, OccupancyGrid

from interface_node.conversions import world_from_message


def test_regions_and_the_map_come_along() -> None:
    origin = Pose(
        position=Point(x=1.0, y=2.0), orientation=Quaternion(z=sin(pi / 4), w=sin(pi / 4))
    )
    grid = OccupancyGrid(
        info=MapMetaData(resolution=0.5, width=3, height=2, origin=origin),
        data=array('b', [0, 100, 0, 100, 0, 0]),
    )
    corners = [Point(x=0.0, y=0.0), Point(x=4.0, y=0.0), Point(x=4.0, y=4.0)]
    world = world_from_message(
        msg.World(
            revision='r',
            x_max=10.0,
            y_max=10.0,
            regions=[
                msg.Region(name='dock', polygon=corners),
                msg.Region(name='yard', center=Point(x=7.0, y=7.0), radius=2.0),
            ],
            map=[grid],
        )
    )
    assert [(region.name, len(region.corners), region.radius) for region in world.regions] == [
        ('dock', 3, 0.0),
        ('yard', 0, 2.0),
    ]
    assert world.map is not None
    assert world.map.occupied.tolist() == [[False, True, False], [True, False, False]]
    assert (world.map.resolution, world.map.origin) == (0.5, (1.0, 2.0))
    assert world.map.yaw == pytest.approx(pi / 2)
    assert world_from_message(msg.World(revision='r')).map is None
