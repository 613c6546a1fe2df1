"""Messages to dataclasses and back, and what becomes of a fault inside a request."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import fields
from math import inf, nan, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rclpy
from geohtn_msgs import msg, srv
from hypothesis import given
from hypothesis import strategies as st

from motion_planner_node import conversions, motion_conversions
from motion_planner_node.codes import AttemptResult, Code, Purpose, Scope
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.node import MotionPlannerNode
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import (
    AdviceAnswer,
    AdviceRequest,
    Attempt,
    CandidateAdvice,
    GeometricAnswer,
    GeometricRequest,
    Opportunity,
    Place,
    Residual,
)
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.world import read_world

WORLD = (
    Path(__file__).resolve().parents[2] / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
).read_text(encoding='utf-8')


@given(
    st.floats(allow_nan=False, allow_infinity=False),
    st.floats(allow_nan=False, allow_infinity=False),
    st.floats(-pi, pi, exclude_min=True),
)
def test_a_state_survives_the_journey_bit_for_bit(x: float, y: float, heading: float) -> None:
    state = {'rover0': Attitude(x, y, heading), 'rover1': Attitude(y, x, 0.0)}
    assert conversions.state_from_msg(conversions.state_to_msg(state)) == state


@given(st.floats(-1e6, 1e6))
def test_every_heading_ends_up_in_its_range(heading: float) -> None:
    (attitude,) = conversions.state_from_msg(
        [msg.AgentState(agent='rover0', heading=heading)]
    ).values()
    assert -pi < attitude.heading <= pi
    assert np.cos(attitude.heading) == pytest.approx(np.cos(heading), abs=1e-9)
    assert np.sin(attitude.heading) == pytest.approx(np.sin(heading), abs=1e-9)


def test_a_half_turn_has_one_name() -> None:
    states = conversions.state_from_msg([msg.AgentState(agent='rover0', heading=-pi)])
    assert states['rover0'].heading == pi


@pytest.mark.parametrize('name', ['x', 'y', 'heading'])
@pytest.mark.parametrize('value', [nan, inf, -inf])
def test_a_number_that_is_not_finite_is_no_start(name: str, value: float) -> None:
    with pytest.raises(MotionPlannerError, match=name) as refused:
        conversions.state_from_msg([msg.AgentState(agent='rover0', **{name: value})])
    assert refused.value.code is Code.INVALID_START


def test_an_agent_stands_in_one_place() -> None:
    twice = [msg.AgentState(agent='rover0'), msg.AgentState(agent='rover0', x=1.0)]
    with pytest.raises(MotionPlannerError, match='rover0 twice') as refused:
        conversions.state_from_msg(twice)
    assert refused.value.code is Code.INVALID_START


def test_an_answer_of_numpy_numbers_becomes_a_message_of_plain_ones() -> None:
    one = np.float64(1.0)
    yes: Any = np.bool_(1)
    attitude = Attitude(one, one, one)
    answer = GeometricAnswer(
        code=Code.NO_PATH,
        message='no path',
        scope=Scope.ANY_START,
        agent='rover0',
        objects=('tree',),
        world_revision='r',
        end={'rover0': attitude},
        assigned=yes,
        motion=Motion('rover0', attitude, (Segment(one, one), Segment(-one, one))),
        residuals=(Residual('c', one, yes),),
        attempts=(Attempt('rover0', attitude, AttemptResult.NO_PATH, 'why'),),
        diagnostics=(Diagnostic('remark', 3, 4, 'text', 'file'),),
        advice='turn',
    )
    asked = msg.GeometricRequest(request_id='id', alternative=4)
    sent = conversions.answer_to_msg(answer, asked, np.float64(0.5))
    assert (sent.status, sent.code, sent.scope) == (
        msg.GeometricAnswer.UNKNOWN,
        msg.GeometricAnswer.NO_PATH,
        msg.GeometricAnswer.ANY_START,
    )
    assert (sent.request_id, sent.alternative, sent.length) == ('id', 4, 2.0)
    assert type(sent.end[0].x) is float
    assert type(sent.residuals[0].satisfied) is bool
    assert [part.steering_angle for part in sent.motion.segments] == [1.0, -1.0]
    assert sent.attempts[0].result == msg.Attempt.NO_PATH
    assert (sent.diagnostics[0].line, sent.diagnostics[0].source) == (3, 'file')


def test_advice_becomes_a_message() -> None:
    candidates = (CandidateAdvice(1.0, 2.0), CandidateAdvice(inf, inf, impossible=True))
    sent = conversions.advice_to_msg(
        AdviceAnswer(candidates, (0, 1), 'r'), msg.AdviceRequest(request_id='id'), 0.5
    )
    assert [item.estimate for item in sent.candidates] == [2.0, inf]
    assert list(sent.order) == [0, 1]
    assert sent.request_id == 'id'


def test_what_a_tour_needs_arrives_and_its_answer_is_told() -> None:
    end = msg.AgentState(agent='r', x=1.0, y=2.0, heading=3.0)
    motion = msg.Motion(agent='r', start=end, segments=[msg.Segment(length=2.0)])
    asked = msg.AdviceRequest(
        preconditions=['a', 'b'],
        purpose=msg.AdviceRequest.SHORTEST_TOUR,
        before=[1],
        after=[0],
        ends=[end, msg.AgentState()],
        effort=2,
        motions=[motion],
    )
    request = conversions.advice_request_from_msg(asked)
    here = 'r', Attitude(1.0, 2.0, 3.0)
    assert (request.purpose, request.before, request.after) == (Purpose.SHORTEST_TOUR, (1,), (0,))
    assert (request.ends, request.effort) == ((here, None), 2)
    assert request.motions == (Motion('r', here[1], (Segment(0.0, 2.0),)),)
    opportunity = Opportunity(1, 0, 1.5, here)
    answer = AdviceAnswer((), (1, 0), '', (), (), (here, None), 7.0, (opportunity,))
    sent = conversions.advice_to_msg(answer, asked, 0.0)
    assert [state.agent for state in sent.ends] == ['r', '']
    assert (sent.ends[0].x, sent.tour_length) == (1.0, 7.0)
    told = sent.opportunities[0]
    assert (told.candidate, told.motion, told.distance, told.end.y) == (1, 0, 1.5, 2.0)


places = st.builds(
    Place,
    st.integers(0, 2**32 - 1),
    st.sampled_from(['rover0', 'r']),
    st.builds(Attitude, *[st.floats(allow_nan=False, allow_infinity=False)] * 3),
)


@given(st.lists(places, max_size=4), st.data())
def test_places_and_what_lies_between_are_told(told: list[Place], data: st.DataObject) -> None:
    size = (len(told) + 1) * len(told)
    lengths = data.draw(st.lists(st.floats(0.0), min_size=size, max_size=size))
    answer = AdviceAnswer((), (), places=tuple(told), place_lengths=tuple(lengths))
    sent = conversions.advice_to_msg(answer, msg.AdviceRequest(), 0.0)
    assert list(sent.place_candidates) == [place.candidate for place in told]
    assert [(state.agent, state.x, state.y, state.heading) for state in sent.places] == [
        (place.agent, place.attitude.x, place.attitude.y, place.attitude.heading) for place in told
    ]
    assert list(sent.place_lengths) == lengths


def test_a_request_for_advice_arrives_as_it_was_sent() -> None:
    end = msg.AgentState(agent='r', x=1.0, y=2.0, heading=0.5)
    same = {'seed': 2**64 - 1, 'purpose': 2, 'effort': 5, 'places': 2**32 - 1}
    sent = msg.AdviceRequest(
        world_revision='abc',
        request_id='id',
        pairwise=True,
        preconditions=['a', 'b'],
        start=[end],
        before=[1],
        after=[0],
        ends=[end, end],
        motions=[msg.Motion(agent='r', start=end, segments=[msg.Segment(length=2.0)])],
        **same,
    )
    request = conversions.advice_request_from_msg(sent)
    assert {name: getattr(request, name) for name in same} == same
    # Whatever is added to requests has to be sent here as well.
    empty = AdviceRequest((), {})
    names = [item.name for item in fields(AdviceRequest)]
    assert [name for name in names if getattr(request, name) == getattr(empty, name)] == []


def test_a_preferred_end_arrives_and_one_that_is_not_finite_is_named() -> None:
    end = msg.AgentState(agent='r', x=1.0, y=2.0, heading=3.0)
    request = conversions.request_from_msg(msg.GeometricRequest(preferred_end=[end]))
    assert request.preferred_end == {'r': Attitude(1.0, 2.0, 3.0)}
    end.x = nan
    with pytest.raises(MotionPlannerError, match='the preferred end of r has x nan'):
        conversions.request_from_msg(msg.GeometricRequest(preferred_end=[end]))


def test_the_constants_of_the_messages_are_those_of_the_planner() -> None:
    for code in Code:
        assert getattr(msg.GeometricAnswer, code.name) == code
    for scope in Scope:
        assert getattr(msg.GeometricAnswer, scope.name) == scope
    for result in AttemptResult:
        assert getattr(msg.Attempt, result.name) == result


def test_a_world_becomes_a_message() -> None:
    sent = conversions.world_to_msg(read_world(WORLD, 'world.yaml'))
    assert (sent.x_min, sent.y_min, sent.x_max, sent.y_max) == (0.0, 0.0, 800.0, 600.0)
    circles = [item for item in sent.obstacles if not item.polygon]
    assert {item.name for item in circles} == {'north_pillar', 'east_pillar', 'middle_pillar'}
    assert all(item.radius > 0.0 for item in circles)
    assert list(sent.objects[1].field_names) == ['x', 'y']
    assert list(sent.objects[1].field_values) == [67.0, 171.0]
    assert list(sent.robots[0].start) == []
    assert list(sent.regions) == []


def test_the_regions_of_the_world_are_told() -> None:
    regions = (
        'regions: [{name: dock, polygon: [[0, 0], [9, 0], [9, 8]]},'
        ' {name: pond, circle: {center: [4, 5], radius: 6}}]'
    )
    dock, pond = conversions.world_to_msg(read_world(WORLD + regions, '')).regions
    assert (dock.name, dock.radius) == ('dock', 0.0)
    assert [(corner.x, corner.y) for corner in dock.polygon] == [(0, 0), (9, 0), (9, 8)]
    assert (pond.name, len(pond.polygon)) == ('pond', 0)
    assert (pond.center.x, pond.center.y, pond.radius) == (4.0, 5.0, 6.0)


@pytest.fixture
def node() -> Iterator[MotionPlannerNode]:
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=1 + os.getpid() % 200)
    node = MotionPlannerNode(context=context)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_a_fault_inside_a_request_is_answered_and_outlived(
    node: MotionPlannerNode, monkeypatch: pytest.MonkeyPatch
) -> None:
    accepted = node._worlds._set_world(srv.SetWorld.Request(yaml=WORLD), srv.SetWorld.Response())
    assert accepted.accepted

    def broken(*_: object) -> None:
        raise ZeroDivisionError('broken on purpose')

    with monkeypatch.context() as patched:
        for name in ('satisfy', 'advise'):
            patched.setattr(MotionPlanner, name, broken)
        request = srv.SatisfyPreconditions.Request()
        answer = node._satisfy(request, srv.SatisfyPreconditions.Response()).answer
        assert (answer.status, answer.code) == (
            msg.GeometricAnswer.ERROR,
            msg.GeometricAnswer.INTERNAL,
        )
        assert 'ZeroDivisionError: broken on purpose' in answer.message
        advice = node._advise(srv.Advise.Request(), srv.Advise.Response()).answer
        assert advice.code == msg.GeometricAnswer.INTERNAL
    request.request.preconditions = (
        '((agent rover0)(setProperty(rover0.x, 20))(setProperty(rover0.y, 20))'
        '(setProperty(rover0.heading, 0)))'
    )
    answer = node._satisfy(request, srv.SatisfyPreconditions.Response()).answer
    assert answer.status == msg.GeometricAnswer.FOUND


def test_a_request_arrives_as_it_was_sent() -> None:
    same: dict[str, Any] = {
        'preconditions': '((agent r))',
        'agent': 'r',
        'behaviour': 'slowly',
        'alternative': 3,
        'world_revision': 'abc',
        'seed': 7,
        'time_budget': 2.0,
        'request_id': 'id',
        'mode': 'paper',
        'planner': 'direct',
    }
    sent = msg.GeometricRequest(
        start=[msg.AgentState(agent='r', x=1.0, y=2.0, heading=0.5)],
        preferred_end=[msg.AgentState(agent='r', x=4.0, y=5.0, heading=-0.5)],
        **same,
    )
    request = conversions.request_from_msg(sent)
    assert request == GeometricRequest(
        start={'r': Attitude(1.0, 2.0, 0.5)},
        preferred_end={'r': Attitude(4.0, 5.0, -0.5)},
        **same,
    )
    # Whatever is added to requests has to be sent here as well.
    empty = GeometricRequest('')
    names = [item.name for item in fields(GeometricRequest)]
    assert [name for name in names if getattr(request, name) == getattr(empty, name)] == []


def test_every_robot_becomes_a_message_with_all_of_its_model() -> None:
    text = """
bounds: [0, 0, 80, 60]
robots:
  truck: {model: reverse_car, wheelbase: 3, max_steering_angle: 0.5, speed: 2, safety_margin: 0.25,
          footprint: [[-1, -1], [4, -1], [4, 1], [-1, 1]]}
  vacuum: {model: differential, radius: 0.5, speed: 1, turning_speed: 2,
           start: {x: 5, y: 5, heading: 0}}
"""
    truck, vacuum = conversions.world_to_msg(read_world(text, '')).robots
    assert (truck.model, truck.wheelbase, truck.safety_margin) == ('reverse_car', 3.0, 0.25)
    assert [(corner.x, corner.y) for corner in truck.footprint][:2] == [(-1.0, -1.0), (4.0, -1.0)]
    assert (truck.turning_speed, list(truck.start)) == (0.0, [])
    assert (vacuum.model, vacuum.turning_speed, vacuum.wheelbase) == ('differential', 2.0, 0.0)
    assert (vacuum.radius, list(vacuum.footprint), vacuum.start[0].x) == (0.5, [], 5.0)


def test_a_motion_survives_its_message() -> None:
    segments = (
        Segment(0.5, -2.0),
        Segment(0.0, 3.0, direction=-1.0),
        Segment(0.0, 0.0, turn=2.0),
    )
    motion = Motion('r', Attitude(1.0, 2.0, 3.0), segments)
    sent = motion_conversions.motion_to_msg(motion, 7.0, 0.5)
    assert (sent.length, sent.duration, sent.clearance) == (5.0, 7.0, 0.5)
    assert motion_conversions.motion_from_msg(sent) == motion
    with pytest.raises(MotionPlannerError) as refused:
        motion_conversions.motion_from_msg(msg.Motion(start=msg.AgentState(x=nan)))
    assert refused.value.code is Code.INVALID_START


def test_a_path_has_its_times_as_stamps() -> None:
    rows = np.array([[1.0, 2.0, pi / 2, 0.0], [3.0, 4.0, pi, 2.25], [3.0, 4.0, pi, 1e12]])
    path = motion_conversions.path_to_msg(rows)
    assert path.header.frame_id == 'map'
    assert [pose.header.stamp.sec for pose in path.poses] == [0, 2, 2**31 - 1]
    assert path.poses[1].header.stamp.nanosec == 250_000_000
    first = path.poses[0].pose
    assert (first.position.x, first.position.y) == (1.0, 2.0)
    assert 2.0 * np.arctan2(first.orientation.z, first.orientation.w) == pytest.approx(pi / 2)
