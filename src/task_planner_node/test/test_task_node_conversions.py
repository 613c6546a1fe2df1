"""What crosses between the search and the messages, and the parameter and option that name the guidance."""

from __future__ import annotations

from dataclasses import fields
from math import inf, pi

import pytest
from geohtn_msgs.msg import (
    AdviceAnswer,
    AdviceRequest,
    AgentState,
    CandidateAdvice,
    GeometricAnswer,
    Motion,
    Opportunity,
)
from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.conversions import (
    advice_from_message,
    advice_to_message,
    answer_from_message,
    states_from_token,
    statistics_to_message,
    token_from_states,
)
from task_planner_node.oracle import Advice, AdviceQuery, Place, Purpose
from task_planner_node.parameters import Parameters, read_guidance, read_parameters
from task_planner_node.search.statistics import Statistics

HERE = AgentState(agent='rover0', x=1.0, y=2.0, heading=pi)
OTHER = AgentState(agent='rover1', x=9.0, y=9.0)


def found(end: list[AgentState]) -> GeometricAnswer:
    return GeometricAnswer(
        status=GeometricAnswer.FOUND, agent='rover0', end=end, motion=Motion(agent='rover0')
    )


@pytest.mark.parametrize(
    ('x', 'heading', 'near'), [(1.0, -pi, True), (1.0009, 3.1412, True), (1.002, pi, False)]
)
def test_an_end_is_the_preferred_one_if_it_misses_it_by_rounding(
    x: float, heading: float, near: bool
) -> None:
    wanted = token_from_states([AgentState(agent='rover0', x=x, y=2.0, heading=heading)])
    answer = answer_from_message(found([OTHER, HERE]), wanted)
    assert answer.as_preferred == near
    assert answer.attitude is not None
    assert states_from_token(answer.attitude) == [HERE]


def test_without_a_preference_or_an_end_nothing_is_as_preferred() -> None:
    assert not answer_from_message(found([HERE])).as_preferred
    none = answer_from_message(GeometricAnswer(status=2, agent='rover0'), token_from_states([HERE]))
    assert (none.attitude, none.as_preferred) == (None, False)
    other = token_from_states([AgentState(agent='rover1', x=1.0, y=2.0, heading=pi)])
    assert not answer_from_message(found([HERE]), other).as_preferred


def test_everything_that_is_asked_is_in_the_request() -> None:
    query = AdviceQuery(
        token_from_states([HERE, OTHER]),
        ('((a))', '((b))'),
        Purpose.SHORTEST_TOUR,
        ((0, 1),),
        (token_from_states([HERE]), None),
        3,
        (answer_from_message(found([HERE])),),
        8,
    )
    message = advice_to_message(query)
    assert (message.start, message.preconditions) == ([HERE, OTHER], ['((a))', '((b))'])
    assert (message.purpose, message.effort) == (AdviceRequest.SHORTEST_TOUR, 3)
    assert (list(message.before), list(message.after)) == ([0], [1])
    assert [end.agent for end in message.ends] == ['rover0', '']
    assert [motion.agent for motion in message.motions] == ['rover0']
    assert message.places == 8
    # Whatever is added to queries has to be asked here as well.
    empty = AdviceQuery((), ())
    names = [item.name for item in fields(AdviceQuery)]
    assert [name for name in names if getattr(query, name) == getattr(empty, name)] == []


def test_everything_that_is_advised_arrives() -> None:
    message = AdviceAnswer(
        candidates=[CandidateAdvice(lower_bound=4.0), CandidateAdvice()],
        order=[1, 0],
        ends=[AgentState(), HERE],
        opportunities=[Opportunity(candidate=1, motion=2, distance=5.0, end=HERE)],
    )
    advice = advice_from_message(message)
    assert (advice.order, advice.candidates[0].lower_bound) == ((1, 0), 4.0)
    assert advice.ends == (None, token_from_states([HERE]))
    (opportunity,) = advice.opportunities
    assert (opportunity.candidate, opportunity.motion, opportunity.distance) == (1, 2, 5.0)
    assert states_from_token(opportunity.end) == [HERE]


states = st.builds(
    lambda agent, *numbers: AgentState(
        agent=agent, **dict(zip(('x', 'y', 'heading'), numbers, strict=True))
    ),
    st.sampled_from(['rover0', 'rover1']),
    *[st.floats(allow_nan=False, allow_infinity=False)] * 3,
)


@given(st.lists(st.tuples(st.integers(0, 2**32 - 1), states), max_size=4), st.data())
def test_places_and_what_lies_between_arrive(
    told: list[tuple[int, AgentState]], data: st.DataObject
) -> None:
    size = (len(told) + 1) * len(told)
    lengths = data.draw(st.lists(st.floats(0.0) | st.just(inf), min_size=size, max_size=size))
    message = AdviceAnswer(
        places=[state for _, state in told],
        place_candidates=[candidate for candidate, _ in told],
        place_lengths=lengths,
    )
    advice = advice_from_message(message)
    assert advice.places == tuple(
        Place(candidate, ((state.agent, state.x, state.y, state.heading),))
        for candidate, state in told
    )
    assert advice.place_lengths == tuple(lengths)
    assert advice_from_message(AdviceAnswer()) == Advice((), ())


def test_better_plans_are_counted_in_the_statistics() -> None:
    message = statistics_to_message(Statistics(improvements=3, opportunities=2))
    assert (message.improvements, message.opportunities) == (3, 2)


def test_the_guidance_is_one_of_its_words() -> None:
    assert read_parameters({}) == Parameters()
    assert read_parameters({'guidance': 'nearest_first'}).guidance == 'nearest_first'
    for value in ('', 'Tour', 3, None):
        with pytest.raises(ValueError, match=r'^parameter guidance .*tour, nearest_first'):
            read_parameters({'guidance': value})
    with pytest.raises(ValueError, match=r"^options\.guidance .* not 'best'"):
        read_guidance('best')
