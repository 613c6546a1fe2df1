"""``plan.json`` keeps its contract, whatever the plan is."""

from __future__ import annotations

import json
from dataclasses import replace
from math import inf, nan
from typing import Any

from interface_node.driving import drive
from interface_node.history import History
from interface_node.plan import Attitude, Diagnostic, Plan, Segment
from interface_node.plan_document import to_text


def read(plan: Plan) -> Any:
    return json.loads(to_text(plan))


def test_the_contract_is_kept(sample_plan: Plan) -> None:
    document = read(sample_plan)
    assert document['outcome'] == 'SOLVED'
    assert document['world'] == 'missions/world.yaml'
    assert (
        document['robot'].items()
        >= {
            'wheelbase': 2.0,
            'max_steering_angle': 0.5,
            'radius': 1.0,
        }.items()
    )
    assert document['planning_time'] == 0.25
    assert document['statistics'].items() >= {'requests': 3, 'answers': 3}.items()
    assert [step['action'][0] for step in document['steps']] == [
        '!init_rover_attitude',
        '!take_photo',
        '!charge',
        '!take_photo',
    ]
    for key in ('length', 'duration'):
        assert document[key] == sum(step[key] for step in document['steps'])
    assert [step['clearance'] for step in document['steps']] == [None, 2.5, None, 2.5]


def test_the_history_of_the_best_plan_is_told(sample_plan: Plan) -> None:
    assert read(sample_plan)['improvements'] == []
    history = History()
    words = (
        (0.5, inf, inf),
        (1.0, 40.0, 45.0),
        (1.5, 40.0, 45.0),
        (3.5, 36.0, 38.0),
        (2.5, 37.0, 39.0),
    )
    assert [history.note(*word) for word in words] == [False, True, False, True, True]
    document = read(replace(sample_plan, improvements=history.improvements))
    assert document['improvements'] == [
        {'elapsed': 1.0, 'length': 40.0},
        {'elapsed': 2.5, 'length': 37.0},
        {'elapsed': 3.5, 'length': 36.0},
    ]


def test_a_stranger_can_drive_the_plan_from_the_file_alone(sample_plan: Plan) -> None:
    document = read(sample_plan)
    for step in document['steps']:
        end = drive(
            Attitude(**step['start']),
            [Segment(*segment) for segment in step['segments']],
            document['robot']['wheelbase'],
        )
        assert end == Attitude(**step['end'])
    ends = [step['end'] for step in document['steps']]
    assert [step['start'] for step in document['steps'][1:]] == ends[:-1]


def test_a_segment_has_four_numbers_only_where_it_needs_them(sample_plan: Plan) -> None:
    segments = (
        Segment(0.5, -2.0),
        Segment(0.0, 3.0, direction=0.25),
        Segment(0.0, 0.0, turn=-1.5),
    )
    plan = replace(sample_plan, steps=(replace(sample_plan.steps[1], segments=segments),))
    document = read(plan)
    assert document['steps'][0]['segments'] == [
        [0.5, -2.0],
        [0.0, 3.0, 0.25, 0.0],
        [0.0, 0.0, 0.0, -1.5],
    ]
    assert [robot['label'] for robot in document['robots']] == ['scout', 'rover0']
    assert document['robot'] in document['robots']


def test_numbers_are_read_back_bit_for_bit(sample_plan: Plan) -> None:
    step = read(sample_plan)['steps'][3]
    assert step['segments'][1][1] == 1.0 / 3.0
    assert sample_plan.steps[3].end is not None
    assert step['end']['x'] == sample_plan.steps[3].end.x


def test_a_symbolic_action_stands_where_the_robot_stands(sample_plan: Plan) -> None:
    tree, charged = read(sample_plan)['steps'][1:3]
    assert charged['start'] == charged['end'] == tree['end']
    assert (charged['agent'], charged['segments'], charged['length']) == ('', [], 0.0)


def test_a_symbolic_action_before_any_attitude_stands_nowhere(sample_plan: Plan) -> None:
    plan = replace(sample_plan, steps=sample_plan.steps[2:3])
    assert read(plan)['steps'][0]['start'] is None


def test_a_failure_is_a_document_as_well() -> None:
    remark = Diagnostic('unexpected )', 'domain.lisp', 3, 5, ')', warning=True)
    document = read(Plan('small', 'INVALID', 'the domain is at fault', (remark,)))
    assert document['steps'] == []
    assert document['robot'] is None
    assert document['diagnostics'] == [
        {
            'severity': 'WARNING',
            'source': 'domain.lisp',
            'line': 3,
            'column': 5,
            'text': ')',
            'message': 'unexpected )',
        }
    ]


def test_what_is_not_finite_is_null(sample_plan: Plan) -> None:
    plan = replace(sample_plan, planning_time=inf, statistics={'search_time': nan})
    document = read(plan)
    assert document['planning_time'] is None
    assert document['statistics'] == {'search_time': None}
