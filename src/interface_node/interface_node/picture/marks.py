"""Marks where actions take place: a number in a dot, and an arrow along the heading."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, hypot, remainder, sin, tau
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from interface_node.picture.style import BETWEEN, END, START
from interface_node.plan import Attitude, Plan

#: Headings [rad] that differ by less have one arrow.
SAME_HEADING = 0.05


@dataclass(slots=True)
class Mark:
    """Actions of one robot that take place in one spot: their numbers, where, and its headings."""

    agent: str
    place: Attitude
    color: str
    numbers: list[int] = field(default_factory=list)
    headings: list[float] = field(default_factory=list)

    @property
    def text(self) -> str:
        """The numbers, a run of three or more as its ends: 3, 5-8."""
        runs: list[list[int]] = []
        for number in self.numbers:
            if runs and runs[-1][-1] == number - 1:
                runs[-1].append(number)
            else:
                runs.append([number])
        parts = [
            f'{run[0]}-{run[-1]}' if len(run) > 2 else ', '.join(map(str, run)) for run in runs
        ]
        return ', '.join(parts)

    @property
    def crowded(self) -> bool:
        """Whether the numbers are too many for the spot itself: they stand beside it."""
        return len(self.numbers) > 2


def group_marks(plan: Plan, colors: Mapping[str, str], apart: float) -> list[Mark]:
    """The marks of a plan; those nearer to each other than ``apart`` [m] would hide one another.

    ``colors`` are those of robots that share a plan; a single one's first mark is green when it
    was put there, and its last one is red.
    """
    placed = [(number, step) for number, step in enumerate(plan.steps, 1) if step.end]
    marks: list[Mark] = []
    for number, step in placed:
        end = step.end
        assert end is not None
        color = colors.get(step.agent, BETWEEN)
        if not colors and number == placed[-1][0]:
            color = END
        elif not colors and number == placed[0][0] and step.assigned:
            color = START
        near = (
            mark
            for mark in marks
            if mark.agent == step.agent
            and hypot(mark.place.x - end.x, mark.place.y - end.y) < apart
            and (mark.color == color or color == END)
        )
        mark = next(near, None)
        if mark is None:
            mark = Mark(step.agent, end, color)
            marks.append(mark)
        mark.color = color
        mark.numbers.append(number)
        if all(abs(remainder(end.heading - h, tau)) > SAME_HEADING for h in mark.headings):
            mark.headings.append(end.heading)
    return marks


def draw_marks(axes: Axes, marks: Sequence[Mark], reach: float) -> None:
    """Draw the marks, with arrows ``reach`` [m] long, and the numbers that fit on them."""
    for mark in marks:
        x, y = mark.place.x, mark.place.y
        for heading in mark.headings:
            axes.annotate(
                '',
                xy=(x + reach * cos(heading), y + reach * sin(heading)),
                xytext=(x, y),
                arrowprops={
                    'arrowstyle': '-|>,head_width=0.3,head_length=0.6',
                    'color': mark.color,
                    'linewidth': 2.2,
                    'shrinkA': 0,
                    'shrinkB': 0,
                    'path_effects': [withStroke(linewidth=4, foreground='white')],
                },
                zorder=7,
            )
        several = len(mark.numbers) > 1
        if not several or mark.crowded:
            axes.plot(
                x, y, marker='o', markersize=14, color=mark.color, mec='white', mew=1.2, zorder=8
            )
        if not mark.crowded:
            axes.annotate(
                mark.text,
                (x, y),
                ha='center',
                va='center_baseline',
                bbox=pill(mark.color) if several else None,
                zorder=9,
                **number_style(mark),
            )


def number_style(mark: Mark) -> dict[str, Any]:
    """How the numbers of a mark are written."""
    size = 9 if mark.numbers[-1] < 100 else 6
    return {'fontsize': size, 'fontweight': 'bold', 'color': 'white'}


def pill(color: str) -> dict[str, Any]:
    """The ground on which several numbers stand."""
    return {
        'boxstyle': 'round,pad=0.3,rounding_size=0.7',
        'facecolor': color,
        'edgecolor': 'white',
        'linewidth': 1.2,
    }


def draw_starts(
    axes: Axes, places: Sequence[tuple[str, Attitude]], colors: Mapping[str, str]
) -> None:
    """Draw where robots drive off: no action takes place there, so there is no number."""
    for agent, place in places:
        axes.plot(
            place.x,
            place.y,
            marker='o',
            markersize=9,
            color='white' if colors else START,
            mec=colors.get(agent, 'white'),
            mew=2.2 if colors else 1.2,
            zorder=7.5,
        )
