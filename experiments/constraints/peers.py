"""The peers: scipy's least_squares and SLSQP, and CasADi with IPOPT, as one would use them well."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import atan2, cos, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from experiments.constraints.formulations import LENGTH, Row, missed
from experiments.constraints.judge import Pose

Array = NDArray[np.float64]
#: Asked of every peer: the tolerance that the motion planner solves with.
ACCURACY = 1e-9
MOST_STEPS = 200

Solver = Callable[[Array], Array]


def least_squares(rows: Sequence[Row], method: str) -> Solver:
    """``scipy.optimize.least_squares`` on the violations, with the analytic Jacobian."""
    from scipy.optimize import least_squares as solve

    # MINPACK wants as many residuals as unknowns.
    padding = max(0, 3 - len(rows)) if method == 'lm' else 0

    def residuals(state: Array) -> Array:
        values = [missed(row, row.slope(*state.tolist())[0]) for row in rows]
        return np.array(values + [0.0] * padding)

    def jacobian(state: Array) -> Array:
        slopes = [row.slope(*state.tolist()) for row in rows]
        lines = [
            slope[1:] if missed(row, slope[0]) else (0.0, 0.0, 0.0)
            for row, slope in zip(rows, slopes, strict=True)
        ]
        return np.array(lines + [(0.0, 0.0, 0.0)] * padding)

    def solved(start: Array) -> Array:
        state: Array = solve(
            residuals,
            start,
            jacobian,
            method=method,
            x_scale=(LENGTH, LENGTH, 1.0),
            ftol=ACCURACY,
            xtol=ACCURACY,
            gtol=ACCURACY,
            max_nfev=MOST_STEPS,
        ).x
        return state

    return solved


def slsqp(rows: Sequence[Row]) -> Solver:
    """``scipy.optimize.minimize`` with SLSQP: the nearest attitude (scaled) that meets the rows."""
    from scipy.optimize import minimize

    constraints: list[dict[str, Any]] = []
    for kind, side in (('eq', 0.0), ('ineq', 1.0), ('ineq', -1.0)):
        chosen = [row for row in rows if _has(row, side)]
        if chosen:
            values, slopes = _side(chosen, side)
            constraints.append({'type': kind, 'fun': values, 'jac': slopes})
    weights = np.array([1.0 / LENGTH, 1.0 / LENGTH, 1.0])

    def solved(start: Array) -> Array:
        def far(z: Array) -> tuple[float, Array]:
            moved = z - start * weights
            return 0.5 * float(moved @ moved), moved

        state = minimize(
            far,
            start * weights,
            jac=True,
            method='SLSQP',
            constraints=constraints,
            options={'ftol': ACCURACY, 'maxiter': MOST_STEPS},
        ).x
        return np.asarray(state / weights)

    return solved


def ipopt(rows: Sequence[Row]) -> Solver:
    """CasADi's ``nlpsol`` with IPOPT: the nearest attitude (scaled) that meets the rows."""
    import casadi

    state, start = casadi.SX.sym('state', 3), casadi.SX.sym('start', 3)
    parts = [part for row in rows for part in row.smooth(casadi, state)]
    moved = (state - start) / casadi.DM([LENGTH, LENGTH, 1.0])
    problem: dict[str, Any] = {
        'x': state,
        'p': start,
        'f': 0.5 * casadi.dot(moved, moved),
        'g': casadi.vertcat(*(expression for expression, _, _ in parts)),
    }
    quiet: dict[str, Any] = {'print_level': 0, 'sb': 'yes', 'tol': ACCURACY, 'max_iter': MOST_STEPS}
    nlp: Any = casadi.nlpsol('nlp', 'ipopt', problem, {'ipopt': quiet, 'print_time': False})
    low, high = [part[1] for part in parts], [part[2] for part in parts]

    def solved(at: Array) -> Array:
        result = nlp(x0=at, p=at, lbg=low, ubg=high)['x']
        return np.array(result, dtype=np.float64).reshape(-1)

    return solved


PEERS: Mapping[str, Callable[[Sequence[Row]], Solver]] = {
    'least_squares (trf)': lambda rows: least_squares(rows, 'trf'),
    'least_squares (lm)': lambda rows: least_squares(rows, 'lm'),
    'SLSQP': slsqp,
    'CasADi/IPOPT': ipopt,
}


def wrapped(state: Array) -> Pose:
    """The attitude with its heading in [-pi, pi]."""
    x, y, heading = state.tolist()
    return x, y, atan2(sin(heading), cos(heading))


def _has(row: Row, side: float) -> bool:
    return (row.low == row.high) == (side == 0.0)


def _side(
    rows: Sequence[Row], side: float
) -> tuple[Callable[[Array], Array], Callable[[Array], Array]]:
    """Equations (side 0), lower (1) or upper bounds (-1) in the scaled variables of SLSQP."""
    sign = side or 1.0
    bounds = [row.high if side < 0.0 else row.low for row in rows]
    scale = np.array([LENGTH, LENGTH, 1.0])

    def values(z: Array) -> Array:
        state = (z * scale).tolist()
        pairs = zip(rows, bounds, strict=True)
        return np.array([sign * (row.slope(*state)[0] - bound) for row, bound in pairs])

    def slopes(z: Array) -> Array:
        state = (z * scale).tolist()
        return np.array([row.slope(*state)[1:] for row in rows]) * (sign * scale)

    return values, slopes
