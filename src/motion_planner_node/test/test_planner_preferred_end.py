"""Preferred ends: exactly there when that will do, and otherwise as if nobody had asked."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, inf, nan, pi, remainder, tau
from typing import Any

import pytest

from motion_planner_node.codes import Code, Status
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import GeometricAnswer, GeometricRequest
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Circle, Polygon, World, WorldObject

WALL = Polygon('wall', ((330.0, 180.0), (370.0, 180.0), (370.0, 420.0), (330.0, 420.0)))
ROCK = Circle('rock', (300.0, 380.0), 20.0)
CAR = Robot('r', 8.0, 0.5, 5.0, 2.0)
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 600.0, 600.0),
    objects={'o': WorldObject('o', {'x': 300.0, 'y': 300.0})},
    obstacles=(WALL, ROCK),
    robots={'r': CAR, 's': replace(CAR, label='s')},
)
STATE = {'r': Attitude(60.0, 300.0, 0.0)}
PHOTO = (
    '(agent r)(object o)(distance(r, o) >= 50)(distance(r, o) <= 100)'
    '(rel_angle(r, o) = cos-and-sin(pi/2))'
)
GOOD = Attitude(300.0, 220.0, pi)  # the object is on the right, 80 m away


def ask(end: Attitude | None, agent: str = 'r', **more: Any) -> GeometricAnswer:
    preferred = {} if end is None else {agent: end}
    request = GeometricRequest(PHOTO, STATE, preferred_end=preferred, **more)
    return MotionPlanner(WORLD).satisfy(request)


@pytest.mark.parametrize('mode', ['default', 'paper'])
def test_the_motion_ends_at_a_preferred_end_that_will_do(mode: str) -> None:
    answer = ask(GOOD, mode=mode)
    assert answer.status is Status.FOUND
    assert answer.motion is not None
    end = answer.end['r']
    assert hypot(end.x - GOOD.x, end.y - GOOD.y) < 1e-9
    assert abs(remainder(end.heading - GOOD.heading, tau)) < 1e-9
    assert ask(GOOD, mode=mode) == answer


@pytest.mark.parametrize(
    'end',
    [
        Attitude(300.0, 220.0, 0.0),  # the object is on the other side
        Attitude(300.0, 380.0, 0.0),  # in the rock
        Attitude(-300.0, 380.0, 0.0),  # off the map
    ],
)
def test_a_preferred_end_that_will_not_do_changes_nothing(end: Attitude) -> None:
    for alternative in range(2):
        assert ask(end, alternative=alternative) == ask(None, alternative=alternative)


def test_an_end_that_cannot_be_driven_to_changes_nothing() -> None:
    # Facing the edge of the map from 6 m, a car that turns in 15 m could only have come from there.
    near = '((agent r)(r.x <= 10))'
    ahead = Attitude(6.0, 300.0, 0.0)
    request = GeometricRequest(near, STATE, preferred_end={'r': ahead})
    planner = MotionPlanner(WORLD)
    answer = planner.satisfy(request)
    assert answer == planner.satisfy(replace(request, preferred_end={}))
    assert answer.status is Status.FOUND


def test_further_alternatives_differ_from_the_preferred_end() -> None:
    ends = [ask(GOOD, alternative=k).end['r'] for k in range(3)]
    for other in ends[1:]:
        turned = abs(remainder(other.heading - GOOD.heading, tau))
        assert hypot(other.x - GOOD.x, other.y - GOOD.y) >= 10.0 or turned >= 0.75


def test_staying_is_preferred_when_the_start_is() -> None:
    request = GeometricRequest(PHOTO, {'r': GOOD}, preferred_end={'r': GOOD})
    answer = MotionPlanner(WORLD).satisfy(request)
    assert answer.motion is not None
    assert (answer.motion.segments, answer.end['r']) == ((), GOOD)


def test_what_was_asked_with_another_preferred_end_is_not_answered_again() -> None:
    planner = MotionPlanner(WORLD)
    plain = planner.satisfy(GeometricRequest(PHOTO, STATE))
    preferred = planner.satisfy(GeometricRequest(PHOTO, STATE, preferred_end={'r': GOOD}))
    assert preferred.end != plain.end
    assert planner.satisfy(GeometricRequest(PHOTO, STATE)) == plain


@pytest.mark.parametrize(
    ('agent', 'end', 'code', 'words'),
    [
        ('r', Attitude(nan, 0.0, 0.0), Code.INVALID_START, 'the preferred end of r is not finite'),
        ('r', Attitude(0.0, 0.0, inf), Code.INVALID_START, 'the preferred end of r is not finite'),
        ('q', GOOD, Code.UNKNOWN_AGENT, 'the preferred end names agent q; the world has r, s'),
        ('s', GOOD, Code.UNKNOWN_AGENT, 'the preferred end is one of s, but r is what moves'),
    ],
)
def test_a_preferred_end_that_makes_no_sense_is_refused(
    agent: str, end: Attitude, code: Code, words: str
) -> None:
    answer = ask(end, agent)
    assert answer.code is code
    assert words in answer.message
