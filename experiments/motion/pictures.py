"""Draw the curve of length against time, and some answers in each world."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Polygon

from experiments.motion.asking import planner_for, request_of
from experiments.motion.goals import AGENT
from experiments.motion.reference import Known
from experiments.motion.worlds import Place
from tests.support.vehicle import Vehicle

#: Answers that are drawn in each world.
DRAWN = 12


def draw_curve(curve: Mapping[str, Any], path: Path) -> None:
    """Lengths at several budgets, and of the usual way as time goes by."""
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    usual = [point for point in curve['usual'] if point['ratio'] is not None]
    axes.plot(
        [point['milliseconds'] for point in usual],
        [point['ratio'] for point in usual],
        'C1.-',
        label='RRTConnect and simplifier, best so far',
    )
    ours = curve['ours']
    axes.plot(
        [point['milliseconds'] for point in ours.values()],
        [point['ratio'] for point in ours.values()],
        'C0o-',
        label='motion planner',
    )
    # One above the other, as the points are near each other.
    for number, (name, point) in enumerate(ours.items()):
        axes.annotate(
            name,
            (point['milliseconds'], point['ratio']),
            textcoords='offset points',
            xytext=(8, 12 * (number + 1)),
            fontsize=8,
            arrowprops={'arrowstyle': '-', 'linewidth': 0.5},
        )
    axes.set(
        xscale='log',
        xlabel='median time [ms]',
        ylabel='median length by the shortest known',
        title=f'{curve["legs"]} legs, lower left is better',
    )
    axes.grid(alpha=0.3)
    axes.legend()
    _save(figure, path)


def draw_worlds(worlds: Sequence[tuple[Place, Sequence[Known]]], path: Path) -> None:
    """Answers to the first requests of each world."""
    figure, panels = plt.subplots(1, len(worlds), figsize=(3.6 * len(worlds), 3.4), squeeze=False)
    for axes, (place, known) in zip(panels[0], worlds, strict=True):
        draw_world(axes, place)
        planner, vehicle = planner_for(place), Vehicle(place.robot)
        for number, one in enumerate(known[:DRAWN]):
            answer = planner.satisfy(request_of(one))
            if answer.motion is None:
                continue
            segments = [[s.steering_angle, s.length] for s in answer.motion.segments]
            driven = vehicle.drive(one.start, segments)
            colour = f'C{number % 10}'
            axes.plot(driven[:, 0], driven[:, 1], color=colour, linewidth=1.0)
            end = answer.end[AGENT]
            axes.plot(*one.start[:2], '.', color=colour, markersize=5)
            axes.plot(end.x, end.y, 'x', color=colour, markersize=5)
        axes.set_title(place.name, fontsize=10)
    _save(figure, path)


def draw_world(axes: Axes, place: Place) -> None:
    """Obstacles and bounds."""
    x_min, y_min, x_max, y_max = place.bounds
    if place.occupied is not None:
        axes.imshow(
            ~place.occupied, cmap='gray', origin='lower', extent=(x_min, x_max, y_min, y_max)
        )
    for obstacle in place.document.get('obstacles', ()):
        if 'polygon' in obstacle:
            axes.add_patch(Polygon(np.array(obstacle['polygon']), color='0.35', linewidth=0))
        else:
            circle = obstacle['circle']
            axes.add_patch(Circle(circle['center'], circle['radius'], color='0.35', linewidth=0))
    axes.set(xlim=(x_min, x_max), ylim=(y_min, y_max), aspect='equal', xticks=[], yticks=[])


def _save(figure: Figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.tight_layout()
    figure.savefig(path, dpi=80)
    plt.close(figure)
