"""What an expression can be in any world holds what it is in one."""

from __future__ import annotations

import math
from math import inf

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.functions import Dual, Surroundings
from motion_planner_node.language import parse
from motion_planner_node.language.ranges import range_of
from motion_planner_node.language.syntax import Constraint, Expression
from motion_planner_node.language.tape import Tape

COORDINATE = st.sampled_from([0.0, -0.0, 1.0]) | st.floats(-1e3, 1e3)
PLACE = st.fixed_dictionaries({'x': COORDINATE, 'y': COORDINATE})
EXPRESSIONS = (
    'distance(r, a)',
    '-distance(r, a) - 3',
    '2 * distance(r, a) / 4 + abs(r.x)',
    'angle_between(bearing(r, a), bearing(r, b))',
    'min(distance(r, a), 5) - max(distance(r, b), a.x)',
    'distance_to_segment(r, a, b)',
    'abs(cross_track(r, a, b)) + 1',
    'deg(90) * distance(a, b)',
)


def expression_of(text: str) -> Expression:
    (constraint,) = parse(f'((agent r)(object a)(object b)({text} <= 1))').items
    assert isinstance(constraint, Constraint)
    return constraint.left


@pytest.mark.parametrize('text', EXPRESSIONS)
@settings(max_examples=60, deadline=None)
@given(PLACE, PLACE, st.tuples(COORDINATE, COORDINATE, st.floats(-math.pi, math.pi)))
def test_no_value_is_out_of_range(
    text: str, a: dict[str, float], b: dict[str, float], state: tuple[float, float, float]
) -> None:
    expression = expression_of(text)
    bounds = range_of(expression)
    tape = Tape('r', {'a': a, 'b': b}, Surroundings())
    slot = tape.slot(expression)
    with np.errstate(all='ignore'):
        values = tape.run([Dual(np.array([number])) for number in state], Dual.constant)
    value = float(np.ravel(values[slot].value)[0])
    assert math.isnan(value) or bounds.low <= value <= bounds.high


@pytest.mark.parametrize(
    ('text', 'low', 'high'),
    [
        ('distance(r, a)', 0.0, inf),
        ('-distance(r, a) - 3', -inf, -3.0),
        ('angle_between(bearing(r, a), bearing(r, b))', 0.0, math.pi),
        ('min(distance(r, a), 5)', 0.0, 5.0),
        ('min(distance(r, a), 7)', 0.0, 7.0),
        ('a.x', -inf, inf),
        ('clearance(r)', -inf, inf),
        ('deg(180)', math.pi, math.pi),
    ],
)
def test_ranges_are_tight(text: str, low: float, high: float) -> None:
    bounds = range_of(expression_of(text))
    assert float(bounds.low) == pytest.approx(low)
    assert float(bounds.high) == pytest.approx(high)
