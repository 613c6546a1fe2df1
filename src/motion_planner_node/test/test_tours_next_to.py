"""Sampled costs: worked out where groups may be next to each other, and what is left out is not missed."""

from __future__ import annotations

from itertools import pairwise, permutations, product
from math import inf, pi

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from motion_planner_node.codes import Purpose
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning.ground import Ground
from motion_planner_node.requests import AdviceRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.stopping import never
from motion_planner_node.tours.chains import Groups, best_chain
from motion_planner_node.tours.exact import best_tour
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.precedences import Mask, next_to
from motion_planner_node.tours.samples import Samples
from motion_planner_node.world import Scene
from motion_planner_node.world.model import Bounds, Circle, World, WorldObject
from tests.support.precedences import random_precedences

CAR = Robot('r', 8.0, 0.5, 5.0, 2.0)
ROCK = Circle('rock', (150.0, 150.0), 50.0)
WORLD = World('', '', Bounds(0.0, 0.0, 300.0, 300.0), {}, (ROCK,), {'r': CAR})
GROUND = Ground(Scene(WORLD), CAR)


def free_rows(rng: np.random.Generator, count: int) -> NDArray[np.float64]:
    rows = rng.uniform((10.0, 10.0, -pi), (290.0, 290.0, pi), (20 * count, 3))
    outside = np.hypot(*(rows[:, :2] - ROCK.center).T) > ROCK.radius + 6.0
    return np.asarray(rows[outside][:count])


def sampled(seed: int, goals: int, used: Mask) -> Samples:
    """The same attitudes for the same seed, with one fresh attitude for each goal."""
    rng = np.random.default_rng(seed)
    start = free_rows(rng, 1)[0]
    states = [free_rows(rng, int(count)) for count in rng.integers(1, 3, goals)]
    legs = Legs(GROUND, 0, never)
    samples = Samples(GROUND, legs, start, states, 2, used, never)
    samples.add(np.arange(goals), free_rows(rng, goals), never)
    return samples


def best_by_trying(samples: Samples, before: Mask) -> float:
    """The shortest way over all groups in any order that ``before`` allows: all are tried."""
    choices = [range(f, f + n) for f, n in zip(samples.first, samples.count, strict=True)]
    return min(
        sum(float(samples.costs[a, b]) for a, b in pairwise(way))
        for order in permutations(range(1, len(before)))
        if not np.tril(before[np.ix_(order, order)]).any()
        for way in product(*(choices[group] for group in (0, *order)))
    )


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32), st.integers(1, 4), st.integers(0, 6), st.booleans())
def test_the_best_tour_is_that_of_the_full_matrix(
    seed: int, goals: int, precedences: int, fixed: bool
) -> None:
    before = random_precedences(np.random.default_rng(seed), goals, precedences)
    if fixed:
        before = np.triu(np.ones_like(before), 1)
    full = sampled(seed, goals, ~np.eye(goals + 1, dtype=np.bool_))
    part = sampled(seed, goals, next_to(before))
    used = next_to(before)[part.owner][:, part.owner]
    assert np.array_equal(part.costs, np.where(used, full.costs, np.float32(inf)))
    groups = Groups(part.costs, part.first, part.count, before)
    order = np.arange(goals + 1) if fixed else best_tour(groups, never)
    best = best_by_trying(full, before)
    assert best < inf
    assert best_chain(groups, order)[0] == pytest.approx(best, rel=1e-5)


def least_over(costs: NDArray[np.float64], owner: list[int], order: tuple[int, ...]) -> float:
    """The shortest way over places in an order, by ``costs`` (n + 1, n), the start's row first."""
    columns = [[n for n, group in enumerate(owner) if group == goal] for goal in order]
    ways = costs[0, columns[0]]
    for before, after in pairwise(columns):
        ways = (ways[:, None] + costs[np.ix_([n + 1 for n in before], after)]).min(axis=0)
    return float(ways.min())


@settings(max_examples=10, deadline=None)
@given(
    st.lists(st.tuples(st.floats(100.0, 900.0), st.floats(100.0, 900.0)), min_size=2, max_size=5),
    st.sets(st.tuples(st.integers(0, 4), st.integers(0, 4)), max_size=4),
    st.permutations(range(5)),
)
def test_a_tour_is_as_short_as_the_best_over_all_places(
    positions: list[tuple[float, float]], drawn: set[tuple[int, int]], hidden: list[int]
) -> None:
    count = len(positions)
    objects = {
        f'o{k}': WorldObject(f'o{k}', {'x': x, 'y': y}) for k, (x, y) in enumerate(positions)
    }
    planner = MotionPlanner(
        World('', '', Bounds(0.0, 0.0, 1000.0, 1000.0), objects, (), {'r': CAR})
    )
    texts = tuple(
        f'((agent r)(object {label})(distance(r, {label}) >= 20)(distance(r, {label}) <= 40)'
        f'(rel_angle(r, {label}) = cos-and-sin(pi/2)))'
        for label in objects
    )
    start = {'r': Attitude(500.0, 500.0, 0.0)}
    pairs = {(i, j) for i, j in drawn if max(i, j) < count and hidden.index(i) < hidden.index(j)}
    told = planner.advise(AdviceRequest(texts, start, places=16))
    owner = [place.candidate for place in told.places]
    costs = np.array(told.place_lengths).reshape(len(owner) + 1, len(owner))
    allowed = [
        order
        for order in permutations(range(count))
        if all(order.index(i) < order.index(j) for i, j in pairs)
    ]
    best = min(least_over(costs, owner, order) for order in allowed)
    before, after = tuple(i for i, _ in pairs), tuple(j for _, j in pairs)
    request = AdviceRequest(texts, start, purpose=Purpose.SHORTEST_TOUR, before=before, after=after)
    tour = planner.advise(request)
    assert tour.order in allowed
    assert tour.tour_length <= best * (1.0 + 1e-5)
    fixed = planner.advise(AdviceRequest(texts, start, purpose=Purpose.FIXED_ORDER))
    as_given = least_over(costs, owner, tuple(range(count)))
    assert fixed.tour_length <= as_given * (1.0 + 1e-5)
