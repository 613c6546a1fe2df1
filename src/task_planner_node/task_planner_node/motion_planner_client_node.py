"""The motion planner as the search sees it, behind its services."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import count
from math import inf
from typing import Any
from uuid import uuid4

from geohtn_msgs.msg import GeometricRequest
from geohtn_msgs.srv import Advise, CancelRequest, CheckPreconditions, SatisfyPreconditions
from rclpy.client import Client
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

from task_planner_node.conversions import (
    advice_from_message,
    advice_to_message,
    answer_from_message,
    diagnostic_from_message,
    states_from_token,
)
from task_planner_node.errors import Cancelled, GeometryUnavailable, LimitReached
from task_planner_node.oracle import Advice, AdviceQuery, Answer, Query, TextCheck
from task_planner_node.parameters import Parameters

# [s] between two looks at the mission, and without the service until it counts as gone.
POLL = 0.02
LOST = 0.5
#: Looks between two questions whether the motion planner is still there, and questions without an
#: answer after which it is given up: it answers in milliseconds while it works on a request.
LOOKS, SILENT_QUESTIONS = 25, 8
#: A text that is checked in no time.
QUESTION = CheckPreconditions.Request()


class MotionPlannerClient(Node):
    """Clients with an executor and a thread of their own: calls from any thread, fast and without deadlock.

    Clients: satisfy_preconditions, advise, cancel_request, check_preconditions.
    """

    def __init__(self, context: Context) -> None:
        super().__init__('task_planner_client', context=context, start_parameter_services=False)
        self.satisfy = self.create_client(SatisfyPreconditions, 'satisfy_preconditions')
        self.advise = self.create_client(Advise, 'advise')
        self.cancel = self.create_client(CancelRequest, 'cancel_request')
        self.check = self.create_client(CheckPreconditions, 'check_preconditions')
        self._spinner = SingleThreadedExecutor(context=context)
        self._spinner.add_node(self)
        self._closed = threading.Event()
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()

    def _spin(self) -> None:
        while not self._closed.is_set():
            self._spinner.spin_once()

    def close(self) -> None:
        """Stop the thread, then destroy what it waits on: before, it could wait for ever."""
        self._closed.set()
        self._spinner.create_task(lambda: None)  # work ends spin_once; wake() alone does not
        self._thread.join()
        self._spinner.shutdown()
        self.destroy_node()


class Pulse:
    """Whether the motion planner is alive, long before the middleware misses a process that was killed."""

    def __init__(self, check: Client) -> None:
        self._check = check
        self._questions: list[Any] = []
        self._looks = self._silent = 0

    def beats(self) -> bool:
        """Whether some of the last questions were answered; asks the next one every few looks."""
        self._looks += 1
        if self._looks % LOOKS:
            return True
        if len(self._questions) > len(waiting := [q for q in self._questions if not q.done()]):
            self._silent = 0
        elif waiting:
            self._silent += 1
        self._questions = waiting
        if self._check.service_is_ready():
            self._questions.append(self._check.call_async(QUESTION))
        return self._silent < SILENT_QUESTIONS

    def close(self) -> None:
        """Expect no more answers."""
        for question in self._questions:
            self._check.remove_pending_request(question)


@dataclass(frozen=True)
class RemoteOracle:
    """The Oracle of one mission.

    ``should_stop`` ends a wait with Cancelled, ``deadline`` (time.monotonic) with LimitReached.  A request
    that is not waited for any more is cancelled.
    """

    client: MotionPlannerClient
    parameters: Parameters
    mission: str
    world_revision: str
    seed: int
    deadline: float
    should_stop: Callable[[], bool]
    _name: str = field(default_factory=lambda: uuid4().hex[:8])
    _numbers: count[int] = field(default_factory=count)

    def check(self, text: str, source: str, line: int, column: int) -> TextCheck:
        """Oracle.check."""
        request = CheckPreconditions.Request(
            preconditions=text, source=source, line=line, column=column
        )
        response = self._call(self.client.check, request)
        remarks = tuple(diagnostic_from_message(d) for d in response.diagnostics)
        return TextCheck(bool(response.assigns), remarks)

    def satisfy(self, query: Query) -> Answer:
        """Oracle.satisfy."""
        response = self._call(self.client.satisfy, self._request(query))
        return answer_from_message(response.answer, query.preferred)

    def satisfy_together(self, queries: Sequence[Query]) -> Sequence[Answer]:
        """BatchOracle.satisfy_together: all requests are in flight at once, as replicas of the node can use."""
        requests = [self._request(query) for query in queries]
        responses = self._call_together(self.client.satisfy, requests)
        return [
            answer_from_message(response.answer, query.preferred)
            for response, query in zip(responses, queries, strict=True)
        ]

    def _request(self, query: Query) -> SatisfyPreconditions.Request:
        request = GeometricRequest(
            request_id=self._request_id(),
            mission=self.mission,
            action=list(query.action),
            start=states_from_token(query.start),
            preconditions=query.preconditions,
            behaviour=query.behaviour,
            alternative=query.alternative,
            world_revision=self.world_revision,
            seed=self.seed,
            time_budget=self.parameters.request_time_budget,
            preferred_end=[] if query.preferred is None else states_from_token(query.preferred),
        )
        return SatisfyPreconditions.Request(request=request)

    def advise(self, query: AdviceQuery) -> Advice:
        """Oracle.advise."""
        request = advice_to_message(query)
        request.request_id = self._request_id()
        request.mission = self.mission
        request.world_revision = self.world_revision
        request.seed = self.seed
        # How much work it is only the motion planner knows; it tells that it is alive meanwhile.
        response = self._call(self.client.advise, Advise.Request(request=request), inf)
        return advice_from_message(response.answer)

    def _request_id(self) -> str:
        """An id that no other request has, for it may have to be cancelled."""
        return f'{self.mission}:{self._name}:{next(self._numbers)}'

    def _call(self, client: Client, request: Any, budget: float | None = None) -> Any:
        return self._call_together(client, [request], budget)[0]

    def _call_together(
        self, client: Client, requests: Sequence[Any], budget: float | None = None
    ) -> list[Any]:
        """The responses; what is not waited for any more is cancelled.

        ``budget`` [s] is what the motion planner may take for each, which it may answer one after the other.
        """
        self._wait_for_service(client)
        budget = self.parameters.request_time_budget if budget is None else budget
        patience = len(requests) * budget + self.parameters.service_timeout
        futures = [client.call_async(request) for request in requests]
        try:
            return [self._await(client, future, patience) for future in futures]
        finally:
            for request, future in zip(requests, futures, strict=True):
                if not future.done():
                    client.remove_pending_request(future)
                    self._cancel(request)

    def _await(self, client: Client, future: Any, patience: float) -> Any:
        """The response, within ``patience`` [s]."""
        done = threading.Event()
        future.add_done_callback(lambda _: done.set())
        began = time.monotonic()
        lost = began
        pulse = Pulse(self.client.check)
        try:
            while not done.wait(POLL):
                self._check()
                now = time.monotonic()
                if client.service_is_ready():
                    lost = now
                if now - began > patience or now - lost > LOST or not pulse.beats():
                    raise GeometryUnavailable(
                        f'the motion planner (service {client.srv_name}) did not answer within '
                        f'{now - began:.1f} s: it is stuck or was stopped'
                    )
        finally:
            pulse.close()
        return future.result()

    def _cancel(self, request: Any) -> None:
        """Tell the motion planner not to work on ``request``, where it has an id."""
        if hasattr(request, 'request') and self.client.cancel.service_is_ready():
            request_id = request.request.request_id
            self.client.cancel.call_async(CancelRequest.Request(request_id=request_id))

    def _wait_for_service(self, client: Client) -> None:
        began = time.monotonic()
        pause = threading.Event()
        while not client.service_is_ready():
            self._check()
            if time.monotonic() - began > self.parameters.service_timeout:
                raise GeometryUnavailable(
                    f'the motion planner is not running: no service {client.srv_name} within '
                    f'{self.parameters.service_timeout:g} s'
                )
            pause.wait(POLL)

    def _check(self) -> None:
        if self.should_stop():
            raise Cancelled
        if time.monotonic() > self.deadline:
            raise LimitReached('the time budget was spent while the motion planner worked')
