"""Figures 6 and 7 in a reduced form: counts, lengths and attitudes, never seconds."""

from __future__ import annotations

import csv
import math
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import get_type_hints

import numpy as np
import pytest
import shapely

from experiments.paper.methods import part as methods
from experiments.paper.methods.findings import causes, endings_text
from experiments.paper.methods.graphs import (
    START,
    Graph,
    literal_graph,
    rover_world,
    visibility_graph,
)
from experiments.paper.methods.oracles import ShortestPaths
from experiments.paper.methods.summary import compare, slopes
from experiments.paper.methods.trials import ATTITUDES_NAME, METHODS, Bench, Trial, run_attitudes
from experiments.paper.part import Part
from experiments.paper.run import main
from motion_planner_node.world.model import Polygon
from task_planner_node.oracle import Query, Status

Trials = dict[tuple[str, str], list[Trial]]


@pytest.fixture(scope='module')
def graphs() -> tuple[Graph, Graph]:
    world = rover_world()
    dense = visibility_graph(world)
    return dense, literal_graph(dense, world, 1)


@pytest.fixture(scope='module')
def measured(tmp_path_factory: pytest.TempPathFactory) -> tuple[Part, Path]:
    folder = tmp_path_factory.mktemp('methods')
    return methods.measure(methods.QUICK, 1, folder), folder


@pytest.fixture(scope='module')
def all_trials(measured: tuple[Part, Path]) -> Trials:
    """The trials that the part has written, by graph and method."""
    found: Trials = defaultdict(list)
    with (measured[1] / 'trials.csv').open(encoding='utf-8') as file:
        for row in csv.DictReader(file):
            values = {name: kind(row[name]) for name, kind in get_type_hints(Trial).items()}
            trial = Trial(**values)
            found[trial.graph, trial.method].append(trial)
    return found


@pytest.fixture(scope='module', params=['swapped', 'literal'])
def trials(request: pytest.FixtureRequest, all_trials: Trials) -> dict[str, list[Trial]]:
    return {
        method: members for (graph, method), members in all_trials.items() if graph == request.param
    }


def total(trials: Sequence[Trial]) -> tuple[int, float]:
    return sum(trial.work for trial in trials), sum(trial.length for trial in trials)


def test_both_readings_of_the_graph(graphs: tuple[Graph, Graph]) -> None:
    dense, sparse = graphs
    assert 60 <= len(dense.points) <= 80
    assert 900 <= len(dense.arcs) <= 1300
    assert (len(sparse.points), len(sparse.arcs)) == (1126, 70)
    assert len(sparse.goals) >= 15
    world = rover_world()
    obstacles = shapely.union_all(
        [
            shapely.Polygon(obstacle.corners)
            if isinstance(obstacle, Polygon)
            else shapely.Point(obstacle.center).buffer(obstacle.radius)
            for obstacle in world.obstacles
        ]
    )
    (robot,) = world.robots.values()
    for graph in graphs:
        for (a, b), length in graph.arcs.items():
            ends = graph.points[a], graph.points[b]
            assert graph.arcs[b, a] == length == pytest.approx(math.dist(*ends))
            assert shapely.LineString(ends).distance(obstacles) > robot.radius - 1e-3
        assert np.isfinite(shortest(graph)).all()


def shortest(graph: Graph) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Lengths between all joined waypoints, by Floyd and Warshall."""
    labels = graph.joined
    lengths = np.full((len(labels), len(labels)), np.inf)
    np.fill_diagonal(lengths, 0.0)
    for (a, b), length in graph.arcs.items():
        lengths[labels.index(a), labels.index(b)] = length
    for k in range(len(labels)):
        lengths = np.minimum(lengths, lengths[:, k, None] + lengths[None, k])
    return lengths


def test_the_external_reasoner_answers_with_shortest_ways(graphs: tuple[Graph, Graph]) -> None:
    for graph in graphs:
        paths, labels, lengths = ShortestPaths(graph), graph.joined, shortest(graph)
        start = labels.index(START)
        for number, goal in enumerate(labels):
            answer = paths.satisfy(Query((), f'((agent r)(object {goal}))', START, 0))
            assert answer.status == Status.FOUND
            assert answer.length == pytest.approx(lengths[start, number])
            way = answer.payload
            assert isinstance(way, list)
            assert (way[0], way[-1]) == (START, goal)
            driven = sum(graph.arcs[arc] for arc in pairwise(way))
            assert driven == pytest.approx(lengths[start, number])
    alone = next(label for label in graphs[1].points if label not in graphs[1].joined)
    answer = ShortestPaths(graphs[1]).satisfy(Query((), f'((object {alone}))', START, 0))
    assert answer.status == Status.IMPOSSIBLE


def test_linear_matching_costs_the_symbolic_search_most(trials: dict[str, list[Trial]]) -> None:
    assert all(trial.solved for members in trials.values() for trial in members)
    work = {label: total(members)[0] for label, members in trials.items()}
    assert work['blind, linear'] > 12 * work['hybrid, linear']
    assert work['nearest first, linear'] > work['blind, linear']
    for name in ('blind', 'nearest first', 'hybrid'):
        assert work[f'{name}, indexed'] < work[f'{name}, linear'] / 5
    assert [trial.requests for trial in trials['hybrid, linear']] == list(methods.QUICK.goals)
    assert not any(trial.requests for trial in trials['blind, linear'])


@pytest.mark.parametrize('name', ['blind', 'nearest first'])
def test_a_goal_costs_a_symbolic_search_more_comparisons_and_more_steps(
    trials: dict[str, list[Trial]], name: str
) -> None:
    """Figure 6 in counts, goal by goal: matching, which an index makes cheap, and HTN steps, which stay."""
    for matching, factor in (('linear', 30), ('indexed', 10)):
        for searched, twin in zip(
            trials[f'{name}, {matching}'], trials[f'hybrid, {matching}'], strict=True
        ):
            assert searched.goals == twin.goals
            assert searched.work > factor * twin.work
            assert searched.decompositions > 8 * twin.decompositions


def test_matching_does_not_change_the_plans(trials: dict[str, list[Trial]]) -> None:
    for name in ('blind', 'nearest first', 'hybrid'):
        linear, indexed = trials[f'{name}, linear'], trials[f'{name}, indexed']
        assert [(t.length, t.steps) for t in linear] == [(t.length, t.steps) for t in indexed]
    blind, circles = trials['blind, linear'], trials['blind, circles left to the search, linear']
    assert [trial.length for trial in blind] == [trial.length for trial in circles]


def test_the_hybrid_drives_less(trials: dict[str, list[Trial]]) -> None:
    for label in ('blind, linear', 'nearest first, linear'):
        found = compare(trials[label], trials['hybrid, linear'])
        assert found.sizes_with_hybrid_shorter == len(methods.QUICK.goals)
        assert total(trials[label])[1] > total(trials['hybrid, linear'])[1]
        assert all(ratio.least >= 1.0 - 1e-9 for ratio in found.length_ratios.values())


def test_tables_for_programs_hold_every_method_and_size(
    measured: tuple[Part, Path], all_trials: Trials
) -> None:
    _, folder = measured
    with (folder / 'comparisons.csv').open(encoding='utf-8') as file:
        rows = {(row['graph'], row['method']): row for row in csv.DictReader(file)}
    assert set(rows) == set(all_trials)
    for key, row in rows.items():
        assert int(row['trials']) == len(all_trials[key])
        assert float(row['seconds_per_goal_lower']) <= float(row['seconds_per_goal_upper'])
    with (folder / 'length_ratios.csv').open(encoding='utf-8') as file:
        ratios = {(r['graph'], r['method'], int(r['goals'])): r for r in csv.DictReader(file)}
    for graph, method in all_trials:
        for trial in all_trials[graph, method]:
            (twin,) = (t for t in all_trials[graph, 'hybrid, linear'] if t.goals == trial.goals)
            for column in ('ratio_lower', 'ratio_median', 'ratio_upper'):
                ratio = float(ratios[graph, method, trial.goals][column])
                assert ratio == pytest.approx(trial.length / twin.length)


def test_attitudes_make_ways_shorter_than_from_waypoint_to_waypoint(
    trials: dict[str, list[Trial]],
) -> None:
    driven, paths = trials[ATTITUDES_NAME], trials['hybrid, linear']
    assert all(trial.solved and trial.requests >= trial.goals for trial in driven)
    assert total(driven)[1] < total(paths)[1]


def test_every_size_is_planned_without_a_limit_before_any_counts(
    monkeypatch: pytest.MonkeyPatch, graphs: tuple[Graph, Graph]
) -> None:
    planned: list[tuple[float, int]] = []

    def drive(bench: Bench, _planner: object, _start: object, count: int, number: int) -> Trial:
        planned.append((bench.limit, count))
        return trial(count, number, 0.1)

    monkeypatch.setattr(Bench, 'drive', drive)
    counted = list(run_attitudes(Bench(graphs[0], 1, 2.0), rover_world(), (1, 3), 2))
    assert [one.goals for one in counted] == [1, 3, 1, 3]
    assert planned == [(math.inf, 1), (math.inf, 3), *[(2.0, 1), (2.0, 3)] * 2]


def test_one_number_of_goals_is_measured_by_all_methods_but_has_no_slope(tmp_path: Path) -> None:
    page = tmp_path / 'page.md'
    main(
        [
            *('--only', 'methods', '--quick', '--goals', '2'),
            *('--output', f'{tmp_path}', '--page', f'{page}'),
        ]
    )
    with (tmp_path / 'methods' / 'trials.csv').open(encoding='utf-8') as file:
        rows = [(row['graph'], row['method'], row['goals']) for row in csv.DictReader(file)]
    assert len(set(rows)) == len(rows) == 2 * (len(METHODS) + 1)
    assert {goals for _, _, goals in rows} == {'2'}
    text = page.read_text(encoding='utf-8')
    assert 'times the hybrid' in text
    assert 'nan' not in text
    assert 'added goal by' not in text


@pytest.mark.parametrize('goals', ['0', '-3', 'few', '1.5'])
def test_a_wrong_number_of_goals_is_refused(goals: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(['--only', 'methods', f'--goals={goals}'])
    assert 'at least 1' in capsys.readouterr().err


def test_more_goals_than_there_are_waypoints_are_refused(tmp_path: Path) -> None:
    with pytest.raises(SystemExit, match='no more than 29 goals'):
        main(['--only', 'methods', '--goals', '30', '--output', f'{tmp_path}'])


def trial(goals: int, number: int, seconds: float, outcome: str = 'SOLVED') -> Trial:
    length = 100.0 * goals if outcome == 'SOLVED' else math.nan
    reason = '' if outcome == 'SOLVED' else 'no time left'
    return Trial(
        *('g', 'm', goals, number, outcome, seconds, length, 10 * goals, 0, 0, goals), reason=reason
    )


def test_slopes_are_those_of_the_trials_with_a_plan() -> None:
    members = [trial(n, k, 0.5 + 0.1 * (k + 1) * n) for n in (1, 2, 3, 4) for k in (0, 1)]
    members[-1] = trial(4, 1, 99.0, 'CANCELLED')
    assert slopes(members) == pytest.approx({0: 0.1, 1: 0.2})
    hybrid = [replace(trial(n, k, 0.01 * n), length=80.0 * n) for n in (1, 2, 3, 4) for k in (0, 1)]
    found = compare(members, hybrid)
    assert found.unsolved == 1
    assert found.endings == {'CANCELLED: no time left': 1}
    assert found.slope_ratio.median == pytest.approx(15.0)
    assert (found.hybrid_shorter, found.compared) == (7, 7)
    assert {ratio.median for ratio in found.length_ratios.values()} == {1.25}


def test_the_cause_is_told_of_each_graph_by_its_own_figures() -> None:
    def taking(seconds: float) -> list[Trial]:
        return [trial(n, 0, seconds * n) for n in (1, 2, 3)]

    hybrid = taking(0.01)
    slopes_of = {'swapped': (0.33, 0.08), 'literal': (0.15, 0.12)}
    at = {
        (graph, f'{name}, {matching}'): compare(taking(slope), hybrid)
        for graph, both in slopes_of.items()
        for matching, slope in zip(('linear', 'indexed'), both, strict=True)
        for name in ('blind', 'nearest first')
    }
    large, small = causes(at).split('; ')
    assert '8.0 and 8.0 instead of 33.0 and 33.0 on the large graph' in large
    assert 'matching is most of the cause' in large
    assert '12.0 and 12.0 instead of 15.0 and 15.0 on the small graph' in small
    assert 'the number of HTN steps is most of the cause' in small


def test_a_search_without_a_plan_has_a_reason(graphs: tuple[Graph, Graph]) -> None:
    given_up = Bench(graphs[0], 1, 0.0).trial(METHODS[0], 2, 0)
    assert not given_up.solved
    assert given_up.reason
    found = compare([given_up], [Bench(graphs[0], 1, 2.0).trial(METHODS[0], 2, 0)])
    assert f'1 {given_up.outcome}: {given_up.reason}' in endings_text([found], 0.0)


def test_the_part_tells_what_was_measured(measured: tuple[Part, Path], all_trials: Trials) -> None:
    part, folder = measured
    lengths = [t for t in part.targets if t.name.startswith('numbers of goals')]
    assert len(lengths) == 4
    assert all(t.met for t in lengths)
    assert len(part.claims) == 3
    assert all(method in part.text for _, method in all_trials)
    for told in ('**The target**', '**The cause**', '**Drivable motions**', 'All searches found'):
        assert told in part.text
    assert len(all_trials) == 2 * (len(METHODS) + 1)
    assert all(len(members) == 2 for members in all_trials.values())
    for name in ('graphs', 'figure_6', 'figure_7', 'length_ratios'):
        assert (folder / f'{name}.svg').stat().st_size > 0
        assert (folder / f'{name}.png').read_bytes().startswith(b'\x89PNG')
