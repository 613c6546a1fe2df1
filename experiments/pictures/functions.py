"""Draw level sets of the library's functions and where conditions hold, for docs/functions.md.

Run from the top of the repository: ``python -m experiments.pictures.functions``.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import pi
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Patch, Polygon

from motion_planner_node.functions import FUNCTIONS, Array, Dual, Place, surroundings_of
from motion_planner_node.world.model import Bounds, World
from motion_planner_node.world.model import Circle as Disc
from motion_planner_node.world.model import Polygon as Outline

IMAGES = Path(__file__).resolve().parents[2] / 'docs' / 'images'
SIZE = 100.0
WALL = ((40.0, 20.0), (48.0, 20.0), (48.0, 60.0), (40.0, 60.0))
BAY = ((15.0, 15.0), (75.0, 15.0), (75.0, 75.0), (45.0, 45.0), (15.0, 75.0))
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, SIZE, SIZE),
    objects={},
    obstacles=(Outline('wall', WALL), Disc('rock', (75.0, 72.0), 8.0)),
    robots={},
    regions={'bay': Outline('bay', BAY)},
)
FIRST, SECOND = (30.0, 40.0), (70.0, 60.0)

Value = Callable[[Place[Dual]], Dual]


def place(x: float, y: float) -> Place[Dual]:
    """A place that is the same for all attitudes."""
    return Place(Dual.constant(x), Dual.constant(y), Dual.constant(0.0))


def panels() -> dict[str, Value]:
    """What is drawn in each panel, as a function of the agent."""
    first, second, surroundings = place(*FIRST), place(*SECOND), surroundings_of(WORLD)
    bay, view = surroundings.region('bay'), Dual.constant(pi / 3.0)
    value = {name: function.value for name, function in FUNCTIONS.items()}
    return {
        'distance(r, a)': lambda r: value['distance'](r, first),
        'field_of_view(r, a, deg(60))': lambda r: value['field_of_view'](r, first, view),
        'distance_to_segment(r, a, b)': lambda r: value['distance_to_segment'](r, first, second),
        'cross_track(r, a, b)': lambda r: value['cross_track'](r, first, second),
        'along_track(r, a, b)': lambda r: value['along_track'](r, first, second),
        'equidistant(r, a, b)': lambda r: value['equidistant'](r, first, second),
        'inside(r, bay)': lambda r: value['inside'](r, bay),
        'clearance(r)': lambda r: value['clearance'](surroundings, r),
        'visible(r, b)': lambda r: value['visible'](surroundings, r, second),
    }


def draw(axes: Axes, title: str, value: Value, cells: int) -> None:
    """Level sets of ``value`` for an agent that heads east, and where its condition holds."""
    line = np.linspace(0.0, SIZE, cells)
    x, y = (grid.ravel() for grid in np.meshgrid(line, line))
    with np.errstate(all='ignore'):
        found = value(Place(Dual(x), Dual(y), Dual(np.zeros_like(x)))).value
    field: Array = np.broadcast_to(found, x.shape).reshape(cells, cells)
    condition = FUNCTIONS[title.split('(', maxsplit=1)[0]].condition
    if condition == '<=':
        axes.contourf(line, line, field, levels=[-1e9, 0.0], colors=['#bfe3c0'])
    wanted = 9 if 'visible' not in title else np.arange(2.5, 21.0, 2.5)
    levels = axes.contour(line, line, field, levels=wanted, colors='#4a6fa5', linewidths=0.7)
    axes.clabel(levels, fontsize=6)
    if condition:
        axes.contour(line, line, field, levels=[0.0], colors='#2b7a2b', linewidths=1.6)
    for patch in patches(title):
        axes.add_patch(patch)
    for (px, py), name in ((FIRST, 'a'), (SECOND, 'b')):
        if f' {name})' in title or f' {name},' in title:
            axes.plot(px, py, 'o', color='black', markersize=3)
            axes.annotate(name, (px, py), (3, 3), textcoords='offset points', fontsize=8)
    axes.set(aspect='equal', xlim=(0.0, SIZE), ylim=(0.0, SIZE), xticks=(), yticks=())
    axes.set_title(title, fontsize=9)


def patches(title: str) -> list[Patch]:
    """The outlines that the function looks at."""
    if 'bay' in title:
        return [Polygon(BAY, fill=False, linestyle='--')]
    if title.startswith(('clearance', 'visible')):
        return [Polygon(WALL, color='0.6'), Circle((75.0, 72.0), 8.0, color='0.6')]
    return []


def main(arguments: list[str] | None = None) -> None:
    """Write ``functions.png``."""
    parser = argparse.ArgumentParser(description=(__doc__ or '').split('\n', maxsplit=1)[0])
    parser.add_argument('--output', type=Path, default=IMAGES)
    parser.add_argument('--cells', type=int, default=241, help='points on a side of a panel')
    options = parser.parse_args(arguments)
    figure, axes = plt.subplots(3, 3, figsize=(7.5, 7.8), layout='constrained')
    for each, (title, value) in zip(axes.flat, panels().items(), strict=True):
        draw(each, title, value, options.cells)
    options.output.mkdir(parents=True, exist_ok=True)
    figure.savefig(options.output / 'functions.png', dpi=72, metadata={'Software': ''})


if __name__ == '__main__':
    main()
