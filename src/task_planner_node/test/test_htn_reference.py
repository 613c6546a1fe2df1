"""Random missions against a brute-force planner written differently: same answers, and only real plans."""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from hypothesis import given, reject, settings
from hypothesis import strategies as st

from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Query,
    Scope,
    Status,
    TextCheck,
)
from task_planner_node.outcomes import Options, Outcome, Result

OBJECTS = ('a', 'b')
PREDICATES = ('p', 'q')
Literal = tuple[bool, str, str]  # holds or not, predicate, variable or object
Facts = frozenset[tuple[str, str]]
Plan = tuple[tuple[str, str], ...]
# A network is ('task', name, argument), ('ordered', networks) or ('unordered', networks).
Net = tuple[Any, ...]

variables = st.sampled_from(['?x', '?x', '?y', *OBJECTS])
conditions = st.lists(
    st.tuples(st.sampled_from([True, True, False]), st.sampled_from(PREDICATES), variables),
    max_size=2,
)


@dataclass(frozen=True)
class Action:
    condition: list[Literal]
    effects: list[Literal]
    geometric: bool


@dataclass(frozen=True)
class Random:
    """Tasks t0, t1 ... each with methods of branches; a task only leads to later ones."""

    actions: list[Action]
    tasks: list[list[list[tuple[list[Literal], Net]]]]
    facts: Facts
    top: Net
    impossible: frozenset[str]
    unknown: frozenset[str]
    # How many destinations there are for each text, and from which of them to which texts no way is found.
    destinations: int
    lost: frozenset[tuple[str, str]]


def networks(names: list[str], arguments: st.SearchStrategy[str]) -> st.SearchStrategy[Net]:
    task = st.tuples(st.just('task'), st.sampled_from(names), arguments)
    kind = st.sampled_from(['ordered', 'unordered'])
    inner = st.tuples(kind, st.lists(task, max_size=2))
    return st.tuples(kind, st.lists(task | inner, max_size=3))


@st.composite
def missions(draw: st.DrawFn) -> Random:
    effects = st.lists(
        st.tuples(st.booleans(), st.sampled_from(PREDICATES), st.sampled_from(['?x', 'a'])),
        max_size=2,
    )
    actions = [
        Action(draw(conditions), draw(effects), draw(st.booleans()))
        for _ in range(draw(st.integers(1, 3)))
    ]
    primitive = [f'!o{i}' for i in range(len(actions))]
    count = draw(st.integers(1, 3))
    tasks = []
    for index in range(count):
        names = primitive + [f't{later}' for later in range(index + 1, count)]
        branch = st.tuples(conditions, networks(names, st.sampled_from(['?x', *OBJECTS])))
        tasks.append(
            [draw(st.lists(branch, min_size=1, max_size=2)) for _ in range(draw(st.integers(1, 2)))]
        )
    everything = primitive + [f't{i}' for i in range(count)]
    facts = draw(st.frozensets(st.tuples(st.sampled_from(PREDICATES), st.sampled_from(OBJECTS))))
    every = [f'{name} {o}' for name in primitive for o in OBJECTS]
    texts = st.sampled_from(every)
    destinations, random = draw(st.integers(1, 2)), draw(st.randoms(use_true_random=False))
    ends = [end_of(text, number) for text in every for number in range(destinations)]
    lost = [pair for pair in itertools.product(ends, every) if random.random() < 0.4]
    top = draw(networks(everything, st.sampled_from(OBJECTS)))
    return Random(
        actions,
        tasks,
        facts,
        top,
        draw(st.frozensets(texts, max_size=1)),
        draw(st.frozensets(texts, max_size=1)),
        destinations,
        frozenset(lost),
    )


def end_of(text: str, alternative: int) -> str:
    return f'{text} at {alternative}'


# --- the mission as text


def literal(item: Literal) -> str:
    text = f'({item[1]} {item[2]})'
    return text if item[0] else f'(not {text})'


def network_text(net: Net) -> str:
    if net[0] == 'task':
        return f'({net[1]} {net[2]})'
    return f'(:{net[0]} {" ".join(network_text(part) for part in net[1])})'


def texts(mission: Random) -> tuple[str, str]:
    forms = []
    for index, action in enumerate(mission.actions):
        geometric = f'(!o{index} ?x)' if action.geometric else '()'
        condition = ' '.join(map(literal, action.condition))
        effects = ' '.join(map(literal, action.effects))
        forms.append(f'(Operator (!o{index} ?x) ({condition}) {geometric} ({effects}))')
    for index, methods in enumerate(mission.tasks):
        for branches in methods:
            parts = ' '.join(
                f'({" ".join(map(literal, condition))}) {network_text(net)}'
                for condition, net in branches
            )
            forms.append(f'(:method (t{index} ?x) {parts})')
    facts = ' '.join(f'({name} {thing})' for name, thing in sorted(mission.facts))
    domain = f'(defdomain d ({" ".join(forms)}))'
    return domain, f'(defproblem p d ({facts}) {network_text(mission.top)})'


# --- the reference: recursion over immutable values, all plans


def substitute(word: str, binding: dict[str, str]) -> str:
    return binding.get(word, word)


def bindings(
    condition: list[Literal], facts: Facts, binding: dict[str, str]
) -> list[dict[str, str]]:
    """All extensions of ``binding``, from left to right; a negative literal binds nothing."""
    if not condition:
        return [binding]
    (positive, name, word), rest = condition[0], condition[1:]
    word = substitute(word, binding)
    things = [thing for thing in OBJECTS if (name, thing) in facts]
    if not positive:
        holds = bool(things) if word.startswith('?') else word in things
        return [] if holds else bindings(rest, facts, binding)
    if not word.startswith('?'):
        return bindings(rest, facts, binding) if word in things else []
    return [b for thing in things for b in bindings(rest, facts, {**binding, word: thing})]


def ground(net: Net, binding: dict[str, str]) -> Net:
    if net[0] == 'task':
        return ('task', net[1], substitute(net[2], binding))
    return (net[0], tuple(ground(part, binding) for part in net[1]))


def firsts(net: Net) -> Iterator[tuple[tuple[str, str], Callable[[Net], Net]]]:
    """Each task without predecessors, with how to put a network in its place."""
    if net[0] == 'task':
        yield (net[1], net[2]), lambda new: new
        return
    parts = net[1]
    open_parts = [i for i, part in enumerate(parts) if not done(part)]
    for i in open_parts[:1] if net[0] == 'ordered' else open_parts:
        for task, put in firsts(parts[i]):

            def replaced(new: Net, i: int = i, put: Callable[[Net], Net] = put) -> Net:
                return (net[0], (*parts[:i], put(new), *parts[i + 1 :]))

            yield task, replaced


def done(net: Net) -> bool:
    return net[0] != 'task' and all(done(part) for part in net[1])


EMPTY: Net = ('ordered', ())
#: Plans of all networks together that the reference works out; interleavings soon are too many.
MOST_PLANS = 50_000


class TooLarge(Exception):
    """The mission has more plans than a test has time for."""


class Reference:
    """All plans of a mission; raises TooLarge when they are more than MOST_PLANS."""

    def __init__(
        self, mission: Random, blocked: frozenset[str], lost: frozenset[tuple[str, str]]
    ) -> None:
        self.mission = mission
        self.blocked = blocked
        self.lost = lost
        self.known: dict[tuple[Net, Facts, str], frozenset[Plan]] = {}
        self.count = 0

    def plans(self, net: Net, facts: Facts, where: str = '') -> frozenset[Plan]:
        if done(net):
            return frozenset([()])
        key = (net, facts, where)
        if key not in self.known:
            found: set[Plan] = set()
            for (name, thing), put in firsts(net):
                if name.startswith('!'):
                    found |= self.act(name, thing, put, facts, where)
                else:
                    for branches in self.mission.tasks[int(name[1:])]:
                        for condition, tasks in branches:
                            solutions = bindings(condition, facts, {'?x': thing})
                            for binding in solutions:
                                found |= self.plans(put(ground(tasks, binding)), facts, where)
                            if solutions:
                                break
            self.known[key] = frozenset(found)
            self.count += 1 + len(found)
            if self.count > MOST_PLANS:
                raise TooLarge
        return self.known[key]

    def act(
        self, name: str, thing: str, put: Callable[[Net], Net], facts: Facts, where: str
    ) -> set[Plan]:
        action, text = self.mission.actions[int(name[2:])], f'{name} {thing}'
        if action.geometric and (text in self.blocked or (where, text) in self.lost):
            return set()
        if not bindings(action.condition, facts, {'?x': thing}):
            return set()
        effects = [(add, p, substitute(word, {'?x': thing})) for add, p, word in action.effects]
        after = facts - {(p, t) for add, p, t in effects if not add}
        after |= {(p, t) for add, p, t in effects if add}
        numbers = range(self.mission.destinations)
        ends = [end_of(text, number) for number in numbers] if action.geometric else [where]
        return {
            ((name, thing), *rest) for end in ends for rest in self.plans(put(EMPTY), after, end)
        }


@dataclass
class RandomMotionPlanner:
    """Some texts are impossible, others are never found, or not from everywhere."""

    mission: Random
    reverse: bool

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        name = query.preconditions.strip('()')
        if name in self.mission.impossible:
            return Answer(Status.IMPOSSIBLE, 103, Scope.CONNECTED_STARTS, 'walled in')
        is_lost = (query.start, name) in self.mission.lost
        if (
            name in self.mission.unknown
            or is_lost
            or query.alternative >= self.mission.destinations
        ):
            return Answer(Status.UNKNOWN, 202, message='not found')
        return Answer(Status.FOUND, end=end_of(name, query.alternative), length=1.0)

    def advise(self, query: AdviceQuery) -> Advice:
        preconditions = query.preconditions
        order = sorted(
            range(len(preconditions)), key=preconditions.__getitem__, reverse=self.reverse
        )
        candidates = tuple(
            CandidateAdvice(text.strip('()') in self.mission.impossible, Scope.CONNECTED_STARTS)
            for text in preconditions
        )
        return Advice(candidates, tuple(order))


@settings(max_examples=200, deadline=None)
@given(missions(), st.booleans(), st.booleans())
def test_the_search_agrees_with_brute_force(
    plan: Callable[..., Result], mission: Random, use_advice: bool, reverse: bool
) -> None:
    domain, problem = texts(mission)
    top = ground(mission.top, {})
    try:
        blocked = mission.impossible | mission.unknown
        surely = Reference(mission, blocked, mission.lost).plans(top, mission.facts)
        perhaps = Reference(mission, mission.impossible, frozenset()).plans(top, mission.facts)
    except TooLarge:
        reject()
    oracle = RandomMotionPlanner(mission, reverse)
    options = Options(use_advice=use_advice, max_alternatives=3, time_budget=600.0)
    result = plan(domain, problem, oracle, options)
    if result.outcome == Outcome.INVALID:
        assert re.search('bound by neither', result.explanation)
        return
    found = tuple((step.action[0], step.action[1]) for step in result.steps)
    if surely:
        assert result.outcome == Outcome.SOLVED
        assert found in surely
    else:
        assert result.outcome in (Outcome.NO_PLAN, Outcome.LIMIT)
    if not perhaps and not mission.unknown and not any(a.geometric for a in mission.actions):
        assert result.outcome == Outcome.NO_PLAN
    if result.outcome == Outcome.NO_PLAN:
        assert not perhaps
