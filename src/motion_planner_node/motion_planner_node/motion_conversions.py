"""Robots and motions as messages and back; every number becomes a plain float."""

from __future__ import annotations

from math import cos, floor, isfinite, pi, remainder, sin, tau

import numpy as np
from builtin_interfaces.msg import Time
from geohtn_msgs import msg
from geometry_msgs.msg import Point, Pose, PoseStamped, Quaternion
from nav_msgs.msg import Path
from numpy.typing import NDArray
from std_msgs.msg import Header

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.robots.robot import Robot

#: Frame of all positions.
FRAME = 'map'


def attitude_from_msg(state: msg.AgentState, what: str = 'start') -> Attitude:
    """The attitude; a heading outside (-pi, pi] is wrapped, one inside is left bit for bit.

    ``what`` it is of its agent, for errors.

    :raises MotionPlannerError: INVALID_START when a number is not finite
    """
    for name in ('x', 'y', 'heading'):
        value = getattr(state, name)
        if not isfinite(value):
            raise MotionPlannerError(
                Code.INVALID_START, f'the {what} of {state.agent} has {name} {value}'
            )
    heading = state.heading if -pi < state.heading <= pi else remainder(state.heading, tau)
    return Attitude(state.x, state.y, pi if heading == -pi else heading)


def agent_state_to_msg(agent: str, attitude: Attitude) -> msg.AgentState:
    """One attitude."""
    return msg.AgentState(
        agent=agent,
        x=float(attitude.x),
        y=float(attitude.y),
        heading=float(attitude.heading),
    )


def robot_to_msg(robot: Robot) -> msg.RobotModel:
    """The robot with the parameters of its model."""
    return msg.RobotModel(
        label=robot.label,
        model=robot.kind,
        wheelbase=float(robot.wheelbase),
        max_steering_angle=float(robot.max_steering_angle),
        radius=float(robot.radius),
        footprint=[Point(x=float(x), y=float(y)) for x, y in robot.footprint],
        safety_margin=float(robot.safety_margin),
        speed=float(robot.speed),
        turning_speed=float(robot.turning_speed),
        start=[agent_state_to_msg(robot.label, robot.start)] if robot.start else [],
    )


def motion_to_msg(motion: Motion, duration: float, clearance: float) -> msg.Motion:
    """The motion, which takes ``duration`` [s] and keeps ``clearance`` [m]."""
    return msg.Motion(
        agent=motion.agent,
        start=agent_state_to_msg(motion.agent, motion.start),
        segments=[
            msg.Segment(
                steering_angle=float(segment.steering_angle),
                length=float(segment.length),
                direction=float(segment.direction),
                turn=float(segment.turn),
            )
            for segment in motion.segments
        ],
        length=float(motion.length),
        duration=float(duration),
        clearance=float(clearance),
    )


def motion_from_msg(motion: msg.Motion) -> Motion:
    """The motion; its segments may be no commands of any robot.

    :raises MotionPlannerError: INVALID_START as in `attitude_from_msg`
    """
    segments = tuple(
        Segment(item.steering_angle, item.length, item.direction, item.turn)
        for item in motion.segments
    )
    return Motion(motion.agent, attitude_from_msg(motion.start), segments)


def path_to_msg(rows: NDArray[np.float64]) -> Path:
    """Poses at attitudes whose times [s] are the fourth column of ``rows`` (n, 4)."""
    header = Header(frame_id=FRAME)
    return Path(header=header, poses=[_pose(*row) for row in rows.tolist()])


def _pose(x: float, y: float, heading: float, time: float) -> PoseStamped:
    seconds = floor(time)
    nanoseconds = min(int((time - seconds) * 1e9), 999_999_999)
    # Stamps are 32 bits of seconds: later ones all get the last.
    stamp = Time(sec=min(seconds, 2**31 - 1), nanosec=nanoseconds)
    orientation = Quaternion(z=sin(heading / 2.0), w=cos(heading / 2.0))
    return PoseStamped(
        header=Header(stamp=stamp, frame_id=FRAME),
        pose=Pose(position=Point(x=x, y=y), orientation=orientation),
    )
