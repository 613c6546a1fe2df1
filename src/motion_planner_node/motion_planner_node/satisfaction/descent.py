"""From attitudes to attitudes that satisfy a program: the inner loop of Algorithm 1, in batches.

The first steps are the paper's: along the truncated gradient, which turns the robot rather than
moves it. What they do not solve, damped Gauss-Newton steps (Levenberg-Marquardt) on the full
derivatives do, in variables scaled so that a radian and a length weigh alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.satisfaction.penalty import Penalty, is_met, penalty
from motion_planner_node.satisfaction.program import Program
from motion_planner_node.satisfaction.row import wrap

#: Keeps the matrices of damped steps regular, relative to their size.
_LEAST_PIVOT = 1e-12


@dataclass(frozen=True, slots=True)
class DescentOptions:
    """Limits of a descent.

    Attributes:
        truncated_steps: at most so many steps of the paper come first
        damped_steps: at most so many Levenberg-Marquardt steps follow
        halvings: the step length of equation 5 starts at 1 and is halved so often at most
        length: what weighs as much as a radian [m]
    """

    truncated_steps: int = 8
    damped_steps: int = 50
    halvings: int = 20
    length: float = 50.0


@dataclass(frozen=True, slots=True)
class Descent:
    """Where n descents ended.

    Attributes:
        states: (n, 3) x, y [m] and heading [rad] in (-pi, pi]
        satisfied: (n,) whether all constraints are met
        violations: (n, m) by how much each constraint is missed
        iterations: (n,) steps taken
    """

    states: Array
    satisfied: NDArray[np.bool_]
    violations: Array
    iterations: NDArray[np.int64]

    @property
    def best(self) -> int:
        """Index of the attitude that comes closest: the least sum of squared violations."""
        with np.errstate(over='ignore'):
            return int(np.argmin((self.violations**2).sum(axis=1)))


def descend(program: Program, states: Array, options: DescentOptions = DescentOptions()) -> Descent:
    """Descend from each of ``states`` (n, 3) until all constraints are met or no step helps."""
    current = np.array(states, dtype=np.float64).reshape(-1, 3)
    iterations = np.zeros(len(current), dtype=np.int64)
    with np.errstate(over='ignore', invalid='ignore'):
        unmet = _truncated_descent(program, current, iterations, options)
        if len(unmet):
            _damped_descent(program, current, unmet, iterations, options)
    current[:, 2] = wrap(current[:, 2])
    violations = program.violations(current)
    return Descent(current, program.meets(violations), violations, iterations)


def _truncated_descent(
    program: Program, states: Array, iterations: NDArray[np.int64], options: DescentOptions
) -> NDArray[np.int64]:
    """Equation 5 with the derived codes of Table 2, in place; stops where no step length helps.

    Returns the indices of the states that it has not brought to their end.
    """
    active = np.arange(len(states))
    stalled = []
    for _ in range(options.truncated_steps):
        at = penalty(program, states[active], derivatives='truncated')
        going = ~is_met(program, at.residuals)
        active, gradient, before = active[going], at.gradient.T[going], at.total[going]
        if not len(active):
            break
        improved = _line_search(program, states, active, gradient, before, options.halvings)
        stalled.append(active[~improved])
        active = active[improved]
        iterations[active] += 1
    return np.sort(np.concatenate((active, *stalled)))


def _line_search(
    program: Program,
    states: Array,
    active: NDArray[np.int64],
    gradient: Array,
    before: Array,
    halvings: int,
) -> NDArray[np.bool_]:
    """Step along -gradient, from length 1 halved until F decreases; says where it did."""
    improved = np.zeros(len(active), dtype=np.bool_)
    waiting = np.arange(len(active))
    step = 1.0
    for _ in range(halvings):
        proposed = states[active[waiting]] - step * gradient[waiting]
        total = penalty(program, proposed, derivatives='none').total
        better = total < before[waiting]
        states[active[waiting[better]]] = proposed[better]
        improved[waiting[better]] = True
        waiting = waiting[~better]
        if not len(waiting):
            break
        step *= 0.5
    return improved


def _damped_descent(
    program: Program,
    states: Array,
    active: NDArray[np.int64],
    iterations: NDArray[np.int64],
    options: DescentOptions,
) -> None:
    """Levenberg-Marquardt in scaled variables, in place; stops where damping no longer helps.

    Each residual is weighed by the slope that it has at first, so that metres and radians count
    alike in the damping and in the sum that has to decrease.
    """
    scale = np.array([options.length, options.length, 1.0])
    at = penalty(program, states[active], derivatives='full')
    slopes = np.sqrt(np.square(at.slopes * scale[:, None]).sum(axis=1))
    weights = 1.0 / np.where(slopes > 1e-30, slopes, 1.0)
    damping = np.full(len(active), 1e-3)
    for _ in range(options.damped_steps):
        going = ~is_met(program, at.residuals) & (damping < 1e8)
        if not going.all():
            active, damping, weights = active[going], damping[going], weights[:, going]
            at = Penalty(*(part[..., going] for part in (at.residuals, at.jacobian, at.slopes)))
        if not len(active):
            return
        proposed = states[active] + _damped_step(at, weights, damping, scale)
        new = penalty(program, proposed, derivatives='full')
        better = new.weighed(weights) < at.weighed(weights)
        states[active[better]] = proposed[better]
        iterations[active[better]] += 1
        damping = np.where(better, np.maximum(damping * 0.1, 1e-12), damping * 8.0)
        at = Penalty(
            *(
                np.where(better, a, b)
                for a, b in (
                    (new.residuals, at.residuals),
                    (new.jacobian, at.jacobian),
                    (new.slopes, at.slopes),
                )
            )
        )


def _damped_step(at: Penalty, weights: Array, damping: Array, scale: Array) -> Array:
    """Solve (J^T J + mu I) d = -J^T f for each attitude, J in scaled variables; d is (n, 3)."""
    jacobian = (at.jacobian * weights[:, None, :]).transpose(2, 0, 1) * scale
    transposed = jacobian.transpose(0, 2, 1)
    matrix = transposed @ jacobian
    right = transposed @ (at.residuals * weights).T[:, :, None]
    least = _LEAST_PIVOT * (1e-30 + np.trace(matrix, axis1=1, axis2=2))
    matrix += (damping + least)[:, None, None] * np.eye(3)
    return np.asarray(-np.linalg.solve(matrix, right)[:, :, 0] * scale)
