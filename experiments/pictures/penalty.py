"""The penalty of the paper's photo (Figure 3) over positions, with descents of both modes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import matplotlib

matplotlib.use('Agg')

import matplotlib.pyplot as plt
import numpy as np

from experiments.pictures.landscape import (
    Landscape,
    at_best_heading,
    at_heading,
    descents_of,
    draw_descents,
    shade,
)
from motion_planner_node.functions import Array
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction import DescentOptions, Program, descend
from motion_planner_node.satisfaction.paper_mode import PaperCriterion

PHOTO = '(distance(r, o) >= 50)(distance(r, o) <= 100)(rel_angle(r, o) = cos-and-sin(pi/2))'
FIELD = Landscape(300.0, (150.0, 150.0), Attitude(20.0, 270.0, 0.0))
#: At a fixed heading the angle adds 2 at most, so the levels begin low.
LEVELS = (1e-9, 0.02, 0.1, 0.5, 1.0, 2.0, 5.0, 25.0, 100.0, 500.0, 2000.0, 8000.0)
#: Length of an arrow [m].
ARROW = 16.0
MODES = ('paper', 'default')


def paper_field(program: Program, x: Array, y: Array, heading: float) -> Array:
    """F of the paper at positions for one heading [rad]: cosine and sine of an angle are two functions."""
    criterion = PaperCriterion(program)
    states = zip(x.ravel(), y.ravel(), strict=True)
    values = [criterion.value(np.array([a, b, heading])) for a, b in states]
    return np.reshape(values, x.shape)


def starts(count: int, seed: int, heading: float | None) -> Iterator[Array]:
    """Where the descents begin: the robot's place, then random ones; all at ``heading`` if given."""
    begin = FIELD.start
    random_state = FIELD.random_states(seed)
    for number in range(count):
        state = np.array([begin.x, begin.y, begin.heading]) if number == 0 else random_state()
        if heading is not None:
            state[2] = heading
        yield state


def descents(mode: str, states: Iterator[Array]) -> list[Array]:
    """The iterates (k, 3) of the descent from each state."""
    if mode == 'paper':
        begin = next(states)
        field = replace(FIELD, start=Attitude(*map(float, begin)))
        others = list(states)
        following = iter(others)
        trace = field.trace(PHOTO, len(others) + 1, lambda: next(following, begin))
        return descents_of(trace)[: len(others) + 1]
    return [iterates(FIELD.program(PHOTO), state) for state in states]


def iterates(program: Program, state: Array) -> Array:
    """The states (k, 3) of the default descent from ``state``: where it stands after each step."""
    whole = DescentOptions()
    found = [state]
    for truncated, damped in (
        *((steps, 0) for steps in range(1, whole.truncated_steps + 1)),
        *((whole.truncated_steps, steps) for steps in range(1, whole.damped_steps + 1)),
    ):
        options = replace(whole, truncated_steps=truncated, damped_steps=damped, retries=0)
        result = descend(program, state, options)
        if not np.array_equal(result.states[0], found[-1]):
            found.append(result.states[0])
        if result.satisfied[0]:
            break
    return np.array(found)


def draw(stem: Path, cells: int, count: int, seed: int) -> tuple[Path, dict[str, list[Array]]]:
    """Draw SVG and PNG; the latter's path, and the iterates (k, 3) of each descent by mode.

    Rows are modes; columns the best heading, and heading 0, from which those descents begin.
    """
    x, y = FIELD.grid(cells)
    program = FIELD.program(PHOTO)
    figure, panels = plt.subplots(2, 2, figsize=(12.5, 10.4), layout='compressed')
    found: dict[str, list[Array]] = {mode: [] for mode in MODES}
    for mode, row in zip(MODES, panels, strict=True):
        fixed = paper_field if mode == 'paper' else at_heading
        fields = at_best_heading(program, x, y), fixed(program, x, y, 0.0)
        for axes, field, heading in zip(row, fields, (None, 0.0), strict=True):
            shade(axes, x, y, field, LEVELS)
            place = 'at the best heading' if heading is None else 'at heading 0'
            FIELD.prepare(axes, f'{mode} mode: F {place}')
            axes.label_outer()
            drawn = descents(mode, starts(count, seed, heading))
            draw_descents(axes, drawn, ARROW)
            found[mode] += drawn
    png = stem.with_suffix('.png')
    figure.savefig(stem.with_suffix('.svg'))
    figure.savefig(png, dpi=110)
    plt.close(figure)
    return png, found


def violation(descents: Iterable[Array]) -> float:
    """The greatest violation [m or rad] of the photo's constraints where descents (k, 3) end."""
    ends = np.array([states[-1] for states in descents])
    return float(np.maximum(FIELD.program(PHOTO).violations(ends), 0.0).max())
