"""Draw how destinations are found: penalty field, iterates and feasible set, for docs/solver.md.

Run from the top of the repository: ``python -m experiments.pictures.solver``.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Annulus
from matplotlib.patches import Polygon as Outline

from experiments.pictures.landscape import (
    RADIUS,
    Landscape,
    arrow,
    at_best_heading,
    descents_of,
    draw_descents,
    shade,
)
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import Room, descend, destinations
from motion_planner_node.world.clearance import clearances
from motion_planner_node.world.model import Polygon
from motion_planner_node.world.shapes import shapes_of

IMAGES = Path(__file__).resolve().parents[2] / 'docs' / 'images'
HOUSE = Polygon('house', ((62.0, 46.0), (100.0, 40.0), (104.0, 72.0), (66.0, 78.0)))
START = Attitude(20.0, 100.0, 0.0)
#: The robot and the object of the paper's worked example.
EXAMPLE = Landscape(120.0, (50.0, 50.0), START, (HOUSE,))
RING = '(distance(r, o) >= 10)(distance(r, o) <= 20)'
PHOTO = '(distance(r, o) >= 20)(distance(r, o) <= 30)(rel_angle(r, o) = cos-and-sin(pi/2))'
#: Descents that are drawn in each panel.
DESCENTS = 7
#: Corners of the grid along each side, less one.
CELLS = 480


def draw_paper_mode(path: Path) -> None:
    """The worked example and a photo, as Algorithm 1 solves them."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(12.5, 5.2), layout='constrained')
    x, y = EXAMPLE.grid(CELLS)
    shade(left, x, y, at_best_heading(EXAMPLE.program(RING), x, y))
    EXAMPLE.prepare(left, '10 <= distance(r, o) <= 20')
    trace = EXAMPLE.trace(RING, DESCENTS, EXAMPLE.random_states(1))
    draw_descents(left, descents_of(trace))
    first = [iterate for iterate in trace if iterate.attempt == 0]
    for iterate in first:
        at_x, at_y, _ = iterate.state
        label = f'$r_{iterate.k}$ = ({at_x:.6g}, {at_y:.6g}), F = {max(iterate.criterion, 0.0):.4g}'
        left.annotate(
            label,
            (at_x, at_y),
            (-20, 12) if iterate.k == 0 else (-100, -22),
            textcoords='offset points',
            fontsize=8,
            bbox={'boxstyle': 'round', 'facecolor': 'white', 'alpha': 0.85, 'lw': 0},
            zorder=8,
        )
    coupled = f'{PHOTO}(r.y <= 40)'
    shade(right, x, y, at_best_heading(EXAMPLE.program(coupled), x, y))
    EXAMPLE.prepare(right, '20 <= distance(r, o) <= 30, r.y <= 40, o on the right of r')
    trace = EXAMPLE.trace(coupled, DESCENTS, EXAMPLE.random_states(9))
    draw_descents(right, descents_of(trace), 7.0)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def draw_default_mode(path: Path) -> None:
    """Destinations that keep out of an obstacle, and the first ones that are handed out."""
    compiled, room = EXAMPLE.program(PHOTO), Room(shapes_of(EXAMPLE.world)[0], RADIUS)
    figure, (left, right) = plt.subplots(1, 2, figsize=(11.0, 5.4), layout='constrained')
    for axes in (left, right):
        axes.add_patch(Annulus((50.0, 50.0), 30.0, 10.0, color='#8fd19e', lw=0))
        axes.add_patch(Outline(HOUSE.corners, color='0.45'))
    EXAMPLE.prepare(left, 'descents that end in an obstacle go on until they have left it')
    rng = np.random.default_rng(3)
    starts = rng.uniform((50.0, 30.0, -3.0), (110.0, 85.0, 3.0), (24, 3))
    ends = descend(compiled, starts).states
    blocked = ends[clearances(room.shapes, ends) < RADIUS]
    free = descend(compiled, blocked, room=room)
    for begin, end in zip(blocked[free.satisfied], free.states[free.satisfied], strict=True):
        left.plot(*np.column_stack((begin, end))[:2], '-', color='tab:red', lw=1.2, zorder=4)
        left.plot(*begin[:2], 'o', color='tab:red', mfc='white', ms=5, zorder=5)
        arrow(left, end, 'tab:blue')
    EXAMPLE.prepare(right, 'destinations: each is the farthest from those before it')
    found = destinations(compiled, START, EXAMPLE.world.bounds, np.random.default_rng(0), 16, room)
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
