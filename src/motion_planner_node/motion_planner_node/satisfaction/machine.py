"""One descent, step by step, as a compiled machine: the inner loop of Algorithm 1.

The machine is told the residuals and their derivatives where it last asked for them, and asks for
the next place. So the same steps serve programs of primitive operations, which are evaluated in the
same kernel, and those whose functions are batches of numpy.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from motion_planner_node.functions import Array
from motion_planner_node.robots.kernel import part
from motion_planner_node.satisfaction.evaluation import ALLOWED

#: Phases of a descent: the paper's steps, damped Gauss-Newton steps, over.
TRUNCATED, DAMPED, DONE = 0, 1, 2

#: Keeps the matrices of damped steps regular, relative to their size.
_LEAST_PIVOT = 1e-12
_MOST_DAMPING = 1e8

#: A step of the paper that leaves more than this share of the criterion hands over to damped steps,
#: two damped steps in turn that each leave more than that share have come to a standstill.
_SLOW, _STALL = 0.25, 0.999

#: Damping at first, and its factors after a step that helps and one that does not.
_FIRST_DAMPING, _RELIEF, _STRAIN = 0.01, 0.5, 8.0

#: A step that is damped no more than this, and promises to reduce the criterion by less than that
#: share, has come to a minimum.
_HARDLY_DAMPED, _HOPELESS = 1e-5, 1e-3


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


@part
def start(head: Array, x: float, y: float, heading: float, limits: Limits) -> None:
    """Begin a descent at the attitude (x, y [m], heading [rad])."""
    head[:] = 0.0
    head[_FIRST] = 1.0
    if limits.truncated_steps == 0:
        head[PHASE] = DAMPED
    head[BEST] = head[TRIAL] = x
    head[BEST + 1] = head[TRIAL + 1] = y
    head[BEST + 2] = head[TRIAL + 2] = heading


@part
def advance(head: Array, memory: Array, limits: Limits, told: Array, conditions: Array) -> None:
    """Take note of what is ``told`` of the trial, and set the next one.

    ``told`` (m, 4) are residuals and their derivatives; ``conditions`` (m, 4) have, in their last
    column, the residuals with which the descent is over.
    """
    if head[PHASE] == TRUNCATED:
        _advance_truncated(head, limits, told, conditions)
    else:
        _advance_damped(head, memory, limits, told, conditions)


@part
def _is_met(told: Array, conditions: Array) -> bool:
    result = True
    for row in range(len(told)):
        result = result and abs(told[row, _RESIDUAL]) <= conditions[row, ALLOWED]
    return result


@part
def _accept(head: Array, criterion: float) -> None:
    for axis in range(3):
        head[BEST + axis] = head[TRIAL + axis]
    head[_CRITERION] = criterion
    if head[_FIRST] == 0.0:
        head[TAKEN] += 1.0
    head[_FIRST] = 0.0


@part
def _advance_truncated(head: Array, limits: Limits, told: Array, conditions: Array) -> None:
    """Equation 5 with the derived codes of Table 2, while it helps much."""
    criterion = 0.0
    for row in range(len(told)):
        criterion += 0.5 * told[row, _RESIDUAL] * told[row, _RESIDUAL]
    if head[_FIRST] or criterion < head[_CRITERION]:
        is_slow = head[_FIRST] == 0.0 and criterion > _SLOW * head[_CRITERION]
        _accept(head, criterion)
        head[_TRIED] += 1.0
        head[_STEP], head[_HALVED] = 1.0, 0.0
        is_promising = _gradient_step(head, told) < _SLOW * criterion
        is_over = is_slow or head[_TRIED] > limits.truncated_steps or not is_promising
        if _is_met(told, conditions):
            head[PHASE] = DONE
    else:
        head[_STEP] *= 0.5
        head[_HALVED] += 1.0
        is_over = head[_HALVED] >= limits.halvings
    for axis in range(3):
        step = 0.0 if is_over else head[_STEP] * head[_DIRECTION + axis]
        head[TRIAL + axis] = head[BEST + axis] + step
    if is_over and head[PHASE] != DONE:
        head[PHASE], head[_FIRST], head[_TRIED] = DAMPED, 1.0, 0.0


@part
def _gradient_step(head: Array, told: Array) -> float:
    """Set the direction to the negative gradient; returns the criterion that it should lead to."""
    u, v, w = 0.0, 0.0, 0.0
    for row in range(len(told)):
        residual = told[row, _RESIDUAL]
        u -= residual * told[row, _SLOPE]
        v -= residual * told[row, _SLOPE + 1]
        w -= residual * told[row, _SLOPE + 2]
    head[_DIRECTION], head[_DIRECTION + 1], head[_DIRECTION + 2] = u, v, w
    criterion = 0.0
    for row in range(len(told)):
        residual = told[row, _RESIDUAL]
        if residual != 0.0:
            along = told[row, _SLOPE] * u + told[row, _SLOPE + 1] * v
            residual += along + told[row, _SLOPE + 2] * w
            criterion += 0.5 * residual * residual
    return criterion


@part
def _advance_damped(
    head: Array, memory: Array, limits: Limits, told: Array, conditions: Array
) -> None:
    """Levenberg-Marquardt in scaled variables, until damping no longer helps."""
    if head[_FIRST]:
        _weigh(memory, told, limits.length)
        head[_STEP] = _FIRST_DAMPING
    criterion = 0.0
    for row in range(len(memory)):
        residual = told[row, _RESIDUAL] * memory[row, _WEIGHT]
        criterion += residual * residual
    if head[_FIRST] or criterion < head[_CRITERION]:
        if not head[_FIRST]:
            head[_STEP] = max(_RELIEF * head[_STEP], 1e-12)
            head[_STALLED] = head[_STALLED] + 1.0 if criterion > _STALL * head[_CRITERION] else 0.0
        _accept(head, criterion)
        for row in range(len(memory)):
            weight = memory[row, _WEIGHT]
            memory[row, _RESIDUAL] = told[row, _RESIDUAL] * weight
            memory[row, _SLOPE] = told[row, _SLOPE] * (weight * limits.length)
            memory[row, _SLOPE + 1] = told[row, _SLOPE + 1] * (weight * limits.length)
            memory[row, _SLOPE + 2] = told[row, _SLOPE + 2] * weight
        is_over = _is_met(told, conditions) or head[_STALLED] > 1.0
    else:
        head[_STEP] *= _STRAIN
        is_over = not head[_STEP] < _MOST_DAMPING
    head[_TRIED] += 1.0
    if is_over or head[_TRIED] > limits.damped_steps:
        head[PHASE] = DONE
    else:
        _damped_step(head, memory, limits.length)


@part
def _weigh(memory: Array, told: Array, length: float) -> None:
    """Weigh each residual by the slope that it has now.

    So metres and radians count alike in the damping and in the sum that has to decrease.
    """
    for row in range(len(memory)):
        across = (told[row, _SLOPE] ** 2 + told[row, _SLOPE + 1] ** 2) * length**2
        slope = sqrt(across + told[row, _SLOPE + 2] ** 2)
        memory[row, _WEIGHT] = 1.0 / slope if slope > 1e-30 else 1.0


@part
def _damped_step(head: Array, memory: Array, length: float) -> None:
    """Set the trial to best + d with (J^T J + mu |f| I) d = -J^T f, J in scaled variables.

    Damping in proportion to |f| keeps convergence quadratic (Fan and Yuan 2005). The matrix is
    symmetric and positive definite, so it is solved by its L D L^T factors. The descent is over
    where a step that is hardly damped promises hardly any progress: that is a minimum.
    """
    a, b, c, d, e, f = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    u, v, w = 0.0, 0.0, 0.0
    for row in range(len(memory)):
        residual = memory[row, _RESIDUAL]
        if residual != 0.0:
            x, y, z = memory[row, _SLOPE], memory[row, _SLOPE + 1], memory[row, _SLOPE + 2]
            a, b, c = a + x * x, b + x * y, c + x * z
            d, e, f = d + y * y, e + y * z, f + z * z
            u, v, w = u - x * residual, v - y * residual, w - z * residual
    damping = head[_STEP] * sqrt(head[_CRITERION]) + _LEAST_PIVOT * (1e-30 + a + d + f)
    a, d, f = a + damping, d + damping, f + damping
    first = 1.0 / a
    p, q = b * first, c * first
    t = e - p * c
    second = 1.0 / (d - p * b)
    s = t * second
    north = v - p * u
    turn = (w - q * u - s * north) / (f - q * c - s * t)
    north = north * second - s * turn
    east = u * first - p * north - q * turn
    head[TRIAL] = head[BEST] + length * east
    head[TRIAL + 1] = head[BEST + 1] + length * north
    head[TRIAL + 2] = head[BEST + 2] + turn
    promised = u * east + v * north + w * turn
    promised += damping * (east * east + north * north + turn * turn)
    if damping <= _HARDLY_DAMPED and promised <= _HOPELESS * head[_CRITERION]:
        head[PHASE] = DONE
