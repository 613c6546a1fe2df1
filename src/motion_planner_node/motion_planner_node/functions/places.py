"""Distances and directions between agents and objects."""

from __future__ import annotations

from math import pi

from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.scalar import Place, S

#: Divides instead of a length of 0.
_TINY = 1e-300


def distance(first: Place[S], second: Place[S]) -> S:
    """Euclidean distance [m] between two places (Table 2)."""
    return (second.x - first.x).hypot(second.y - first.y)


def equidistant(agent: Place[S], first: Place[S], second: Place[S]) -> S:
    """By how much [m] the first place is farther away than the second."""
    return distance(agent, first) - distance(agent, second)


def heading(agent: Place[S]) -> S:
    """The agent's heading [rad]."""
    return agent.heading


def bearing(agent: Place[S], target: Place[S]) -> S:
    """Direction [rad] from the agent to the target, from +x; undefined on the target."""
    return (target.y - agent.y).direction(target.x - agent.x)


def relative_angle(agent: Place[S], target: Place[S]) -> S:
    """Angle [rad] from the bearing of ``target`` to the agent's heading (Table 2).

    Its cosine and sine are the paper's f1 and f2: pi/2 puts the target on the agent's right. It is
    undefined where the agent stands on the target.
    """
    return agent.heading - bearing(agent, target)


def on_left(agent: Place[S], target: Place[S]) -> S:
    """How far [rad] the relative angle is from that of a target exactly on the left, -pi/2."""
    angle = relative_angle(agent, target)
    return angle + angle.constant(0.5 * pi)


def on_right(agent: Place[S], target: Place[S]) -> S:
    """How far [rad] the relative angle is from that of a target exactly on the right, pi/2."""
    angle = relative_angle(agent, target)
    return angle - angle.constant(0.5 * pi)


def behind(agent: Place[S], target: Place[S]) -> S:
    """How far [rad] the relative angle is from that of a target exactly behind, pi."""
    angle = relative_angle(agent, target)
    return angle - angle.constant(pi)


def same_heading(first: Place[S], second: Place[S]) -> S:
    """The first agent's heading minus the second's [rad]."""
    return first.heading - second.heading


def field_of_view(agent: Place[S], target: Place[S], angle: S) -> S:
    """By how much [rad] the target is outside a view of ``angle`` round the agent's heading."""
    east, north = target.x - agent.x, target.y - agent.y
    sine, cosine = agent.heading.sin(), agent.heading.cos()
    ahead, aside = east * cosine + north * sine, north * cosine - east * sine
    return aside.__abs__().arctan2(ahead) - angle.scaled(0.5)


def distance_to_segment(agent: Place[S], start: Place[S], end: Place[S]) -> S:
    """Distance [m] from the agent to the straight segment between two places."""
    length = distance(start, end)
    divisor = length.maximum(length.constant(_TINY))
    east, north = (end.x - start.x) / divisor, (end.y - start.y) / divisor
    along = (agent.x - start.x) * east + (agent.y - start.y) * north
    along = along.maximum(along.constant(0.0)).minimum(length)
    return (agent.x - start.x - along * east).hypot(agent.y - start.y - along * north)


def cross_track(agent: Place[S], start: Place[S], end: Place[S]) -> S:
    """Signed distance [m] from the line through two places, positive on the left of its way."""
    length = distance(start, end)
    east, north = (end.x - start.x) / length, (end.y - start.y) / length
    return (agent.y - start.y) * east - (agent.x - start.x) * north


def along_track(agent: Place[S], start: Place[S], end: Place[S]) -> S:
    """How far [m] the agent has come from ``start`` along the line to ``end``."""
    length = distance(start, end)
    east, north = (end.x - start.x) / length, (end.y - start.y) / length
    return (agent.x - start.x) * east + (agent.y - start.y) * north


_PAIR = (Kind.AGENT, Kind.PLACE)
_LINE = (Kind.AGENT, Kind.PLACE, Kind.PLACE)

PLACES = (
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
        arguments=_PAIR,
        result=Kind.ANGLE,
        value=relative_angle,
        derived_codes=('heading',),
        description='Heading of the agent minus the bearing from the agent to the place.',
    ),
    Function(
        name='heading',
        arguments=(Kind.AGENT,),
        result=Kind.ANGLE,
        value=heading,
        description='Heading of the agent.',
    ),
    Function(
        name='bearing',
        arguments=_PAIR,
        result=Kind.ANGLE,
        value=bearing,
        description='Direction from the agent to the place.',
    ),
    *(
        Function(
            name=name,
            arguments=_PAIR,
            result=Kind.ANGLE,
            value=value,
            derived_codes=('heading',),
            condition='=',
            description=f'The place is exactly {where} the agent.',
        )
        for name, value, where in (
            ('facing', relative_angle, 'ahead of'),
            ('object_on_left', on_left, 'on the left of'),
            ('object_on_right', on_right, 'on the right of'),
            ('object_behind', behind, 'behind'),
        )
    ),
    Function(
        name='same_heading',
        arguments=(Kind.AGENT, Kind.AGENT),
        result=Kind.ANGLE,
        value=same_heading,
        derived_codes=('heading',),
        condition='=',
        description='Two agents have the same heading.',
    ),
    Function(
        name='field_of_view',
        arguments=(*_PAIR, Kind.NUMBER),
        result=Kind.NUMBER,
        value=field_of_view,
        derived_codes=('heading',),
        condition='<=',
        description='The place is within half the angle on either side of the heading.',
    ),
    Function(
        name='equidistant',
        arguments=_LINE,
        result=Kind.NUMBER,
        value=equidistant,
        condition='=',
        description='The agent is equally far from two places.',
    ),
    Function(
        name='distance_to_segment',
        arguments=_LINE,
        result=Kind.NUMBER,
        value=distance_to_segment,
        description='Distance to the straight segment between two places.',
    ),
    Function(
        name='cross_track',
        arguments=_LINE,
        result=Kind.NUMBER,
        value=cross_track,
        description='Signed distance from the line through two places, positive on its left.',
    ),
    Function(
        name='along_track',
        arguments=_LINE,
        result=Kind.NUMBER,
        value=along_track,
        description='How far the agent has come on the line from one place to another.',
    ),
)
