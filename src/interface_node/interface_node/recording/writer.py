"""Writing an MCAP file that rosbag2 plays and Foxglove opens, from serialised messages."""

from __future__ import annotations

from typing import BinaryIO

from mcap.writer import Writer

LIBRARY = 'geohtn'
_FOREVER = '{sec: 9223372036, nsec: 854775807}'


def qos_profile(*, latched: bool, depth: int) -> str:
    """The quality of service in rosbag2's YAML, so that a replay offers what was offered."""
    return '\n'.join(
        (
            '- history: keep_last',
            f'  depth: {depth}',
            '  reliability: reliable',
            f'  durability: {"transient_local" if latched else "volatile"}',
            f'  deadline: {_FOREVER}',
            f'  lifespan: {_FOREVER}',
            '  liveliness: automatic',
            f'  liveliness_lease_duration: {_FOREVER}',
            '  avoid_ros_namespace_conventions: false',
        )
    )


class RecordingWriter:
    """One recording. The same messages at the same times give the same bytes."""

    def __init__(self, file: BinaryIO):
        """Begin the recording in a file that is open for writing."""
        self._writer = Writer(file)
        self._writer.start(profile='ros2', library=LIBRARY)
        self._schemas: dict[str, int] = {}
        self._channels: dict[str, int] = {}
        self._counts: dict[str, int] = {}

    def add_topic(self, topic: str, kind: str, schema: str, *, latched: bool, depth: int) -> None:
        """Declare a topic with messages of ``kind``, described by ``schema`` (see schema.py)."""
        if kind not in self._schemas:
            self._schemas[kind] = self._writer.register_schema(
                name=kind, encoding='ros2msg', data=schema.encode()
            )
        self._channels[topic] = self._writer.register_channel(
            topic=topic,
            message_encoding='cdr',
            schema_id=self._schemas[kind],
            metadata={'offered_qos_profiles': qos_profile(latched=latched, depth=depth)},
        )

    def write(self, topic: str, data: bytes, time: int) -> None:
        """Add one serialised message that was received at ``time`` [ns since 1970]."""
        count = self._counts.get(topic, 0)
        self._writer.add_message(
            channel_id=self._channels[topic],
            log_time=time,
            publish_time=time,
            data=data,
            sequence=count,
        )
        self._counts[topic] = count + 1

    def finish(self) -> None:
        """Write the index; nothing can be added after that."""
        self._writer.finish()
