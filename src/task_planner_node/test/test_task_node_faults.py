"""The node itself: what it answers when the motion planner is missing or stuck, and how it stops."""

from __future__ import annotations

import math
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import pytest
from geohtn_msgs.action import PlanTasks
from geohtn_msgs.msg import PlanningOptions, SourceText
from geohtn_msgs.srv import (
    Explain,
)
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from task_planner_node.node import NAME, TaskPlannerNode
from task_planner_node.outcomes import Outcome
from tests.support.processes import output_of, running
from tests.support.spinning import DOMAIN, PATIENCE, spinning
from tests.support.tiny_motion_planner import tiny_motion_planner

ROVER = Path(__file__).parents[2] / 'interface_node' / 'missions' / 'rover'


def until(condition: Callable[[], bool]) -> None:
    pause = threading.Event()
    end = time.monotonic() + PATIENCE
    while not condition():
        assert time.monotonic() < end
        pause.wait(0.01)


def wait(future: Any) -> Any:
    done = threading.Event()
    future.add_done_callback(lambda _: done.set())
    assert done.wait(PATIENCE), 'no answer'
    return future.result()


class MissionClient(Node):
    """Sends missions and waits for their ends."""

    def __init__(self, context: Context) -> None:
        super().__init__('mission_client', context=context)
        self.actions = ActionClient(self, PlanTasks, 'plan_tasks')
        self.explain = self.create_client(Explain, 'explain')
        self.phases: list[str] = []
        self.improved: list[str] = []

    def send(
        self, mission: str, domain: SourceText, problem: SourceText, time_budget: float = 0.0
    ) -> Any:
        goal = PlanTasks.Goal(
            mission=mission,
            domain=domain,
            problem=problem,
            options=PlanningOptions(use_advice=True, time_budget=time_budget),
        )
        return self.send_goal(goal)

    def send_goal(self, goal: PlanTasks.Goal) -> Any:
        assert self.actions.wait_for_server(PATIENCE)

        def hear(message: Any) -> None:
            self.phases.append(message.feedback.progress.phase)
            self.improved += message.feedback.progress.improved

        return wait(self.actions.send_goal_async(goal, hear))

    def plan(self, mission: str = 'm', domain: str = 'domain', problem: str = 'problem') -> Any:
        sources = [
            SourceText(path=str(ROVER / f'{name}.lisp'))
            if name.isalpha()
            else SourceText(text=name)
            for name in (domain, problem)
        ]
        return wait(self.send(mission, *sources).get_result_async()).result

    def why(self, mission: str, form: str = '') -> Any:
        assert self.explain.wait_for_service(PATIENCE)
        return wait(self.explain.call_async(Explain.Request(mission=mission, format=form)))


@pytest.fixture
def planner() -> Iterator[TaskPlannerNode]:
    with spinning(TaskPlannerNode, close=TaskPlannerNode.close) as node:
        node.set_parameters([Parameter('service_timeout', value=2.0)])
        yield node


@pytest.fixture
def client(planner: TaskPlannerNode) -> Iterator[MissionClient]:
    with spinning(MissionClient) as node:
        yield node


def test_without_a_motion_planner_the_mission_is_unavailable_and_the_next_one_is_served(
    client: MissionClient,
) -> None:
    began = time.monotonic()
    result = client.plan()
    assert time.monotonic() - began < 5.0
    assert result.outcome.value == Outcome.UNAVAILABLE
    assert 'the motion planner is not running' in result.outcome.explanation
    symbolic = '(defdomain d ((:operator (!a) () () ())))'
    result = client.plan('symbolic', symbolic, '(defproblem p d () ((!a)))')
    assert result.outcome.value == Outcome.SOLVED
    assert [list(step.action) for step in result.steps] == [['!a']]
    assert result.steps[0].answer == []
    result = client.plan('bad', symbolic, '(defproblem p d () ((!b)))')
    assert result.outcome.value == Outcome.INVALID
    (diagnostic,) = result.outcome.diagnostics
    assert (diagnostic.source, diagnostic.line, diagnostic.column) == ('<problem>', 1, 21)
    assert client.why('').text == client.why('bad').text
    assert 'not running' in client.why('m').text
    assert not client.why('nobody').available
    assert client.why('symbolic', 'tree').text == '1. (!a)\n'
    assert client.why('symbolic', 'svg').text.startswith('<svg ')
    for mission, form in (('symbolic', 'png'), ('bad', 'tree'), ('m', 'json')):
        assert not client.why(mission, form).available


def test_the_answers_of_the_motion_planner_are_passed_on_unopened(client: MissionClient) -> None:
    with tiny_motion_planner():
        result = client.plan()
    assert result.outcome.value == Outcome.SOLVED
    assert len(result.steps) == 9
    assert [len(step.start) for step in result.steps] == [0] + [1] * 8
    ids = [step.answer[0].request_id for step in result.steps]
    assert len(set(ids)) == len(ids)
    assert all(name.startswith('m:') for name in ids)
    assert result.statistics.requests == 9
    assert client.phases[:2] == ['loading', 'checking']
    # Backwards advice at every choice: the last goal first, and so on.
    assert [step.action[2] for step in result.steps[1:3]] == ['location8', 'location7']


WALK = """(defdomain d (
(:operator (!walk ?x ?y) ((at ?x)(road ?x ?y)) ((at ?x)) ((at ?y)) (call * 1 1))
(:operator (!ride ?x ?y) ((at ?x)(bus ?x ?y)) ((at ?x)) ((at ?y)) 5)
(:method (go ?x ?y) ((at ?x)) ((!walk ?x ?y)))
(:method (go ?x ?y) () ((!ride ?x ?y)))))"""
TRIP = '(defproblem p d ((at {})(road a b)(bus a b)(bus b c){}) ((go a b) (go b c)))'


def test_a_plan_is_gone_on_with_and_several_are_given(client: MissionClient) -> None:
    def plan(mission: str, problem: str, **fields: Any) -> Any:
        texts = {'domain': SourceText(text=WALK), 'problem': SourceText(text=problem)}
        goal = PlanTasks.Goal(mission=mission, **texts, **fields)
        return wait(client.send_goal(goal).get_result_async()).result

    def actions(steps: Any) -> list[str]:
        return [' '.join(step.action) for step in steps]

    options = PlanningOptions(optimise=True, plans=3)
    best = plan('trip', TRIP.format('a', '(road b c)'), options=options)
    assert actions(best.steps) == ['!walk a b', '!walk b c']
    assert [other.cost for other in best.others] == [6.0, 6.0]
    # Feedback that overtakes the goal's acceptance is lost, and this mission takes no time.
    for _ in range(20):
        if client.improved:
            break
        plan('trip', TRIP.format('a', '(road b c)'), options=options)
    assert client.improved[-2:] == ['(!walk a b)', '(!walk b c)']
    rest = plan('rest', TRIP.format('b', '(road b c)'), resumes='trip', executed=1)
    assert actions(rest.steps) == ['!walk b c']
    blocked = plan('blocked', TRIP.format('b', ''), resumes='trip', executed=1)
    assert actions(blocked.steps) == ['!ride b c']
    nothing = plan('nothing', TRIP.format('b', ''), resumes='never', executed=1)
    assert nothing.outcome.value == Outcome.INVALID
    assert 'no plan of a mission never to go on with' in nothing.outcome.explanation


@pytest.mark.parametrize('waits', ['running', 'queued'])
def test_a_cancelled_mission_ends_at_once(client: MissionClient, waits: str) -> None:
    files = [SourceText(path=str(ROVER / name)) for name in ('domain.lisp', 'problem.lisp')]
    with tiny_motion_planner(stuck=True) as tiny:
        first = client.send('first', *files)
        assert tiny.asked.wait(PATIENCE)
        goal = first if waits == 'running' else client.send('second', *files)
        began = time.monotonic()
        wait(goal.cancel_goal_async())
        result = wait(goal.get_result_async()).result
        assert time.monotonic() - began < 0.5
        assert result.outcome.value == Outcome.CANCELLED
        if waits == 'running':
            until(lambda: tiny.cancelled == tiny.asked_for)
        tiny.release.set()
        if waits == 'queued':
            result = wait(first.get_result_async()).result
            assert result.outcome.value == Outcome.SOLVED


def test_a_stuck_motion_planner_is_given_up(
    planner: TaskPlannerNode, client: MissionClient
) -> None:
    planner.set_parameters(
        [Parameter('request_time_budget', value=0.2), Parameter('service_timeout', value=1.0)]
    )
    with tiny_motion_planner(stuck=True):
        result = client.plan()
    assert result.outcome.value == Outcome.UNAVAILABLE
    assert 'satisfy_preconditions' in result.outcome.explanation


def test_a_motion_planner_that_falls_silent_is_given_up_long_before_its_budget_is_spent(
    planner: TaskPlannerNode, client: MissionClient
) -> None:
    planner.set_parameters([Parameter('request_time_budget', value=3600.0)])
    with tiny_motion_planner(stuck=True, mute=True):
        result = client.plan()
    assert result.outcome.value == Outcome.UNAVAILABLE
    assert 'was stopped' in result.outcome.explanation


def test_a_wrong_parameter_is_refused_with_a_sentence(planner: TaskPlannerNode) -> None:
    (answer,) = planner.set_parameters([Parameter('time_budget', value=-1.0)])
    assert not answer.successful
    assert 'from 0.1 to 86400 s' in answer.reason
    (answer,) = planner.set_parameters([Parameter('time_budget', value=50)])
    assert answer.successful


@pytest.mark.parametrize('time_budget', [math.nan, math.inf, -math.inf, -1.0])
def test_a_time_budget_that_is_none_is_refused(client: MissionClient, time_budget: float) -> None:
    texts = ('(defdomain d ((:operator (!a) () () ())))', '(defproblem p d () ((!a)))')
    domain, problem = (SourceText(text=text) for text in texts)
    result = wait(client.send('m', domain, problem, time_budget).get_result_async()).result
    assert result.outcome.value == Outcome.INVALID
    assert 'options.time_budget has to be a finite number of seconds' in result.outcome.explanation
    (diagnostic,) = result.outcome.diagnostics
    assert f'not {time_budget:g}' in diagnostic.message


def run_node(*arguments: str) -> AbstractContextManager[subprocess.Popen[str]]:
    return running(
        [sys.executable, '-X', 'faulthandler', '-m', NAME, *arguments],
        {**os.environ, 'ROS_DOMAIN_ID': str(DOMAIN)},
    )


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_a_signal_stops_the_process_without_a_traceback(number: signal.Signals) -> None:
    with run_node() as process:
        assert process.stdout is not None
        line = process.stdout.readline()
        assert 'ready' in line, line + process.stdout.read()
        process.send_signal(number)
        rest = output_of(process, PATIENCE)
    assert process.returncode == 0
    assert rest == ''


@pytest.mark.parametrize(
    ('arguments', 'code', 'text'),
    [
        (('--help',), 0, 'examples:'),
        (('--ros-args', '-p', 'max_depth:=3'), 2, 'from 100 to 2e+07'),
        (('--ros-args', '-p', 'time_budget:=soon'), 2, "not 'soon'"),
        (('--nonsense',), 2, 'unrecognized'),
        (('--ros-args', '--nonsense'), 2, "wrong ROS arguments: ['--nonsense']"),
        (('--ros-args', '-p', 'rounds'), 2, 'wrong ROS arguments: Failed to parse'),
    ],
)
def test_the_command_line(arguments: tuple[str, ...], code: int, text: str) -> None:
    with run_node(*arguments) as process:
        output = output_of(process, PATIENCE)
    assert process.returncode == code
    assert text in output
    assert 'Traceback' not in output
