"""Intervals hold every value that an operation can take on their members."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.functions import Dual, Interval

NUMBERS = st.floats(min_value=-1e9, max_value=1e9) | st.sampled_from([0.0, -0.0, 1e-320, 1e300])
SHARES = st.floats(min_value=0.0, max_value=1.0)

OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    'sum': lambda a, b: a + b,
    'difference': lambda a, b: a - b,
    'product': lambda a, b: a * b,
    'quotient': lambda a, b: a / b,
    'hypot': lambda a, b: a.hypot(b),
    'arctan2': lambda a, b: a.arctan2(b),
    'negative': lambda a, b: -a - b.scaled(3.0),
}


def member(interval: tuple[float, float], share: float) -> float:
    low, high = min(interval), max(interval)
    return min(max(low + share * (high - low), low), high)


@settings(max_examples=200, deadline=None)
@given(st.tuples(NUMBERS, NUMBERS), st.tuples(NUMBERS, NUMBERS), SHARES, SHARES)
@pytest.mark.parametrize('name', OPERATIONS)
def test_members_stay_inside(
    name: str, first: tuple[float, float], second: tuple[float, float], a: float, b: float
) -> None:
    intervals = (
        Interval(np.array([min(bounds)]), np.array([max(bounds)])) for bounds in (first, second)
    )
    with np.errstate(all='ignore'):
        result = OPERATIONS[name](*intervals)
        value = OPERATIONS[name](
            *(Dual.constant(member(*pair)) for pair in ((first, a), (second, b)))
        ).value
    assert not np.isnan(result.low).any()
    assert not np.isnan(result.high).any()
    assert np.isnan(value) or (result.low[0] <= value <= result.high[0])


def test_an_unknown_constant_is_any_number() -> None:
    unknown = Interval.constant(float('nan'))
    assert unknown.low == -np.inf
    assert unknown.high == np.inf
    length = unknown.hypot(unknown)
    assert length.low == 0.0
    with np.errstate(invalid='ignore'):
        squared = length * length
    assert squared.low <= 0.0
    assert squared.low > -1e-300
    assert squared.high == np.inf


def test_a_quotient_by_zero_is_any_number() -> None:
    with np.errstate(all='ignore'):
        quotient = Interval.constant(1.0) / Interval(np.array([-1.0]), np.array([1.0]))
    assert quotient.low[0] == -np.inf
    assert quotient.high[0] == np.inf
