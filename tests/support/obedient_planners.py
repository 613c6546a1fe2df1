"""Planners that do as they are told, and who asks for missions, each in a thread of its own."""

from __future__ import annotations

import threading
from math import inf
from time import monotonic
from typing import Any

from geohtn_msgs import msg, srv
from geohtn_msgs.action import PlanMission, PlanTasks
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.node import Node

from interface_node.waiting import wait_for, wait_until


def never() -> bool:
    return False


class ObedientMotionPlanner(Node):
    """Accepts every world but ``refuse``; answers a request by the length of its preconditions."""

    def __init__(self, context: Context):
        super().__init__('motion_planner_node', context=context)
        self.extra = 0.0
        self.create_service(srv.SetWorld, 'set_world', self._set_world)
        self.create_service(srv.GetWorld, 'get_world', self._get_world)
        self.create_service(srv.SatisfyPreconditions, 'satisfy_preconditions', self._satisfy)
        self.create_service(srv.Advise, 'advise', self._advise)

    def _set_world(self, request: Any, response: Any) -> Any:
        response.accepted = request.yaml != 'refuse'
        response.revision = 'r1'
        if not response.accepted:
            remark = msg.Diagnostic(source=request.source, line=2, column=3, message='wrong')
            response.diagnostics = [remark]
        return response

    def _get_world(self, _: Any, response: Any) -> Any:
        response.available = True
        response.world = msg.World(source='w', revision='r1', x_max=80.0, y_max=60.0)
        response.world.robots = [
            msg.RobotModel(label='rover0', wheelbase=2.0, max_steering_angle=0.5, radius=1.0)
        ]
        response.world.objects = [
            msg.WorldObject(label='tree', field_names=['x', 'y'], field_values=[40.0, 40.0])
        ]
        return response

    def _satisfy(self, request: Any, response: Any) -> Any:
        length = len(request.request.preconditions) + self.extra
        response.answer = msg.GeometricAnswer(length=length, time_spent=monotonic())
        return response

    def _advise(self, request: Any, response: Any) -> Any:
        response.answer = msg.AdviceAnswer(order=range(len(request.request.preconditions)))
        return response


class ObedientTaskPlanner(Node):
    """Does what the text of the domain says: solve, jump, search or break."""

    def __init__(self, context: Context, steps: list[msg.Step]):
        super().__init__('task_planner_node', context=context)
        self._steps = steps
        self._events = self.create_publisher(msg.PlanningEvent, 'planning_events', 100)
        self.searching, self.cancelled = threading.Event(), threading.Event()
        self.released = threading.Event()
        self.released.set()
        self.create_service(
            srv.Explain, 'explain', self._explain, callback_group=ReentrantCallbackGroup()
        )
        self._server = ActionServer(
            self,
            PlanTasks,
            'plan_tasks',
            self._execute,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def destroy_node(self) -> None:
        self._server.destroy()
        super().destroy_node()

    def _explain(self, request: Any, response: Any) -> Any:
        self.released.wait(20)
        if request.format:
            response.available, response.text = True, f'{request.format} of {request.mission}'
        return response

    def _execute(self, handle: Any) -> PlanTasks.Result:
        goal = handle.request
        result = PlanTasks.Result(outcome=msg.Outcome(value=msg.Outcome.SOLVED))
        handle.publish_feedback(PlanTasks.Feedback(progress=_progress(inf)))
        if goal.domain.text == 'search':
            self.searching.set()
            wait_until(lambda: handle.is_cancel_requested, monotonic() + 20, never)
            self.cancelled.set()
            result.outcome.value = msg.Outcome.CANCELLED
            handle.canceled()
            return result
        if goal.domain.text == 'hang':
            self.released.clear()
            self.released.wait(20)
            handle.abort()
            return result
        if goal.domain.text == 'break':
            raise RuntimeError('broken on purpose')
        result.steps = (
            [self._steps[0], self._steps[3]] if goal.domain.text == 'jump' else self._steps
        )
        # Of another mission, and therefore not to be recorded.
        self._exchange('other')
        for _ in range(0 if goal.domain.text == 'silent' else 3):
            self._exchange(goal.mission)
        result.statistics.answers = 3
        result.statistics.planning_time = 0.5
        length = sum(answer.length for step in result.steps for answer in step.answer)
        told = [_progress(length + worse) for worse in (2.0, 1.0, 0.0)]
        for progress in told if goal.domain.text != 'late' else told[1:2]:
            handle.publish_feedback(PlanTasks.Feedback(progress=progress))
        result.improvements = told
        handle.succeed()
        return result

    def _exchange(self, mission: str) -> None:
        request = msg.GeometricRequest(mission=mission, preconditions='four', request_id='1')
        self._events.publish(
            msg.PlanningEvent(request=[request], answer=[msg.GeometricAnswer(length=4.0)])
        )


def _progress(length: float) -> msg.PlanningProgress:
    return msg.PlanningProgress(phase='searching', best_length=length, best_cost=length + 3.0)


class Client(Node):
    """Asks for missions."""

    def __init__(self, context: Context):
        super().__init__('client', context=context)
        self.feedback: list[str] = []
        self._client = ActionClient(self, PlanMission, 'plan_mission')

    def destroy_node(self) -> None:
        self._client.destroy()
        super().destroy_node()

    def send(self, domain: str = 'solve', **fields: Any) -> Any:
        fields.setdefault('problem', msg.SourceText(text='problem'))
        fields.setdefault('world', msg.SourceText(path='w.yaml', text='world'))
        goal = PlanMission.Goal(mission='small', domain=msg.SourceText(text=domain), **fields)
        wait_until(self._client.server_is_ready, monotonic() + 10, never)
        sent = self._client.send_goal_async(
            goal, feedback_callback=lambda f: self.feedback.append(f.feedback.progress.phase)
        )
        return wait_for(sent, monotonic() + 10, never)

    def plan(self, domain: str = 'solve', **fields: Any) -> Any:
        handle = self.send(domain, **fields)
        assert handle.accepted
        return wait_for(handle.get_result_async(), monotonic() + 20, never)
