"""The experiment on constraints in a reduced form: what it counts, not how long it takes."""

from __future__ import annotations

import math
from collections.abc import Mapping

import pytest

from experiments.constraints.formulations import FORMULATIONS, violation
from experiments.constraints.judge import Judge
from experiments.constraints.run import search, search_targets
from experiments.constraints.search import Bench, Outcome
from experiments.constraints.sets import AGENT, ConstraintSet, read_map, read_sets
from experiments.results import Target

SETS = {constraints.name: constraints for constraints in read_sets()}
JUDGE = Judge(read_map(), AGENT)


@pytest.fixture(scope='module')
def outcomes() -> Mapping[str, Outcome]:
    """All sets from two batches of starts each."""
    return {outcome.name: outcome for outcome in search(list(SETS.values()), 128, seed=3)}


def test_the_search_reaches_what_was_to_be_reached(outcomes: Mapping[str, Outcome]) -> None:
    for target in search_targets(list(outcomes.values())):
        assert target.met, str(target)


def test_sets_about_one_object_are_solved_from_every_start(outcomes: Mapping[str, Outcome]) -> None:
    for name in ('worked_example', 'take_photo', 'photo_from_75', 'thin_ring'):
        assert outcomes[name].solved >= 0.9 * outcomes[name].starts, name


@pytest.mark.parametrize(
    ('text', 'pose', 'missed'),
    [
        ('facing(rover0, a)', (100.0, 200.0, 0.25), 0.25),
        ('object_on_left(rover0, a)', (200.0, 100.0, 0.0), 0.0),
        ('object_on_right(rover0, a)', (200.0, 100.0, 0.0), math.pi),
        ('object_behind(rover0, a)', (200.0, 300.0, math.pi / 2), 0.0),
        ('field_of_view(rover0, a, deg(60))', (100.0, 200.0, 1.0), 1.0 - math.pi / 6),
        ('not(field_of_view(rover0, a, deg(60)))', (100.0, 200.0, 1.0), 0.0),
        ('inside(rover0, pond)', (350.0, 520.0, 0.0), 10.0),
        ('outside(rover0, court)', (410.0, 100.0, 0.0), 10.0),
        ('distance_to_boundary(rover0, pond) = 5', (350.0, 450.0, 0.0), 55.0),
        ('clearance(rover0) >= 20', (330.0, 200.0, 0.0), 10.0),
        ('clearance(rover0) >= 20', (5.0, 200.0, 0.0), 15.0),
        ('visible(rover0, b)', (310.0, 200.0, 0.0), 20.0),
        ('visible(rover0, a)', (310.0, 200.0, 0.0), 0.0),
        ('not(visible(rover0, a))', (310.0, 200.0, 0.0), 1.0),
        ('cross_track(rover0, a, b) = 7', (0.0, 210.0, 0.0), 3.0),
        ('along_track(rover0, a, b) = -50', (100.0, 210.0, 0.0), 50.0),
        ('distance_to_segment(rover0, a, b) <= 7', (510.0, 200.0, 0.0), 3.0),
        ('equidistant(rover0, a, b)', (200.0, 200.0, 0.0), 300.0),
        ('same_heading(rover0, rover1)', (0.0, 0.0, 2.0), 0.5),
        ('angle_between(bearing(rover0, a), heading(rover0)) = 1', (0.0, 200.0, -1.5), 0.5),
        ('rover0.x != a.x', (200.0, 0.0, 0.0), 1.0),
        ('min(distance(rover0, a), rover0.x) >= 150', (100.0, 200.0, 0.0), 50.0),
        ('distance(rover0, a) >= 50', (200.0, 240.0, 0.0), 10.0),
        ('distance(rover0, a) <= 50', (200.0, 240.0, 0.0), 0.0),
        ('rel_angle(rover0, a) = cos-and-sin(pi/2)', (100.0, 200.0, math.pi / 2), 0.0),
        ('rel_angle(rover0, a) = cos-and-sin(pi/2)', (100.0, 200.0, -math.pi / 2), math.pi),
        ('rover0.heading = 2 * pi + 1', (1.0, 1.0, 1.5), 0.5),
        ('rover0.x * 2 - a.y / 4 = -a.reach', (0.0, 0.0, 0.0), 10.0),
        ('rover0.x > 5', (5.0, 0.0, 0.0), 1.0),
        ('rover0.x <= 9', (-3.0, 0.0, 0.0), 3.0),
        ('rover0.x <= 9', (3.0, math.nan, 0.0), math.inf),
    ],
)
def test_the_judge_computes_what_a_person_would(
    text: str, pose: tuple[float, float, float], missed: float
) -> None:
    constraints = ConstraintSet('', (text,), feasible=True, agents=(), objects=())
    assert JUDGE.violation(constraints, pose) == pytest.approx(missed)


@pytest.mark.parametrize('name', FORMULATIONS)
def test_the_peers_are_given_the_same_sets(name: str) -> None:
    """Formulation and judge agree on how far random attitudes are off, up to inequalities met."""
    for x, y, heading in Bench().starts(5, 50).tolist():
        by_judge = JUDGE.violation(SETS[name], (x, y, heading))
        assert violation(FORMULATIONS[name], (x, y, heading)) == pytest.approx(by_judge)


@pytest.mark.parametrize('name', FORMULATIONS)
def test_the_peers_are_given_the_right_derivatives(name: str) -> None:
    step = 1e-6
    for pose in Bench().starts(6, 20).tolist():
        for row in FORMULATIONS[name]:
            slope = row.slope(*pose)[1:]
            for component in range(3):
                ends = []
                for sign in (1.0, -1.0):
                    moved = list(pose)
                    moved[component] += sign * step
                    ends.append(row.slope(*moved)[0])
                quotient = math.remainder(ends[0] - ends[1], math.tau) / (2.0 * step)
                assert slope[component] == pytest.approx(quotient, abs=1e-4)


def test_targets_know_their_side() -> None:
    assert Target('', 1.0, 2.0).met
    assert not Target('', 1.0, 2.0, at_least=True).met
    assert 'MISSED' in str(Target('', math.nan, 2.0))
