"""The interface node among planners that do as they are told: outcomes, cancelling, recording."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import groupby
from pathlib import Path
from time import monotonic

import pytest
from action_msgs.msg import GoalStatus
from geohtn_msgs import msg
from rclpy.parameter import Parameter

from interface_node.node import InterfaceNode
from interface_node.plan import Plan
from interface_node.recording.errors import RecordingError
from interface_node.recording.message_conversions import EVENTS, read_messages
from interface_node.replay_node import MotionPlannerUnavailable, replay
from interface_node.waiting import wait_for, wait_until
from tests.support.obedient_planners import (
    Client,
    ObedientMotionPlanner,
    ObedientTaskPlanner,
    never,
)
from tests.support.processes import output_of, running
from tests.support.spinning import DOMAIN, PATIENCE, spinning


@dataclass
class Team:
    """The node under test, its client, and the planners."""

    client: Client
    node: InterfaceNode
    motion_planner: ObedientMotionPlanner
    task_planner: ObedientTaskPlanner


@pytest.fixture
def interface() -> Iterator[InterfaceNode]:
    with spinning(lambda context: InterfaceNode(context=context)) as node:
        yield node


@pytest.fixture
def client(interface: InterfaceNode) -> Iterator[Client]:
    with spinning(Client) as node:
        yield node


@pytest.fixture
def team(client: Client, interface: InterfaceNode, sample_steps: list[msg.Step]) -> Iterator[Team]:
    with (
        spinning(ObedientMotionPlanner) as motion_planner,
        spinning(lambda context: ObedientTaskPlanner(context, sample_steps)) as task_planner,
    ):
        yield Team(client, interface, motion_planner, task_planner)


def test_a_mission_is_planned_published_and_written(
    team: Team, tmp_path: Path, sample_plan: Plan
) -> None:
    out = tmp_path / 'new' / 'out'
    answer = team.client.plan(output_directory=str(out))
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    result = answer.result
    assert result.outcome.value == msg.Outcome.SOLVED, result.outcome.explanation
    assert result.plan.length == pytest.approx(sample_plan.length)
    assert set(result.files) == {str(file) for file in out.iterdir()}
    assert sorted(file.name for file in out.iterdir()) == [
        'mission.mcap',
        'mission.png',
        'plan.ipc',
        'plan.json',
        'tree.json',
        'tree.svg',
        'tree.txt',
    ]
    assert (out / 'tree.txt').read_text(encoding='utf-8').startswith('tree of ')
    assert (out / 'tree.svg').read_text(encoding='utf-8').startswith('svg of ')
    document = json.loads((out / 'plan.json').read_text(encoding='utf-8'))
    assert [tuple(step['action']) for step in document['steps']] == [
        step.action for step in sample_plan.steps
    ]
    recorded = list(read_messages(out / 'mission.mcap'))
    events = [found.message for found in recorded if found.topic == EVENTS]
    assert len(events) == 3
    assert len({event.request[0].mission for event in events}) == 1
    topics = {found.topic for found in recorded}
    assert topics >= {'/global_plan', '/path', '/map', '/markers', '/mission/outcome'}
    phases = [p for p, _ in groupby(team.client.feedback) if p != 'searching']
    assert [p for p, _ in groupby(phases)] == ['loading', 'checking', 'writing']


def test_a_recording_is_replayed_and_differences_are_told(
    team: Team, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('ROS_DOMAIN_ID', str(DOMAIN))
    team.client.plan(output_directory=str(tmp_path))
    report = replay(tmp_path / 'mission.mcap')
    assert (report.requests, report.equal, report.same) == (3, 3, True)
    team.motion_planner.extra = 0.5
    report = replay(tmp_path / 'mission.mcap')
    assert (report.equal, report.same) == (0, False)
    assert report.differences[0].endswith('length was 4.0 and now is 4.5')


def test_without_a_motion_planner_there_is_no_replay(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('ROS_DOMAIN_ID', str(DOMAIN))
    (tmp_path / 'no.mcap').write_bytes(b'no')
    with pytest.raises(RecordingError):
        replay(tmp_path / 'no.mcap')
    world = msg.SourceText(text='world')
    monkeypatch.setattr('interface_node.replay_node._read', lambda _: (world, []))
    with pytest.raises(MotionPlannerUnavailable, match='is not running'):
        replay(tmp_path / 'no.mcap')


@pytest.mark.parametrize(
    ('arguments', 'code', 'text'),
    [
        (['--help'], 0, 'usage: interface_node'),
        (['--nonsense'], 2, 'interface_node: unknown argument --nonsense'),
        (['--ros-args', '-p', 'rounds'], 2, 'wrong ROS arguments: Failed to parse'),
        (['--ros-args', '-p', 'path_spacing:=far'], 2, 'path_spacing'),
    ],
)
def test_the_command_line(arguments: list[str], code: int, text: str) -> None:
    with running([sys.executable, '-m', 'interface_node', *arguments]) as process:
        output = output_of(process, PATIENCE)
    assert process.returncode == code
    assert text in output
    assert 'Traceback' not in output


def test_missing_planners_are_named_within_five_seconds(client: Client, tmp_path: Path) -> None:
    started = monotonic()
    answer = client.plan(output_directory=str(tmp_path))
    assert monotonic() - started < 5.0
    assert answer.status == GoalStatus.STATUS_ABORTED
    result = answer.result
    assert result.outcome.value == msg.Outcome.UNAVAILABLE
    for name in ('motion_planner_node', 'task_planner_node'):
        assert f'{name} is not running: start it with `' in result.outcome.explanation
    document = json.loads((tmp_path / 'plan.json').read_text(encoding='utf-8'))
    assert document['outcome'] == 'UNAVAILABLE'


def test_bad_input_is_told_and_the_next_mission_is_planned(team: Team, tmp_path: Path) -> None:
    missing = str(tmp_path / 'none.lisp')
    answer = team.client.plan(problem=msg.SourceText(path=missing))
    assert answer.status == GoalStatus.STATUS_ABORTED
    result = answer.result
    assert result.outcome.value == msg.Outcome.INVALID
    assert [remark.source for remark in result.outcome.diagnostics] == [missing]
    result = team.client.plan(world=msg.SourceText(path='w.yaml', text='refuse')).result
    assert result.outcome.value == msg.Outcome.INVALID
    (remark,) = result.outcome.diagnostics
    assert (remark.source, remark.line, remark.column) == ('w.yaml', 2, 3)
    answer = team.client.plan('break')
    assert answer.result.outcome.value == msg.Outcome.FAILED
    assert answer.status == GoalStatus.STATUS_ABORTED
    assert 'task_planner_node' in answer.result.outcome.explanation
    assert team.client.plan().result.outcome.value == msg.Outcome.SOLVED


def test_steps_that_do_not_fit_together_are_no_plan(team: Team, tmp_path: Path) -> None:
    (tmp_path / 'mission.png').write_bytes(b'of an earlier mission')
    answer = team.client.plan('jump', output_directory=str(tmp_path))
    assert answer.status == GoalStatus.STATUS_ABORTED
    outcome = answer.result.outcome
    assert outcome.value == msg.Outcome.FAILED
    assert 'step 2, (!take_photo rover0 gate cam_0)' in outcome.explanation
    assert answer.result.plan.steps == []


@pytest.mark.parametrize(
    ('where', 'reason'),
    [('file/out', 'Not a directory'), ('file', 'it is no directory')],
)
def test_where_nothing_can_be_written_the_plan_is_returned_all_the_same(
    team: Team, tmp_path: Path, where: str, reason: str
) -> None:
    (tmp_path / 'file').write_bytes(b'')
    answer = team.client.plan(output_directory=str(tmp_path / where))
    result = answer.result
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    assert result.outcome.value == msg.Outcome.SOLVED
    assert result.plan.steps
    assert result.files == []
    (remark,) = result.outcome.diagnostics
    assert remark.severity == msg.Diagnostic.ERROR
    assert (remark.source, remark.message) == (
        str(tmp_path / where),
        f'cannot be written: {reason}',
    )
    assert str(tmp_path / where) in result.outcome.explanation


@pytest.mark.parametrize('name', ['plan.json', 'mission.png', 'mission.mcap', 'tree.svg'])
def test_a_file_that_cannot_be_written_does_not_hinder_the_others(
    team: Team, tmp_path: Path, name: str
) -> None:
    (tmp_path / name).mkdir()
    result = team.client.plan(output_directory=str(tmp_path)).result
    trees = {'tree.txt', 'tree.json', 'tree.svg', 'plan.ipc'}
    names = {'plan.json', 'mission.png', 'mission.mcap'} | trees
    assert {Path(file).name for file in result.files} == names - {name}
    assert {file.name for file in tmp_path.iterdir()} == names
    (remark,) = result.outcome.diagnostics
    assert remark.source == str(tmp_path / name)
    assert remark.message == 'cannot be written: Is a directory'


def test_a_recording_without_all_events_is_a_warning(team: Team, tmp_path: Path) -> None:
    team.node.set_parameters([Parameter('recording_timeout', value=0.1)])
    result = team.client.plan('silent', output_directory=str(tmp_path)).result
    assert result.outcome.value == msg.Outcome.SOLVED
    (remark,) = result.outcome.diagnostics
    assert remark.severity == msg.Diagnostic.WARNING
    assert 'it holds 0 of 3 answers' in remark.message
    left = {Path(file).name for file in result.files}
    trees = {'tree.txt', 'tree.json', 'tree.svg', 'plan.ipc'}
    assert left == {'plan.json', 'mission.png', 'mission.mcap'} | trees


@pytest.mark.parametrize('domain', ['solve', 'late'])
def test_no_better_plan_is_lost_when_word_of_it_comes_late(
    team: Team, tmp_path: Path, sample_plan: Plan, domain: str
) -> None:
    team.client.plan(domain, output_directory=str(tmp_path))
    document = json.loads((tmp_path / 'plan.json').read_text(encoding='utf-8'))
    lengths = [told['length'] for told in document['improvements']]
    assert lengths == pytest.approx([sample_plan.length + worse for worse in (2.0, 1.0, 0.0)])
    recorded = read_messages(tmp_path / 'mission.mcap')
    told = [found.message for found in recorded if found.topic == '/mission/progress']
    assert sorted(progress.best_length for progress in told) == pytest.approx(lengths[::-1])


def test_a_parameter_is_changed_while_the_node_runs(interface: InterfaceNode) -> None:
    (refused,) = interface.set_parameters([Parameter('path_spacing', value=-1.0)])
    assert 'path_spacing must be a number from' in refused.reason
    (accepted,) = interface.set_parameters([Parameter('path_spacing', value=2.5)])
    assert accepted.successful
    assert interface.get_parameter('path_spacing').value == 2.5


def test_a_mission_is_told_of_twice_a_second_while_nothing_else_happens(team: Team) -> None:
    handle = team.client.send('search')
    assert team.task_planner.searching.wait(10)
    wait_until(lambda: len(team.client.feedback) >= 7, monotonic() + 5, never)
    handle.cancel_goal_async()
    wait_for(handle.get_result_async(), monotonic() + 10, never)


def test_a_task_planner_that_hangs_is_given_up(team: Team) -> None:
    started = monotonic()
    answer = team.client.plan('hang')
    team.task_planner.released.set()
    assert answer.result.outcome.value == msg.Outcome.UNAVAILABLE
    assert 'task_planner_node vanished or hangs' in answer.result.outcome.explanation
    assert monotonic() - started < 6.0


def test_a_mission_is_cancelled_in_mid_search_and_only_one_runs_at_a_time(team: Team) -> None:
    handle = team.client.send('search')
    assert team.task_planner.searching.wait(10)
    assert not team.client.send().accepted, 'one mission at a time'
    started = monotonic()
    handle.cancel_goal_async()
    answer = wait_for(handle.get_result_async(), monotonic() + 10, never)
    assert monotonic() - started < 1.0
    assert answer.status == GoalStatus.STATUS_CANCELED
    assert answer.result.outcome.value == msg.Outcome.CANCELLED
    assert team.task_planner.cancelled.is_set()
    assert team.client.plan().result.outcome.value == msg.Outcome.SOLVED
