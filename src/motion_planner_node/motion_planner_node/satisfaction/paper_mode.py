"""The paper's own solver: equations 1 to 8, Table 2 and Algorithm 1, each line under its number.

What the paper leaves open or gets wrong in floating point is mended, and marked "Mended"; all of it
is told in docs/solver.md. The default solver (``descend``) is faster and solves more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import pi
from typing import NamedTuple, TypeVar

import numpy as np

from motion_planner_node.functions import Array, Dual
from motion_planner_node.robots.arcs import wrap_angle
from motion_planner_node.satisfaction.program import Program

Path = TypeVar('Path')


@dataclass(frozen=True, slots=True)
class PaperLimits:
    """The constants of Algorithm 1.

    Attributes:
        max_tries: maxTries, descents from the start and then from random states
        max_steps: maxK, steps of one descent
        halvings: the step length of equation 5 is halved so often at most (Mended: the paper halves
            it for ever where no length helps)
    """

    max_tries: int = 200
    max_steps: int = 100
    halvings: int = 40


class Iterate(NamedTuple):
    """One state vector r_k of one descent, for traces.

    Attributes:
        attempt: nbTries, 0 for the descent from the start
        k: number of the step
        state: (3,) x, y [m], heading [rad]
        criterion: F(r_k)
        gradient: (3,) of F at r_k
        step_length: lambda that led here; 0 for the first
    """

    attempt: int
    k: int
    state: Array
    criterion: float
    gradient: Array
    step_length: float


class PaperCriterion:
    """F of a program (equations 1 to 4) and its gradient (equations 6 to 8)."""

    def __init__(self, program: Program) -> None:
        self._program = program

    def functions(self, state: Array) -> list[tuple[bool, float, Array]]:
        """The functions f_i at ``state`` (3,): whether from an equality, f_i and its gradient (3,).

        A constraint becomes left minus right side, with its sign reversed for >=. One that equates
        angles becomes two: one of cosines, one of sines. Gradients consist of the derived codes of
        Table 2; an undefined function counts 1 and has no slope (Mended: division by zero).
        """
        result = []
        with np.errstate(all='ignore'):
            sides = self._program.sides(state[None, :], derivatives='truncated')
            for row, (left, right) in zip(self._program.rows, sides, strict=True):
                if row.periodic:
                    derived = [left.cos() - right.cos(), left.sin() - right.sin()]
                else:
                    derived = [right - left if row.is_reversed else left - right]
                result += [(row.is_equality, *_known(function)) for function in derived]
        return result

    def value(self, state: Array) -> float:
        """F(r), the sum of G_i(f_i(r)) (equations 1 and 2)."""
        total = 0.0
        for is_equality, f, _ in self.functions(state):
            if is_equality:
                total += 0.5 * f * f  # equation 3
            else:
                total += 0.5 * f * f * _heaviside(f)  # equation 4
        return total

    def gradient(self, state: Array) -> Array:
        """Gradient of F, (3,): the sum of the gradients of f_i times that of G_i (equation 6)."""
        total = np.zeros(3)
        for is_equality, f, slope in self.functions(state):
            if is_equality:
                total += slope * f  # equation 7
            else:
                total += slope * f * _heaviside(f)  # equation 8
        return total

    def is_zero(self, state: Array) -> bool:
        """Mended: "F(r) > 0" never ends in floating point, so each constraint has a tolerance."""
        return bool(self._program.satisfied(state[None, :])[0])

    def next_state(self, state: Array, halvings: int) -> tuple[Array, float] | None:
        """r_{k+1} of equation 5 and its step length; None where no length makes F smaller."""
        before, gradient = self.value(state), self.gradient(state)
        step_length = 1.0  # "At each iteration, lambda_k is initialized to 1 ...
        for _ in range(halvings):
            following = state - step_length * gradient
            if self.value(following) < before:
                following[2] = wrap_angle(float(following[2]))
                return following, step_length
            step_length *= 0.5  # ... and divided by 2 until F(r_{k+1}) < F(r_k)"
        return None


def algorithm_1(
    criterion: PaperCriterion,
    start: Array,
    random_state: Callable[[], Array],
    not_in_obstacle: Callable[[Array], bool],
    find_path: Callable[[Array], Path | None],
    limits: PaperLimits = PaperLimits(),
    trace: Callable[[Iterate], None] | None = None,
) -> Iterator[Path]:
    """Paths to states that satisfy the criterion: Algorithm 1, which goes on when asked for more.

    Mended: the paper stores in noPathFound that a path was found; it tests r_{k+1} where its loop has
    left the last state in r_k; and it looks for a path to whatever the descent has ended with.
    """
    r = start.copy()  # 1: r_0 = S
    for attempt in range(limits.max_tries):  # 3: while nbTries < maxTries, 18: nbTries + 1
        k, step_length = 0, 0.0  # 4
        _note(trace, criterion, attempt, k, r, step_length)
        while not criterion.is_zero(r) and k < limits.max_steps:  # 5
            proposed = criterion.next_state(r, limits.halvings)  # 6 and 7
            if proposed is None:  # Mended: a minimum with F > 0, or a saddle
                break
            r, step_length = proposed
            k += 1  # 8
            _note(trace, criterion, attempt, k, r, step_length)
        if criterion.is_zero(r) and not_in_obstacle(r):  # 10
            path = find_path(r)  # 11
            if path is not None:
                yield path
        r = random_state()  # 13 and 16: r_0 = S_rand()


def _note(
    trace: Callable[[Iterate], None] | None,
    criterion: PaperCriterion,
    attempt: int,
    k: int,
    state: Array,
    step_length: float,
) -> None:
    if trace is not None:
        value, gradient = criterion.value(state), criterion.gradient(state)
        trace(Iterate(attempt, k, state.copy(), value, gradient, step_length))


def _heaviside(value: float) -> float:
    """H of equation 4: 0 where the constraint is satisfied, 1 otherwise."""
    return 1.0 if value > 0.0 else 0.0


def _known(function: Dual) -> tuple[float, Array]:
    value = float(np.ravel(function.value)[0])
    if np.isnan(value) or function.gradient is None:
        return (1.0 if np.isnan(value) else value), np.zeros(3)
    return value, np.nan_to_num(function.gradient[:, 0], posinf=0.0, neginf=0.0)


def random_states(
    rng: np.random.Generator, low: tuple[float, float], high: tuple[float, float]
) -> Callable[[], Array]:
    """S_rand of Algorithm 1: states with x and y [m] between ``low`` and ``high``, any heading."""

    def random_state() -> Array:
        return rng.uniform((*low, -pi), (*high, pi))

    return random_state
