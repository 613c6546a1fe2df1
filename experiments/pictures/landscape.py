"""A robot, an object and the penalty of constraints between them, to draw and to descend in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import BoundaryNorm

from motion_planner_node.functions import Array
from motion_planner_node.language import parse
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program, compile_program
from motion_planner_node.satisfaction.paper_mode import (
    Iterate,
    PaperCriterion,
    algorithm_1,
    random_states,
)
from motion_planner_node.world.model import Bounds, Obstacle, World, WorldObject

COLOURS = [f'C{index}' for index in range(10)]
LEVELS = (1e-9, 5.0, 25.0, 100.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0)
RADIUS = 3.0


@dataclass(frozen=True)
class Landscape:
    """A square of ``size`` [m] with the object o at ``place`` [m] and the robot r at ``start``."""

    size: float
    place: tuple[float, float]
    start: Attitude
    obstacles: tuple[Obstacle, ...] = ()

    @property
    def world(self) -> World:
        """Everything that is there."""
        x, y = self.place
        return World(
            source='',
            revision='',
            bounds=Bounds(0.0, 0.0, self.size, self.size),
            objects={'o': WorldObject('o', {'x': x, 'y': y})},
            obstacles=self.obstacles,
            robots={'r': Robot('r', 4.0, 0.5, RADIUS, 2.0)},
        )

    def program(self, text: str) -> Program:
        """The constraints of ``text`` on the robot r and the object o."""
        return compile_program(parse(f'(agent r)(object o){text}'), self.world, {'r': self.start})

    def trace(self, text: str, descents: int, random_state: Callable[[], Array]) -> list[Iterate]:
        """All iterates of some descents of Algorithm 1, from the start and from random states."""
        trace: list[Iterate] = []
        states = algorithm_1(
            PaperCriterion(self.program(text)),
            np.array([self.start.x, self.start.y, self.start.heading]),
            random_state,
            lambda _: True,
            lambda state: state,
            trace=trace.append,
        )
        list(islice(states, descents))
        return trace

    def random_states(self, seed: int) -> Callable[[], Array]:
        """States anywhere but at the edge."""
        low, high = self.size / 24.0, self.size * 23.0 / 24.0
        return random_states(np.random.default_rng(seed), (low, low), (high, high))

    def grid(self, cells: int) -> tuple[Array, Array]:
        """Positions [m], x and y, of the corners of ``cells`` times ``cells`` cells."""
        x, y = np.meshgrid(*2 * [np.linspace(0.0, self.size, cells + 1)])
        return x, y

    def prepare(self, axes: Axes, title: str) -> None:
        """The object, and the axes."""
        axes.plot(*self.place, marker='s', color='gold', markeredgecolor='black', ms=8, zorder=5)
        axes.annotate('o', self.place, (6, 6), textcoords='offset points')
        axes.set(xlim=(0, self.size), ylim=(0, self.size), aspect='equal')
        axes.set(xlabel='x [m]', ylabel='y [m]')
        axes.set_title(title, fontsize=10)


def at_best_heading(program: Program, x: Array, y: Array) -> Array:
    """F at positions for the best heading: angles that can be met by turning on the spot add nothing."""
    rows = [index for index, row in enumerate(program.rows) if not row.periodic]
    return at_heading(program.only(rows), x, y, 0.0)


def at_heading(program: Program, x: Array, y: Array, heading: float) -> Array:
    """F at positions for one heading [rad]: half the sum of the squared violations."""
    states = np.column_stack((x.ravel(), y.ravel(), np.full(x.size, heading)))
    total: Array = 0.5 * np.square(program.violations(states)).sum(axis=1)
    return total.reshape(x.shape)


def shade(axes: Axes, x: Array, y: Array, field: Array, levels: tuple[float, ...] = LEVELS) -> None:
    """Shade F over positions, green where it is 0."""
    norm = BoundaryNorm(levels, 256)
    shades = axes.contourf(x, y, field, levels, cmap='YlOrBr', norm=norm, alpha=0.8)
    axes.contourf(x, y, field, [-1.0, levels[0]], colors=['#8fd19e'])
    bar = axes.figure.colorbar(shades, ax=axes, shrink=0.8, label='penalty F', ticks=levels)
    bar.ax.set_yticklabels(['0', *(f'{level:g}' for level in levels[1:])])


def arrow(axes: Axes, state: Array, colour: object, size: float = 5.0) -> None:
    """The heading of one attitude; ``size`` [m]."""
    x, y, heading = state
    axes.arrow(
        x,
        y,
        size * np.cos(heading),
        size * np.sin(heading),
        color=colour,
        width=size / 20.0,
        head_width=size * 0.36,
        length_includes_head=True,
        zorder=6,
    )


def draw_descents(axes: Axes, descents: list[Array], size: float = 0.0) -> None:
    """The states (k, 3) of each descent in a colour of its own, the first one of each hollow.

    With ``size`` [m] the first and the last one have arrows along their headings.
    """
    for number, states in enumerate(descents):
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(*states[:, :2].T, '-o', color=colour, ms=4, lw=1.4, zorder=4)
        axes.plot(*states[0, :2], 'o', color=colour, mfc='white', ms=6, zorder=5)
        if size:
            arrow(axes, states[0], colour, size)
            arrow(axes, states[-1], colour, size)


def descents_of(trace: list[Iterate]) -> list[Array]:
    """The states (k, 3) of each descent of a trace."""
    return [
        np.array([iterate.state for iterate in trace if iterate.attempt == attempt])
        for attempt in range(trace[-1].attempt + 1)
    ]
