"""Derivatives: against finite differences, and against the paper's Table 2 written out by hand."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.functions import FUNCTIONS, Array, Dual, Place

COORDINATES = st.floats(min_value=-800.0, max_value=800.0)
HEADINGS = st.floats(min_value=-3.1, max_value=3.1)
STEP = 1e-5


def dual_state(x: float, y: float, heading: float) -> tuple[Dual, Dual, Dual]:
    unit = np.eye(3)
    first, second, third = (
        Dual(np.array([value]), unit[:, index : index + 1])
        for index, value in enumerate((x, y, heading))
    )
    return first, second, third


def place(x: float, y: float) -> Place[Dual]:
    return Place(Dual.constant(x), Dual.constant(y), Dual.constant(math.nan))


def gradient(result: Dual) -> NDArray[np.float64]:
    assert result.gradient is not None
    return result.gradient[:, 0]


def finite_differences(
    function: Callable[[Dual, Dual, Dual], Dual], x: float, y: float, heading: float
) -> list[float]:
    slopes = []
    for index in range(3):
        values = []
        for sign in (-1.0, 1.0):
            state = [x, y, heading]
            state[index] += sign * STEP
            values.append(float(function(*(Dual(np.array([v])) for v in state)).value[0]))
        slopes.append((values[1] - values[0]) / (2.0 * STEP))
    return slopes


@settings(max_examples=150, deadline=None)
@given(COORDINATES, COORDINATES, HEADINGS, COORDINATES, COORDINATES)
@pytest.mark.parametrize('name', ['distance', 'rel_angle'])
def test_functions_have_the_slopes_of_finite_differences(
    name: str, x: float, y: float, heading: float, ox: float, oy: float
) -> None:
    assume(math.hypot(ox - x, oy - y) > 1.0)
    assume(name != 'rel_angle' or ox - x > 0.0 or abs(oy - y) > 1e-3)

    def function(*state: Dual) -> Dual:
        result: Dual = FUNCTIONS[name].value(Place(*state), place(ox, oy))
        return result

    found = gradient(function(*dual_state(x, y, heading)))
    assert found == pytest.approx(finite_differences(function, x, y, heading), abs=1e-5)


@settings(max_examples=100, deadline=None)
@given(COORDINATES, COORDINATES, HEADINGS)
def test_arithmetic_has_the_slopes_of_finite_differences(
    x: float, y: float, heading: float
) -> None:
    assume(abs(y) > 1.0)

    def function(x: Dual, y: Dual, heading: Dual) -> Dual:
        two = Dual.constant(2.0)
        return (x * heading - two) / y + (two / y - (-x)) * heading + (two + y) * two

    found = gradient(function(*dual_state(x, y, heading)))
    expected = finite_differences(function, x, y, heading)
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-3)


@settings(max_examples=100, deadline=None)
@given(COORDINATES, COORDINATES, HEADINGS)
def test_primitives_have_the_slopes_of_finite_differences(
    x: float, y: float, heading: float
) -> None:
    assume(min(abs(x - y), abs(heading - y), abs(x), abs(x - heading)) > 1e-3)

    def function(x: Dual, y: Dual, heading: Dual) -> Dual:
        return (
            heading.sin() * x + heading.cos() * y + abs(x) + x.minimum(y) + heading.maximum(y) * x
        )

    found = gradient(function(*dual_state(x, y, heading)))
    expected = finite_differences(function, x, y, heading)
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-3)


class Product:
    """``x * y`` as a field."""

    def values(self, *arguments: Array) -> Array:
        return arguments[0] * arguments[1]

    def slopes(self, *arguments: Array) -> tuple[Array, Array]:
        return arguments[1], arguments[0]

    def bounds(self, *ranges: tuple[Array, Array]) -> tuple[Array, Array]:
        raise NotImplementedError


def test_an_opaque_operation_follows_the_chain_rule() -> None:
    x, y, heading = dual_state(2.0, 3.0, 0.5)
    found = (x + heading).opaque(Product(), y * heading)
    assert found.value[0] == pytest.approx(2.5 * 1.5)
    assert gradient(found) == pytest.approx([1.5, 2.5 * 0.5, 1.5 + 2.5 * 3.0])
    constant = Dual.constant(2.0).opaque(Product(), Dual.constant(3.0))
    assert float(constant.value) == 6.0
    assert constant.gradient is None


@settings(max_examples=150, deadline=None)
@given(COORDINATES, COORDINATES, HEADINGS, COORDINATES, COORDINATES)
def test_derived_codes_are_those_of_table_2(
    x: float, y: float, heading: float, ox: float, oy: float
) -> None:
    root = math.sqrt((ox - x) ** 2 + (oy - y) ** 2)
    assume(root > 1.0)
    robot = Place(*dual_state(x, y, heading))

    distance = FUNCTIONS['distance'].truncated(robot, place(ox, oy))
    assert float(distance.value[0]) == pytest.approx(root)
    assert gradient(distance) == pytest.approx([(x - ox) / root, (y - oy) / root, 0.0])

    angle = FUNCTIONS['rel_angle'].truncated(robot, place(ox, oy))
    value, (by_x, by_y, by_heading) = float(angle.value[0]), gradient(angle)
    cosine = ((ox - x) * math.cos(heading) + (oy - y) * math.sin(heading)) / root
    sine = ((ox - x) * math.sin(heading) - (oy - y) * math.cos(heading)) / root
    assert math.cos(value) == pytest.approx(cosine, abs=1e-9)
    assert math.sin(value) == pytest.approx(sine, abs=1e-9)
    cosine_slope = (-(ox - x) * math.sin(heading) + (oy - y) * math.cos(heading)) / root
    sine_slope = ((ox - x) * math.cos(heading) + (oy - y) * math.sin(heading)) / root
    assert -math.sin(value) * by_heading == pytest.approx(cosine_slope, abs=1e-9)
    assert math.cos(value) * by_heading == pytest.approx(sine_slope, abs=1e-9)
    assert by_x == by_y == 0.0


def test_a_robot_on_the_object_has_a_distance_with_a_slope_and_no_angle() -> None:
    robot = Place(*dual_state(3.0, 4.0, 0.5))
    distance = FUNCTIONS['distance'].value(robot, place(3.0, 4.0))
    assert distance.value[0] == 0.0
    assert gradient(distance).tolist() == [-1.0, 0.0, 0.0]
    angle = FUNCTIONS['rel_angle'].value(robot, place(3.0, 4.0))
    assert np.isnan(angle.value[0])
    assert np.isfinite(gradient(angle)).all()


def test_right_of_the_robot_is_a_relative_angle_of_half_pi() -> None:
    robot = Place(*dual_state(0.0, 0.0, 0.0))
    angle = FUNCTIONS['rel_angle'].value(robot, place(0.0, -10.0))
    assert float(angle.value[0]) == pytest.approx(math.pi / 2.0)


def test_degrees_are_turned_into_radians() -> None:
    degrees = FUNCTIONS['deg'].value(Dual.constant(90.0))
    assert float(degrees.value) == pytest.approx(math.pi / 2.0)
