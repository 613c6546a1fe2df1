"""The functions that constraints can use. To add one, write its value and an entry below."""

from __future__ import annotations

from math import pi

from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.scalar import Place, S


def distance(first: Place[S], second: Place[S]) -> S:
    """Euclidean distance [m] between two places (Table 2)."""
    return (second.x - first.x).hypot(second.y - first.y)


def relative_angle(agent: Place[S], target: Place[S]) -> S:
    """Angle [rad] from the bearing of ``target`` to the agent's heading (Table 2).

    Its cosine and sine are the paper's f1 and f2: pi/2 puts the target on the agent's right. It is
    undefined where the agent stands on the target.
    """
    return agent.heading - (target.y - agent.y).direction(target.x - agent.x)


def degrees(angle: S) -> S:
    """An angle given in degrees [rad]."""
    return angle.scaled(pi / 180.0)


def angle_of(radians: S) -> S:
    """The angle [rad] modulo 2 pi whose cosine and sine a constraint is about."""
    return radians


FUNCTIONS: dict[str, Function] = {
    function.name: function
    for function in (
        Function(
            name='distance',
            arguments=(Kind.PLACE, Kind.PLACE),
            result=Kind.NUMBER,
            value=distance,
            symmetric=True,
            description='Euclidean distance between two places.',
        ),
        Function(
            name='rel_angle',
            arguments=(Kind.AGENT, Kind.PLACE),
            result=Kind.ANGLE,
            value=relative_angle,
            derived_codes=('heading',),
            description='Heading of the agent minus the bearing from the agent to the place.',
        ),
        Function(
            name='cos-and-sin',
            arguments=(Kind.NUMBER,),
            result=Kind.ANGLE,
            value=angle_of,
            description='The angle that has this many radians, for comparison with an angle.',
        ),
        Function(
            name='deg',
            arguments=(Kind.NUMBER,),
            result=Kind.NUMBER,
            value=degrees,
            description='Radians of an angle given in degrees.',
        ),
    )
}
