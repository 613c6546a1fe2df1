"""Places: each meets its candidate and is free, and nothing between two is expected shorter than it is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import atan2, cos, hypot, inf, nan, pi, remainder, sin, tau
from typing import Any, NamedTuple

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from ompl import base

from motion_planner_node.codes import Code, Purpose
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, End
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Circle, Polygon, World, WorldObject

SIDE = 600.0
# c and e are on both sides of the rock, d is in a room without a door.
OBJECTS = {'a': (120, 120), 'b': (480, 120), 'c': (300, 440), 'd': (480, 480), 'e': (300, 225)}
ROCK = Circle('rock', (300.0, 300.0), 60.0)
WALLS = [
    shapely.box(390, 390, 570, 400),
    shapely.box(390, 560, 570, 570),
    shapely.box(390, 390, 400, 570),
    shapely.box(560, 390, 570, 570),
]
CAR = Robot('r', 8.0, 0.5, 5.0, 2.0)
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, SIDE, SIDE),
    objects={n: WorldObject(n, {'x': float(x), 'y': float(y)}) for n, (x, y) in OBJECTS.items()},
    obstacles=(
        ROCK,
        *(Polygon(f'wall{k}', tuple(w.exterior.coords[:4])) for k, w in enumerate(WALLS)),
    ),
    robots={'r': CAR, 's': replace(CAR, label='s')},
)
PLANNER = MotionPlanner(WORLD)
STATE = {'r': Attitude(40.0, 300.0, 0.0), 's': Attitude(560.0, 300.0, pi)}


class Photo(NamedTuple):
    """Preconditions, and whether an attitude meets them by formulas of their own."""

    agent: str
    place: str
    near: float = 30.0
    far: float = 60.0
    angle: float = pi / 2

    @property
    def text(self) -> str:
        one = f'{self.agent}, {self.place}'
        return (
            f'((agent {self.agent})(object {self.place})(distance({one}) >= {self.near!r})'
            f'(distance({one}) <= {self.far!r})(rel_angle({one}) = cos-and-sin({self.angle!r})))'
        )

    def misses(self, here: Attitude) -> float:
        x, y = OBJECTS[self.place]
        apart = hypot(x - here.x, y - here.y)
        turn = remainder(here.heading - atan2(y - here.y, x - here.x) - self.angle, tau)
        return max(self.near - apart, apart - self.far, abs(turn))

    def end(self, bearing: float, share: float) -> End | None:
        """Where the object is seen in a direction, if the robot may stand there."""
        apart = self.near + share * (self.far - self.near)
        x = OBJECTS[self.place][0] - apart * cos(bearing)
        y = OBJECTS[self.place][1] - apart * sin(bearing)
        here = Attitude(x, y, remainder(bearing + self.angle, tau))
        return (self.agent, here) if clearance(np.array([[x, y]])) > CAR.radius + 0.1 else None


PHOTOS = (Photo('r', 'a'), Photo('s', 'b'), Photo('r', 'c'), Photo('r', 'e'), Photo('s', 'a'))


def clearance(points: NDArray[np.float64]) -> float:
    """The least distance [m] of any of ``points`` (n, 2) from what is solid."""
    rock = np.hypot(*(points - ROCK.center).T).min() - ROCK.radius
    walls = shapely.distance(shapely.union_all(WALLS), shapely.points(points)).min()
    return float(min(points.min(), SIDE - points.max(), rock, walls))


def advise(photos: Sequence[Photo] = PHOTOS, **more: Any) -> AdviceAnswer:
    texts = tuple(photo.text for photo in photos)
    fields: dict[str, Any] = {'start': STATE, 'places': 4}
    return PLANNER.advise(AdviceRequest(texts, **(fields | more)))


def matrix_of(answer: AdviceAnswer) -> NDArray[np.float64]:
    count = len(answer.places)
    assert len(answer.place_lengths) == (count + 1) * count
    return np.array(answer.place_lengths).reshape(count + 1, count)


shares = st.floats(0.05, 0.95)
bearings = st.floats(-3.1, 3.1)
angles = st.sampled_from([0.0, pi / 4, pi / 2, -3.0])
photos = st.builds(
    lambda agent, place, near, wide, angle: Photo(agent, place, near, near + wide, angle),
    st.sampled_from('rs'),
    st.sampled_from(sorted(OBJECTS)),
    st.floats(15.0, 30.0),
    st.floats(10.0, 30.0) | st.just(-5.0),
    angles,
)
seeds = st.integers(0, 2**64 - 1)
starts = st.builds(
    lambda one, other: {'r': Attitude(40.0, 300.0, one), 's': Attitude(560.0, 300.0, other)},
    bearings,
    bearings,
)


@st.composite
def asked(draw: st.DrawFn) -> tuple[list[Photo], tuple[End | None, ...]]:
    """One candidate of each robot that can be met, further ones, and ends that meet some of them."""
    chosen = draw(st.permutations([*PHOTOS[:2], *draw(st.lists(photos, max_size=4))]))
    ends = [
        photo.end(draw(bearings), draw(shares))
        if photo.near < photo.far and draw(st.booleans())
        else None
        for photo in chosen
    ]
    return chosen, tuple(ends)


@settings(max_examples=25, deadline=None)
@given(asked(), starts, st.integers(1, 9), seeds)
def test_places_meet_their_candidates_and_ends_come_first(
    request: tuple[list[Photo], tuple[End | None, ...]],
    start: dict[str, Attitude],
    places: int,
    seed: int,
) -> None:
    chosen, ends = request
    answer = advise(chosen, start=start, ends=ends, places=places, seed=seed)
    members: list[list[int]] = [[] for _ in chosen]
    for number, place in enumerate(answer.places):
        members[place.candidate].append(number)
        photo, here = chosen[place.candidate], place.attitude
        assert place.agent == photo.agent
        assert photo.misses(here) < 1e-6
        assert clearance(np.array([[here.x, here.y]])) >= CAR.radius - 1e-6
        assert -pi < here.heading <= pi
    for photo, end, numbers in zip(chosen, ends, members, strict=True):
        met = photo.place != 'd' and photo.near < photo.far
        assert (met or end is not None) <= len(numbers) <= (places if met else end is not None)
        if end is not None:
            assert answer.places[numbers[0]].attitude == end[1]
    lengths = matrix_of(answer)
    for i, place in enumerate(answer.places):
        for j, other in enumerate(answer.places):
            together = place.agent == other.agent and place.candidate != other.candidate
            inside = 'd' in (chosen[place.candidate].place, chosen[other.candidate].place)
            assert (lengths[i + 1, j] < inf) == together or (together and inside)


def dubins(here: Attitude, there: Attitude) -> tuple[float, NDArray[np.float64]]:
    """Length [m] of the shortest way, as OMPL finds it, and points (n, 2) on it."""
    space = base.DubinsStateSpace(CAR.turning_radius)
    start, end, between = (space.allocState() for _ in range(3))
    for state, attitude in ((start, here), (end, there)):
        state.setXY(attitude.x, attitude.y)
        state.setYaw(attitude.heading)
    length = float(space.distance(start, end))
    points = []
    for share in np.linspace(0.0, 1.0, 2 + int(length / 2.0)):
        space.interpolate(start, end, float(share), between)
        points.append((between.getX(), between.getY()))
    return length, np.array(points)


@settings(max_examples=6, deadline=None)
@given(starts, seeds)
def test_lengths_are_those_of_the_shortest_ways_where_these_are_free(
    start: dict[str, Attitude], seed: int
) -> None:
    answer = advise(start=start, places=3, seed=seed)
    lengths = matrix_of(answer)
    free = blocked = longer = 0
    for j, there in enumerate(answer.places):
        for i, row in enumerate(lengths):
            if i and not row[j] < inf:
                continue
            here = answer.places[i - 1].attitude if i else start[there.agent]
            length, points = dubins(here, there.attitude)
            room = clearance(points)
            assert row[j] >= length * (1.0 - 1e-5)
            if room > CAR.radius + 0.1:
                free += 1
                assert row[j] == pytest.approx(length, rel=1e-5)
            elif room < CAR.radius - 0.1:
                blocked += 1
                longer += length * (1.0 + 1e-5) < row[j] < inf
    # Another way may be free and hardly longer.
    assert min(free, longer) > 5
    assert longer > 0.8 * blocked


def test_ends_behind_walls_are_places_and_only_those_beside_them_lead_there() -> None:
    chosen = (Photo('r', 'd', angle=0.0), Photo('r', 'a'), Photo('r', 'd'))
    ends = tuple(photo.end(0.3, 0.5) for photo in chosen)
    answer = advise(chosen, ends=(ends[0], None, ends[2]), places=2)
    assert [answer.candidates[index].impossible for index in range(3)] == [True, False, True]
    of = [[n for n, place in enumerate(answer.places) if place.candidate == k] for k in range(3)]
    assert [len(numbers) for numbers in of] == [1, 2, 1]
    (one,), around, (other,) = of
    lengths = matrix_of(answer)
    assert (lengths[0, [one, other]] == inf).all()
    assert (lengths[0, around] < inf).all()
    assert lengths[one + 1, other] < inf > lengths[other + 1, one]
    for number in around:
        assert (lengths[number + 1, [one, other]] == inf).all()
        assert (lengths[[one + 1, other + 1], number] == inf).all()


@pytest.mark.parametrize(('count', 'places'), [(60, 16), (3, 2**32 - 1), (520, 8)])
def test_there_are_512_places_at_most_or_one_of_each(count: int, places: int) -> None:
    chosen = [PHOTOS[k % 5]._replace(far=60.0 + k % 60) for k in range(count)]
    answer = advise(chosen, places=places)
    assert len(answer.places) <= max(512, count)
    assert {place.candidate for place in answer.places} == set(range(count))
    lengths = matrix_of(answer)
    rows = np.array([(p.attitude.x, p.attitude.y) for p in answer.places])
    straight = np.hypot(*(rows[:, None] - rows).transpose(2, 0, 1))
    assert (lengths[1:] >= straight * (1.0 - 1e-6)).all()
    owner = np.array([place.candidate for place in answer.places])
    agents = np.array([place.agent for place in answer.places])
    apart = (owner[:, None] == owner) | (agents[:, None] != agents)
    assert ((lengths[1:] == inf) == apart).all()
    assert (lengths[0] < inf).all()


def test_the_same_request_has_the_same_places() -> None:
    request = AdviceRequest(
        tuple(photo.text for photo in PHOTOS), STATE, places=5, seed=3, ends=(None,) * 5
    )
    fresh = MotionPlanner(WORLD).advise(request)
    assert fresh == PLANNER.advise(request)
    assert PLANNER.advise(replace(request, seed=4)).places != fresh.places


@pytest.mark.parametrize('purpose', Purpose)
def test_without_places_everything_else_is_as_with_them(purpose: Purpose) -> None:
    bare = advise(purpose=purpose, pairwise=True, places=0)
    assert (bare.places, bare.place_lengths) == ((), ())
    answer = advise(purpose=purpose, pairwise=True, places=2)
    assert replace(answer, places=(), place_lengths=()) == bare


def test_what_is_wrong_impossible_or_done_without_driving_has_no_place() -> None:
    here = '((agent r)(setProperty(r.x, 40))(setProperty(r.y, 300))(setProperty(r.heading, 0)))'
    texts = ('((', Photo('r', 'd').text, here, Photo('r', 'a', 40.0, 30.0).text)
    answer = PLANNER.advise(AdviceRequest(texts, STATE, places=3))
    assert (answer.places, answer.place_lengths) == ((), ())
    answer = PLANNER.advise(AdviceRequest((*texts, PHOTOS[0].text), STATE, places=3))
    assert [place.candidate for place in answer.places] == [4, 4, 4]
    assert PLANNER.advise(AdviceRequest((), STATE, places=3)).places == ()


def test_looking_for_places_is_broken_off_whenever_that_is_asked_for() -> None:
    def questions(places: int, most: float) -> int:
        """How often it asks whether to stop, the answer being yes after ``most`` times."""
        asked = 0

        def should_stop() -> bool:
            nonlocal asked
            asked += 1
            return asked > most

        texts = tuple(photo.text for photo in PHOTOS)
        PLANNER.advise(AdviceRequest(texts, STATE, places=places), should_stop)
        return asked

    questions(4, inf)
    without, together = questions(0, inf), questions(4, inf)
    assert without < together
    for most in range(without, together):
        with pytest.raises(Stopped):
            questions(4, most)


@pytest.mark.parametrize(
    ('ends', 'code', 'words'),
    [
        ((None,), Code.UNSUPPORTED, '1 ends for 5 candidates'),
        ((None,) * 6, Code.UNSUPPORTED, '6 ends for 5 candidates'),
        (
            (None, ('q', STATE['r']), None, None, None),
            Code.UNKNOWN_AGENT,
            'the end of candidate 1 names agent q; the world has r, s',
        ),
        (
            (('r', Attitude(0.0, nan, 0.0)),) * 5,
            Code.INVALID_START,
            'the end of candidate 0 of r is not finite',
        ),
    ],
)
def test_ends_that_make_no_sense_are_refused(
    ends: tuple[End | None, ...], code: Code, words: str
) -> None:
    with pytest.raises(MotionPlannerError) as caught:
        advise(ends=ends)
    assert caught.value.code is code
    assert words in caught.value.message
    assert advise(ends=ends, places=0) == advise(places=0)


def test_an_end_of_a_robot_that_cannot_meet_anything_now_is_a_place() -> None:
    chosen = (Photo('r', 'a'), Photo('s', 'd'))
    end = chosen[1].end(0.3, 0.5)
    answer = advise(chosen, ends=(None, end))
    assert end is not None
    assert [p.attitude for p in answer.places if p.candidate == 1] == [end[1]]


def test_a_place_meets_its_candidate_where_no_destination_is_known() -> None:
    world = replace(WORLD, objects={'q': WorldObject('q', {'x': 360.0, 'y': 300.0})})
    text = '((agent r)(object q)(distance(r, q) <= 5.01))'
    answer = MotionPlanner(world).advise(AdviceRequest((text,), STATE, places=8))
    for p in answer.places:
        assert hypot(p.attitude.x - 360.0, p.attitude.y - 300.0) <= 5.01 + 1e-6


def test_an_end_belongs_to_the_robot_that_moves() -> None:
    answer = advise((Photo('r', 'a'), Photo('s', 'b')), ends=(('s', STATE['s']), None))
    assert all(p.agent == 'rs'[p.candidate] for p in answer.places)


def test_an_end_of_a_robot_that_stands_nowhere_is_left_out() -> None:
    request = AdviceRequest(
        (Photo('r', 'a').text, Photo('s', 'b').text),
        {'r': STATE['r']},
        places=4,
        ends=(None, ('s', STATE['s'])),
    )
    assert {place.agent for place in MotionPlanner(WORLD).advise(request).places} == {'r'}


def test_robots_stand_where_the_world_says_if_nothing_else_is_told() -> None:
    robots = {label: replace(robot, start=STATE[label]) for label, robot in WORLD.robots.items()}
    planner = MotionPlanner(replace(WORLD, robots=robots))
    texts = tuple(photo.text for photo in PHOTOS)
    told = planner.advise(AdviceRequest(texts, STATE, places=4))
    untold = planner.advise(AdviceRequest(texts, {}, places=4))
    assert untold.places == told.places
    assert untold.place_lengths == told.place_lengths
