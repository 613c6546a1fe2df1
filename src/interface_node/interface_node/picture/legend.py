"""What the signs in the picture mean."""

from __future__ import annotations

from collections.abc import Mapping

from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from interface_node.picture.robots import robots_in_sight
from interface_node.picture.style import (
    BETWEEN,
    END,
    INK,
    OBJECTIVE,
    PAIR,
    PROGRESS,
    START,
    VIEW,
)
from interface_node.picture.terrain import OBSTACLE, OBSTACLE_EDGE, REGION, REGION_EDGE
from interface_node.plan import Plan, World


def legend_handles(plan: Plan, world: World, colors: Mapping[str, str]) -> list[Line2D | Patch]:
    """A handle for each kind of sign that is there; ``colors`` are of robots that share a plan."""

    def dot(color: str, label: str, marker: str = 'o', edge: str = 'white') -> Line2D:
        return Line2D(
            [], [], ls='', marker=marker, ms=9, color=color, mec=edge, mew=0.9, label=label
        )

    handles: list[Line2D | Patch] = [
        Patch(facecolor=OBSTACLE, edgecolor=OBSTACLE_EDGE, label='obstacle'),
        dot(OBJECTIVE, 'object', 's', INK),
    ]
    if world.regions:
        handles.append(Patch(facecolor=REGION, edgecolor=REGION_EDGE, ls='--', label='region'))
    if any(step.end for step in plan.steps):
        handles += [
            *(
                Line2D([], [], color=color, lw=2.4, marker='o', ms=9, mec='white', label=agent)
                for agent, color in colors.items()
            ),
            *([] if colors else [dot(START, 'start'), dot(BETWEEN, 'action'), dot(END, 'end')]),
            Line2D([], [], color=INK, lw=1.0, ls=VIEW, label='view'),
        ]
        if any(True for step in plan.steps for _ in robots_in_sight(step)):
            handles.append(Line2D([], [], color=INK, lw=1.1, ls=PAIR, label='sight of a robot'))
        if not colors:
            handles.append(Line2D([], [], color=PROGRESS(0.4), lw=2.4, label='way driven'))
    return handles
