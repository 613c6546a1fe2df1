"""Functions that look at the world: its named regions, and the obstacles round the agent."""

from __future__ import annotations

from motion_planner_node.functions.field import Field
from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.scalar import Place, S
from motion_planner_node.functions.surroundings import Surroundings


def distance_to_region(agent: Place[S], region: Field) -> S:
    """Distance [m] from the agent to the region's boundary, negative inside."""
    return agent.x.opaque(region, agent.y)


def distance_to_boundary(agent: Place[S], region: Field) -> S:
    """Distance [m] from the agent to the region's boundary, from either side."""
    return agent.x.opaque(region, agent.y).__abs__()


def clearance(surroundings: Surroundings, agent: Place[S]) -> S:
    """Distance [m] to the nearest obstacle or edge of the map, negative where the agent can't be."""
    return agent.x.opaque(surroundings.clearance, agent.y)


def hidden(surroundings: Surroundings, agent: Place[S], target: Place[S]) -> S:
    """By how much [m] the line of sight misses going round the obstacles, negative if it is free."""
    return agent.x.opaque(surroundings.sight, agent.y, target.x, target.y)


_IN_REGION = (Kind.AGENT, Kind.REGION)

REGIONS = (
    Function(
        name='inside',
        arguments=_IN_REGION,
        result=Kind.NUMBER,
        value=distance_to_region,
        condition='<=',
        description='The agent is in the region or on its boundary.',
    ),
    Function(
        name='outside',
        arguments=_IN_REGION,
        result=Kind.NUMBER,
        value=distance_to_region,
        condition='>=',
        description='The agent is outside the region or on its boundary.',
    ),
    Function(
        name='distance_to_boundary',
        arguments=_IN_REGION,
        result=Kind.NUMBER,
        value=distance_to_boundary,
        description="Distance from the agent to the region's boundary, from either side.",
    ),
    Function(
        name='clearance',
        arguments=(Kind.AGENT,),
        result=Kind.NUMBER,
        value=clearance,
        sees_world=True,
        description='Distance from the agent to the nearest obstacle or edge of the map.',
    ),
    Function(
        name='visible',
        arguments=(Kind.AGENT, Kind.PLACE),
        result=Kind.NUMBER,
        value=hidden,
        condition='<=',
        sees_world=True,
        description='No obstacle is between the agent and the place.',
    ),
)
