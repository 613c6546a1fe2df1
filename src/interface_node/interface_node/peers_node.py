"""The other two nodes as the interface sees them: calls that end in time."""

from __future__ import annotations

from collections.abc import Callable
from time import monotonic
from typing import Any

from action_msgs.msg import GoalStatus
from geohtn_msgs.action import PlanTasks
from geohtn_msgs.msg import Outcome
from geohtn_msgs.srv import Explain, GetWorld, SetWorld
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.node import Node

from interface_node.goal_client_node import GoalClient
from interface_node.pulse_node import Pulse
from interface_node.starting import how_to_start, start_command
from interface_node.waiting import Cancelled, TimedOut, wait_for, wait_until

ShouldStop = Callable[[], bool]
#: [s] between two looks at whether the task planner is still there.
LIVENESS_PERIOD = 0.5


class Unavailable(Exception):
    """A node does not answer; the message names it and how it is started."""


class Peers:
    """Clients of the motion planner and the task planner, in a callback group of their own.

    All methods wait in the calling thread; an executor has to spin in others.
    """

    def __init__(self, node: Node):
        self._namespace = node.get_namespace().strip('/')
        group = ReentrantCallbackGroup()
        self._get_world = node.create_client(GetWorld, 'get_world', callback_group=group)
        self._set_world = node.create_client(SetWorld, 'set_world', callback_group=group)
        self._explain = node.create_client(Explain, 'explain', callback_group=group)
        self._plan_tasks = GoalClient(node, PlanTasks, 'plan_tasks', callback_group=group)

    def check(self, timeout: float, should_stop: ShouldStop) -> None:
        """Return when both nodes answer; raises Unavailable after ``timeout`` [s]."""
        deadline = monotonic() + timeout
        missing = []
        motion_planner_there = self._set_world.service_is_ready
        try:
            wait_until(motion_planner_there, deadline, should_stop)
            wait_until(self._get_world.service_is_ready, deadline, should_stop)
            wait_for(self._get_world.call_async(GetWorld.Request()), deadline, should_stop)
        except TimedOut:
            missing.append(self._missing('motion_planner_node', motion_planner_there(), timeout))
        try:
            wait_until(self._plan_tasks.server_is_ready, deadline, should_stop)
        except TimedOut:
            missing.append(self._missing('task_planner_node', present=False, timeout=timeout))
        if missing:
            raise Unavailable('\n'.join(missing))

    def set_world(
        self, request: SetWorld.Request, timeout: float, should_stop: ShouldStop
    ) -> SetWorld.Response:
        """Give the motion planner a world; raises Unavailable after ``timeout`` [s]."""
        try:
            future = self._set_world.call_async(request)
            return wait_for(future, monotonic() + timeout, should_stop)
        except TimedOut:
            raise Unavailable(
                f'motion_planner_node did not accept or refuse the world within {timeout:g} s'
            ) from None

    def get_world(self, timeout: float, should_stop: ShouldStop) -> GetWorld.Response:
        """The motion planner's world; raises Unavailable after ``timeout`` [s]."""
        try:
            future = self._get_world.call_async(GetWorld.Request())
            return wait_for(future, monotonic() + timeout, should_stop)
        except TimedOut:
            raise Unavailable(
                f'motion_planner_node did not give its world within {timeout:g} s'
            ) from None

    def plan_tasks(
        self,
        goal: PlanTasks.Goal,
        *,
        accept_timeout: float,
        cancel_timeout: float,
        should_stop: ShouldStop,
        on_feedback: Callable[[PlanTasks.Feedback], None],
    ) -> PlanTasks.Result:
        """Have the task planner search, as long as it takes.

        When ``should_stop`` says so the search is cancelled, and its result returned if it comes
        within ``cancel_timeout`` [s]; else Cancelled is raised. Raises Unavailable when the goal is
        not accepted within ``accept_timeout`` [s], or the task planner vanishes.
        """
        pulse = Pulse(self._explain)

        def forward(message: Any) -> None:
            pulse.hear()
            on_feedback(message.feedback)

        sent = self._plan_tasks.send_goal_async(goal, feedback_callback=forward)
        try:
            handle = wait_for(sent, monotonic() + accept_timeout, should_stop)
        except TimedOut:
            raise Unavailable(
                self._missing('task_planner_node', present=True, timeout=accept_timeout)
            ) from None
        except Cancelled:
            # Accepted after all, it must not go on searching for nobody.
            sent.add_done_callback(_cancel)
            raise
        if not handle.accepted:
            raise Unavailable(
                'task_planner_node does not accept the search: it is busy with another one'
            )
        result = handle.get_result_async()
        try:
            self._follow(result, pulse, should_stop)
        except Unavailable:
            handle.cancel_goal_async()
            raise
        except Cancelled:
            handle.cancel_goal_async()
            try:
                wait_for(result, monotonic() + cancel_timeout, lambda: False)
            except TimedOut:
                raise Cancelled from None
        answer = result.result()
        outcome = answer.result.outcome
        if answer.status != GoalStatus.STATUS_SUCCEEDED and outcome.value == Outcome.SOLVED:
            # An exception in an action's callback arrives as an aborted goal with an empty result.
            outcome.value = Outcome.FAILED
            outcome.explanation = (
                'task_planner_node gave the search up without a result; its log says why'
            )
        return answer.result

    def tree(self, mission: str, form: str, timeout: float, should_stop: ShouldStop) -> str:
        """How the task planner decomposed the tasks of a mission, in the format ``form`` of ``explain``.

        Empty when it has no such tree; raises Unavailable after ``timeout`` [s].
        """
        request = Explain.Request(mission=mission, format=form)
        try:
            future = self._explain.call_async(request)
            answer = wait_for(future, monotonic() + timeout, should_stop)
        except TimedOut:
            raise Unavailable(
                f'task_planner_node did not give the decomposition tree within {timeout:g} s'
            ) from None
        return str(answer.text) if answer.available else ''

    def _follow(self, result: Any, pulse: Pulse, should_stop: ShouldStop) -> None:
        with pulse:
            while True:
                try:
                    wait_for(result, monotonic() + LIVENESS_PERIOD, should_stop)
                except TimedOut:
                    if self._plan_tasks.server_is_ready() and pulse.beats():
                        continue
                    raise Unavailable(
                        'task_planner_node vanished or hangs in the middle of the search; '
                        f'start it again: {self._start_command("task_planner_node")}'
                    ) from None
                return

    def _missing(self, name: str, present: bool, timeout: float) -> str:
        if present:
            return (
                f'{name} did not answer within {timeout:g} s: it is busy, or hangs, or was killed; '
                f'start it anew: {self._start_command(name)}'
            )
        return f'{name} is not running: {how_to_start([name], self._namespace)}'

    def _start_command(self, name: str) -> str:
        return start_command(name, self._namespace)


def _cancel(sent: Any) -> None:
    handle = sent.result()
    if handle is not None and handle.accepted:
        handle.cancel_goal_async()
