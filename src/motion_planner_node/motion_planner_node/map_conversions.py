"""Occupancy grids as messages: into maps of a world, and out of them."""

from __future__ import annotations

from array import array
from collections.abc import Sequence
from math import atan2, cos, hypot, isfinite, sin

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion
from nav_msgs.msg import MapMetaData, OccupancyGrid
from std_msgs.msg import Header

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.world.map_reader import kinds_of_percents, map_of
from motion_planner_node.world.model import OccupancyMap

FRAME = 'map'
#: How much of a turn about a level axis is taken for rounding.
_LEVEL = 1e-3


def map_from_msg(grid: OccupancyGrid) -> OccupancyMap:
    """The map of a grid; what is unknown in it counts as occupied.

    :raises MotionPlannerError: NO_WORLD when its frame, size or orientation cannot be used
    """
    info = grid.info
    if grid.header.frame_id not in {'', FRAME}:
        raise _refusal(f'is in the frame {grid.header.frame_id[:100]}, not in {FRAME}')
    if len(grid.data) != info.width * info.height:
        size = f'{info.width} x {info.height}'
        raise _refusal(f'has {len(grid.data)} cells and says that it has {size}')
    origin = [info.origin.position.x, info.origin.position.y, _yaw(info.origin.orientation)]
    if not all(isfinite(value) for value in (*origin, info.resolution)):
        raise _refusal('has a resolution or an origin that is not finite')
    cells = np.frombuffer(array('b', grid.data), np.int8).reshape(info.height, info.width)
    # 256 values, of which those below 0 come last.
    table = kinds_of_percents(np.arange(256).astype(np.int8).astype(np.float64))
    kinds = table[cells.view(np.uint8)]
    # The resolution is a float32, but meant are the digits that it is written with.
    return map_of(kinds, float(f'{info.resolution:.7g}'), origin, unknown_occupied=True)


def map_of_request(grids: Sequence[OccupancyGrid]) -> OccupancyMap | None:
    """The map of the one grid that came along, if one did.

    :raises MotionPlannerError: as `map_from_msg`
    """
    return map_from_msg(grids[0]) if grids else None


def map_to_msg(grid: OccupancyMap) -> OccupancyGrid:
    """The grid of a map: 100 where it is occupied, 0 where it is free."""
    half = 0.5 * grid.yaw
    origin = Pose(
        position=Point(x=float(grid.x), y=float(grid.y)),
        orientation=Quaternion(z=sin(half), w=cos(half)),
    )
    return OccupancyGrid(
        header=Header(frame_id=FRAME),
        info=MapMetaData(
            resolution=float(grid.resolution),
            width=grid.columns,
            height=grid.rows,
            origin=origin,
        ),
        data=array('b', (grid.occupied * np.uint8(100)).tobytes()),
    )


def _yaw(q: Quaternion) -> float:
    length = hypot(q.x, q.y, q.z, q.w)
    if length == 0.0:
        return 0.0
    if not hypot(q.x, q.y) <= _LEVEL * length:
        raise _refusal('is not level')
    return 2.0 * atan2(q.z, q.w)


def _refusal(what: str) -> MotionPlannerError:
    return MotionPlannerError(Code.NO_WORLD, f'the occupancy grid {what}')
