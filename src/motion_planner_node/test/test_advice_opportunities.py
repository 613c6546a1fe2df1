"""Opportunities: places on the motions themselves, found wherever a dense sampling finds one."""

from __future__ import annotations

from math import hypot, inf, pi, remainder, tau

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from motion_planner_node.codes import Code, Purpose
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceRequest, Opportunity
from motion_planner_node.robots.driving import end_of, sample
from motion_planner_node.robots.motion import Attitude, Motion, Segment
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, World, WorldObject

CAR = Robot('r', 8.0, 0.5, 5.0, 2.0)
OTHER = Robot('s', 8.0, 0.5, 5.0, 2.0)
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 400.0, 400.0),
    objects={'o': WorldObject('o', {'x': 200.0, 'y': 200.0})},
    obstacles=(),
    robots={'r': CAR, 's': OTHER},
)
PLANNER = MotionPlanner(WORLD)
STATE = {'r': Attitude(100.0, 150.0, 0.0), 's': Attitude(300.0, 300.0, 0.0)}
NEAR = '((agent r)(object o)(distance(r, o) <= 60))'
BESIDE = '((agent r)(object o)(distance(r, o) <= 100)(rel_angle(r, o) = cos-and-sin(pi/2)))'
PHOTO = BESIDE.replace('pi/2', '-pi/2')
#: Along the line 50 m below the object, which is abreast on the left after 100 m.
STRAIGHT = Motion('r', Attitude(100.0, 150.0, 0.0), (Segment(0.0, 200.0),))


def asked(motions: tuple[Motion, ...], *texts: str) -> tuple[Opportunity, ...]:
    request = AdviceRequest(texts, STATE, purpose=Purpose.OPPORTUNITIES, motions=motions)
    return PLANNER.advise(request).opportunities


def test_where_a_circle_is_entered_and_where_an_object_is_abreast() -> None:
    near, abreast = asked((STRAIGHT,), NEAR, PHOTO)
    assert (near.candidate, near.motion, abreast.candidate) == (0, 0, 1)
    assert near.distance == pytest.approx(100.0 - np.sqrt(60.0**2 - 50.0**2))
    assert abreast.distance == pytest.approx(100.0)
    assert abreast.end[0] == 'r'
    assert abreast.end[1].x == pytest.approx(200.0)


def test_each_motion_has_its_first_place_and_what_is_never_met_has_none() -> None:
    ahead = end_of(STRAIGHT, CAR)
    back = Motion('r', Attitude(ahead.x, 250.0, pi), (Segment(0.0, 200.0),))
    found = asked((STRAIGHT, back), NEAR, '((agent r)(object o)(distance(r, o) <= 40))')
    assert [(item.candidate, item.motion) for item in found] == [(0, 0), (0, 1)]


def test_only_the_robot_that_moves_meets_candidates_on_its_way() -> None:
    assert asked((STRAIGHT,), NEAR.replace('r,', 's,').replace('agent r', 'agent s')) == ()


def test_other_robots_stand_where_their_motions_have_led_them() -> None:
    meet = '((agent r)(agent s)(distance(r, s) <= 60))'
    come = Motion('s', STATE['s'], (Segment(0.0, 50.0),))
    assert asked((STRAIGHT,), meet) == ()
    to = Motion('s', Attitude(200.0, 100.0, 0.0), ())
    found = asked((come, to, STRAIGHT), meet)
    assert [item.motion for item in found] == [2]
    assert found[0].distance == pytest.approx(100.0 - np.sqrt(60.0**2 - 50.0**2))


def test_a_motion_of_no_length_is_looked_at_too() -> None:
    stay = Motion('r', Attitude(190.0, 200.0, 0.0))
    assert [(item.candidate, item.distance) for item in asked((stay,), NEAR)] == [(0, 0.0)]


pieces = st.lists(
    st.builds(Segment, st.sampled_from([-0.5, 0.0, 0.5]), st.floats(0.5, 60.0)), max_size=6
)
starts = st.builds(Attitude, st.floats(50.0, 350.0), st.floats(50.0, 350.0), st.floats(-3.1, 3.1))


@given(starts, pieces, st.floats(20.0, 150.0), st.floats(-3.0, 3.0))
@settings(max_examples=60, deadline=None)
def test_places_are_on_the_motion_and_no_dense_sample_is_before_them(
    start: Attitude, segments: list[Segment], radius: float, angle: float
) -> None:
    motion = Motion('r', start, tuple(segments))
    within = f'((agent r)(object o)(distance(r, o) <= {radius!r}))'
    looking = f'((agent r)(object o)(distance(r, o) <= {radius!r})(rel_angle(r, o) = cos-and-sin({angle!r})))'
    found = {item.candidate: item for item in asked((motion,), within, looking)}
    rows = sample(motion, CAR, 0.05)
    apart = np.hypot(rows[:, 0] - 200.0, rows[:, 1] - 200.0)
    way = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(rows[:, :2], axis=0).T))))
    # A look at the world beside the planner: the angle to the object, wrapped.
    off = rows[:, 2] - np.arctan2(200.0 - rows[:, 1], 200.0 - rows[:, 0]) - angle
    off = np.arctan2(np.sin(off), np.cos(off))
    inside = apart <= radius
    deep = np.flatnonzero(apart <= radius - 0.5)
    assert not len(deep) or (0 in found and found[0].distance <= way[deep[0]] + 1e-6)
    crossed = (off[:-1] > 0.0) != (off[1:] > 0.0)
    crossed &= (np.abs(off[:-1] - off[1:]) < 1.0) & (apart[:-1] < radius - 0.5)
    first = np.flatnonzero(crossed & inside[:-1] & inside[1:])
    # Grazing angles change their sign twice between two of the planner's samples.
    spacing = np.flatnonzero(np.abs(off[::20]) < 0.02)
    if len(first) and len(spacing) <= 1:
        assert 1 in found
        assert found[1].distance <= way[first[0] + 1] + 1e-6
    for index, item in found.items():
        end = item.end[1]
        near = np.hypot(rows[:, 0] - end.x, rows[:, 1] - end.y)
        assert near.min() < 0.05
        assert abs(way[int(np.argmin(near))] - item.distance) < 0.2 or near.min() < 0.05
        assert hypot(end.x - 200.0, end.y - 200.0) <= radius + 1e-6
        if index == 1:
            bearing = np.arctan2(200.0 - end.y, 200.0 - end.x)
            assert abs(remainder(end.heading - bearing - angle, tau)) < 1e-6


@pytest.mark.parametrize(
    ('motion', 'code', 'words'),
    [
        (Motion('q', STATE['r']), Code.UNKNOWN_AGENT, 'the start of motion 0 names agent q'),
        (Motion('r', Attitude(inf, 0.0, 0.0)), Code.INVALID_START, 'motion 0 of r is not finite'),
        (
            Motion('r', STATE['r'], (Segment(0.2, 1.0),)),
            Code.UNSUPPORTED,
            'segment 1 of motion 0 has the steering angle 0.2',
        ),
    ],
)
def test_motions_that_make_no_sense_are_refused(motion: Motion, code: Code, words: str) -> None:
    with pytest.raises(MotionPlannerError) as caught:
        asked((motion,), NEAR)
    assert caught.value.code is code
    assert words in caught.value.message


def test_faulty_texts_are_named_and_impossible_ones_are_only_never_met() -> None:
    never = f'{NEAR[:-1]}(distance(r, o) >= 1000))'
    request = AdviceRequest(
        ('((agent r)(nonsense))', never, NEAR),
        STATE,
        purpose=Purpose.OPPORTUNITIES,
        motions=(STRAIGHT,),
    )
    answer = PLANNER.advise(request)
    assert [candidate.code >= Code.INVALID_PRECONDITIONS for candidate in answer.candidates] == [
        True,
        False,
        False,
    ]
    assert not any(candidate.impossible for candidate in answer.candidates)
    assert [found.candidate for found in answer.opportunities] == [2]
