"""Every function of the library against an independent formula, finite differences and samples."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from motion_planner_node.functions import (
    FUNCTIONS,
    Dual,
    Function,
    Interval,
    Kind,
    Place,
    Surroundings,
    surroundings_of,
)
from motion_planner_node.world.model import Bounds, Circle, Polygon, World

WALL = ((20.0, 10.0), (30.0, 10.0), (30.0, 60.0), (20.0, 60.0))
HOOK = ((60.0, 10.0), (90.0, 10.0), (90.0, 50.0), (80.0, 50.0), (80.0, 20.0), (60.0, 20.0))
BAY = ((40.0, 70.0), (70.0, 70.0), (70.0, 95.0), (55.0, 80.0), (40.0, 95.0))
WORLD = World(
    '',
    '',
    Bounds(0.0, 0.0, 100.0, 100.0),
    {},
    (Polygon('wall', WALL), Polygon('hook', HOOK), Circle('pillar', (50.0, 40.0), 6.0)),
    {},
    {'bay': Polygon('bay', BAY)},
)
SEEN = surroundings_of(WORLD)
PILLAR = shapely.Point(50.0, 40.0)
OUTLINES = (shapely.Polygon(WALL), shapely.Polygon(HOOK))

#: Where places are often: on each other, on a line, on an obstacle's edge; else anywhere.
SPECIAL = st.sampled_from([0.0, 10.0, 20.0, 50.0, 50.0 + 1e-9, 1e-300, 70.0])
COORDINATES = SPECIAL | st.floats(min_value=0.0, max_value=100.0)
FAR = COORDINATES | st.floats(min_value=-1e7, max_value=1e7) | st.sampled_from([1e-160, -1e7])
HEADINGS = st.sampled_from([0.0, math.pi, -math.pi, math.pi / 2.0]) | st.floats(-7.0, 7.0)
NUMBERS = st.sampled_from([0.0, -1e-300, 1e300]) | st.floats(-1e6, 1e6)

#: x, y, heading of an agent, and x, y, heading of two other places.
STATES = st.tuples(FAR, FAR, HEADINGS, FAR, FAR, HEADINGS, FAR, FAR, HEADINGS)
NEAR = st.tuples(*(COORDINATES, COORDINATES, HEADINGS) * 3)

State = tuple[float, ...]


def arguments_of(function: Function, state: State, make: Callable[[int], Any]) -> list[Any]:
    """The arguments of ``function`` out of a state, a number being the heading of a place."""
    found: list[Any] = [SEEN] if function.sees_world else []
    numbers = 0
    for index, kind in enumerate(function.arguments):
        if kind is Kind.REGION:
            found.append(SEEN.region('bay'))
        elif kind in {Kind.NUMBER, Kind.ANGLE}:
            found.append(make(3 * (2 - numbers) + 2))
            numbers += 1
        else:
            found.append(Place(*(make(3 * index + offset) for offset in range(3))))
    return found


def value_of(function: Function, state: State) -> float:
    arguments = arguments_of(function, state, lambda index: Dual(np.array([state[index]])))
    with np.errstate(all='ignore'):
        return float(np.ravel(function.value(*arguments).value)[0])


def bearing(state: State) -> float:
    east, north = state[3] - state[0], state[4] - state[1]
    return math.atan2(north, east) if east or north else math.nan


def length(state: State, first: int, second: int) -> float:
    return math.dist(state[3 * first : 3 * first + 2], state[3 * second : 3 * second + 2])


def angle_between(first: float, second: float) -> float:
    return abs(math.remainder(first - second, 2.0 * math.pi))


def along_line(state: State) -> complex:
    """Along and across the line between the two other places."""
    start, end = complex(*state[3:5]), complex(*state[6:8])
    if start == end:
        return complex(math.nan, math.nan)
    turn = math.atan2((end - start).imag, (end - start).real)
    turned: complex = (complex(*state[0:2]) - start) * cmath.rect(1.0, -turn)
    return turned


def to_segment(state: State) -> float:
    if length(state, 1, 2) < 1e-100:
        return length(state, 0, 1)
    line = shapely.LineString([state[3:5], state[6:8]])
    return float(line.distance(shapely.Point(state[:2])))


def to_bay(state: State) -> float:
    bay, here = shapely.Polygon(BAY), shapely.Point(state[:2])
    away = float(shapely.LinearRing(BAY).distance(here))
    return -away if bay.contains(here) else away


def to_obstacles(state: State) -> float:
    here = shapely.Point(state[:2])
    found = [state[0], state[1], 100.0 - state[0], 100.0 - state[1], PILLAR.distance(here) - 6.0]
    for outline in OUTLINES:
        away = float(outline.exterior.distance(here))
        found.append(-away if outline.contains(here) else away)
    return float(min(found))


#: Independent formulas.
EXPECTED: dict[str, Callable[[State], float]] = {
    'distance': lambda s: length(s, 0, 1),
    'rel_angle': lambda s: s[2] - bearing(s),
    'heading': lambda s: s[2],
    'bearing': bearing,
    'facing': lambda s: s[2] - bearing(s),
    'object_on_left': lambda s: s[2] + math.pi / 2.0 - bearing(s),
    'object_on_right': lambda s: s[2] - math.pi / 2.0 - bearing(s),
    'object_behind': lambda s: s[2] + math.pi - bearing(s),
    'same_heading': lambda s: s[2] - s[5],
    'field_of_view': lambda s: angle_between(s[2], bearing(s)) - s[8] / 2.0,
    'equidistant': lambda s: length(s, 0, 1) - length(s, 0, 2),
    'distance_to_segment': to_segment,
    'cross_track': lambda s: along_line(s).imag,
    'along_track': lambda s: along_line(s).real,
    'inside': to_bay,
    'outside': to_bay,
    'distance_to_boundary': lambda s: abs(to_bay(s)),
    'clearance': to_obstacles,
    'cos-and-sin': lambda s: s[8],
    'deg': lambda s: math.radians(s[8]),
    'angle_between': lambda s: angle_between(s[8], s[5]),
    'min': lambda s: min(s[8], s[5]),
    'max': lambda s: max(s[8], s[5]),
    'abs': lambda s: math.fabs(s[8]),
}

#: Where formulas of other authors lose digits, in units of the largest coordinate.
TOLERANCE = 1e-12


@settings(max_examples=150, deadline=None)
@given(STATES)
@pytest.mark.parametrize('name', EXPECTED)
def test_values_are_those_of_an_independent_formula(name: str, state: State) -> None:
    function, expected = FUNCTIONS[name], EXPECTED[name](state)
    found = value_of(function, state)
    if math.isnan(expected):
        assert math.isnan(found)
        return
    nearby = length(state, 1, 2)
    scale = max(1.0, *map(abs, state))
    if name.endswith('_track') and nearby < 1.0:
        scale *= scale / nearby
    if function.result is Kind.ANGLE:
        assert angle_between(found, expected) <= 1e-9
    else:
        assert found == pytest.approx(expected, abs=max(TOLERANCE * scale, 1e-9))


@settings(max_examples=200, deadline=None)
@given(NEAR)
def test_what_is_visible_is_what_no_obstacle_crosses(state: State) -> None:
    found = value_of(FUNCTIONS['visible'], state)
    target = shapely.Point(state[3:5])
    # A line without any length to speak of makes shapely divide by zero.
    apart = math.dist(state[:2], state[3:5]) > 1e-100
    line = shapely.LineString([state[:2], state[3:5]]) if apart else target
    away = [math.hypot(100.0, 100.0)]
    away += [line.distance(outline) for outline in OUTLINES if not outline.contains(target)]
    if PILLAR.distance(target) >= 6.0 - 1e-9:
        away.append(line.distance(PILLAR) - 6.0)
    if min(away) > 1e-9:
        assert found == pytest.approx(-min(away), abs=1e-9)
    else:
        assert found >= -1e-9
    if any(line.intersects(o.buffer(-1e-6)) for o in OUTLINES if not o.contains(target)):
        assert found > 0.0


def test_a_hidden_place_is_seen_after_the_sideways_step_that_the_value_says() -> None:
    state = (5.0, 40.0, 0.0, 45.0, 40.0, 0.0, 0.0, 0.0, 0.0)
    assert value_of(FUNCTIONS['visible'], state) == pytest.approx(20.0)
    above = (5.0, 60.1, 0.0, 45.0, 60.1, 0.0, 0.0, 0.0, 0.0)
    assert value_of(FUNCTIONS['visible'], above) == pytest.approx(-0.1)


def test_an_obstacle_does_not_hide_what_is_inside_it() -> None:
    state = (5.0, 40.0, 0.0, 25.0, 40.0, 0.0, 0.0, 0.0, 0.0)
    assert value_of(FUNCTIONS['visible'], state) < 0.0


@settings(max_examples=60, deadline=None)
@given(st.lists(st.floats(min_value=3.0, max_value=97.0), min_size=9, max_size=9), st.data())
@pytest.mark.parametrize('name', FUNCTIONS)
def test_slopes_are_those_of_finite_differences(
    name: str, numbers: list[float], data: st.DataObject
) -> None:
    function = FUNCTIONS[name]
    state = [number / 30.0 if index % 3 == 2 else number for index, number in enumerate(numbers)]
    assume(min(length(tuple(state), *pair) for pair in ((0, 1), (0, 2), (1, 2))) > 1.0)
    moving = data.draw(st.integers(min_value=0, max_value=8))
    one = np.ones((3, 1))

    def number(index: int) -> Dual:
        value = np.array([state[index]])
        return Dual(value, one if index == moving else None)

    def at(step: float) -> float:
        moved = tuple(v + step * (index == moving) for index, v in enumerate(state))
        return value_of(function, moved)

    with np.errstate(all='ignore'):
        found = function.value(*arguments_of(function, tuple(state), number))
    slope = 0.0 if found.gradient is None else float(found.gradient[0, 0])
    step = 1e-6
    back, here, forth = at(-step), at(0.0), at(step)
    if abs((forth - here) - (here - back)) > 1e-9 or math.isnan(back + forth):
        return
    if abs(forth - back) < 1.0:
        assert slope == pytest.approx((forth - back) / (2.0 * step), rel=1e-3, abs=1e-3)


@settings(max_examples=80, deadline=None)
@given(NEAR, st.floats(min_value=0.0, max_value=20.0), st.floats(min_value=0.0, max_value=2.0))
@example((0.0,) * 9, 5e-324, 5e-324)
@pytest.mark.parametrize('name', FUNCTIONS)
def test_bounds_hold_all_samples_of_a_box(
    name: str, state: State, width: float, turn: float
) -> None:
    function = FUNCTIONS[name]
    sizes = (width, width, turn, 0.0, 0.0, turn, 0.0, 0.0, turn)

    def interval(index: int) -> Interval:
        return Interval(np.array([state[index]]), np.array([state[index] + sizes[index]]))

    with np.errstate(all='ignore'):
        bounds = function.value(*arguments_of(function, state, interval))
    low, high = float(bounds.low[0]), float(bounds.high[0])
    assert not math.isnan(low + 0.0 * (high == low))
    rng = np.random.default_rng(3)
    for share in rng.random((12, 9)):
        moved = tuple(
            min(s + part * size, s + size)
            for s, part, size in zip(state, share, sizes, strict=True)
        )
        found = value_of(function, moved)
        turns = (-2.0 * math.pi, 0.0, 2.0 * math.pi) if function.result is Kind.ANGLE else (0.0,)
        assert math.isnan(found) or any(low <= found + turn <= high for turn in turns)


def test_bounds_prove_that_a_wall_hides_a_box() -> None:
    box = (
        Interval(np.array([5.0]), np.array([10.0])),
        Interval(np.array([30.0]), np.array([40.0])),
    )
    target = (Dual.constant(45.0), Dual.constant(35.0))
    low, _ = SEEN.sight.bounds(
        *((side.low, side.high) for side in box),
        *((np.array([float(t.value)]),) * 2 for t in target),
    )
    assert low[0] > 5.0


def test_undefined_numbers_leave_bounds_open() -> None:
    nothing = Interval.constant(math.nan)
    agent = Place(nothing, nothing, nothing)
    with np.errstate(all='ignore'):
        for bounds in (
            FUNCTIONS['inside'].value(agent, SEEN.region('bay')),
            FUNCTIONS['clearance'].value(SEEN, agent),
            FUNCTIONS['visible'].value(SEEN, agent, agent),
        ):
            assert float(bounds.low) == -math.inf
            assert float(bounds.high) == math.inf


def test_nothing_is_known_of_a_region_without_a_world() -> None:
    x = Dual(np.array([1.0, 2.0]))
    inside = FUNCTIONS['inside'].value(Place(x, x, x), Surroundings().region('bay'))
    assert np.isnan(inside.value).all()


@pytest.mark.parametrize('name', FUNCTIONS)
def test_standing_on_a_place_is_no_exception(name: str) -> None:
    state = (50.0, 40.0, 1.0) * 3
    value = value_of(FUNCTIONS[name], state)
    undefined = {
        'rel_angle',
        'bearing',
        'facing',
        'object_on_left',
        'object_on_right',
        'object_behind',
        'field_of_view',
        'cross_track',
        'along_track',
    }
    assert math.isnan(value) == (name in undefined)


@pytest.mark.parametrize('name', FUNCTIONS)
def test_every_function_is_documented(name: str) -> None:
    documents = Path(__file__).resolve().parents[3] / 'docs'
    rows = [
        line
        for line in (documents / 'functions.md').read_text().splitlines()
        if line.startswith('| `') and f'`{name}(' in line
    ]
    assert len(rows) == 1
    assert FUNCTIONS[name].description.endswith('.')
