"""Random missions with conditions, effects and tasks of every form: all their plans, against an interpreter written differently."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from hypothesis import assume, given, reject, settings
from hypothesis import strategies as st

from task_planner_node.outcomes import Options, Outcome, Result

Planned = Callable[..., Result]
OBJECTS = ('1', '2')
Form = Any
Fact = tuple[str, str]
# Facts in the order in which they became true; protected facts with counts.
State = tuple[tuple[Fact, ...], tuple[tuple[Fact, int], ...]]
Plan = tuple[tuple[str, str], ...]
Binding = dict[str, str]

words = st.sampled_from(['?x', '?x', '?y', '?y', '1', '2'])
literals = st.tuples(st.just('is'), st.sampled_from(['p', 'q', 'r']), words)
own = st.tuples(st.just('is'), st.sampled_from(['p', 'q']), st.just('?z'))
quantified = st.tuples(st.sampled_from(['forall', 'exists']), own, st.tuples(st.just('not'), own))
derived = st.tuples(st.just('is'), st.just('ax'), words)


def composite(inner: st.SearchStrategy[Form]) -> st.SearchStrategy[Form]:
    return st.one_of(
        st.tuples(st.just('not'), inner),
        st.tuples(st.sampled_from(['and', 'or']), st.lists(inner, min_size=1, max_size=3)),
        st.tuples(st.just('imply'), inner, inner),
        st.tuples(st.just('first'), inner),
        st.tuples(st.just('sort'), st.sampled_from(['<', '>']), own_sorted(inner)),
        st.tuples(st.just('assign'), st.sampled_from(['?y', '?w']), st.sampled_from(OBJECTS)),
        st.tuples(st.just('each'), st.just('?y'), st.just('(1 2)')),
        st.tuples(st.just('same'), words, words),
    )


def own_sorted(inner: st.SearchStrategy[Form]) -> st.SearchStrategy[Form]:
    bind = st.tuples(st.just('is'), st.sampled_from(['p', 'q']), st.just('?y'))
    return st.tuples(bind, inner).map(lambda pair: ('and', list(pair)))


conditions = st.recursive(
    st.one_of(literals, literals, derived, quantified), composite, max_leaves=5
)
# Conditions that bind ?y in several ways.
choosing = st.one_of(
    own_sorted(conditions),
    own_sorted(conditions).map(lambda form: ('first', form)),
    st.tuples(st.just('sort'), st.sampled_from(['<', '>']), own_sorted(st.just(('and', [])))),
    st.tuples(st.just('sort'), st.sampled_from(['<', '>']), own_sorted(st.just(('and', [])))).map(
        lambda form: ('first', form)
    ),
)
effects = st.lists(
    st.tuples(
        st.sampled_from(['add', 'add', 'del', 'all', 'when', 'protect', 'free']),
        st.sampled_from(['p', 'q', 'r']),
        st.sampled_from(['?x', '1', '2']),
    ),
    max_size=3,
)


@dataclass(frozen=True)
class Mission:
    """Tasks t0, t1 ... each with methods of branches; a task only leads to later ones."""

    actions: list[tuple[Form, list[tuple[str, str, str]]]]
    tasks: list[list[list[tuple[Form, Form]]]]
    axioms: list[Form]
    facts: tuple[Fact, ...]
    top: Form


@st.composite
def missions(draw: st.DrawFn) -> Mission:
    actions = draw(
        st.lists(
            st.tuples(st.just(('and', [])) | st.just(('and', [])) | conditions, effects),
            min_size=1,
            max_size=3,
        )
    )
    primitive = [f'!o{i}' for i in range(len(actions))]
    count = draw(st.integers(1, 2))
    tasks = []
    for index in range(count):
        names = primitive + [f't{later}' for later in range(index + 1, count)]
        branch = st.one_of(
            st.tuples(conditions, networks(names, st.sampled_from(['?x', '?x', '1']))),
            st.tuples(choosing, networks(names, st.sampled_from(['?x', '?y', '?y']))),
        )
        branches = st.lists(branch, min_size=1, max_size=2)
        tasks.append(draw(st.lists(branches, min_size=1, max_size=2)))
    every = st.tuples(st.sampled_from(['p', 'q', 'r']), st.sampled_from(OBJECTS))
    facts = draw(st.lists(every, unique=True, min_size=3, max_size=6))
    axioms = draw(
        st.lists(conditions.filter(lambda c: "'ax'" not in repr(c)), min_size=1, max_size=2)
    )
    names = [*primitive, *(f't{i}' for i in range(count)), 't0', 't0', 't0']
    return Mission(
        actions, tasks, axioms, tuple(facts), draw(networks(names, st.sampled_from(OBJECTS)))
    )


def networks(names: list[str], arguments: st.SearchStrategy[str]) -> st.SearchStrategy[Form]:
    task = st.tuples(st.sampled_from(['task', 'task', 'now']), st.sampled_from(names), arguments)
    kind = st.sampled_from(['ordered', 'unordered'])
    inner = st.tuples(kind, st.lists(task, max_size=2))
    return st.tuples(kind, st.lists(task | inner, min_size=1, max_size=3))


# --- as text


def condition_text(form: Form) -> str:
    word, *rest = form
    if word == 'is':
        return f'({rest[0]} {rest[1]})'
    if word in ('and', 'or'):
        return f'({" ".join([word, *map(condition_text, rest[0])])})'
    if word in ('forall', 'exists'):
        return f'({word} (?z) ({condition_text(rest[0])}) ({condition_text(rest[1])}))'
    if word in ('not', 'imply'):
        return f'({" ".join([word, *map(condition_text, rest)])})'
    if word == 'first':
        return f'(:first {condition_text(rest[0])})'
    if word == 'sort':
        return f'(:sort-by ?y {rest[0]} {condition_text(rest[1])})'
    if word == 'same':
        return f'(call equal {rest[0]} {rest[1]})'
    return f"({'assign*' if word == 'each' else 'assign'} {rest[0]} '{rest[1]})"


def effect_texts(some: list[tuple[str, str, str]]) -> tuple[str, str]:
    deletes, adds = [], []
    for kind, name, word in some:
        literal = f'({name} {word})'
        if kind == 'del':
            deletes.append(literal)
        elif kind == 'free':
            deletes.append(f'(:protection {literal})')
        elif kind == 'protect':
            adds += [literal, f'(:protection {literal})']
        elif kind == 'all':
            adds.append(f'(forall (?z) ((p ?z)) (({name} ?z)))')
        elif kind == 'when':
            deletes.append(f'(forall (?z) ((q ?z) (not (p ?z))) (({name} ?z)))')
        else:
            adds.append(literal)
    return ' '.join(deletes), ' '.join(adds)


def network_text(form: Form) -> str:
    if form[0] in ('task', 'now'):
        return f'({":task :immediate " if form[0] == "now" else ""}{form[1]} {form[2]})'
    return f'(:{form[0]} {" ".join(map(network_text, form[1]))})'


def texts(mission: Mission) -> tuple[str, str]:
    forms = [
        f'(:operator (!o{i} ?x) {condition_text(condition)} ({deletes}) ({adds}))'
        for i, (condition, some) in enumerate(mission.actions)
        for deletes, adds in [effect_texts(some)]
    ]
    for i, methods in enumerate(mission.tasks):
        for branches in methods:
            parts = ' '.join(f'{condition_text(c)} {network_text(n)}' for c, n in branches)
            forms.append(f'(:method (t{i} ?x) {parts})')
    forms.append(f'(:- (ax ?x) {" ".join(map(condition_text, mission.axioms))})')
    facts = ' '.join(f'({name} {thing})' for name, thing in mission.facts)
    return (
        f'(defdomain d ({" ".join(forms)}))',
        f'(defproblem p d ({facts}) {network_text(mission.top)})',
    )


# --- the interpreter: lists of all solutions, recursion over immutable values

MOST_PLANS = 200
MOST_WORK = 10_000


class TooLarge(Exception):
    """The mission has more plans than a test has time for."""


class Unbound(Exception):
    """A value was asked for that is not bound."""


class Interpreter:
    """All plans of a mission."""

    def __init__(self, mission: Mission) -> None:
        self.mission = mission
        self.work = 0

    def solve(self, form: Form, facts: tuple[Fact, ...], b: Binding) -> list[Binding]:
        """All solutions, in the order of the text and of the facts."""
        self.work += 1
        if self.work > MOST_WORK:
            raise TooLarge
        word, *rest = form
        if word == 'is':
            return self.literal(rest[0], rest[1], facts, b)
        if word == 'and':
            found = [b]
            for part in rest[0]:
                found = [c for before in found for c in self.solve(part, facts, before)]
            return found
        if word == 'or':
            return [c for part in rest[0] for c in self.solve(part, facts, b)]
        if word == 'not':
            return [] if self.solve(rest[0], facts, b) else [b]
        if word == 'imply':
            return self.solve(rest[1], facts, b) if self.solve(rest[0], facts, b) else [b]
        if word in ('forall', 'exists'):
            good = [bool(self.solve(rest[1], facts, c)) for c in self.solve(rest[0], facts, b)]
            return [b] if (all(good) if word == 'forall' else any(good)) else []
        if word == 'first':
            return self.solve(rest[0], facts, b)[:1]
        if word == 'sort':
            sign = 1 if rest[0] == '<' else -1
            return sorted(self.solve(rest[1], facts, b), key=lambda c: sign * int(c['?y']))
        if word == 'same':
            left, right = (b.get(item, item) for item in rest)
            if left.startswith('?') or right.startswith('?'):
                raise Unbound
            return [b] if left == right else []
        values = OBJECTS if word == 'each' else (rest[1],)
        return [{**b, rest[0]: value} for value in values if b.get(rest[0], value) == value]

    def literal(self, name: str, word: str, facts: tuple[Fact, ...], b: Binding) -> list[Binding]:
        value = b.get(word, word)
        if name != 'ax':
            things = [thing for predicate, thing in facts if predicate == name]
        elif value.startswith('?'):
            things = self.derived(facts)
        else:
            bodies = (self.solve(body, facts, {'?x': value}) for body in self.mission.axioms)
            things = [value] if any(bodies) else []
        if value.startswith('?'):
            return [{**b, word: thing} for thing in things]
        return [b] if value in things else []

    def derived(self, facts: tuple[Fact, ...]) -> list[str]:
        for body in self.mission.axioms:
            found = self.solve(body, facts, {})
            if any('?x' not in c for c in found):
                raise Unbound
            if found:
                return [c['?x'] for c in found]
        return []

    def act(self, index: int, thing: str, state: State) -> list[State]:
        facts, protected = state
        condition, some = self.mission.actions[index]
        if not self.solve(condition, facts, {'?x': thing}):
            return []
        gone: list[Fact] = []
        new: list[Fact] = []
        counts = dict(protected)
        for kind, name, word in some:
            fact = (name, thing if word == '?x' else word)
            if kind == 'del':
                gone.append(fact)
            elif kind == 'free':
                counts[fact] = max(0, counts.get(fact, 0) - 1)
            elif kind == 'all':
                new += [(name, z) for predicate, z in facts if predicate == 'p']
            elif kind == 'when':
                gone += [(name, z) for q, z in facts if q == 'q' and ('p', z) not in facts]
            else:
                new.append(fact)
        for kind, name, word in some:
            if kind == 'protect':
                fact = (name, thing if word == '?x' else word)
                counts[fact] = counts.get(fact, 0) + 1
        left = [fact for fact in facts if fact not in gone]
        left += [fact for fact in dict.fromkeys(new) if fact not in left]
        if any(count and fact not in left for fact, count in counts.items()):
            return []
        kept = sorted((fact, count) for fact, count in counts.items() if count)
        return [(tuple(left), tuple(kept))]

    def plans(self, net: Form, state: State) -> set[Plan]:
        self.work += 20
        firsts = list(self.firsts(net))
        if not firsts:
            return {()}
        urgent = [first for first in firsts if first[2]]
        found: set[Plan] = set()
        for (name, thing), put, _ in urgent or firsts:
            if name.startswith('!'):
                for after in self.act(int(name[2:]), thing, state):
                    found |= {((name, thing), *plan) for plan in self.plans(put(EMPTY), after)}
            else:
                for tasks in self.decompose(int(name[1:]), thing, state):
                    found |= self.plans(put(tasks), state)
            if len(found) > MOST_PLANS:
                raise TooLarge
        return found

    def decompose(self, index: int, thing: str, state: State) -> Iterator[Form]:
        for branches in self.mission.tasks[index]:
            for condition, tasks in branches:
                solutions = self.solve(condition, state[0], {'?x': thing})
                yield from {ground(tasks, b): None for b in solutions}
                if solutions:
                    break

    def firsts(self, net: Form) -> Iterator[tuple[tuple[str, str], Callable[[Form], Form], bool]]:
        """Each task without predecessors, how to put a network in its place, and whether it is immediate."""
        if net[0] in ('task', 'now'):
            yield (net[1], net[2]), lambda new: new, net[0] == 'now'
            return
        parts = net[1]
        open_parts = [i for i, part in enumerate(parts) if any(True for _ in self.firsts(part))]
        for i in open_parts[:1] if net[0] == 'ordered' else open_parts:
            for task, put, urgent in self.firsts(parts[i]):

                def replaced(new: Form, i: int = i, put: Callable[[Form], Form] = put) -> Form:
                    return (net[0], (*parts[:i], put(new), *parts[i + 1 :]))

                yield task, replaced, urgent


EMPTY: Form = ('ordered', ())


def ground(net: Form, b: Binding) -> Form:
    if net[0] in ('task', 'now'):
        value = b.get(net[2], net[2])
        if value.startswith('?'):
            raise Unbound
        return (net[0], net[1], value)
    return (net[0], tuple(ground(part, b) for part in net[1]))


@settings(max_examples=150, deadline=None)
@given(missions())
def test_the_search_finds_all_plans_and_no_others(plan: Planned, mission: Mission) -> None:
    interpreter = Interpreter(mission)
    try:
        wanted = interpreter.plans(ground(mission.top, {}), (mission.facts, ()))
    except (TooLarge, Unbound):
        reject()
    options = Options(use_advice=False, plans=MOST_PLANS + 1, time_budget=600.0)
    result = plan(*texts(mission), None, options)
    assume(result.outcome != Outcome.INVALID)
    assert {tuple(s.action for s in found.steps) for found in result.plans} == wanted
    assert result.outcome == (Outcome.SOLVED if wanted else Outcome.NO_PLAN)
    first = plan(*texts(mission), None, Options(use_advice=False, time_budget=600.0))
    assert first.outcome == result.outcome
    assert first.plans[0].actions == result.plans[0].actions if wanted else not first.plans
