"""Rehearsals: what is left to do as the facts alone have it, and what orders these allow."""

from __future__ import annotations

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.mission import MissionText, check_and_compile, read_mission
from task_planner_node.oracle import Advice, AdviceQuery, CandidateAdvice, Scope
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Itinerary
from task_planner_node.search.rehearsal import Rehearsal
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from tests.support.sites import Sites, label_of

# A store that is emptied at the base when it is full, visits in any order, a choice of what to look at, and an endless task.
DOMAIN = """(defdomain d (
(Operator (!visit ?p) () ((near ?p)) ((visited ?p)))
(Operator (!collect ?s ?c) ((free ?c)) ((near ?s)) ((in ?c ?s) (not (free ?c))))
(Operator (!unload ?c ?s) ((in ?c ?s)) ((near base)) ((not (in ?c ?s)) (free ?c)))
(:method (fetch ?s) room ((free ?c)) ((!collect ?s ?c)) full () ((unload) (fetch ?s)))
(:method (unload) some ((:first (in ?c ?s))) ((!unload ?c ?s) (unload)) none () ())
(:method (fetch-all nil) () ())
(:method (fetch-all (?s . ?rest)) () (:unordered (fetch ?s) (fetch-all ?rest)))
(:method (look) ((target ?t)) ((!visit ?t)))
(:method (endless ?p) () ((!visit ?p) (endless (?p))))
(Operator (!guard ?a ?p) () ((agent ?a)(near ?p)) ((guarded ?p)))
(Operator (!pass ?b ?p ?a) ((guarded ?p)) ((agent ?b)(agent ?a)(near ?p)) ((passed ?p)))
(:method (escort ?p) () ((!guard car ?p) (!pass walker ?p car)))
))"""
FREE = ' '.join(f'(free c{number})' for number in range(2))


def rehearsal(tasks: str, facts: str = '', world: Sites | None = None) -> Rehearsal:
    """That of a mission from its beginning; nothing is driven to."""
    texts = MissionText('d', DOMAIN), MissionText('p', f'(defproblem p d ({facts}) {tasks})')
    domain, problem = read_mission(*texts)
    world = world or Sites({})
    mission = check_and_compile(domain, problem, world)
    state = State(mission.domain.plan, [(fact.name, *fact.args) for fact in problem.facts])
    geometry = Geometry(world, Statistics(), 4, lambda: None)
    beginning = mission.domain.beginning(problem)
    start = (0.0, 0.0)
    return Rehearsal(
        mission.domain, beginning, problem.tasks, state, geometry, lambda: None, start, start
    )


def labels(itinerary: Itinerary | None) -> list[str]:
    assert itinerary is not None
    return [re.findall(r'near (\w+)', text)[0] for text in itinerary.texts]


def unordered(name: str, places: str) -> str:
    return f'(:unordered {" ".join(f"({name} {place})" for place in places)})'


@given(st.permutations('abcde'))
def test_an_order_that_the_facts_leave_open_is_followed(order: list[str]) -> None:
    rehearsed = rehearsal(unordered('!visit', 'abcde'))
    first = rehearsed.along()
    assert labels(first) == list('abcde')
    assert first is not None
    tour = first.tour([('abcde'.index(label), None) for label in order])
    assert labels(rehearsed.along(tour)) == order
    assert rehearsed.is_free(first)


def test_a_rehearsal_leaves_everything_as_it_was() -> None:
    rehearsed = rehearsal('((fetch-all (a b c d)) (unload))', FREE)
    before = set(rehearsed.state.facts), rehearsed.state.key
    assert rehearsed.along() is not None
    assert (set(rehearsed.state.facts), rehearsed.state.key) == before
    world = rehearsed.known._oracle
    assert isinstance(world, Sites)
    assert not world.queries
    assert not world.advised


def legal(sequence: list[str], samples: str, room: int) -> bool:
    """Whether a store of so many compartments allows it, and all samples get to the base."""
    loaded = 0
    for label in sequence:
        loaded += -1 if label == 'base' else 1
        if not 0 <= loaded <= room:
            return False
    return loaded == 0 and sorted(label for label in sequence if label != 'base') == list(samples)


@settings(max_examples=40, deadline=None)
@given(st.integers(2, 5), st.integers(1, 3), st.data())
def test_whatever_is_proposed_comes_out_as_the_store_allows(
    count: int, room: int, data: st.DataObject
) -> None:
    samples = 'abcde'[:count]
    facts = ' '.join(f'(free c{number})' for number in range(room))
    rehearsed = rehearsal(f'((fetch-all ({" ".join(samples)})) (unload))', facts)
    first = rehearsed.along()
    assert first is not None
    assert legal(labels(first), samples, room)
    order = data.draw(st.permutations(range(len(first.texts))))
    found = rehearsed.along(first.tour([(index, None) for index in order]))
    assert found is not None
    assert legal(labels(found), samples, room)
    settled = rehearsed.settled(found)
    again = rehearsed.along(settled.tour(settled.own))
    assert labels(again) == labels(settled)


@pytest.mark.parametrize(
    ('tasks', 'facts'),
    [
        ('((fetch-all (a b c)) (unload))', FREE),
        ('(:unordered (look) (!visit a))', '(target s) (target t)'),
    ],
)
def test_stores_and_choices_do_not_leave_an_order_open(tasks: str, facts: str) -> None:
    rehearsed = rehearsal(tasks, facts)
    first = rehearsed.along()
    assert first is not None
    assert not rehearsed.is_free(first)


def test_what_could_be_met_instead_is_known_and_can_be_chosen() -> None:
    rehearsed = rehearsal('(:unordered (look) (!visit a))', '(target s) (target t)')
    first = rehearsed.along()
    assert labels(first) == ['s', 'a']
    assert first is not None
    others = rehearsed.alternatives[first.texts[0]]
    assert [label_of(text) for text in others] == ['s', 't']
    assert labels(rehearsed.along(first.tour(first.own, {0: others[1]}))) == ['t', 'a']


def test_what_has_no_end_leads_to_nothing() -> None:
    assert rehearsal('((endless a))').along() is None


def test_what_cannot_be_done_leads_to_nothing() -> None:
    assert rehearsal('((!collect a c9))').along() is None


def test_what_is_proven_impossible_everywhere_is_not_granted() -> None:
    class Shut(Sites):
        def advise(self, query: AdviceQuery) -> Advice:
            shut = CandidateAdvice(impossible=True, scope=Scope.ANY_START, message='shut')
            return Advice((shut,) * len(query.preconditions), ())

    rehearsed = rehearsal('(:unordered (look) (!visit a))', '(target s) (target t)', Shut({}))
    assert labels(rehearsed.along()) == ['s', 'a']
    rehearsed.known.advise(AdviceQuery((0.0, 0.0), ('((near s))',)), (0.0, 0.0))
    assert labels(rehearsed.along()) == ['t', 'a']


def test_what_is_shut_from_where_robots_were_put_is_not_granted() -> None:
    shut = Sites({'s': ((1.0, 0.0),)}, shut=frozenset('s'))
    rehearsed = rehearsal('(:unordered (look) (!visit a))', '(target s) (target t)', shut)
    rehearsed.known.advise(AdviceQuery((0.0, 0.0), ('((near s))',)), (0.0, 0.0))
    assert labels(rehearsed.along()) == ['t', 'a']


def test_where_a_robot_waits_for_another_one_is_open() -> None:
    rehearsed = rehearsal(unordered('escort', 'ab'))
    first = rehearsed.along()
    assert labels(first) == ['a', 'a', 'b', 'b']
    assert first is not None
    assert first.open == {1, 3}


def test_the_nearest_comes_first_where_it_is_asked_for() -> None:
    rehearsed = rehearsal(unordered('!visit', 'abc'))
    places = {'a': 2.0, 'b': -1.0, 'c': 5.0}

    def apart(met: str | None, texts: object) -> list[float]:
        here = places[label_of(met)] if met is not None else 0.0
        assert isinstance(texts, tuple)
        return [abs(places[label_of(text)] - here) for text in texts]

    assert labels(rehearsed.nearest_first(apart)) == ['b', 'a', 'c']


def test_stops_of_a_task_are_a_part() -> None:
    first = rehearsal(unordered('escort', 'ab')).along()
    assert first is not None
    assert set(first.parts) == {(0, 1), (2, 3)}
    assert [tasks[1] for tasks in first.made_for] == [('escort', 'a')] * 2 + [('escort', 'b')] * 2
