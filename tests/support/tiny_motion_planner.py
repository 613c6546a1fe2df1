"""A motion planner that finds everything at once, is stuck, or falls silent."""

from __future__ import annotations

import threading
from contextlib import AbstractContextManager
from typing import Any

from geohtn_msgs.msg import AgentState, GeometricAnswer
from geohtn_msgs.srv import (
    Advise,
    CancelRequest,
    CheckPreconditions,
    SatisfyPreconditions,
)
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.node import Node

from tests.support.spinning import PATIENCE, spinning


class TinyMotionPlanner(Node):
    """Finds everything at once, or, when ``stuck``, answers no request before it is released.

    When ``mute``, it answers nothing at all from then on.
    """

    def __init__(self, context: Context, stuck: bool = False, mute: bool = False) -> None:
        super().__init__('tiny_motion_planner', context=context)
        self.mute = mute
        self.asked_for: list[str] = []
        self.cancelled: list[str] = []
        self.release = threading.Event()
        self.asked = threading.Event()
        if not stuck:
            self.release.set()
        group = ReentrantCallbackGroup()
        for kind, name, answer in (
            (CheckPreconditions, 'check_preconditions', self.check),
            (SatisfyPreconditions, 'satisfy_preconditions', self.satisfy),
            (Advise, 'advise', self.advise),
            (CancelRequest, 'cancel_request', self.cancel),
        ):
            self.create_service(kind, name, answer, callback_group=group)

    def cancel(self, request: Any, response: Any) -> Any:
        self.cancelled.append(request.request_id)
        return response

    def check(self, request: Any, response: Any) -> Any:
        if self.mute and self.asked.is_set():
            self.release.wait(PATIENCE)
        response.valid = True
        response.assigns = 'setProperty' in request.preconditions
        return response

    def satisfy(self, request: Any, response: Any) -> Any:
        self.asked_for.append(request.request.request_id)
        self.asked.set()
        self.release.wait(PATIENCE)
        request = request.request
        response.answer = GeometricAnswer(
            status=GeometricAnswer.FOUND,
            request_id=request.request_id,
            assigned='setProperty' in request.preconditions,
            length=float(len(request.start)),
            end=[AgentState(agent='rover0', x=1.0, y=2.0, heading=0.5)],
        )
        return response

    def advise(self, request: Any, response: Any) -> Any:
        count = len(request.request.preconditions)
        response.answer.order = list(reversed(range(count)))
        response.answer.candidates = []
        return response


def tiny_motion_planner(
    stuck: bool = False, mute: bool = False
) -> AbstractContextManager[TinyMotionPlanner]:
    """One that spins, and lets go of all requests in the end."""
    return spinning(
        lambda context: TinyMotionPlanner(context, stuck, mute),
        release=lambda node: node.release.set(),
    )
