"""Table 2: the functions and derived codes of the library and of the paper, against finite differences."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import nan, pi

import numpy as np

from motion_planner_node.functions import FUNCTIONS, Array, Dual, Place

#: Least distance [m] to the object: nearer to it, differences say little of derivatives.
NEAREST = 1.0
#: Of the central differences [m or rad].
STEP = 1e-4
COMPONENTS = {'x': 0, 'y': 1, 'theta': 2}
Formula = Callable[[Array, Array, Array], Array]


def _root(dx: Array, dy: Array) -> Array:
    return np.sqrt(dx**2 + dy**2)


#: As printed; dx and dy lead from the robot to the object, t is the heading.
FORMULAS: Mapping[str, Formula] = {
    'distance f1': lambda dx, dy, _: _root(dx, dy),
    'rel_angle f1': lambda dx, dy, t: (dx * np.cos(t) + dy * np.sin(t)) / _root(dx, dy),
    'rel_angle f2': lambda dx, dy, t: (dx * np.sin(t) - dy * np.cos(t)) / _root(dx, dy),
}
DERIVED: Mapping[tuple[str, str], Formula] = {
    ('distance f1', 'x'): lambda dx, dy, _: -dx / _root(dx, dy),
    ('distance f1', 'y'): lambda dx, dy, _: -dy / _root(dx, dy),
    ('rel_angle f1', 'theta'): lambda dx, dy, t: (-dx * np.sin(t) + dy * np.cos(t)) / _root(dx, dy),
    ('rel_angle f2', 'theta'): lambda dx, dy, t: (dx * np.cos(t) + dy * np.sin(t)) / _root(dx, dy),
}


@dataclass(frozen=True)
class Check:
    """The greatest deviations from central differences, over all states, of one derivative.

    printed: of the derived code in Table 2, NaN where that has none
    library: of the library's derivative with all components
    kept: whether the library's truncated gradient, that of the paper, has it; else it is 0 there
    greatest: the greatest absolute value of the difference quotients
    """

    function: str
    component: str
    printed: float
    library: float
    kept: bool
    greatest: float


def random_states(count: int, seed: int) -> tuple[Array, tuple[float, float]]:
    """Attitudes (count, 3) over the rover's world, and an object that none is on."""
    rng = np.random.default_rng(seed)
    place = (400.0, 300.0)
    states = rng.uniform((0.0, 0.0, -pi), (800.0, 600.0, pi), (count, 3))
    away = np.hypot(states[:, 0] - place[0], states[:, 1] - place[1])
    return states[away >= NEAREST], place


def checks(count: int, seed: int) -> list[Check]:
    """Every function by every component."""
    states, place = random_states(count, seed)
    found = []
    for name, formula in FORMULAS.items():
        full, truncated = _library(name, states, place, whole=True), _library(name, states, place)
        for component, index in COMPONENTS.items():
            slope = _difference(formula, states, place, index)
            printed = DERIVED.get((name, component))
            found.append(
                Check(
                    name,
                    component,
                    nan if printed is None else _apart(_at(printed, states, place), slope),
                    _apart(full[index], slope),
                    bool(np.any(truncated[index])),
                    float(np.abs(slope).max()),
                )
            )
    return found


def _at(formula: Formula, states: Array, place: tuple[float, float]) -> Array:
    return formula(place[0] - states[:, 0], place[1] - states[:, 1], states[:, 2])


def _difference(formula: Formula, states: Array, place: tuple[float, float], index: int) -> Array:
    step = np.zeros(3)
    step[index] = STEP
    return (_at(formula, states + step, place) - _at(formula, states - step, place)) / (2.0 * STEP)


def _apart(values: Array, others: Array) -> float:
    return float(np.abs(values - others).max())


def _library(name: str, states: Array, place: tuple[float, float], *, whole: bool = False) -> Array:
    """The library's gradients (3, n); ``whole`` keeps what the paper leaves out."""
    unit = np.eye(3)[:, :, None] * np.ones(len(states))
    robot = Place(*(Dual(states[:, index], unit[index]) for index in range(3)))
    target = Place(*(Dual.constant(value) for value in (*place, nan)))
    function, part = name.split()
    of = FUNCTIONS[function]
    result: Dual = of.value(robot, target) if whole else of.truncated(robot, target)
    if function == 'rel_angle':
        result = result.cos() if part == 'f1' else result.sin()
    if result.gradient is None:
        raise ValueError(f'{name} has no derivatives')
    return result.gradient
