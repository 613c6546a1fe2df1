"""Whether the task planner is alive while it searches, long before the middleware misses it."""

from __future__ import annotations

from types import TracebackType
from typing import Any

from geohtn_msgs.srv import Explain
from rclpy.client import Client

#: Looks without a sign of life after which the node is given up; it answers in milliseconds while
#: it searches. They are counted, so that a node that was suspended itself does not blame the other.
SILENT_LOOKS = 8
#: A mission that there is none of, so that the answer is short.
QUESTION = Explain.Request(mission='is anybody there?')


class Pulse:
    """Context manager; signs of life are feedback and answers of the service ``explain``."""

    def __init__(self, explain: Client):
        self._explain = explain
        self._questions: list[Any] = []
        self._heard = True
        self._silent_looks = 0

    def __enter__(self) -> Pulse:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        for question in self._questions:
            self._explain.remove_pending_request(question)

    def hear(self) -> None:
        """There was a sign of life."""
        self._heard = True

    def beats(self) -> bool:
        """Whether there was a sign of life during the last looks; asks for the next one."""
        answered = [question for question in self._questions if question.done()]
        if self._heard or answered or not self._explain.service_is_ready():
            self._silent_looks = 0
        else:
            self._silent_looks += 1
        self._heard = False
        self._questions = [question for question in self._questions if question not in answered]
        if self._explain.service_is_ready():
            self._questions.append(self._explain.call_async(QUESTION))
        return self._silent_looks < SILENT_LOOKS
