"""Two functions for geometric preconditions: a number, and a condition that stands alone."""

from __future__ import annotations

from motion_planner_node.functions import Function, Kind, Place, S


def aspect_ratio(agent: Place[S], first: Place[S], second: Place[S]) -> S:
    """How many times as far from the second place as from the first the agent is."""
    to_first = (first.x - agent.x).hypot(first.y - agent.y)
    to_second = (second.x - agent.x).hypot(second.y - agent.y)
    return to_second / to_first


def behind(agent: Place[S], leader: Place[S]) -> S:
    """By how much [m] the agent is ahead of the leader, along the leader's heading."""
    east, north = agent.x - leader.x, agent.y - leader.y
    return east * leader.heading.cos() + north * leader.heading.sin()


FUNCTIONS = (
    Function(
        name='aspect_ratio',
        arguments=(Kind.AGENT, Kind.PLACE, Kind.PLACE),
        result=Kind.NUMBER,
        value=aspect_ratio,
        description='Distance to the second place divided by that to the first.',
    ),
    Function(
        name='behind',
        arguments=(Kind.AGENT, Kind.AGENT),
        result=Kind.NUMBER,
        value=behind,
        condition='<=',
        description='The first agent is not ahead of the second.',
    ),
)
