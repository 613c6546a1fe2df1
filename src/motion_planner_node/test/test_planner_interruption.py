"""A request that is broken off ends soon, says so, and leaves nothing behind."""

from __future__ import annotations

from math import inf
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code
from motion_planner_node.parameters import Parameters
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.planning.answers import as_cancelled
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.satisfaction.branch_and_prune import BATCH, BUDGET
from motion_planner_node.world import read_world

WORLD = Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
PLANNER = MotionPlanner(
    read_world(WORLD.read_text(encoding='utf-8'), 'world.yaml'), Parameters(paper_tries=3)
)
START = {'rover0': Attitude(20.0, 20.0, 0.0)}
#: A destination behind obstacles; a contradiction that takes many boxes; one that is never proven.
TEXTS = (
    (
        '((agent rover0)(object location4)(distance(rover0, location4) >= 50)'
        '(distance(rover0, location4) <= 100)(rel_angle(rover0, location4) = cos-and-sin(pi/2)))'
    ),
    (
        '((agent rover0)(object location2)(object location3)(visible(rover0, location2))'
        '(distance(rover0, location3) <= 30)(rover0.heading = 1))'
    ),
    (
        '((agent rover0)(object location1)(distance(rover0, location1) <= 200)'
        '(distance(rover0, location1) * distance(rover0, location1) >= 40001))'
    ),
)


class After:
    """Says to stop from the n-th question on; counts the questions."""

    def __init__(self, most: float = inf) -> None:
        self.most = most
        self.asked = 0

    def __call__(self) -> bool:
        self.asked += 1
        return self.asked > self.most


@settings(max_examples=25, deadline=None)
@given(st.sampled_from(TEXTS), st.sampled_from(['default', 'paper']), st.floats(0.0, 1.0))
def test_it_stops_at_the_first_question_and_the_next_answer_is_the_same(
    text: str, mode: str, share: float
) -> None:
    request = GeometricRequest(text, START, mode=mode)
    whole = After()
    expected = MotionPlanner(PLANNER.world, Parameters(paper_tries=3)).satisfy(request, whole)
    part = After(int(share * (whole.asked - 1)))
    planner = MotionPlanner(PLANNER.world, Parameters(paper_tries=3))
    assert planner.satisfy(request, part).code is Code.OUT_OF_TIME
    assert part.asked == part.most + 1
    assert planner.satisfy(request) == expected


@pytest.mark.parametrize(('text', 'least'), [(TEXTS[1], 100), (TEXTS[2], BUDGET // BATCH)])
def test_proofs_and_explanations_ask_whether_to_stop(text: str, least: int) -> None:
    """One that is never proven asks before each batch of boxes until its budget is spent."""
    questions = After()
    PLANNER.satisfy(GeometricRequest(text, START, seed=7), questions)
    assert questions.asked > least


def test_a_cancelled_answer_says_so_and_any_other_stays() -> None:
    late = PLANNER.satisfy(GeometricRequest(TEXTS[0], START, seed=3), lambda: True)
    assert as_cancelled(late).code is Code.CANCELLED
    assert 'cancelled' in as_cancelled(late).message
    found = PLANNER.satisfy(GeometricRequest(TEXTS[0], START, seed=3))
    assert as_cancelled(found) is found
