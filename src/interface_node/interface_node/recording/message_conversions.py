"""Recordings of messages: their definitions from the installation, and messages to bytes."""

from __future__ import annotations

import importlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, BinaryIO

from ament_index_python.packages import PackageNotFoundError, get_package_share_directory
from geohtn_msgs.msg import (
    GlobalPlan,
    Outcome,
    PlanningEvent,
    PlanningOptions,
    PlanningProgress,
    PlanningStatistics,
    SourceText,
)
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
from rclpy.serialization import deserialize_message, serialize_message
from visualization_msgs.msg import MarkerArray

from interface_node.recording.errors import RecordingError
from interface_node.recording.reader import read_serialised
from interface_node.recording.schema import same_definition, schema_text
from interface_node.recording.writer import RecordingWriter

EVENTS = '/planning_events'
#: What a recording holds: type of the messages by topic.
TOPICS: dict[str, Any] = {
    '/mission/domain': SourceText,
    '/mission/problem': SourceText,
    '/mission/world': SourceText,
    '/mission/options': PlanningOptions,
    '/mission/progress': PlanningProgress,
    EVENTS: PlanningEvent,
    '/map': OccupancyGrid,
    '/markers': MarkerArray,
    '/path': PathMessage,
    '/global_plan': GlobalPlan,
    '/mission/outcome': Outcome,
    '/mission/statistics': PlanningStatistics,
}


@dataclass(frozen=True, slots=True)
class RecordedMessage:
    """One message of a recording, and when it was received [ns since 1970]."""

    topic: str
    message: Any
    time: int


class Recording:
    """A recording that is being written, with all TOPICS declared."""

    def __init__(self, file: BinaryIO):
        self._writer = RecordingWriter(file)
        for topic, kind in TOPICS.items():
            name = type_name(kind)
            self._writer.add_topic(
                topic,
                name,
                schema_text(name, definition),
                latched=topic != EVENTS,
                depth=1000 if topic == EVENTS else 1,
            )

    def write(self, topic: str, message: Any, time: int) -> None:
        """Add a message, or one that is serialised already."""
        data = message if isinstance(message, bytes) else serialize_message(message)
        self._writer.write(topic, data, time)

    def finish(self) -> None:
        """Complete the recording."""
        self._writer.finish()


def read_messages(path: Path) -> Iterator[RecordedMessage]:
    """Yield the messages of a recording, oldest first.

    Raises RecordingError for a damaged file, and for a message of a type that is not installed
    or has another definition here.
    """
    classes: dict[tuple[str, str], Any] = {}
    for serialised in read_serialised(path):
        key = (serialised.kind, serialised.schema)
        try:
            if key not in classes:
                classes[key] = _message_class(*key)
            message = deserialize_message(serialised.data, classes[key])
        except Exception as error:
            raise RecordingError(
                f'{path}: a message on {serialised.topic} cannot be read: {error}'
            ) from error
        yield RecordedMessage(serialised.topic, message, serialised.time)


def type_name(kind: Any) -> str:
    """The name of a message type, for example nav_msgs/msg/Path."""
    package = kind.__module__.split('.')[0]
    return f'{package}/msg/{kind.__name__}'


def definition(name: str) -> str:
    """The text of an installed ``.msg`` file."""
    package, _, base = name.split('/')
    file = Path(get_package_share_directory(package), 'msg', f'{base}.msg')
    return file.read_text(encoding='utf-8')


def _message_class(name: str, schema: str) -> Any:
    """The class of an installed message type; a file cannot name just any module of Python."""
    package, _, base = name.partition('/msg/')
    try:
        installed = schema_text(name, definition)
    except (PackageNotFoundError, ValueError, OSError):
        raise LookupError(f'the message type {name} is not installed') from None
    if not same_definition(installed, schema):
        raise LookupError(f'{name} was recorded with another definition than the installed one')
    return getattr(importlib.import_module(f'{package}.msg'), base)
