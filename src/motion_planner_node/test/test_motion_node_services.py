"""The motion planner as a process of its own, asked over ROS 2."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
from geohtn_msgs import msg, srv
from rcl_interfaces.srv import DescribeParameters, SetParameters
from rclpy.parameter import Parameter

from tests.support.motion_planner import (
    DEADLINE,
    PACKAGE,
    ROVER,
    START,
    Asker,
    start_node,
    wait_until_ready,
)
from tests.support.processes import output_of
from tests.support.spinning import DOMAIN

PHOTO = (
    '((agent rover0)(object {0})(distance(rover0, {0}) >= 50)(distance(rover0, {0}) <= 100)'
    '(rel_angle(rover0, {0}) = cos-and-sin(pi/2)))'
)


@pytest.fixture(scope='module')
def process() -> Iterator[subprocess.Popen[str]]:
    with start_node() as process:
        wait_until_ready(process)
        yield process
        assert process.poll() is None, 'the node did not outlive the tests'
        process.send_signal(signal.SIGTERM)
        assert process.wait(timeout=DEADLINE) == 0


@pytest.fixture(scope='module')
def asker(process: subprocess.Popen[str]) -> Iterator[Asker]:
    asker = Asker()
    yield asker
    asker.close()


@pytest.fixture
def rover(asker: Asker) -> Asker:
    assert asker.set_world(ROVER.read_text(encoding='utf-8')).accepted
    return asker


def test_without_a_world_everything_says_so(asker: Asker) -> None:
    assert not asker.call(srv.GetWorld, '/get_world').available
    assert asker.satisfy(PHOTO.format('location1')).code == msg.GeometricAnswer.NO_WORLD
    assert asker.advise(PHOTO.format('location1')).code == msg.GeometricAnswer.NO_WORLD
    check = asker.call(
        srv.CheckPreconditions, '/check_preconditions', preconditions=PHOTO.format('?o')
    )
    assert check.valid


def test_the_world_can_be_read_back_and_a_bad_one_leaves_it(rover: Asker) -> None:
    held = rover.call(srv.GetWorld, '/get_world')
    assert held.available
    assert [item.label for item in held.world.objects] == [f'location{i}' for i in range(9)]
    assert len(held.world.obstacles) == 13
    assert held.world.robots[0].wheelbase == 8.0
    for text in ('', 'bounds: [0, 0, nan, 1]', '{', '\x01', 'x' * (1 << 20) + 'x'):
        refused = rover.set_world(text)
        assert not refused.accepted
        assert refused.diagnostics[0].message
        assert refused.diagnostics[0].source == 'world.yaml'
    assert rover.call(srv.GetWorld, '/get_world').world == held.world


def test_a_request_is_answered_and_published(rover: Asker) -> None:
    rover.events.clear()
    answer = rover.satisfy(
        PHOTO.format('location1'), request_id='r7', action=['!take_photo'], seed=2**64 - 1
    )
    assert answer.status == msg.GeometricAnswer.FOUND
    assert answer.request_id == 'r7'
    assert answer.motion.start == START
    assert answer.length == pytest.approx(sum(part.length for part in answer.motion.segments))
    assert 0.0 < answer.time_spent < DEADLINE
    advice = rover.advise(PHOTO.format('location1'), PHOTO.format('location5'), request_id='a1')
    assert list(advice.order) == [0, 1]
    assert advice.candidates[0].lower_bound <= answer.length
    rover.spin_until(lambda: len(rover.events) >= 2)
    first, second = rover.events
    assert (first.kind, second.kind) == (msg.PlanningEvent.REQUEST, msg.PlanningEvent.ADVICE)
    assert first.request[0].action == ['!take_photo']
    assert first.answer[0] == answer
    assert second.advice_answer[0] == advice
    assert second.advice_request[0].request_id == 'a1'
    assert (first.received.sec, first.received.nanosec) <= (
        first.answered.sec,
        first.answered.nanosec,
    )


def test_a_motion_is_told_as_poses(rover: Asker) -> None:
    motion = rover.satisfy(PHOTO.format('location1')).motion
    response = rover.call(srv.SampleMotion, '/sample_motion', motion=motion, spacing=2.0)
    assert response.code == msg.GeometricAnswer.NONE
    poses = response.path.poses
    assert len(poses) > motion.length / 2.0
    assert poses[0].pose.position.x == START.x
    assert poses[-1].header.stamp.sec == int(motion.duration)
    motion.agent = 'ghost'
    refused = rover.call(srv.SampleMotion, '/sample_motion', motion=motion, spacing=2.0)
    assert refused.code == msg.GeometricAnswer.UNKNOWN_AGENT
    assert 'ghost' in refused.message


@pytest.mark.parametrize(
    ('preconditions', 'fields', 'code'),
    [
        ('', {}, 'INVALID_PRECONDITIONS'),
        ('\x07garbage \U0001f916', {}, 'INVALID_PRECONDITIONS'),
        ('(' * 70_000, {}, 'INVALID_PRECONDITIONS'),
        ('((agent ghost))', {}, 'UNKNOWN_AGENT'),
        (PHOTO.format('ghost'), {}, 'UNKNOWN_OBJECT'),
        (PHOTO.format('location1'), {'start': []}, 'NO_START'),
        (PHOTO.format('location1'), {'start': [START, START]}, 'INVALID_START'),
        (PHOTO.format('location1'), {'world_revision': 'x'}, 'WORLD_CHANGED'),
        (PHOTO.format('location1'), {'behaviour': 'slowly'}, 'UNSUPPORTED'),
        (PHOTO.format('location1'), {'time_budget': nan}, 'UNSUPPORTED'),
        (PHOTO.format('location1'), {'time_budget': 1e-9, 'seed': 99}, 'OUT_OF_TIME'),
        (
            PHOTO.format('location1'),
            {'start': [msg.AgentState(agent='rover0', x=inf)]},
            'INVALID_START',
        ),
    ],
)
def test_nonsense_is_answered_with_its_cause(
    rover: Asker, preconditions: str, fields: dict[str, Any], code: str
) -> None:
    answer = rover.satisfy(preconditions, **fields)
    assert answer.code == getattr(msg.GeometricAnswer, code)
    assert answer.message
    assert answer.world_revision


def test_advice_on_nonsense_is_answered_with_its_cause(rover: Asker) -> None:
    assert rover.advise('((', world_revision='x').code == msg.GeometricAnswer.WORLD_CHANGED
    assert rover.advise(purpose=9).code == msg.GeometricAnswer.UNSUPPORTED
    assert rover.advise(start=[START, START]).code == msg.GeometricAnswer.INVALID_START
    advice = rover.advise('((', PHOTO.format('location1'))
    assert advice.candidates[0].code == msg.GeometricAnswer.INVALID_PRECONDITIONS
    assert list(advice.order) == [1, 0]


def test_places_and_what_lies_between_come_through(rover: Asker) -> None:
    texts = [PHOTO.format('location1'), PHOTO.format('location5')]
    reached = rover.satisfy(texts[1])
    (end,) = reached.end
    rover.events.clear()
    advice = rover.advise(*texts, places=4, ends=[msg.AgentState(), end])
    owner = list(advice.place_candidates)
    of = [[n for n, candidate in enumerate(owner) if candidate == k] for k in (0, 1)]
    assert all(1 <= len(numbers) <= 4 for numbers in of)
    assert sum(map(len, of)) == len(advice.places)
    assert {state.agent for state in advice.places} == {'rover0'}
    assert advice.places[of[1][0]] == end
    count = len(owner)
    rows = [advice.place_lengths[k : k + count] for k in range(0, (count + 1) * count, count)]
    assert len(advice.place_lengths) == (count + 1) * count
    for row, own in zip(rows, [None, *owner], strict=True):
        assert [length < inf for length in row] == [other != own for other in owner]
    for number in of[0]:
        place = advice.places[number]
        answer = rover.satisfy(texts[0], preferred_end=[place])
        assert (answer.end[0].x, answer.end[0].y) == pytest.approx((place.x, place.y), abs=1e-6)
    rover.spin_until(lambda: bool(rover.events))
    told = next(event for event in rover.events if event.kind == msg.PlanningEvent.ADVICE)
    assert (told.advice_request[0].places, told.advice_answer[0]) == (4, advice)
    refused = rover.advise(*texts, places=4, ends=[msg.AgentState(agent='ghost')] * 2)
    assert refused.code == msg.GeometricAnswer.UNKNOWN_AGENT
    assert rover.advise(*texts, ends=[end]).places == []


def test_a_heading_beyond_a_turn_is_wrapped(rover: Asker) -> None:
    start = msg.AgentState(agent='rover0', x=20.0, y=20.0, heading=7.0)
    answer = rover.satisfy(PHOTO.format('location1'), start=[start])
    assert answer.status == msg.GeometricAnswer.FOUND
    assert answer.motion.start.heading == pytest.approx(7.0 - 2.0 * 3.141592653589793)


def test_checks_name_the_place_in_the_file(rover: Asker) -> None:
    check = rover.call(
        srv.CheckPreconditions,
        '/check_preconditions',
        preconditions='((agent ?r)(object ?o)\n (nearness(?r, ?o) <= 5))',
        source='domain.lisp',
        line=40,
        column=7,
    )
    assert not check.valid
    (remark,) = check.diagnostics
    assert (remark.source, remark.line, remark.column) == ('domain.lisp', 41, 3)
    assert 'nearness' in remark.message
    assigns = rover.call(
        srv.CheckPreconditions,
        '/check_preconditions',
        preconditions='((agent ?r)(object ?o)(setProperty(?r.x, ?o.x)))',
    )
    assert assigns.valid
    assert assigns.assigns


def test_parameters_are_described_changed_and_refused(rover: Asker) -> None:
    described = rover.call(
        DescribeParameters, '/motion_planner_node/describe_parameters', names=['time_budget']
    )
    assert described.descriptors[0].floating_point_range[0].to_value == 3600.0
    assert '[s]' in described.descriptors[0].description

    def change(name: str, value: object) -> Any:
        parameters = [Parameter(name, value=value).to_parameter_msg()]
        service = '/motion_planner_node/set_parameters'
        return rover.call(SetParameters, service, parameters=parameters).results[0]

    assert change('time_budget', 10).successful
    refused = change('time_budget', 'soon')
    assert not refused.successful
    assert "not 'soon'" in refused.reason
    assert not change('rounds', 0).successful
    assert not change('world', 'other.yaml').successful
    assert rover.satisfy(PHOTO.format('location1')).status == msg.GeometricAnswer.FOUND


def test_replicas_give_the_same_answer(rover: Asker) -> None:
    asked = [
        rover.satisfy(PHOTO.format('location4'), alternative=alternative, seed=5)
        for alternative in (2, 0, 2)
    ]
    for answer in asked:
        answer.time_spent = 0.0
    assert asked[0] == asked[2]
    assert asked[0].motion != asked[1].motion


@pytest.mark.parametrize(
    ('arguments', 'code', 'expected'),
    [
        (['--help'], 0, 'usage: motion_planner_node'),
        (['--nonsense'], 2, 'unknown argument --nonsense'),
        (['--ros-args', '-p', 'time_budget:=soon'], 2, "not 'soon'"),
        (['--ros-args', '-p', 'rounds:=0'], 2, 'rounds'),
        (['--ros-args', '-p', 'rounds'], 2, 'wrong ROS arguments: Failed to parse'),
        (['--ros-args', '-p', 'world:=nowhere.yaml'], 2, 'nowhere.yaml: No such file'),
    ],
)
def test_a_wrong_start_ends_in_a_sentence(arguments: list[str], code: int, expected: str) -> None:
    with start_node(*arguments) as process:
        output = output_of(process, DEADLINE)
    assert process.returncode == code
    assert expected in output
    assert 'Traceback' not in output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_node_cleanly(number: signal.Signals) -> None:
    with start_node('--ros-args', '-p', f'world:={ROVER}') as process:
        wait_until_ready(process)
        process.send_signal(number)
        output = output_of(process, DEADLINE)
    assert process.returncode == 0, output
    assert 'Traceback' not in output


def test_a_broken_package_of_functions_keeps_the_node_from_starting(tmp_path: Path) -> None:
    information = tmp_path / 'broken-1.dist-info'
    information.mkdir()
    (information / 'METADATA').write_text('Metadata-Version: 2.1\nName: broken\nVersion: 1\n')
    (information / 'entry_points.txt').write_text(
        '[motion_planner_node.functions]\nsensors = no_such_module:FUNCTIONS\n'
    )
    paths = [str(tmp_path), str(PACKAGE), os.environ.get('PYTHONPATH', '')]
    done = subprocess.run(
        [sys.executable, '-m', 'motion_planner_node'],
        env=os.environ | {'PYTHONPATH': os.pathsep.join(paths), 'ROS_DOMAIN_ID': str(DOMAIN)},
        capture_output=True,
        text=True,
        timeout=DEADLINE,
        check=False,
    )
    assert done.returncode == 2
    assert 'the plugin sensors (no_such_module:FUNCTIONS) cannot be loaded' in done.stderr
    assert 'Traceback' not in done.stdout + done.stderr


def test_pairwise_costs_of_a_thousand_candidates_come_through(rover: Asker) -> None:
    set_here = (
        '((agent rover0)(setProperty(rover0.x, 20))(setProperty(rover0.y, 20))'
        '(setProperty(rover0.heading, 0)))'
    )
    texts = [PHOTO.format('location1'), PHOTO.format('location2'), *[set_here] * 998]
    answer = rover.advise(*texts, pairwise=True)
    assert len(answer.candidates) == len(answer.order) == 1000
    for matrix in (answer.pairwise_lower_bounds, answer.pairwise_estimates):
        assert len(matrix) == 1_000_000
        assert min(matrix[1], matrix[1000]) > 0.0
        assert matrix[1001] == matrix[2] == 0.0
