"""Draw how destinations are found: penalty field, iterates and feasible set, for docs/solver.md.

Run from the top of the repository: ``python -m experiments.pictures.solver``.
"""

from __future__ import annotations

import argparse
from itertools import islice
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm
from matplotlib.patches import Annulus
from matplotlib.patches import Polygon as Outline

from motion_planner_node.functions import Array
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import (
    Program,
    Room,
    compile_program,
    descend,
    destinations,
)
from motion_planner_node.satisfaction.paper_mode import (
    Iterate,
    PaperCriterion,
    algorithm_1,
    random_states,
)
from motion_planner_node.world.clearance import clearances
from motion_planner_node.world.model import Bounds, Polygon, World, WorldObject
from motion_planner_node.world.shapes import shapes_of

IMAGES = Path(__file__).resolve().parents[2] / 'docs' / 'images'
BOUNDS = Bounds(0.0, 0.0, 120.0, 120.0)
HOUSE = Polygon('house', ((62.0, 46.0), (100.0, 40.0), (104.0, 72.0), (66.0, 78.0)))
RADIUS = 3.0
WORLD = World(
    source='',
    revision='',
    bounds=BOUNDS,
    objects={'o': WorldObject('o', {'x': 50.0, 'y': 50.0})},
    obstacles=(HOUSE,),
    robots={'r': Robot('r', 4.0, 0.5, RADIUS, 2.0)},
)
START = Attitude(20.0, 100.0, 0.0)
RING = '(distance(r, o) >= 10)(distance(r, o) <= 20)'
PHOTO = '(distance(r, o) >= 20)(distance(r, o) <= 30)(rel_angle(r, o) = cos-and-sin(pi/2))'
#: Descents that are drawn in each panel.
DESCENTS = 7
COLOURS = [f'C{index}' for index in range(10)]


def program(text: str) -> Program:
    """The constraints of ``text`` on the robot r and the object o."""
    return compile_program(parse(f'(agent r)(object o){text}'), WORLD, {'r': START})


def draw_field(axes: Axes, of: Program) -> None:
    """Shade F over positions, green where it is 0, for the best heading.

    Angles that can be met by turning on the spot add nothing there.
    """
    rows = [index for index, row in enumerate(of.rows) if not row.periodic]
    x, y = np.meshgrid(np.linspace(0.0, 120.0, 481), np.linspace(0.0, 120.0, 481))
    states = np.column_stack((x.ravel(), y.ravel(), np.zeros(x.size)))
    field = 0.5 * np.square(of.only(rows).violations(states)).sum(axis=1).reshape(x.shape)
    levels = [1e-9, 5.0, 25.0, 100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0]
    norm = BoundaryNorm(levels, 256)
    shades = axes.contourf(x, y, field, levels, cmap='YlOrBr', norm=norm, alpha=0.8)
    axes.contourf(x, y, field, [-1.0, 1e-9], colors=['#8fd19e'])
    bar = axes.figure.colorbar(shades, ax=axes, shrink=0.8, label='penalty F', ticks=levels)
    bar.ax.set_yticklabels(['0', *(f'{level:g}' for level in levels[1:])])


def prepare(axes: Axes, title: str) -> None:
    """The object, and the axes."""
    axes.plot(50.0, 50.0, marker='s', color='gold', markeredgecolor='black', ms=8, zorder=5)
    axes.annotate('o', (50.0, 50.0), (6, 6), textcoords='offset points')
    axes.set(xlim=(0, 120), ylim=(0, 120), aspect='equal', xlabel='x [m]', ylabel='y [m]')
    axes.set_title(title, fontsize=10)


def arrow(axes: Axes, state: Array, colour: object, size: float = 5.0) -> None:
    """The heading of one attitude."""
    x, y, heading = state
    axes.arrow(
        x,
        y,
        size * np.cos(heading),
        size * np.sin(heading),
        color=colour,
        width=0.25,
        head_width=1.8,
        length_includes_head=True,
        zorder=6,
    )


def trace_of(text: str, seed: int) -> list[Iterate]:
    """All iterates of some descents of Algorithm 1, from the start and from random states."""
    trace: list[Iterate] = []
    states = algorithm_1(
        PaperCriterion(program(text)),
        np.array([START.x, START.y, START.heading]),
        random_states(np.random.default_rng(seed), (5.0, 5.0), (115.0, 115.0)),
        lambda _: True,
        lambda state: state,
        trace=trace.append,
    )
    list(islice(states, DESCENTS))
    return trace


def draw_iterates(axes: Axes, trace: list[Iterate], *, with_headings: bool) -> None:
    """The iterates of each descent in a colour of its own, the first one of each hollow."""
    for attempt in range(trace[-1].attempt + 1):
        states = np.array([iterate.state for iterate in trace if iterate.attempt == attempt])
        colour = COLOURS[attempt % len(COLOURS)]
        axes.plot(*states[:, :2].T, '-o', color=colour, ms=4, lw=1.4, zorder=4)
        axes.plot(*states[0, :2], 'o', color=colour, mfc='white', ms=6, zorder=5)
        if with_headings:
            arrow(axes, states[0], colour, 7.0)
            arrow(axes, states[-1], colour, 7.0)


def draw_paper_mode(path: Path) -> None:
    """The worked example and a photo, as Algorithm 1 solves them."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(12.5, 5.2), layout='constrained')
    draw_field(left, program(RING))
    prepare(left, '10 <= distance(r, o) <= 20')
    trace = trace_of(RING, 1)
    draw_iterates(left, trace, with_headings=False)
    first = [iterate for iterate in trace if iterate.attempt == 0]
    for iterate in first:
        x, y, _ = iterate.state
        label = f'$r_{iterate.k}$ = ({x:.6g}, {y:.6g}), F = {max(iterate.criterion, 0.0):.4g}'
        left.annotate(
            label,
            (x, y),
            (-20, 12) if iterate.k == 0 else (-100, -22),
            textcoords='offset points',
            fontsize=8,
            bbox={'boxstyle': 'round', 'facecolor': 'white', 'alpha': 0.85, 'lw': 0},
            zorder=8,
        )
    coupled = f'{PHOTO}(r.y <= 40)'
    draw_field(right, program(coupled))
    prepare(right, '20 <= distance(r, o) <= 30, r.y <= 40, o on the right of r')
    draw_iterates(right, trace_of(coupled, 9), with_headings=True)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_default_mode(path: Path) -> None:
    """Destinations that keep out of an obstacle, and the first ones that are handed out."""
    compiled, room = program(PHOTO), Room(shapes_of(WORLD)[0], RADIUS)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 5.4), layout='constrained')
    for axes in (left, right):
        axes.add_patch(Annulus((50.0, 50.0), 30.0, 10.0, color='#8fd19e', lw=0))
        axes.add_patch(Outline(HOUSE.corners, color='0.45'))
    prepare(left, 'descents that end in an obstacle go on until they have left it')
    rng = np.random.default_rng(3)
    starts = rng.uniform((50.0, 30.0, -3.0), (110.0, 85.0, 3.0), (24, 3))
    ends = descend(compiled, starts).states
    blocked = ends[clearances(room.shapes, ends) < RADIUS]
    free = descend(compiled, blocked, room=room)
    for begin, end in zip(blocked[free.satisfied], free.states[free.satisfied], strict=True):
        left.plot(*np.column_stack((begin, end))[:2], '-', color='tab:red', lw=1.2, zorder=4)
        left.plot(*begin[:2], 'o', color='tab:red', mfc='white', ms=5, zorder=5)
        arrow(left, end, 'tab:blue')
    prepare(right, 'destinations: each is the farthest from those before it')
    found = destinations(compiled, START, BOUNDS, np.random.default_rng(0), 16, room)
    right.plot(START.x, START.y, 'o', color='black', ms=6)
    right.annotate('start', (START.x, START.y), (6, 4), textcoords='offset points')
    for number, state in enumerate(found):
        arrow(right, state, 'tab:blue')
        away = state[:2] - np.array([50.0, 50.0])
        x, y = state[:2] + 4.5 * away / np.hypot(*away)
        right.text(x, y, str(number), fontsize=8, ha='center', va='center', zorder=7)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def main() -> None:
    """Write both pictures."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--directory', type=Path, default=IMAGES, help='where the pictures go')
    directory: Path = parser.parse_args().directory
    directory.mkdir(parents=True, exist_ok=True)
    draw_paper_mode(directory / 'solver_paper_mode.png')
    draw_default_mode(directory / 'solver_default_mode.png')


if __name__ == '__main__':
    main()
