"""The search for the best known tour in a reduced form: it only ever gets shorter, and is sound."""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from experiments.motion.geometry import Array
from experiments.motion.goals import AGENT
from experiments.motion.grounds import lattice_of
from experiments.motion.lattice import Lattice
from experiments.motion.worlds import Place, rover
from experiments.paper.best_known import __main__ as search
from experiments.paper.best_known import kept
from experiments.paper.best_known.effort import QUICK
from experiments.paper.best_known.polishing import polished
from experiments.paper.orders import shortest_tours
from tests.support.checker import Judge
from tests.support.missions import ROVER

PHOTOS = [f'location{k}' for k in range(1, 9)]
ROUNDS = 2


@pytest.fixture(scope='module')
def place(tmp_path_factory: pytest.TempPathFactory) -> Place:
    return rover(tmp_path_factory.mktemp('rover'))


@pytest.fixture(scope='module')
def lattice(place: Place) -> Lattice:
    return lattice_of(place)


@pytest.fixture(scope='module')
def found(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The plan that a short search has kept."""
    file = tmp_path_factory.mktemp('best_known') / 'rover.json'
    search.main(['--quick', '--rounds', str(ROUNDS), '--file', str(file)])
    return file


def test_a_short_search_finds_a_plan_without_faults(found: Path) -> None:
    judge = Judge(found, ROVER / 'world.yaml')
    assert judge.complaints() == []
    assert sorted(step['action'][2] for step in judge.plan['steps'][1:]) == PHOTOS


def test_the_shortest_round_is_kept(found: Path, place: Place, lattice: Lattice) -> None:
    lengths = [
        search.round_of(place, lattice, np.random.default_rng(seed), QUICK)[2]
        for seed in range(1, ROUNDS + 1)
    ]
    assert kept.read(found)['length'] == pytest.approx(min(lengths), rel=1e-9)


def command_of(document: Mapping[str, Any]) -> list[str]:
    """The arguments of the command that made a plan."""
    told: str = document['made_by']
    return told.removeprefix('python -m experiments.paper.best_known ').split()


def test_what_is_kept_is_made_again_by_its_command(found: Path, tmp_path: Path) -> None:
    document = kept.read(found)
    search.main([*command_of(document), '--file', str(tmp_path / 'again.json')])
    assert kept.read(tmp_path / 'again.json') == document


def test_the_command_tells_that_it_found_what_is_kept(
    found: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / 'kept.json'
    shutil.copyfile(found, file)
    search.main([*command_of(kept.read(found)), '--file', str(file)])
    assert capsys.readouterr().out.strip().endswith('the length of the tour that is kept')
    assert file.read_bytes() == found.read_bytes()


def test_lengths_are_told_beside_the_one_that_is_kept() -> None:
    assert search.told(10.0 + 1e-12, 10.0) == search.told(10.0 - 1e-12, 10.0)
    assert search.told(10.0, 10.0) == 'the length of the tour that is kept'
    assert search.told(9.5, 10.0) == search.told(9.5, math.inf) == 'the shortest so far: kept'
    assert search.told(12.0, 10.0) == '2.000 m longer than the tour that is kept'


def test_what_is_no_shorter_is_not_kept(found: Path, tmp_path: Path) -> None:
    document = kept.read(found)
    shorter = {**document, 'length': document['length'] - 1e-3}
    file = tmp_path / 'kept.json'
    file.write_text(json.dumps(shorter), encoding='utf-8')
    search.main([*command_of(document), '--file', str(file)])
    assert kept.read(file) == shorter


def test_the_best_known_is_no_longer_than_what_a_short_search_finds(found: Path) -> None:
    assert kept.read()['length'] <= kept.read(found)['length']


@pytest.mark.parametrize('seed', [1, 2])
def test_a_tour_is_never_longer_than_where_it_began(
    place: Place, lattice: Lattice, seed: int
) -> None:
    random = np.random.default_rng(seed)
    goals = list(search.goals_of(place).values())
    roadmap = search.roadmap_of(place, lattice, random, QUICK)
    tour = next(shortest_tours(roadmap.costs))
    legs = roadmap.legs(tour)
    rings = search.rings_of(goals[i] for i in tour.order)
    begun = document_of(place, lattice, legs, tour.order)
    assert begun['length'] == pytest.approx(tour.length)
    for moves in (0, 30, QUICK.moves):
        shorter, length = polished(lattice.ground, legs, rings, random, moves)
        assert length <= tour.length + 1e-9
        ended = document_of(place, lattice, shorter, tour.order)
        assert ended['length'] == pytest.approx(length)
    assert length < tour.length - 1.0


def document_of(
    place: Place, lattice: Lattice, legs: Sequence[Array], order: Sequence[int]
) -> dict[str, Any]:
    labels = list(search.goals_of(place))
    robot = place.document['robots'][AGENT]
    return kept.plan_of(lattice.ground, legs, [labels[i] for i in order], robot)


@pytest.mark.parametrize('which', ['best known', 'short search'])
def test_the_length_that_is_told_is_that_of_the_motions(which: str, found: Path) -> None:
    document = kept.read() if which == 'best known' else kept.read(found)
    driven = 0.0
    for step in document['steps']:
        length = sum(segment[1] for segment in step['segments'])
        assert step['length'] == pytest.approx(length, abs=1e-9)
        assert length >= math.dist(*((step[at]['x'], step[at]['y']) for at in ('start', 'end')))
        driven += length
    assert document['length'] == pytest.approx(driven, abs=1e-9)
