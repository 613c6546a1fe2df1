"""What a mission leaves behind in its directory: the plan, the picture and the recording."""

from __future__ import annotations

import threading
from pathlib import Path
from time import monotonic
from typing import Any

from geohtn_msgs.msg import PlanningEvent, PlanningStatistics
from rclpy.serialization import deserialize_message

from interface_node.files import Replacement, write_file
from interface_node.picture import write_picture
from interface_node.plan import Plan
from interface_node.plan_document import to_text
from interface_node.recording.message_conversions import EVENTS, Recording
from interface_node.waiting import TimedOut, wait_until

PLAN, PICTURE, RECORDING = 'plan.json', 'mission.png', 'mission.mcap'


class Outputs:
    """The files of one mission; where they cannot be written, ``trouble`` says so in sentences.

    The recording grows on disk while the mission runs. All files appear whole or not at all, and
    what an earlier mission left under the same names is replaced or removed. An empty directory
    means no files.
    """

    def __init__(self, directory: str, mission_id: str):
        self.trouble: list[str] = []
        self.files: list[str] = []
        self._mission_id = mission_id
        self._lock = threading.Lock()
        self._requests = self._advices = 0
        self._file: Replacement | None = None
        self._recording: Recording | None = None
        self._directory = Path(directory).absolute() if directory else None
        if self._directory:
            try:
                self._directory.mkdir(parents=True, exist_ok=True)
                self._file = Replacement(self._directory / RECORDING)
                self._recording = Recording(self._file.file)
            except (OSError, ValueError) as error:
                self._give_up(error)

    def record(self, topic: str, message: Any, time: int) -> None:
        """Add a message received at ``time`` [ns since 1970] to the recording."""
        with self._lock:
            if self._recording:
                try:
                    self._recording.write(topic, message, time)
                except OSError as error:
                    self._give_up(error)

    def record_event(self, data: bytes) -> None:
        """Add a serialised planning event, if it belongs to this mission."""
        event = deserialize_message(data, PlanningEvent)
        asked = [*event.request, *event.advice_request]
        if not asked or asked[0].mission != self._mission_id:
            return
        self.record(EVENTS, data, event.answered.sec * 1_000_000_000 + event.answered.nanosec)
        with self._lock:
            self._requests += event.kind == PlanningEvent.REQUEST
            self._advices += event.kind == PlanningEvent.ADVICE

    def await_events(self, statistics: PlanningStatistics, timeout: float) -> None:
        """Wait, at most ``timeout`` [s], for every exchange that the statistics count."""
        if not self._recording:
            return
        try:
            wait_until(
                lambda: (
                    self._requests >= statistics.answers and self._advices >= statistics.advices
                ),
                monotonic() + timeout,
                lambda: False,
            )
        except TimedOut:
            self.trouble.append(
                f'the recording is incomplete: it holds {self._requests} of {statistics.answers} '
                f'answers and {self._advices} of {statistics.advices} advices'
            )

    def write(self, plan: Plan, *, picture: bool) -> None:
        """Complete the recording, and write the plan and, if wanted and possible, the picture."""
        if not self._directory:
            return
        try:
            with self._lock:
                if self._recording and self._file:
                    self._recording.finish()
                    self._recording = None
                    self._file.complete()
                    self.files.append(str(self._directory / RECORDING))
            self._write_file(PLAN, to_text(plan).encode())
            if picture and plan.world:
                self._write_file(PICTURE, write_picture(plan))
            else:
                (self._directory / PICTURE).unlink(missing_ok=True)
        except OSError as error:
            self._give_up(error)

    def abandon(self) -> None:
        """Leave no recording behind that was not completed."""
        with self._lock:
            if self._recording and self._file:
                self._recording = None
                self._file.discard()

    def _write_file(self, name: str, data: bytes) -> None:
        assert self._directory is not None
        path = self._directory / name
        write_file(path, data)
        self.files.append(str(path))

    def _give_up(self, error: Exception) -> None:
        reason = error.strerror if isinstance(error, OSError) else str(error)
        self.trouble.append(f'nothing can be written to {self._directory}: {reason}')
        self._recording = self._directory = None
        if self._file:
            self._file.discard()
