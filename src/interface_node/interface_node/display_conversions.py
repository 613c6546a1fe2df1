"""What people look at in RViz and Foxglove: path, map and markers, frame ``map``."""

from __future__ import annotations

import array
from collections.abc import Iterable
from math import cos, sin

from builtin_interfaces.msg import Duration, Time
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion, Vector3
from nav_msgs.msg import MapMetaData, OccupancyGrid, Path
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from interface_node.driving import sample
from interface_node.footprint import disc_outline, robot_outline
from interface_node.occupancy import occupancy
from interface_node.plan import Attitude, Obstacle, Plan, World

FRAME = 'map'
FREE, OCCUPIED = 0, 100


def header(stamp: Time) -> Header:
    """A header in the frame of everything here."""
    return Header(stamp=stamp, frame_id=FRAME)


def path_message(plan: Plan, spacing: float, stamp: Time) -> Path:
    """The way of the robot that moves first, sampled every ``spacing`` [m] at most."""
    robot = plan.robot
    attitudes: list[Attitude] = []
    for step in plan.steps:
        if robot is None or step.agent != robot.label or step.end is None:
            continue
        if step.start and step.segments:
            driven = sample(step.start, step.segments, robot.wheelbase, spacing).tolist()
            # A leg begins where the one before ended: that attitude is there already.
            attitudes += [Attitude(*row) for row in driven[1 if attitudes else 0 :]]
        else:
            attitudes.append(step.end)
    top = header(stamp)
    return Path(
        header=top, poses=[PoseStamped(header=top, pose=_pose(attitude)) for attitude in attitudes]
    )


def map_message(world: World, resolution: float, stamp: Time) -> OccupancyGrid:
    """The obstacles as a grid: 100 where a cell's centre is in one, else 0."""
    grid = occupancy(world, resolution)
    rows, columns = grid.occupied.shape
    cells = grid.occupied.astype('int8') * (OCCUPIED - FREE) + FREE
    return OccupancyGrid(
        header=header(stamp),
        info=MapMetaData(
            map_load_time=stamp,
            resolution=float(grid.resolution),
            width=columns,
            height=rows,
            origin=_pose(Attitude(*grid.origin, 0.0)),
        ),
        data=array.array('b', cells.astype('int8').tobytes()),
    )


def marker_array(plan: Plan, spacing: float, stamp: Time) -> MarkerArray:
    """Everything of the picture as markers; the first one clears those of earlier missions."""
    world = plan.world
    clear = Marker(header=header(stamp), action=Marker.DELETEALL)
    if world is None:
        return MarkerArray(markers=[clear])
    size = max(world.bounds[2] - world.bounds[0], world.bounds[3] - world.bounds[1]) / 100
    markers = [
        clear,
        *(_outline(obstacle, size) for obstacle in world.obstacles),
        *_objects(world, size),
        *_footprints(plan, world, size),
        *_attitudes(plan, size),
        _views(plan, world, size),
        _way(plan, spacing, size, stamp),
    ]
    for index, marker in enumerate(markers):
        marker.header = header(stamp)
        marker.id = index
        marker.lifetime = Duration()
    return MarkerArray(markers=markers)


def _outline(obstacle: Obstacle, size: float) -> Marker:
    corners: Iterable[tuple[float, float]] = obstacle.corners
    if not obstacle.corners:
        (x, y), radius = obstacle.center, obstacle.radius
        corners = disc_outline(x, y, radius)
    return _closed_line('obstacles', corners, (0.45, 0.48, 0.52), size / 4)


def _footprints(plan: Plan, world: World, size: float) -> Iterable[Marker]:
    """The outline of the robot where it stands after each action."""
    for step in plan.steps:
        robot = world.robot(step.agent)
        if robot and step.end:
            corners = robot_outline(robot, step.end)
            yield _closed_line('footprints', corners, (0.17, 0.37, 0.62), size / 8)


def _closed_line(
    namespace: str,
    corners: Iterable[tuple[float, float]],
    color: tuple[float, float, float],
    width: float,
) -> Marker:
    points = [_point(*corner) for corner in corners]
    marker = _marker(namespace, Marker.LINE_STRIP, color)
    marker.scale.x = width
    marker.points = [*points, points[0]]
    return marker


def _objects(world: World, size: float) -> Iterable[Marker]:
    for label, place in world.objects.items():
        box = _marker('objects', Marker.CUBE, (1.0, 0.82, 0.25))
        box.pose.position = _point(*place)
        box.scale = Vector3(x=size, y=size, z=size)
        yield box
        text = _marker('labels', Marker.TEXT_VIEW_FACING, (0.9, 0.9, 0.9))
        text.pose.position = _point(place[0], place[1] + 1.5 * size, size)
        text.scale.z = 1.5 * size
        text.text = label
        yield text


def _attitudes(plan: Plan, size: float) -> Iterable[Marker]:
    placed = [(number, step.end) for number, step in enumerate(plan.steps, 1) if step.end]
    for number, attitude in placed:
        color = (0.17, 0.37, 0.62)
        if number == placed[0][0]:
            color = (0.1, 0.59, 0.25)
        elif number == placed[-1][0]:
            color = (0.84, 0.1, 0.11)
        arrow = _marker('attitudes', Marker.ARROW, color)
        arrow.pose = _pose(attitude)
        arrow.scale = Vector3(x=3 * size, y=size, z=size)
        yield arrow
        text = _marker('numbers', Marker.TEXT_VIEW_FACING, color)
        text.pose.position = _point(attitude.x, attitude.y - 1.5 * size, size)
        text.scale.z = 1.5 * size
        text.text = str(number)
        yield text


def _views(plan: Plan, world: World, size: float) -> Marker:
    marker = _marker('views', Marker.LINE_LIST, (0.6, 0.6, 0.6))
    marker.scale.x = size / 8
    for step in plan.steps:
        if step.end and not step.assigned:
            for label in step.objects:
                if label in world.objects:
                    marker.points += [
                        _point(step.end.x, step.end.y),
                        _point(*world.objects[label]),
                    ]
    return marker


def _way(plan: Plan, spacing: float, size: float, stamp: Time) -> Marker:
    marker = _marker('way', Marker.LINE_STRIP, (0.17, 0.5, 0.72))
    marker.scale.x = size / 3
    marker.points = [pose.pose.position for pose in path_message(plan, spacing, stamp).poses]
    return marker


def _marker(namespace: str, kind: int, color: tuple[float, float, float]) -> Marker:
    red, green, blue = color
    return Marker(
        ns=namespace,
        type=kind,
        action=Marker.ADD,
        pose=Pose(orientation=Quaternion(w=1.0)),
        color=ColorRGBA(r=red, g=green, b=blue, a=1.0),
    )


def _point(x: float, y: float, z: float = 0.0) -> Point:
    return Point(x=float(x), y=float(y), z=float(z))


def _pose(attitude: Attitude) -> Pose:
    half = attitude.heading / 2
    return Pose(
        position=_point(attitude.x, attitude.y),
        orientation=Quaternion(z=sin(half), w=cos(half)),
    )
