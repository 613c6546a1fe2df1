"""Tours beside routing libraries in a reduced form: lengths alone, and no library is needed."""

from __future__ import annotations

import csv
import itertools
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from experiments.ordering import libraries, run
from experiments.ordering.matrices import groups_of
from experiments.paper.orders import Costs, shortest_tours
from motion_planner_node.tours.chains import Groups

PHOTOS = 9
BRIDGES = (0, 4, 16, 64)


@pytest.fixture(scope='module')
def groups() -> Groups:
    return groups_of(PHOTOS, seed=2)


def shortest(groups: Groups) -> float:
    """Length [m] of the shortest tour, by dynamic programming over subsets."""
    rows = [np.arange(f, f + n) for f, n in zip(groups.first[1:], groups.sizes[1:], strict=True)]
    costs = groups.costs.astype(np.float64)
    between = {
        (i, j): costs[np.ix_(rows[i], rows[j])]
        for i, j in itertools.permutations(range(len(rows)), 2)
    }
    return next(shortest_tours(Costs([costs[0, own] for own in rows], between))).length


def test_matrices_hold_a_way_to_each_photo(groups: Groups) -> None:
    assert len(groups.sizes) == PHOTOS + 1
    assert groups.sizes[0] == 1
    assert groups.costs.shape == (groups.sizes.sum(), groups.sizes.sum())
    assert (groups.costs >= 0.0).all()
    for first, size in zip(groups.first[1:], groups.sizes[1:], strict=True):
        assert np.isfinite(groups.costs[0, first : first + size]).any()


def test_the_local_search_finds_the_shortest_tour_of_few_photos(groups: Groups) -> None:
    lengths = [one.length for one in run.searched(groups, BRIDGES, seed=1)]
    assert lengths == sorted(lengths, reverse=True)
    assert lengths[-1] == pytest.approx(shortest(groups), rel=1e-6)
    assert min(lengths) >= shortest(groups) * (1.0 - 1e-6)


def first_places(
    matrix: libraries.Matrix, owner: NDArray[np.int64], _seconds: float, _seed: int
) -> list[int]:
    """A library that meets the groups as they come, from the place of each that is nearest."""
    tour, at = [], 0
    for group in range(1, int(owner.max()) + 1):
        members = np.flatnonzero(owner == group)
        at = int(members[np.argmin(matrix[at, members])])
        tour.append(at)
    return tour


def test_the_local_search_is_no_longer_than_a_library(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, 'LIBRARIES', {'plain': first_places})
    monkeypatch.setattr(run, 'installed', lambda: {'plain': '1.0'})
    run.main(['--quick', '--output', str(tmp_path)])
    results = json.loads((tmp_path / 'results.json').read_text(encoding='utf-8'))
    assert results['figures']['libraries'] == {'plain': '1.0'}
    assert len(results['targets']) == len(run.QUICK.goals)
    assert all(target['met'] for target in results['targets'])
    with (tmp_path / 'tours.csv').open(encoding='utf-8') as file:
        rows = list(csv.DictReader(file))
    ways = len(run.QUICK.bridges) + len(run.QUICK.seconds)
    assert len(rows) == ways * len(run.QUICK.goals)
    assert all(math.isfinite(float(row['length'])) for row in rows)


def test_a_longer_tour_than_a_librarys_is_told() -> None:
    found = [
        run.Found(8, run.LOCAL_SEARCH, 0, 90.0, 0.1),
        run.Found(8, run.LOCAL_SEARCH, 16, 110.0, 0.1),
        run.Found(8, 'plain', 1.0, 120.0, 1.0),
        run.Found(8, 'plain', 10.0, 100.0, 10.0),
    ]
    soon, late = run.targets_of(found, 16)
    assert soon.value == pytest.approx(110.0 / 120.0)
    assert soon.met
    assert late.value == pytest.approx(1.1)
    assert not late.met
    assert run.targets_of(found[:2], 16) == []
    assert '| 8 | 90 (0.1 s) | 110 (0.1 s) | 120 | 100 |' in run.shown(found)


def test_what_is_not_installed_is_left_out(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.setattr(libraries, 'PACKAGES', {'PyVRP': 'no-such-package', 'OR-Tools': 'numpy'})
    assert list(libraries.installed()) == ['OR-Tools']
    monkeypatch.setattr(run, 'installed', dict)
    run.main(['--quick', '--goals', '4', '--output', str(tmp_path)])
    told = capsys.readouterr().out
    assert 'PyVRP is not installed' in told
    assert 'OR-Tools is not installed' in told
    assert (tmp_path / 'tours.csv').exists()


@settings(max_examples=30)
@given(st.integers(0, 2**32 - 1))
def test_whole_numbers_tell_the_length_of_a_tour_to_centimetres(seed: int) -> None:
    random = np.random.default_rng(seed)
    owner = np.array([0, 1, 1, 2, 3, 3])
    costs = random.uniform(1.0, 900.0, (6, 6)).astype(np.float32)
    matrix = libraries.whole(costs)
    assert (matrix[:, 0] == 0).all()
    tour = [int(random.integers(1, 3)), 3, int(random.integers(4, 6))]
    random.shuffle(tour)
    driven = sum(matrix[a, b] for a, b in itertools.pairwise([0, *tour]))
    length = libraries.length_of(costs, owner, tour)
    assert length == pytest.approx(driven / libraries.SCALE, abs=0.5 * len(tour) / libraries.SCALE)


def test_a_tour_that_leaves_a_photo_out_or_has_no_way_is_infinitely_long() -> None:
    owner = np.array([0, 1, 2])
    costs = np.ones((3, 3), np.float32)
    costs[1, 2] = np.inf
    assert libraries.length_of(costs, owner, [2, 1]) == 2.0
    assert libraries.length_of(costs, owner, [1, 2]) == math.inf
    assert libraries.length_of(costs, owner, [1]) == math.inf
    assert libraries.length_of(costs, owner, []) == math.inf
    assert libraries.whole(costs)[1, 2] == int(libraries.NO_WAY * libraries.SCALE)
