"""One descent, step by step, as a compiled machine: the inner loop of Algorithm 1.

The machine is told the residuals and their derivatives where it last asked for them, and asks for
the next place. So the same steps serve programs of primitive operations, which are evaluated in the
same kernel, and those whose functions are batches of numpy.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.satisfaction.evaluation import ALLOWED

#: Phases of a descent: the paper's steps, damped Gauss-Newton steps, over.
TRUNCATED, DAMPED, DONE = 0, 1, 2

#: Keeps the matrices of damped steps regular, relative to their size.
_LEAST_PIVOT = 1e-12
_MOST_DAMPING = 1e8

#: A step of the paper that leaves more than this share of the criterion hands over to damped steps,
#: two damped steps in turn that each leave more than that share have come to a standstill.
_SLOW, _STALL = 0.25, 0.999


class Limits(NamedTuple):
    """Limits of a descent; `DescentOptions` says what they mean."""

    truncated_steps: int
    damped_steps: int
    halvings: int
    length: float


# A machine is two arrays, so that they can stand in registers and caches. Its head (HEAD,) holds:
# the phase, whether the trial is the phase's first, steps tried in the phase, halvings of the step,
# steps taken in all, the criterion at the best place, and the step length or the damping;
PHASE, _FIRST, _TRIED, _HALVED, TAKEN, _CRITERION, _STEP = range(7)
# the best place, the trial, which is to be evaluated, the direction of its step, and how many damped
# steps in turn have hardly helped.
BEST, TRIAL, _DIRECTION, _STALLED, HEAD = 7, 10, 13, 16, 17
# Its memory (m, MEMORY) holds residuals and their slopes at the best place, and their weights.
_RESIDUAL, _SLOPE, _WEIGHT, MEMORY = 0, 1, 4, 5


@kernel
def start(head: Array, state: Array, limits: Limits) -> None:
    """Begin a descent at ``state`` (3,)."""
    head[:] = 0.0
    head[_FIRST] = 1.0
    if limits.truncated_steps == 0:
        head[PHASE] = DAMPED
    for axis in range(3):
        head[BEST + axis] = head[TRIAL + axis] = state[axis]


@kernel
def advance(head: Array, memory: Array, limits: Limits, told: Array, conditions: Array) -> None:
    """Take note of what is ``told`` of the trial, and set the next one.

    ``told`` (m, 4) are residuals and their derivatives; ``conditions`` (m, 4) have, in their last
    column, the residuals with which the descent is over.
    """
    if head[PHASE] == TRUNCATED:
        _advance_truncated(head, memory, limits, told, conditions)
    else:
        _advance_damped(head, memory, limits, told, conditions)


@kernel
def _is_met(memory: Array, conditions: Array) -> bool:
    for row in range(len(memory)):
        if not abs(memory[row, _RESIDUAL]) <= conditions[row, ALLOWED]:
            return False
    return True


@kernel
def _accept(head: Array, memory: Array, criterion: float, told: Array) -> None:
    for axis in range(3):
        head[BEST + axis] = head[TRIAL + axis]
    head[_CRITERION] = criterion
    for row in range(len(memory)):
        for column in range(4):
            memory[row, column] = told[row, column]
    if head[_FIRST] == 0.0:
        head[TAKEN] += 1.0
    head[_FIRST] = 0.0


@kernel
def _advance_truncated(
    head: Array, memory: Array, limits: Limits, told: Array, conditions: Array
) -> None:
    """Equation 5 with the derived codes of Table 2, while it helps much."""
    criterion = 0.0
    for row in range(len(memory)):
        criterion += 0.5 * told[row, _RESIDUAL] * told[row, _RESIDUAL]
    if head[_FIRST] or criterion < head[_CRITERION]:
        is_slow = head[_FIRST] == 0.0 and criterion > _SLOW * head[_CRITERION]
        _accept(head, memory, criterion, told)
        if _is_met(memory, conditions):
            head[PHASE] = DONE
            return
        steepness = 0.0
        for axis in range(3):
            slope = 0.0
            for row in range(len(memory)):
                slope += memory[row, _RESIDUAL] * memory[row, _SLOPE + axis]
            head[_DIRECTION + axis] = -slope
            steepness += abs(slope)
        head[_STEP] = 1.0
        head[_HALVED] = 0.0
        head[_TRIED] += 1.0
        is_over = is_slow or head[_TRIED] > limits.truncated_steps or steepness == 0.0
    else:
        head[_STEP] *= 0.5
        head[_HALVED] += 1.0
        is_over = head[_HALVED] >= limits.halvings
    if is_over:
        head[PHASE], head[_FIRST], head[_TRIED] = DAMPED, 1.0, 0.0
    for axis in range(3):
        step = 0.0 if is_over else head[_STEP] * head[_DIRECTION + axis]
        head[TRIAL + axis] = head[BEST + axis] + step


@kernel
def _advance_damped(
    head: Array, memory: Array, limits: Limits, told: Array, conditions: Array
) -> None:
    """Levenberg-Marquardt in scaled variables, until damping no longer helps.

    Each residual is weighed by the slope that it has at first, so that metres and radians count
    alike in the damping and in the sum that has to decrease.
    """
    is_first = head[_FIRST] == 1.0
    if is_first:
        for row in range(len(memory)):
            across = (told[row, _SLOPE] ** 2 + told[row, _SLOPE + 1] ** 2) * limits.length**2
            slope = sqrt(across + told[row, _SLOPE + 2] ** 2)
            memory[row, _WEIGHT] = 1.0 / slope if slope > 1e-30 else 1.0
        head[_STEP] = 1e-3
    criterion = 0.0
    for row in range(len(memory)):
        criterion += (told[row, _RESIDUAL] * memory[row, _WEIGHT]) ** 2
    if is_first or criterion < head[_CRITERION]:
        if not is_first:
            head[_STEP] = max(0.1 * head[_STEP], 1e-12)
            head[_STALLED] = head[_STALLED] + 1.0 if criterion > _STALL * head[_CRITERION] else 0.0
        _accept(head, memory, criterion, told)
        if _is_met(memory, conditions):
            head[PHASE] = DONE
            return
    else:
        head[_STEP] *= 8.0
    is_stuck = head[_STALLED] > 1.0 or not head[_STEP] < _MOST_DAMPING
    if is_stuck or head[_TRIED] >= limits.damped_steps:
        head[PHASE] = DONE
        return
    head[_TRIED] += 1.0
    _damped_step(head, memory, limits.length)


@kernel
def _damped_step(head: Array, memory: Array, length: float) -> None:
    """Set the trial to best + d with (J^T J + mu I) d = -J^T f, J in scaled variables.

    The matrix is symmetric and positive definite, so it is solved by its L D L^T factors.
    """
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    u, v, w = 0.0, 0.0, 0.0
    for row in range(len(memory)):
        weight = memory[row, _WEIGHT]
        residual = memory[row, _RESIDUAL] * weight
        if residual != 0.0:
            x = memory[row, _SLOPE] * weight * length
            y = memory[row, _SLOPE + 1] * weight * length
            z = memory[row, _SLOPE + 2] * weight
            a, b, c = a + x * x, b + x * y, c + x * z
            d, e, f = d + y * y, e + y * z, f + z * z
            u, v, w = u - x * residual, v - y * residual, w - z * residual
    damping = head[_STEP] + _LEAST_PIVOT * (1e-30 + a + d + f)
    a, d, f = a + damping, d + damping, f + damping
    p, q = b / a, c / a
    second = d - p * b
    s = (e - p * c) / second
    third = f - q * c - s * (e - p * c)
    v -= p * u
    w -= q * u + s * v
    z = w / third
    y = v / second - s * z
    x = u / a - p * y - q * z
    head[TRIAL] = head[BEST] + length * x
    head[TRIAL + 1] = head[BEST + 1] + length * y
    head[TRIAL + 2] = head[BEST + 2] + z
