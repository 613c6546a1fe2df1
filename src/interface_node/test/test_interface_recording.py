"""Recordings: what is written is read back; what is no recording is refused with a sentence."""

from __future__ import annotations

import struct
from contextlib import suppress
from itertools import pairwise
from pathlib import Path

import pytest
from geohtn_msgs.msg import AgentState, GeometricAnswer, PlanningEvent, SourceText, Step
from hypothesis import given, settings
from hypothesis import strategies as st
from rclpy.serialization import deserialize_message, serialize_message

from interface_node.conversions import (
    diagnostic_from_message,
    diagnostic_to_message,
    step_from_message,
)
from interface_node.display_conversions import map_message, marker_array, path_message
from interface_node.plan import Diagnostic, Plan
from interface_node.recording.comparison import differences
from interface_node.recording.errors import RecordingError
from interface_node.recording.message_conversions import (
    EVENTS,
    TOPICS,
    Recording,
    definition,
    read_messages,
    type_name,
)
from interface_node.recording.schema import dependencies, same_definition, schema_text

HEADER = path_message(Plan('', ''), 1.0, PlanningEvent().received).header


def record(path: Path, messages: list[tuple[str, object, int]]) -> bytes:
    with path.open('wb') as file:
        recording = Recording(file)
        for message in messages:
            recording.write(*message)
        recording.finish()
    return path.read_bytes()


@pytest.fixture
def messages(sample_plan: Plan) -> list[tuple[str, object, int]]:
    assert sample_plan.world is not None
    stamp = HEADER.stamp
    answer = GeometricAnswer(message='é', end=[AgentState(agent='rover0', x=0.1)], length=1 / 3)
    return [
        ('/mission/world', SourceText(path='w.yaml', text='bounds: [0, 0, 1, 1]\n'), 1),
        (EVENTS, PlanningEvent(answer=[answer]), 5),
        ('/map', map_message(sample_plan.world, 1.0, stamp), 7),
        ('/markers', marker_array(sample_plan, 1.0, stamp), 8),
        ('/path', path_message(sample_plan, 1.0, stamp), 9),
    ]


def test_messages_are_read_back(tmp_path: Path, messages: list[tuple[str, object, int]]) -> None:
    path = tmp_path / 'mission.mcap'
    record(path, messages[::-1])
    read = [(found.topic, found.message, found.time) for found in read_messages(path)]
    assert [(topic, time) for topic, _, time in read] == [(t, time) for t, _, time in messages]
    for (_, found, _), (_, written, _) in zip(read, messages, strict=True):
        # A colour of a marker is narrowed to 32 bits on its way.
        assert found == deserialize_message(serialize_message(written), type(written))


@pytest.fixture(scope='module')
def whole(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp('whole') / 'mission.mcap'
    return record(path, [('/mission/world', SourceText(text='x' * 2000), 1)])


@settings(max_examples=60, deadline=None)
@given(st.data())
def test_a_damaged_recording_is_refused_with_its_name(
    tmp_path_factory: pytest.TempPathFactory, whole: bytes, data: st.DataObject
) -> None:
    path = tmp_path_factory.mktemp('damaged') / 'mission.mcap'
    cut = data.draw(st.integers(0, len(whole) - 1))
    path.write_bytes(whole[:cut])
    with pytest.raises(RecordingError, match=r'mission\.mcap: '):
        list(read_messages(path))
    garbled = bytearray(whole)
    for _ in range(data.draw(st.integers(1, 4))):
        garbled[data.draw(st.integers(0, len(whole) - 1))] = data.draw(st.integers(0, 255))
    path.write_bytes(bytes(garbled))
    with suppress(RecordingError):
        list(read_messages(path))


@pytest.mark.parametrize('content', [b'', b'\x00' * 100, b'not a recording', b'\x89MCAP0\r\n'])
def test_what_is_no_recording_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / 'mission.mcap'
    path.write_bytes(content)
    with pytest.raises(RecordingError, match=r'mission\.mcap: '):
        list(read_messages(path))


def test_a_missing_file_and_a_directory_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path / 'none.mcap', tmp_path):
        with pytest.raises(RecordingError, match='cannot be read'):
            list(read_messages(path))


def test_every_schema_names_all_that_it_depends_on() -> None:
    for kind in TOPICS.values():
        name = type_name(kind)
        text = schema_text(name, definition)
        first, *others = text.split('=' * 80 + '\n')
        sections = {name: first}
        for other in others:
            title, _, body = other.partition('\n')
            package, _, base = title.removeprefix('MSG: ').partition('/')
            sections[f'{package}/msg/{base}'] = body
        for owner, body in sections.items():
            assert set(dependencies(owner.partition('/')[0], body)) <= sections.keys()


def test_comments_do_not_make_another_definition() -> None:
    text = 'uint8 A=0  # one\nT[<=1] t\n' + '=' * 80 + '\nMSG: p/T\nstring<=3 s\n'
    assert same_definition(text, text.replace('  # one', ''))
    assert not same_definition(text, text.replace('uint8', 'uint16'))
    assert not same_definition(text, text.replace('<=3', '<=4'))
    assert list(dependencies('p', text.split('=' * 80, maxsplit=1)[0])) == ['p/msg/T']


def test_differences_are_named_and_nan_equals_itself() -> None:
    def answer(length: float, spent: float) -> GeometricAnswer:
        return GeometricAnswer(length=length, time_spent=spent, end=[AgentState(agent='a')])

    ignored = frozenset({'time_spent'})
    assert list(differences(answer(1.5, 1.0), answer(1.5, 2.0), ignored)) == []
    nan = struct.unpack('d', struct.pack('d', float('nan')))[0]
    assert list(differences(answer(nan, 1.0), answer(nan, 2.0), ignored)) == []
    after = answer(1.5 + 2**-50, 1.0)
    after.end[0].x = 2.0
    assert list(differences(answer(1.5, 1.0), after)) == [
        'end[0].x was 0.0 and now is 2.0',
        f'length was 1.5 and now is {1.5 + 2**-50!r}',
    ]
    after.end = []
    assert 'end had 1 elements and now has 0' in list(differences(answer(1.5, 1.0), after))


def test_the_path_is_the_whole_way_without_doubled_poses(sample_plan: Plan) -> None:
    poses = path_message(sample_plan, 0.5, HEADER.stamp).poses
    assert {pose.header.frame_id for pose in poses} == {'map'}
    places = [(pose.pose.position.x, pose.pose.position.y) for pose in poses]
    assert places[0] == (10.0, 10.0)
    assert all(before != after for before, after in pairwise(places))
    for pose in poses:
        turn = pose.pose.orientation
        assert turn.z**2 + turn.w**2 == pytest.approx(1.0)


def test_markers_have_ids_of_their_own(sample_plan: Plan) -> None:
    markers = marker_array(sample_plan, 1.0, HEADER.stamp).markers
    assert len({marker.id for marker in markers}) == len(markers)
    assert {marker.ns for marker in markers[1:]} == {
        'footprints',
        'obstacles',
        'objects',
        'labels',
        'attitudes',
        'numbers',
        'views',
        'way',
    }


def test_steps_survive_their_messages(sample_plan: Plan, sample_steps: list[Step]) -> None:
    assert tuple(step_from_message(step) for step in sample_steps) == sample_plan.steps


def test_a_remark_survives_its_message() -> None:
    for warning in (True, False):
        remark = Diagnostic('wrong', 'a.lisp', 3, 4, '(x', warning)
        assert diagnostic_from_message(diagnostic_to_message(remark)) == remark
