"""The lower bound of a round, and the orders it is taken over."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from experiments.paper.lower_bound import lower_bound
from experiments.paper.orders import Costs, shortest_tours

BOUNDS = np.array([0.0, 0.0, 1000.0, 1000.0])
RADIUS, HIGH, ARC = 5.0, 100.0, 6.0
START = np.array([50.0, 50.0])

seeds = st.integers(0, 2**32 - 1)


def bound(centres: Any, obstacles: list[Any]) -> float:
    return lower_bound(START, np.array(centres, float), HIGH, obstacles, BOUNDS, RADIUS, ARC)


def test_the_bound_of_one_objective_is_the_way_to_its_circle() -> None:
    assert 500.0 - ARC <= bound([[650.0, 50.0]], []) <= 500.0


def test_the_bound_goes_round_a_wall() -> None:
    wall = shapely.box(300.0, 0.0, 310.0, 600.0)
    # A disc passes the wall's upper corners at its radius; the bound may cut them by half an arc.
    up, over = math.hypot(250.0, 550.0), math.hypot(340.0, 550.0)
    assert up + 10.0 + over - HIGH - 3.0 * ARC < bound([[650.0, 50.0]], [wall]) < up + 10.0 + over


def test_finer_arcs_raise_the_bound() -> None:
    centres = np.array([[300.0, 300.0], [700.0, 250.0], [500.0, 800.0]])
    bounds = [lower_bound(START, centres, HIGH, [], BOUNDS, RADIUS, arc) for arc in (8.0, 4.0, 2.0)]
    assert bounds == sorted(bounds)


def test_a_start_within_reach_is_refused() -> None:
    with pytest.raises(ValueError, match='within reach'):
        bound([[100.0, 100.0]], [])


@settings(max_examples=20)
@given(seeds)
def test_no_tour_of_places_within_reach_undercuts_the_bound(seed: int) -> None:
    random = np.random.default_rng(seed)
    centres = random.uniform(250.0, 850.0, (3, 2))
    turned, away = random.uniform(0.0, math.tau, 3), random.uniform(0.0, HIGH, 3)
    places = centres + away[:, None] * np.column_stack([np.cos(turned), np.sin(turned)])
    shortest = min(
        sum(math.dist(a, b) for a, b in itertools.pairwise([START, *places[list(order)]]))
        for order in itertools.permutations(range(3))
    )
    assert lower_bound(START, centres, HIGH, [], BOUNDS, RADIUS, ARC) <= shortest


@given(seeds)
def test_tours_are_those_of_exhaustive_search(seed: int) -> None:
    random = np.random.default_rng(seed)
    sizes = random.integers(1, 4, 4)
    first = [random.uniform(1.0, 9.0, m) for m in sizes]
    between = {
        (i, j): np.where(
            random.random((sizes[i], sizes[j])) < 0.2, np.inf, random.uniform(1.0, 9.0)
        )
        for i, j in itertools.permutations(range(4), 2)
    }
    best: dict[tuple[int, ...], float] = {}
    for order in itertools.permutations(range(4)):
        for places in itertools.product(*(range(sizes[i]) for i in order)):
            length = first[order[0]][places[0]]
            for (i, a), (j, b) in itertools.pairwise(zip(order, places, strict=True)):
                length += between[i, j][a, b]
            best[order] = min(length, best.get(order, math.inf))
    tours = list(shortest_tours(Costs(first, between)))
    assert {tour.order: pytest.approx(tour.length) for tour in tours} == {
        order: length for order, length in best.items() if length < math.inf
    }
    assert [tour.length for tour in tours] == sorted(tour.length for tour in tours)
    for tour in tours:
        stops = list(zip(tour.order, tour.places, strict=True))
        driven = first[stops[0][0]][stops[0][1]] + sum(
            between[i, j][a, b] for (i, a), (j, b) in itertools.pairwise(stops)
        )
        assert driven == pytest.approx(tour.length)
