"""Reading a recording's serialised messages, from a file that may be anything."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mcap.reader import make_reader

from interface_node.recording.errors import RecordingError


@dataclass(frozen=True, slots=True)
class SerialisedMessage:
    """A message as it was recorded; ``kind`` is for example nav_msgs/msg/Path, time in [ns].

    ``schema`` is the definition of its type that it was recorded with.
    """

    topic: str
    kind: str
    schema: str
    data: bytes
    time: int


def read_serialised(path: Path) -> Iterator[SerialisedMessage]:
    """Yield the messages of a ROS 2 recording, oldest first.

    Raises RecordingError when the file is missing, damaged, cut short, or no ROS 2 recording.
    """
    try:
        with path.open('rb') as file:
            reader = make_reader(file, validate_crcs=True)
            profile = reader.get_header().profile
            if profile != 'ros2':
                raise RecordingError(f'{path}: a recording of profile {profile!r}, not of ROS 2')
            if reader.get_summary() is None:
                raise RecordingError(f'{path}: the recording is cut short: it has no summary')
            for schema, channel, message in reader.iter_messages():
                if schema is None or channel.message_encoding != 'cdr':
                    raise RecordingError(f'{path}: topic {channel.topic} is not encoded as cdr')
                yield SerialisedMessage(
                    channel.topic,
                    schema.name,
                    schema.data.decode(),
                    message.data,
                    message.log_time,
                )
    except RecordingError:
        raise
    except OSError as error:
        raise RecordingError(f'{path}: cannot be read: {error.strerror}') from None
    except Exception as error:  # whatever the libraries make of bytes that are no recording
        raise RecordingError(f'{path}: no readable MCAP recording: {error}') from error
