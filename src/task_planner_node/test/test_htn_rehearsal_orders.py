"""Rehearsals against simulations: what facts and networks allow is followed exactly, and nothing else comes out."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from task_planner_node.mission import MissionText, check_and_compile, read_mission
from task_planner_node.oracle import Answer, Query, Scope, Status
from task_planner_node.search.geometry import Geometry, Request
from task_planner_node.search.itinerary import Itinerary
from task_planner_node.search.rehearsal import Rehearsal
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from tests.support.sites import Sites, label_of

# Visits some of which come after others, a battery, a store in which goods are carried, and one that is emptied.
DOMAIN = """(defdomain d (
(Operator (!visit ?p) ((forall (?q) ((after ?p ?q)) ((visited ?q)))) ((near ?p)) ((visited ?p)))
(:method (visit ?p) () ((!visit ?p)))
(:method (visit-any) ((choice ?p)) ((!visit ?p)))

(Operator (!survey ?p) ((charge ?c) (call > ?c 0)) ((near ?p)) ((not (charge ?c)) (charge (call - ?c 1))))
(Operator (!charge) ((charge 0) (full ?most)) ((near dock)) ((not (charge 0)) (charge ?most)))
(:method (survey ?p) charged ((charge ?c) (call > ?c 0)) ((!survey ?p)) empty () ((!charge) (survey ?p)))

(Operator (!fetch ?p ?c) ((free ?c)) ((near ?p)) ((holds ?c ?p) (not (free ?c))))
(Operator (!drop ?p) ((holds ?c ?p)) ((near base)) ((free ?c) (not (holds ?c ?p))))
(:method (carry ?p) ((free ?c)) ((!fetch ?p ?c) (!drop ?p)))
(:method (bring ?p) room ((free ?c)) ((!fetch ?p ?c)) full () ((unload) (bring ?p)))
(:method (unload) some ((:first (holds ?c ?p))) ((!drop ?p) (unload)) none () ())

(:operator (!note ?n) () () ((noted ?n)))
(:operator (!end) ((not (noted 0))) () ())
(:method (note-on ?n) () ((!note ?n) (note-on (call + ?n 1))))
(:method (visit-on ?n) () ((!visit ?n) (visit-on (call + ?n 1))))
(:method (note-some nil) () ((!end)))
(:method (note-some (?n . ?others)) () ((!note ?n) (note-some ?others)))
(:method (note-some (?n . ?others)) () ((note-some ?others)))
))"""
LABELS = 'abcde'
# Where, and for which goal; None where that is left open.
Stops = Sequence[tuple[str, str | None]]


def rehearsal_of(domain: str, facts: str, tasks: str, world: Sites) -> Rehearsal:
    texts = MissionText('d', domain), MissionText('p', f'(defproblem p d ({facts}) ({tasks}))')
    read, problem = read_mission(*texts)
    compiled = check_and_compile(read, problem, world).domain
    state = State(compiled.plan, [(fact.name, *fact.args) for fact in problem.facts])
    known = Geometry(world, Statistics(), 4, lambda: None)
    beginning = compiled.beginning(problem)
    return Rehearsal(compiled, beginning, problem.tasks, state, known, lambda: None, (), ())


def labels(itinerary: Itinerary | None) -> list[str]:
    assert itinerary is not None
    return [label_of(text) for text in itinerary.texts]


def unordered(name: str, goals: Sequence[str]) -> str:
    return f'(:unordered {" ".join(f"({name} {goal})" for goal in goals)})'


def supplied(room: int) -> str:
    """The facts of a full battery and an empty store."""
    return f'(charge {room}) (full {room})' + ''.join(f'(free c{i})' for i in range(room))


def visits(goals: str, _room: int, after: set[tuple[str, str]]) -> Iterator[Stops]:
    for order in itertools.permutations(goals):
        if all(order.index(p) > order.index(q) for p, q in after):
            yield [(goal, goal) for goal in order]


def surveys(goals: str, room: int, _after: set[tuple[str, str]]) -> Iterator[Stops]:
    for order in itertools.permutations(goals):
        stops: list[tuple[str, str | None]] = []
        for number, goal in enumerate(order):
            stops += [('dock', None)] if number and number % room == 0 else []
            stops.append((goal, goal))
        yield stops


def carriages(
    goals: str, room: int, _after: set[tuple[str, str]], held: str = ''
) -> Iterator[Stops]:
    if not goals and not held:
        yield []
    for goal in goals if len(held) < room else '':
        for rest in carriages(goals.replace(goal, ''), room, set(), held + goal):
            yield [(goal, goal), *rest]
    for goal in held:
        for rest in carriages(goals, room, set(), held.replace(goal, '')):
            yield [('base', goal), *rest]


KINDS = {'visit': visits, 'survey': surveys, 'carry': carriages}


def numbered(stops: Stops, itinerary: Itinerary) -> list[int]:
    """The stops as those of an itinerary."""
    left = list(range(len(itinerary.texts)))
    for label, goal in stops:
        index = next(
            index
            for index in left
            if label_of(itinerary.texts[index]) == label
            and (goal is None or any(goal in task for task in itinerary.made_for[index]))
        )
        left.remove(index)
        left.append(index)
    return left


@pytest.mark.parametrize('kind', KINDS)
@settings(max_examples=60, deadline=None)
@given(st.integers(1, 4), st.integers(1, 3), st.data())
def test_what_the_facts_allow_is_followed_and_nothing_else_comes_out(
    kind: str, count: int, room: int, data: st.DataObject
) -> None:
    goals = LABELS[:count]
    pairs = st.sampled_from([(q, p) for p, q in itertools.combinations(LABELS[:4], 2)])
    after = {(p, q) for p, q in data.draw(st.sets(pairs, max_size=3)) if {p, q} <= set(goals)}
    allowed = list(KINDS[kind](goals, room, after))
    facts = supplied(room) + ''.join(f'(after {p} {q})' for p, q in sorted(after))
    world = Sites({})
    tasks = unordered(kind, data.draw(st.permutations(goals)))
    rehearsal = rehearsal_of(DOMAIN, facts, tasks, world)
    before = dict(rehearsal.state.facts), rehearsal.state.key, rehearsal.state.mark()
    first = rehearsal.along()
    sequences = [[label for label, _ in stops] for stops in allowed]
    assert first is not None
    assert labels(first) in sequences
    order = numbered(data.draw(st.sampled_from(allowed)), first)
    found = rehearsal.along(first.tour([(index, None) for index in order]))
    assert labels(found) == [labels(first)[index] for index in order]
    proposed = data.draw(st.permutations(order))
    assert labels(rehearsal.along(first.tour([(i, None) for i in proposed]))) in sequences
    assert (dict(rehearsal.state.facts), rehearsal.state.key, rehearsal.state.mark()) == before
    assert not world.queries
    assert not world.advised


@settings(max_examples=40, deadline=None)
@given(st.sampled_from([*KINDS, 'bring']), st.integers(1, 5), st.integers(1, 3), st.data())
def test_an_order_that_came_of_another_one_comes_of_itself_with_nothing_taken_back(
    kind: str, count: int, room: int, data: st.DataObject
) -> None:
    tasks = unordered(kind, LABELS[:count]) + ('(unload)' if kind == 'bring' else '')
    rehearsal = rehearsal_of(DOMAIN, supplied(room), tasks, Sites({}))
    first = rehearsal.along()
    assert first is not None
    order = data.draw(st.permutations(range(len(first.texts))))
    found = rehearsal.along(first.tour([(index, None) for index in order]))
    assert found is not None
    settled = rehearsal.settled(found)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr('task_planner_node.search.rehearsal.MOST_BACKTRACKS', 0)
        again = rehearsal.along(settled.tour(settled.own))
    assert labels(again) == labels(settled) == labels(found)


@pytest.mark.parametrize('tasks', ['(note-on 0)', '(visit-on 0)'])
def test_what_has_no_end_is_given_up(tasks: str) -> None:
    rehearsal = rehearsal_of(DOMAIN, '', tasks, Sites({}))
    assert rehearsal.along() is None
    assert not rehearsal.state.mark()


@pytest.mark.parametrize(('count', 'found'), [(4, True), (12, False)])
def test_so_is_what_takes_many_choices_back(count: int, found: bool) -> None:
    """The first one must not be noted, which is tried last: half of all choices come before."""
    tasks = f'(note-some ({" ".join(map(str, range(count)))})) (!visit a)'
    rehearsal = rehearsal_of(DOMAIN, '', tasks, Sites({}))
    assert (rehearsal.along() is not None) == found


@pytest.mark.parametrize(('count', 'room'), [(3, 2), (4, 3), (5, 3), (5, 2), (4, 2)])
@pytest.mark.parametrize('kind', ['survey', 'bring'])
def test_what_runs_out_does_not_leave_the_order_open(kind: str, count: int, room: int) -> None:
    tasks = unordered(kind, LABELS[:count]) + ('(unload)' if kind == 'bring' else '')
    for size, free in ((room, False), (count, True)):
        rehearsal = rehearsal_of(DOMAIN, supplied(size), tasks, Sites({}))
        first = rehearsal.along()
        assert first is not None
        assert rehearsal.is_free(first) == free


class Nowhere(Sites):
    """What is shut cannot be met from any start."""

    def satisfy(self, query: Query) -> Answer:
        return Answer(Status.IMPOSSIBLE, 103, Scope.ANY_START, 'shut')


@pytest.mark.parametrize(('tasks', 'met'), [('(visit-any)', ['b']), ('(visit a)', None)])
def test_what_is_impossible_everywhere_is_not_granted(tasks: str, met: list[str] | None) -> None:
    rehearsal = rehearsal_of(DOMAIN, '(choice a) (choice b)', tasks, Nowhere({}))
    assert labels(rehearsal.along()) == ['a']
    next(rehearsal.known.alternatives(Request(('!visit', 'a'), '((near a))', '', (), ())))
    found = rehearsal.along()
    assert (found and labels(found)) == met


networks = st.recursive(
    st.sampled_from(['r s', 's r', 'r', 's']),
    lambda inner: st.tuples(st.booleans(), st.lists(inner, min_size=1, max_size=3)),
    max_leaves=5,
)
# A network of actions: for each the robot that moves and those that it names, and pairs in their order.
Read = tuple[str, list[list[str]], set[tuple[int, int]]]


def written(network: object, first: int = 0) -> Read:
    """A random network as text, with numbers from ``first`` on."""
    if isinstance(network, str):
        robots = network.split()
        name = '!meet' if len(robots) > 1 else '!go'
        return f'({name} {network} l{first})', [robots], set()
    assert isinstance(network, tuple)
    ordered, items = network
    parts: list[Read] = []
    for item in items:
        parts.append(written(item, first + sum(len(part[1]) for part in parts)))
    robots_of = [robots for _, some, _ in parts for robots in some]
    pairs = {pair for part in parts for pair in part[2]}
    if ordered:
        ends = list(itertools.accumulate((len(part[1]) for part in parts), initial=first))
        for begin, end in itertools.pairwise(ends):
            pairs |= {(a, b) for a in range(first, begin) for b in range(begin, end)}
    text = ' '.join(part[0] for part in parts)
    return f'({"" if ordered else ":unordered"} {text})', robots_of, pairs


MEETING = """(defdomain d (
(Operator (!go ?r ?l) () ((agent ?r) (near ?l)) ())
(Operator (!meet ?r ?s ?l) () ((agent ?r) (agent ?s) (near ?l)) ())
))"""


@settings(max_examples=150, deadline=None)
@given(networks)
def test_open_is_what_another_robot_moves_before_in_all_orders(network: object) -> None:
    tasks, robots, pairs = written(network)
    rehearsal = rehearsal_of(MEETING, '', tasks, Sites({}))
    found = rehearsal.along()
    assert found is not None
    assert rehearsal.is_free(found)
    numbers = [int(text.split('near l')[1].rstrip(')')) for text in found.texts]
    expected = {later for earlier, later in pairs if robots[earlier][0] in robots[later][1:]}
    assert {numbers[index] for index in found.open} == expected
    assert {(numbers[a], numbers[b]) for a, b in found.precedences(strict=True)} <= pairs
