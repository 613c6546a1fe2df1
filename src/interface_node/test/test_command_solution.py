"""What is printed about a solved mission."""

from __future__ import annotations

import re
from math import atan2, cos, hypot, isclose, pi, sin

from hypothesis import assume, given
from hypothesis import strategies as st

from interface_node.command_line.progress import progress_line
from interface_node.command_line.results import MissionResult, Progress
from interface_node.command_line.solution import (
    distance_and_angle,
    objective,
    solution_plan,
    step_table,
    totals,
)
from interface_node.plan import Attitude, Plan, Step, World

WORLD = World('w.yaml', 'r1', (0, 0, 800, 600), {'location0': (20, 20), 'location1': (67, 171)})
INIT = Step(
    action=('!init_rover_attitude', 'rover0', 'location0'),
    agent='rover0',
    objects=('location0',),
    end=Attitude(20.0, 20.0, 0.0),
    assigned=True,
)
PHOTO = Step(
    action=('!take_photo', 'rover0', 'location1', 'cam_0'),
    agent='rover0',
    objects=('location1',),
    end=Attitude(67.0, 101.0, pi),
    length=123.45,
)
TALK = Step(action=('!send', 'photo'))
coordinates = st.floats(-1000, 1000)


def plan_of(*steps: Step) -> Plan:
    statistics = {
        'requests': 9,
        'found': 7,
        'impossible': 1,
        'unknown': 1,
        'advices': 4,
        'backtracks': 2,
        'geometric_backtracks': 3,
        'search_time': 0.1,
        'request_time': 0.2,
        'transport_time': 0.05,
    }
    return Plan('m', 'SOLVED', world=WORLD, steps=steps, planning_time=0.35, statistics=statistics)


def test_the_plan_is_printed_as_in_the_paper() -> None:
    assert solution_plan([INIT, PHOTO]) == (
        'SOLUTION PLAN:',
        '1:(!init_rover_attitude rover0 location0)',
        '2:(!take_photo rover0 location1 cam_0)',
    )


def test_an_empty_plan_has_only_its_heading() -> None:
    assert solution_plan([]) == ('SOLUTION PLAN:',)
    assert len(step_table(plan_of())) == 2


def test_the_table_holds_attitude_objective_and_length_of_each_step() -> None:
    heading, rule, *rows = step_table(plan_of(INIT, PHOTO, TALK))
    assert set(rule) == {'-', ' '}
    cells = [re.split(r' {2,}', row.strip()) for row in (heading, *rows)]
    assert cells[0][2:] == [
        'x [m]',
        'y [m]',
        'heading [deg]',
        'distance [m]',
        'angle [deg]',
        'path [m]',
        'total [m]',
    ]
    assert cells[1][2:] == ['20.0', '20.0', '0.0', '0.0', '-', '0.0', '0.0']
    assert cells[2][1:] == [
        '!take_photo rover0 location1 cam_0',
        '67.0',
        '101.0',
        '180.0',
        '70.0',
        '90.0',
        '123.5',
        '123.5',
    ]
    assert cells[3][1:] == ['!send photo', '-', '-', '-', '-', '-', '-', '123.5']
    assert len({len(row) for row in (rule, *rows)}) == 1


def test_nothing_is_printed_as_minus_zero() -> None:
    step = Step(('!a',), end=Attitude(-0.0, -0.04, -1e-9), agent='r')
    assert '-0.0' not in '\n'.join(step_table(plan_of(step)))


@given(coordinates, coordinates, st.floats(-pi, pi), st.floats(1, 500), st.floats(-pi, pi))
def test_distance_and_angle_are_those_of_the_papers_table_2(
    x: float, y: float, heading: float, distance: float, bearing: float
) -> None:
    place = (x + distance * cos(bearing), y + distance * sin(bearing))
    found, angle = distance_and_angle(Attitude(x, y, heading), place)
    assert angle is not None
    assert isclose(found, distance, rel_tol=1e-9, abs_tol=1e-9)
    assert -pi <= angle <= pi
    dx, dy = place[0] - x, place[1] - y
    # f1 and f2 of Table 2: the cosine and the sine of the relative angle.
    norm = hypot(dx, dy)
    f1 = (dx * cos(heading) + dy * sin(heading)) / norm
    f2 = (dx * sin(heading) - dy * cos(heading)) / norm
    assert isclose(cos(angle), f1, abs_tol=1e-9)
    assert isclose(sin(angle), f2, abs_tol=1e-9)


def test_at_the_objective_there_is_no_angle() -> None:
    assert distance_and_angle(Attitude(3, 4, 1), (3, 4)) == (0.0, None)


@given(coordinates, coordinates)
def test_an_objective_on_the_right_is_at_plus_90_degrees(x: float, y: float) -> None:
    assume(hypot(x, y) > 1e-3)
    _, angle = distance_and_angle(Attitude(0, 0, atan2(y, x)), (y, -x))
    assert angle is not None
    assert isclose(angle, pi / 2, abs_tol=1e-9)


def test_the_objective_is_the_first_object_that_stands_somewhere() -> None:
    step = Step(('!a',), objects=('cam_0', 'location1', 'location0'))
    assert objective(step, WORLD) == (67, 171)
    assert objective(step, None) is None
    assert objective(Step(('!a',), objects=('cam_0',)), WORLD) is None


def test_the_totals_name_lengths_times_counts_and_files() -> None:
    text = '\n'.join(totals(MissionResult(plan_of(INIT, PHOTO), ('out/plan.json', 'out/m.png'))))
    for part in (
        '123.5 m',
        '0.350 s (search 0.100 s, requests 0.200 s, transport 0.050 s)',
        '9 (7 found, 1 impossible, 1 unknown), 4 advices',
        '2 over tasks, 3 over destinations',
        'out/plan.json',
        'out/m.png',
    ):
        assert part in text


def test_totals_do_without_statistics() -> None:
    assert totals(MissionResult(Plan('m', 'SOLVED')))


def test_the_progress_line_says_what_is_known() -> None:
    assert progress_line(Progress('loading', elapsed=0.04)) == 'loading  0.0 s'
    line = progress_line(Progress('searching', 3, 8, 17, 2, 1234.56, 2.34))
    assert line == 'searching  goals 3/8  requests 17  backtracks 2  best 1234.6 m  2.3 s'
