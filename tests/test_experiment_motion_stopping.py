"""The experiment on searches that are told to stop: what it asks and counts, not seconds."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from experiments.motion import stopping
from experiments.motion.goals import AGENT
from experiments.motion.reference import read
from experiments.motion.report import stopping_table
from experiments.motion.run import stopping_targets
from experiments.motion.worlds import rover
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.stopping import ShouldStop, never

KNOWN = read('rover').known[:7]


def test_each_way_of_telling_is_tried_alone_and_beside_another_robot(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[GeometricRequest] = []

    def satisfy(
        planner: MotionPlanner, request: GeometricRequest, should_stop: ShouldStop = never
    ) -> GeometricAnswer:
        asked.append(request)
        return answer(planner, request, should_stop)

    answer = MotionPlanner.satisfy
    monkeypatch.setattr(MotionPlanner, 'satisfy', satisfy)
    place = rover(tmp_path)
    rows = stopping.measure(place, KNOWN)
    ways = [(row['beside_another'], row['told_by']) for row in rows]
    assert ways == [(k, name) for k in (False, True) for name in ('deadline', 'cancel')]
    for row in rows:
        # The first and the last are told so at once.
        assert 2 <= row['stopped'] <= row['requests'] == len(KNOWN)
        assert 0.0 < row['late_ms_p50'] <= row['late_ms_p99'] <= row['late_ms_max']
    alone, crowded = asked[: 2 * len(KNOWN)], asked[2 * len(KNOWN) :]
    assert {tuple(request.start) for request in alone} == {(AGENT,)}
    for request in crowded:
        here, there = request.start[AGENT], request.start[stopping.OTHER]
        assert math.hypot(here.x - there.x, here.y - there.y) > 3.0 * place.robot['radius']
    places = [request.start[stopping.OTHER] for request in crowded]
    assert len(set(places)) >= len(KNOWN) - 1
    assert 'rover | yes' in ' '.join(stopping_table({'rover': rows}).split())


def test_targets_are_those_of_the_worst_way_and_world() -> None:
    def world(alone: float, beside: float) -> list[dict[str, object]]:
        return [
            {'beside_another': False, 'late_ms_max': alone},
            {'beside_another': True, 'late_ms_max': beside},
        ]

    worlds = {'a': world(9.0, 7.0), 'b': world(3.0, 60.0)}
    assert [target.value for target in stopping_targets(worlds)] == [9.0, 60.0]
    assert [target.met for target in stopping_targets(worlds)] == [True, False]
