"""How the robots of a plan are told apart: a colour for each, and who looks at whom."""

from __future__ import annotations

import re
from collections.abc import Iterator

from interface_node.plan import Attitude, Plan, Step

#: Of robots that share a plan, in the order in which they act; then from the beginning.
COLORS = ('#2c5f9e', '#c8501e', '#3b8132', '#7b3294', '#8a6d1f', '#1b8a8f')
_SIGHT = re.compile(r'\bvisible\(\s*([^\s,()]+)\s*,\s*([^\s,()]+)\s*\)')


def robot_colors(plan: Plan) -> dict[str, str]:
    """A colour for each robot that acts, nothing when there is only one.

    A single robot's way is coloured by progress, which several ways would make unreadable.
    """
    agents = list(dict.fromkeys(step.agent for step in plan.steps if step.agent and step.end))
    if len(agents) < 2:
        return {}
    return {agent: COLORS[index % len(COLORS)] for index, agent in enumerate(agents)}


def robots_in_sight(step: Step) -> Iterator[Attitude]:
    """Where the other agents stand that the action's preconditions want to be in sight."""
    seen = {name for pair in _SIGHT.findall(step.preconditions) for name in pair}
    for agent, attitude in step.state.items():
        if agent in seen and agent != step.agent:
            yield attitude


def starts(plan: Plan) -> list[tuple[str, Attitude]]:
    """Each driven robot and where it first drives off, but for one that an action put there."""
    found: dict[str, Attitude | None] = {}
    for step in plan.steps:
        if step.agent and (step.assigned or step.segments):
            found.setdefault(step.agent, None if step.assigned else step.start)
    return [(agent, start) for agent, start in found.items() if start]
