"""The criterion that a descent minimises: equations 1 to 4 of the paper and their derivatives."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.functions import Array
from motion_planner_node.satisfaction.program import Program

#: Stands for a function value that is undefined or too large to be squared.
_HUGE = 1e150

#: Steepest slope that is told apart, so that products with values stay finite.
_STEEPEST = 1e100


@dataclass(frozen=True, slots=True)
class Penalty:
    """Residuals of n attitudes: F is half the sum of their squares.

    Attributes:
        residuals: (m, n), the functions f_i where they are penalised and 0 elsewhere
        jacobian: (m, 3, n), their derivatives by x, y and heading
        slopes: (m, 3, n), the derivatives of all functions, penalised or not
    """

    residuals: Array
    jacobian: Array
    slopes: Array

    @property
    def total(self) -> Array:
        """F of equation 2 for each attitude, (n,)."""
        return np.asarray(0.5 * (self.residuals * self.residuals).sum(axis=0))

    def weighed(self, weights: Array) -> Array:
        """Sum of the squared residuals, each times its weight of (m, n), for each attitude."""
        return np.asarray(np.square(self.residuals * weights).sum(axis=0))

    @property
    def gradient(self) -> Array:
        """Gradient of F, (3, n): the sum of f_i times its derivatives (equations 6 to 8)."""
        return np.asarray((self.residuals[:, None, :] * self.jacobian).sum(axis=0))


def penalty(
    program: Program, states: Array, *, derivatives: Literal['none', 'truncated', 'full']
) -> Penalty:
    """Evaluate the penalty functions at ``states`` (n, 3).

    An equality is penalised on both sides, G(X) = X^2 / 2 (equation 3); an inequality where it does
    not hold, G(X) = X^2 H(X) / 2 (equation 4). Inequalities are asked for with a margin of twice
    the tolerance, so that a descent ends inside them and not on their boundary.
    """
    functions = program.functions(states, derivatives=derivatives)
    residuals = np.empty((len(functions), len(states)))
    slopes = np.zeros((len(functions), 3, len(states)))
    margin = 2.0 * program.tolerance
    for index, (row, function) in enumerate(zip(program.rows, functions, strict=True)):
        value = function.value if row.is_equality else np.maximum(function.value + margin, 0.0)
        undefined = pi if row.periodic else _HUGE
        residuals[index] = np.where(np.isnan(value), undefined, np.clip(value, -_HUGE, _HUGE))
        if function.gradient is not None:
            known = np.where(np.isnan(function.gradient), 0.0, function.gradient)
            slopes[index] = np.clip(known, -_STEEPEST, _STEEPEST)
    return Penalty(residuals, slopes * (residuals != 0.0)[:, None, :], slopes)


def is_met(program: Program, residuals: Array) -> NDArray[np.bool_]:
    """Where a descent can stop: equalities within half the tolerance, inequalities in their margin."""
    allowed = [0.5 if row.is_equality else 1.5 for row in program.rows]
    limits = program.tolerance * np.array(allowed)
    return np.asarray((np.abs(residuals) <= limits[:, None]).all(axis=0))
