"""Tours: every end will do, precedences hold, what is known is not made worse, and it can be driven."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, hypot, inf, nan, pi, remainder, tau
from typing import Any

import pytest

from motion_planner_node.advice.purposes import shares_of_budget
from motion_planner_node.codes import Code, Purpose
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.planner import MotionPlanner
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, GeometricRequest
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import Bounds, Circle, World, WorldObject

PLACES = {'a': (120, 120), 'b': (480, 120), 'c': (480, 480), 'd': (120, 480), 'e': (300, 150)}
ROCK = Circle('rock', (300.0, 300.0), 60.0)
CAR = Robot('r', 8.0, 0.5, 5.0, 2.0)
WORLD = World(
    source='',
    revision='',
    bounds=Bounds(0.0, 0.0, 600.0, 600.0),
    objects={n: WorldObject(n, {'x': float(x), 'y': float(y)}) for n, (x, y) in PLACES.items()},
    obstacles=(ROCK,),
    robots={'r': CAR, 's': replace(CAR, label='s')},
)
PLANNER = MotionPlanner(WORLD)
STATE = {'r': Attitude(60.0, 300.0, 0.0), 's': Attitude(560.0, 300.0, pi)}


def photo(place: str, agent: str = 'r') -> str:
    return (
        f'((agent {agent})(object {place})(distance({agent}, {place}) >= 30)'
        f'(distance({agent}, {place}) <= 60)(rel_angle({agent}, {place}) = cos-and-sin(pi/2)))'
    )


TEXTS = tuple(photo(place) for place in PLACES)


def tour(texts: tuple[str, ...] = TEXTS, **more: Any) -> AdviceAnswer:
    return PLANNER.advise(
        AdviceRequest(texts, STATE, **({'purpose': Purpose.SHORTEST_TOUR} | more))
    )


def check_ends(answer: AdviceAnswer, places: tuple[str, ...] = tuple(PLACES)) -> None:
    """Distances, angles and obstacles by formulas of their own."""
    for place, end in zip(places, answer.ends, strict=True):
        assert end is not None
        here, (x, y) = end[1], PLACES[place]
        assert 30.0 - 1e-6 <= hypot(x - here.x, y - here.y) <= 60.0 + 1e-6
        angle = here.heading - atan2(y - here.y, x - here.x)
        assert abs(remainder(angle - pi / 2, tau)) < 1e-6
        assert hypot(here.x - 300.0, here.y - 300.0) >= 65.0 - 1e-6
        assert 5.0 <= here.x <= 595.0
        assert 5.0 <= here.y <= 595.0


def test_every_end_will_do_and_the_tour_can_be_driven_as_promised() -> None:
    answer = tour()
    check_ends(answer)
    assert sorted(answer.order) == [0, 1, 2, 3, 4]
    state: GeometricState = STATE
    driven = 0.0
    for index in answer.order:
        agent, end = answer.ends[index] or ('', Attitude(nan, nan, nan))
        leg = PLANNER.satisfy(GeometricRequest(TEXTS[index], state, preferred_end={agent: end}))
        state = leg.end
        driven += leg.length
        assert hypot(state['r'].x - end.x, state['r'].y - end.y) < 1e-6
    assert driven == pytest.approx(answer.tour_length, rel=0.02)


def test_the_same_request_has_the_same_tour() -> None:
    fresh = MotionPlanner(WORLD)
    request = AdviceRequest(TEXTS, STATE, purpose=Purpose.SHORTEST_TOUR, seed=3)
    assert fresh.advise(request) == PLANNER.advise(request)


def test_precedences_hold_and_cost() -> None:
    free = tour()
    order = list(free.order)
    pairs = list(zip(order[1:], order[:-1], strict=True))[::2]
    before, after = zip(*pairs, strict=True)
    bound = tour(before=before, after=after)
    for i, j in pairs:
        assert bound.order.index(i) < bound.order.index(j)
    check_ends(bound)
    assert bound.tour_length > free.tour_length


def test_a_fixed_order_stays_and_is_no_shorter_than_a_free_one() -> None:
    answer = tour(purpose=Purpose.FIXED_ORDER)
    assert answer.order == (0, 1, 2, 3, 4)
    check_ends(answer)
    assert answer.tour_length >= tour().tour_length - 5.0


def test_a_tour_over_known_ends_is_never_made_worse() -> None:
    known = tour(purpose=Purpose.FIXED_ORDER, effort=1)
    again = tour(purpose=Purpose.FIXED_ORDER, ends=known.ends)
    assert again.tour_length <= known.tour_length + 1e-6


def test_each_robot_has_a_tour_of_its_own_and_precedences_hold_across() -> None:
    texts = (photo('a'), photo('b', 's'), photo('c', 's'), photo('d'))
    answer = tour(texts, before=(1, 3), after=(3, 2))
    assert [end[0] for end in answer.ends if end] == ['r', 's', 's', 'r']
    assert answer.order.index(1) < answer.order.index(3) < answer.order.index(2)


def test_what_is_impossible_comes_last_and_has_no_end() -> None:
    buried = '((agent r)(object a)(distance(r, a) <= 10)(distance(r, a) >= 20))'
    answer = tour((buried, photo('b'), photo('c')))
    assert answer.order[-1] == 0
    assert answer.ends[0] is None
    assert answer.tour_length == inf
    assert answer.ends[1] is not None


def test_nothing_at_all_is_a_tour() -> None:
    answer = tour(())
    assert (answer.order, answer.ends, answer.tour_length) == ((), (), 0.0)


def test_a_tour_is_broken_off() -> None:
    asked = iter([False] * 40)
    request = AdviceRequest(TEXTS, STATE, purpose=Purpose.SHORTEST_TOUR, effort=8)
    with pytest.raises(Stopped):
        PLANNER.advise(request, lambda: next(asked, True))


@pytest.mark.parametrize(
    ('more', 'code', 'words'),
    [
        (
            {'purpose': 9},
            Code.UNSUPPORTED,
            'there is no purpose 9 of advice; there are NEAREST_FIRST',
        ),
        ({'before': (0,)}, Code.UNSUPPORTED, 'before has 1 candidates and after 0'),
        ({'before': (0,), 'after': (5,)}, Code.UNSUPPORTED, 'name candidate 5; there are 5'),
        ({'before': (0, 1), 'after': (1, 0)}, Code.UNSUPPORTED, 'none of the candidates 0, 1 can'),
        ({'before': (2,), 'after': (2,)}, Code.UNSUPPORTED, 'none of the candidates 2 can'),
        ({'ends': (None,)}, Code.UNSUPPORTED, '1 ends for 5 candidates'),
        (
            {'ends': (('q', STATE['r']),) * 5},
            Code.UNKNOWN_AGENT,
            'the end of candidate 0 names agent q; the world has r, s',
        ),
        (
            {'ends': (('r', Attitude(nan, 0.0, 0.0)),) * 5},
            Code.INVALID_START,
            'the end of candidate 0 of r is not finite',
        ),
    ],
)
def test_requests_that_make_no_sense_are_refused(
    more: dict[str, Any], code: Code, words: str
) -> None:
    with pytest.raises(MotionPlannerError) as caught:
        tour(**more)
    assert caught.value.code is code
    assert words in caught.value.message


def test_many_candidates_and_higher_efforts_are_granted_more_time() -> None:
    def shares(count: int, purpose: Purpose, effort: int = 0) -> float:
        return shares_of_budget(
            AdviceRequest(TEXTS[:1] * count, STATE, purpose=purpose, effort=effort)
        )

    assert shares(256, Purpose.NEAREST_FIRST) == 1.0
    assert shares(8, Purpose.SHORTEST_TOUR) == 1.0
    assert shares(256, Purpose.SHORTEST_TOUR) == 16.0
    assert shares(32, Purpose.FIXED_ORDER, effort=2) == 8.0
