"""Intervals hold every value that an operation can take on their members."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.functions import Array, Dual, Interval

NUMBERS = st.floats(min_value=-1e9, max_value=1e9) | st.sampled_from([0.0, -0.0, 1e-320, 1e300])
SHARES = st.floats(min_value=0.0, max_value=1.0)


class Sum:
    """The sum of two numbers as a field."""

    def values(self, *arguments: Array) -> Array:
        return arguments[0] + arguments[1]

    def slopes(self, *arguments: Array) -> tuple[Array, Array]:
        return np.ones_like(arguments[0]), np.ones_like(arguments[1])

    def bounds(self, *ranges: tuple[Array, Array]) -> tuple[Array, Array]:
        return ranges[0][0] + ranges[1][0], ranges[0][1] + ranges[1][1]


OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    'sum': lambda a, b: a + b,
    'difference': lambda a, b: a - b,
    'product': lambda a, b: a * b,
    'quotient': lambda a, b: a / b,
    'hypot': lambda a, b: a.hypot(b),
    'arctan2': lambda a, b: a.arctan2(b),
    'sine': lambda a, b: a.sin() + b.scaled(1e-9).sin(),
    'cosine': lambda a, b: a.cos() - b.scaled(1e-9).cos(),
    'absolute': lambda a, b: abs(a) * abs(b),
    'minimum': lambda a, b: a.minimum(b),
    'maximum': lambda a, b: a.maximum(b),
    'opaque': lambda a, b: a.opaque(Sum(), b),
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


SMALL = st.floats(min_value=-50.0, max_value=50.0) | st.sampled_from([0.0, -0.0])


@settings(max_examples=300, deadline=None)
@given(st.tuples(SMALL, SMALL), st.tuples(SMALL, SMALL), SHARES, SHARES)
def test_directions_stay_inside_modulo_a_turn(
    first: tuple[float, float], second: tuple[float, float], a: float, b: float
) -> None:
    y, x = (
        Interval(np.array([min(bounds)]), np.array([max(bounds)])) for bounds in (first, second)
    )
    with np.errstate(all='ignore'):
        bounds = y.direction(x)
        pair = (Dual.constant(member(*p)) for p in ((first, a), (second, b)))
        value = float(Dual.direction(*pair).value)
    inside = [bounds.low[0] <= value + turn <= bounds.high[0] for turn in (0.0, 2.0 * np.pi)]
    assert np.isnan(value) or any(inside)
    if not (min(first) <= 0.0 <= max(first) and min(second) <= 0.0 <= max(second)):
        assert bounds.high[0] - bounds.low[0] <= np.pi + 1e-9


@settings(max_examples=200, deadline=None)
@given(SMALL, st.floats(min_value=0.0, max_value=8.0))
def test_sine_and_cosine_are_bounded_tightly(low: float, width: float) -> None:
    angle = Interval(np.array([low]), np.array([low + width]))
    samples = np.linspace(low, low + width, 2001)
    for bounds, values in (
        (angle.sin(), np.sin(samples)),
        (angle.cos(), np.cos(samples)),
    ):
        assert bounds.low[0] <= values.min() <= bounds.low[0] + 1e-4
        assert bounds.high[0] >= values.max() >= bounds.high[0] - 1e-4
