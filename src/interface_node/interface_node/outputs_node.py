"""What a mission leaves behind in its directory: the plan, the picture and the recording."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from time import monotonic
from typing import Any

from geohtn_msgs.msg import PlanningEvent, PlanningStatistics
from rclpy.serialization import deserialize_message

from interface_node.files import Replacement, write_file
from interface_node.picture import write_picture
from interface_node.plan import Diagnostic, Plan
from interface_node.plan_document import to_text
from interface_node.recording.message_conversions import EVENTS, Recording
from interface_node.waiting import TimedOut, wait_until

PLAN, PICTURE, RECORDING = 'plan.json', 'mission.png', 'mission.mcap'
#: The decomposition tree of the plan, by the format of the service ``explain``.
TREES = {'tree': 'tree.txt', 'json': 'tree.json', 'svg': 'tree.svg', 'ipc': 'plan.ipc'}


class Outputs:
    """The files of one mission; ``trouble`` says which cannot be written, and why.

    The recording grows on disk while the mission runs. All files appear whole or not at all, and
    what an earlier mission left under the same names is replaced or removed. An empty directory
    means no files. Trouble is an error where a file is missing, else a warning; its source is a path.
    """

    def __init__(self, directory: str, mission_id: str):
        self.trouble: list[Diagnostic] = []
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
                self._complain(self._directory, error)
                self._directory = None

    @property
    def wanted(self) -> bool:
        """Whether there is a directory to write to."""
        return self._directory is not None

    def record(self, topic: str, message: Any, time: int) -> None:
        """Add a message received at ``time`` [ns since 1970] to the recording."""
        with self._lock:
            if self._recording:
                try:
                    self._recording.write(topic, message, time)
                except OSError as error:
                    self._complain(self._path(RECORDING), error)
                    self._drop_recording()

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
                Diagnostic(
                    f'the recording is incomplete: it holds {self._requests} of '
                    f'{statistics.answers} answers and {self._advices} of '
                    f'{statistics.advices} advices',
                    str(self._path(RECORDING)),
                    warning=True,
                )
            )

    def write(self, plan: Plan, trees: Mapping[str, str], *, picture: bool) -> None:
        """Complete the recording, and write the plan, its trees, and, if wanted and possible, the picture.

        ``trees`` has the texts by the formats of TREES; what is empty or missing is not written.
        """
        if not self._directory:
            return
        with self._lock:
            if self._recording and self._file:
                self._leave(RECORDING, self._complete_recording)
                self._drop_recording()
        self._leave(PLAN, lambda path: write_file(path, to_text(plan).encode()))
        for form, name in TREES.items():
            tree = trees.get(form)
            self._leave_or_remove(name, tree.encode if tree else None)
        drawn = picture and plan.world
        self._leave_or_remove(PICTURE, (lambda: write_picture(plan)) if drawn else None)

    def _leave_or_remove(self, name: str, content: Callable[[], bytes] | None) -> None:
        """Write a file, or remove what an earlier mission left."""
        if content:
            self._leave(name, lambda path: write_file(path, content()))
        else:
            with suppress(OSError):
                self._path(name).unlink(missing_ok=True)

    def abandon(self) -> None:
        """Leave no recording behind that was not completed."""
        with self._lock:
            self._drop_recording()

    def _path(self, name: str) -> Path:
        assert self._directory is not None
        return self._directory / name

    def _leave(self, name: str, write: Callable[[Path], None]) -> None:
        path = self._path(name)
        try:
            write(path)
        except OSError as error:
            self._complain(path, error)
        else:
            self.files.append(str(path))

    def _complete_recording(self, _path: Path) -> None:
        assert self._recording is not None
        assert self._file is not None
        self._recording.finish()
        self._file.complete()

    def _drop_recording(self) -> None:
        if self._recording and self._file:
            self._recording = None
            self._file.discard()

    def _complain(self, path: Path, error: OSError | ValueError) -> None:
        if isinstance(error, FileExistsError):
            reason = 'it is no directory'
        else:
            reason = (error.strerror if isinstance(error, OSError) else None) or str(error)
        self.trouble.append(Diagnostic(f'cannot be written: {reason}', str(path)))
