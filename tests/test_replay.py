"""A recorded mission, read back and asked again."""

from __future__ import annotations

import json
from pathlib import Path

from mcap.reader import make_reader

from tests.support.missions import Run
from tests.support.processes import geohtn

#: What a recording has to hold, with its message type.
TOPICS = {
    'planning_events': 'geohtn_msgs/msg/PlanningEvent',
    'global_plan': 'geohtn_msgs/msg/GlobalPlan',
    'path': 'nav_msgs/msg/Path',
    'map': 'nav_msgs/msg/OccupancyGrid',
    'markers': 'visualization_msgs/msg/MarkerArray',
}


def test_the_recording_is_whole(rover_run: Run) -> None:
    statistics = json.loads((rover_run.output / 'plan.json').read_text())['statistics']
    with (rover_run.output / 'mission.mcap').open('rb') as file:
        summary = make_reader(file).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    found = {
        channel.topic.rsplit('/', 1)[-1]: (
            summary.schemas[channel.schema_id].name,
            summary.statistics.channel_message_counts[channel_id],
        )
        for channel_id, channel in summary.channels.items()
    }
    for topic, schema in TOPICS.items():
        assert found[topic][0] == schema
        assert found[topic][1] >= 1
    events = found['planning_events'][1]
    assert events == statistics['answers'] + statistics['advices']


def test_every_request_gets_its_answer_again(rover_run: Run) -> None:
    done = geohtn('replay', rover_run.output / 'mission.mcap')
    assert done.returncode == 0, done.stdout + done.stderr


def test_half_a_recording_is_refused(rover_run: Run, tmp_path: Path) -> None:
    """A recording that was cut off is an error with its name, not a replay of what is left."""
    recording = bytearray((rover_run.output / 'mission.mcap').read_bytes())
    broken = tmp_path / 'broken.mcap'
    broken.write_bytes(recording[: len(recording) // 2])
    done = geohtn('replay', broken)
    assert done.returncode == 2, done.stdout + done.stderr
    assert 'Traceback' not in done.stdout + done.stderr
    assert 'broken.mcap' in done.stdout + done.stderr
