"""What is kept between requests saves work, changes no answer, and is bounded."""

from __future__ import annotations

import gc
import importlib
import pkgutil
from collections import Counter
from functools import partial
from math import pi
from pathlib import Path
from types import FunctionType, ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import motion_planner_node
from motion_planner_node.codes import Status
from motion_planner_node.parameters import MODES, Parameters
from motion_planner_node.planner import MOST_GROUNDS, MotionPlanner
from motion_planner_node.planning.cache import Cache
from motion_planner_node.requests import AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.world import read_world
from motion_planner_node.world.free_space import MOST_FIELDS, FreeSpace

WORLD = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
TEXT = WORLD.read_text(encoding='utf-8')
ROVER = read_world(TEXT, 'world.yaml')
ROBOTS = MOST_GROUNDS + 2
MANY = read_world(
    'bounds: [0, 0, 80, 60]\nobjects: {tree: {x: 60, y: 30}}\nrobots:\n'
    + ''.join(
        f'  r{i}: {{model: car, wheelbase: 1, max_steering_angle: 0.5, radius: 1.{i}, speed: 1}}\n'
        for i in range(ROBOTS)
    ),
    'many.yaml',
)
#: One that forgets nearly at once and one that remembers, both asked all that comes.
FORGETFUL = MotionPlanner(ROVER, Parameters(cache_size=1))
MINDFUL = MotionPlanner(ROVER)
NEAR = '((agent {0})(object {1})(distance({0}, {1}) <= {2}))'

requests = st.builds(
    lambda label, distance, x, y, heading, alternative, seed: GeometricRequest(
        NEAR.format('rover0', label, distance),
        {'rover0': Attitude(x, y, heading)},
        alternative=alternative,
        seed=seed,
    ),
    st.sampled_from(['location1', 'location3', 'location8']),
    st.sampled_from([30, 90]),
    st.sampled_from([20.0, 400.0]),
    st.sampled_from([20.0, 300.0]),
    st.floats(-pi, pi, exclude_min=True),
    st.integers(0, 2),
    st.integers(0, 3),
)


@settings(max_examples=8, deadline=None)
@given(st.lists(requests, min_size=1, max_size=3))
def test_answers_are_the_same_with_and_without_what_is_kept(asked: list[GeometricRequest]) -> None:
    for request in [*asked, asked[0]]:
        texts = tuple(dict.fromkeys(other.preconditions for other in asked))
        advice = AdviceRequest(texts, request.start, seed=request.seed, pairwise=True)
        fresh = MotionPlanner(ROVER)
        answers = fresh.satisfy(request), fresh.advise(advice)
        for planner in (FORGETFUL, MINDFUL):
            assert (planner.satisfy(request), planner.advise(advice)) == answers


def test_more_robots_than_are_kept_are_answered_as_ever() -> None:
    planner = MotionPlanner(MANY)
    planner.prepare()
    asked = [
        GeometricRequest(NEAR.format(f'r{i}', 'tree', 9), {f'r{i}': Attitude(9.0, 9.0, 0.0)})
        for i in [*range(ROBOTS), 0]
    ]
    answers = [planner.satisfy(request) for request in asked]
    assert {answer.status for answer in answers} == {Status.FOUND}
    assert answers[0] == answers[-1]
    assert len(planner._grounds) == MOST_GROUNDS


def test_what_is_forgotten_is_gone_without_the_garbage_collector() -> None:
    planner = MotionPlanner(ROVER, Parameters(cache_size=2))
    start = Attitude(20.0, 20.0, 0.0)
    gc.collect()
    gc.disable()
    try:
        before = Counter(type(one).__name__ for one in gc.get_objects())
        for distance in range(30, 40):
            for mode in MODES:
                text = NEAR.format('rover0', 'location1', distance)
                planner.satisfy(GeometricRequest(text, {'rover0': start}, mode=mode))
        after = Counter(type(one).__name__ for one in gc.get_objects())
    finally:
        gc.enable()
    for kind in ('Ways', 'PaperWays', 'Pool', 'Stream', '_Recorder'):
        assert after[kind] - before[kind] <= 2, kind
    assert after['Stream'] - before['Stream'] == 2


def all_that_is_held_by(root: object) -> list[object]:
    """Everything that ``root`` refers to, but code and modules."""
    found, left = {id(root): root}, [root]
    while left:
        for one in gc.get_referents(left.pop()):
            if id(one) not in found and not isinstance(one, (ModuleType, FunctionType, type)):
                found[id(one)] = one
                left.append(one)
    return list(found.values())


def test_what_is_kept_is_bounded_in_number_and_in_bytes() -> None:
    """However many requests come that differ in everything that they can differ in."""
    planner = MotionPlanner(ROVER, Parameters(cache_size=4, planner='direct'))
    random = np.random.default_rng(5)

    def ask(count: int) -> int:
        """Bytes of the arrays that are kept after so many requests and advices."""
        for _ in range(count):
            x, y = random.uniform((10.0, 10.0), (60.0, 60.0))
            start = {'rover0': Attitude(x, y, 0.0)}
            texts = tuple(NEAR.format('rover0', 'location1', x + k) for k in range(6))
            planner.satisfy(GeometricRequest(texts[0], start, seed=int(x)))
            planner.advise(AdviceRequest(texts, start, pairwise=True))
        held = all_that_is_held_by(planner)
        full = [len(one) for one in held if isinstance(one, Cache) and len(one) == one._size]
        assert full == [4] * 5
        assert all(len(one) <= one._size for one in held if isinstance(one, Cache))
        spaces = [one for one in held if isinstance(one, FreeSpace)]
        assert [len(one._fields) for one in spaces] == [MOST_FIELDS]
        return sum(one.nbytes for one in held if isinstance(one, np.ndarray) and one.base is None)

    assert ask(MOST_FIELDS + 4) == pytest.approx(ask(MOST_FIELDS + 4), rel=0.02)


def test_no_kernel_or_reader_remembers_without_bound() -> None:
    """The memories of functions, all over the package."""
    sizes = {}
    for module in pkgutil.walk_packages(motion_planner_node.__path__, 'motion_planner_node.'):
        if not module.name.endswith(('node', 'conversions')) or module.ispkg:
            for name, one in vars(importlib.import_module(module.name)).items():
                if hasattr(one, 'cache_parameters'):
                    sizes[name] = one.cache_parameters()['maxsize']
    assert len(sizes) > 5
    assert all(size is not None and size <= 1024 for size in sizes.values()), sizes


def test_a_cache_tells_what_it_forgets_and_makes_it_anew() -> None:
    forgotten: list[int] = []
    cache: Cache[str, int] = Cache(2, forgotten.append)
    for key, value in (('a', 1), ('b', 2), ('a', 9), ('c', 3), ('b', 4)):
        cache.get(key, partial(int, value))
    assert forgotten == [2, 1]
    assert cache.get('c', lambda: 0) == 3
    cache.clear()
    assert len(cache) == 0
