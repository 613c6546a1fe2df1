"""Replaying a recording: ask the motion planner everything again, and compare the answers."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import Any

import rclpy
from geohtn_msgs.msg import (
    AdviceRequest,
    GeometricAnswer,
    GeometricRequest,
    PlanningEvent,
    SourceText,
)
from geohtn_msgs.srv import Advise, SatisfyPreconditions, SetWorld
from rclpy.context import Context
from rclpy.node import Node

from interface_node.background_node import BackgroundExecutor
from interface_node.recording.comparison import differences, sentence
from interface_node.recording.errors import RecordingError
from interface_node.recording.message_conversions import EVENTS, read_messages
from interface_node.sources import directory_of
from interface_node.waiting import TimedOut, wait_for, wait_until

#: What may differ between two answers that say the same.
IGNORED = frozenset({'time_spent', 'request_id'})
#: Codes of what was broken off, and says nothing that could be compared.
ENDED_EARLY = {GeometricAnswer.OUT_OF_TIME, GeometricAnswer.CANCELLED}
#: [s] to find the motion planner.
FIND_TIMEOUT = 5.0


class MotionPlannerUnavailable(Exception):
    """The motion planner does not run, or does not answer; the message says which."""


@dataclass(frozen=True)
class ReplayReport:
    """What came of a replay: how much was asked, and what was answered otherwise than before.

    ``skipped`` names exchanges that cannot be compared, because the clock had ended them.
    """

    requests: int = 0
    advices: int = 0
    equal: int = 0
    skipped: tuple[str, ...] = ()
    differences: tuple[str, ...] = ()

    @property
    def same(self) -> bool:
        """Whether nothing differs."""
        return not self.differences


def replay(
    path: Path,
    *,
    namespace: str = '',
    timeout: float = 30.0,
    should_stop: Callable[[], bool] = lambda: False,
) -> ReplayReport:
    """Set the recorded world on a running motion planner and ask every request and advice again.

    Answers are compared exactly, but for times and ids. ``timeout`` [s] holds for each answer.
    Raises RecordingError when the file cannot be read or holds no world,
    MotionPlannerUnavailable, and waiting.Cancelled when ``should_stop`` says so.
    """
    world, events = _read(path)
    with _Client(namespace, timeout, should_stop).running() as client:
        refused = client.set_world(world)
        if refused:
            raise RecordingError(
                f'{path}: the motion planner refuses the recorded world: {refused}'
            )
        return _compare(client, events)


def _read(path: Path) -> tuple[SourceText, list[PlanningEvent]]:
    worlds, events = [], []
    for recorded in read_messages(path):
        if recorded.topic == EVENTS:
            events.append(recorded.message)
        elif recorded.topic == '/mission/world':
            worlds.append(recorded.message)
    if not worlds:
        raise RecordingError(f'{path}: the recording holds no world to replay in')
    return worlds[-1], events


def _compare(client: _Client, events: list[PlanningEvent]) -> ReplayReport:
    counts = {client.satisfy: 0, client.advise: 0}
    equal = 0
    skipped, different = [], []
    for event in events:
        asked, before, ask = (
            (event.request, event.answer, client.satisfy)
            if event.kind == PlanningEvent.REQUEST
            else (event.advice_request, event.advice_answer, client.advise)
        )
        if not asked or not before:
            skipped.append('an event without a question or without an answer')
            continue
        counts[ask] += 1
        name = _name(asked[0])
        now = ask(asked[0])
        if {before[0].code, now.code} & ENDED_EARLY:
            skipped.append(f'{name}: ended by the clock or its client, not by the search')
            continue
        found = list(differences(before[0], now, IGNORED))
        if found:
            different.append(sentence(name, found))
        else:
            equal += 1
    return ReplayReport(
        requests=counts[client.satisfy],
        advices=counts[client.advise],
        equal=equal,
        skipped=tuple(skipped),
        differences=tuple(different),
    )


def _name(asked: GeometricRequest | AdviceRequest) -> str:
    if isinstance(asked, GeometricRequest):
        return f'request {asked.request_id} ({" ".join(asked.action)}), alternative {asked.alternative}'
    return f'advice {asked.request_id}'


class _Client:
    """The motion planner's services, called from a node of our own in a context of its own."""

    def __init__(self, namespace: str, timeout: float, should_stop: Callable[[], bool]):
        self._namespace = namespace
        self._timeout = timeout
        self._should_stop = should_stop
        self._clients: dict[type, Any] = {}

    @contextmanager
    def running(self) -> Iterator[_Client]:
        """Bring the node up, find the motion planner, and leave nothing running afterwards."""
        context = Context()
        rclpy.init(args=[], context=context)
        node = Node(
            f'replay_{os.getpid()}',
            context=context,
            namespace=self._namespace or None,
            enable_rosout=False,
            start_parameter_services=False,
        )
        executor = BackgroundExecutor(node)
        try:
            self._clients = {
                kind: node.create_client(kind, name)
                for kind, name in (
                    (SetWorld, 'set_world'),
                    (SatisfyPreconditions, 'satisfy_preconditions'),
                    (Advise, 'advise'),
                )
            }
            self._find()
            yield self
        finally:
            executor.close()
            node.destroy_node()
            rclpy.shutdown(context=context)

    def set_world(self, world: SourceText) -> str:
        """Set the world; give what is wrong with it, empty when it is accepted."""
        request = SetWorld.Request(
            source=world.path, yaml=world.text, directory=directory_of(world.path)
        )
        response = self._call(SetWorld, request)
        if response.accepted:
            return ''
        return '; '.join(remark.message for remark in response.diagnostics) or 'without a reason'

    def satisfy(self, request: Any) -> Any:
        """Ask a geometric request."""
        return self._call(
            SatisfyPreconditions, SatisfyPreconditions.Request(request=request)
        ).answer

    def advise(self, request: Any) -> Any:
        """Ask for advice."""
        return self._call(Advise, Advise.Request(request=request)).answer

    def _find(self) -> None:
        deadline = monotonic() + FIND_TIMEOUT
        try:
            for client in self._clients.values():
                wait_until(client.service_is_ready, deadline, self._should_stop)
        except TimedOut:
            raise MotionPlannerUnavailable(
                'motion_planner_node is not running; '
                'start it: ros2 run motion_planner_node motion_planner_node'
            ) from None

    def _call(self, kind: type, request: Any) -> Any:
        try:
            future = self._clients[kind].call_async(request)
            return wait_for(future, monotonic() + self._timeout, self._should_stop)
        except TimedOut:
            raise MotionPlannerUnavailable(
                f'motion_planner_node did not answer within {self._timeout:g} s'
            ) from None
