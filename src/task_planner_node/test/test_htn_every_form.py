"""Random missions with conditions, effects and tasks of every form: all their plans, against an interpreter written differently."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from hypothesis import assume, example, given, reject, settings
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

# Missions are drawn by a generator of random numbers, since those that hypothesis draws are mostly too simple.


class Draw:
    """Random forms of the language."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)

    def one(self, *items: Any) -> Any:
        return self.random.choice(items)

    def literal(self, *words: str) -> Form:
        name = self.one('p', 'q', 'r', 'p', 'q', 'r', 'ax')
        return (
            'is',
            name,
            self.one(*words) if words else self.one('?x', '?x', '?y', '?y', '1', '2'),
        )

    def plain(self, word: str) -> Form:
        return ('is', self.one('p', 'q', 'r'), word)

    def condition(self, depth: int = 2) -> Form:
        """Any condition; variables may be unbound where it is tested."""
        if depth == 0 or self.random.random() < 0.3:
            return self.literal()
        inner = depth - 1
        kind = self.random.randrange(10)
        if kind < 2:
            return ('not', self.condition(inner))
        if kind < 5:
            parts = [self.condition(inner) for _ in range(self.random.randint(2, 3))]
            return (self.one('and', 'or', 'or'), parts)
        if kind == 5:
            return ('imply', self.condition(inner), self.condition(inner))
        if kind == 6:
            body = self.one(self.plain('?z'), ('not', self.plain('?z')))
            return (self.one('forall', 'exists'), self.plain('?z'), body)
        if kind == 7:
            return (self.one('assign', 'each'), '?y', self.one(*OBJECTS))
        return self.one(('first', self.condition(inner)), ('same', '?x', self.one('?x', *OBJECTS)))

    def choosing(self) -> Form:
        """A condition that binds ?y, mostly in several ways."""
        either = ('or', [self.plain('?y'), self.plain('?y')])
        chosen = self.one(self.plain('?y'), self.plain('?y'), either, ('each', '?y', ''))
        both: tuple[Any, ...] = (
            'and',
            self.random.sample([chosen, self.condition(1)], 2) if self.one(0, 1) else [chosen],
        )
        if any("'?y'" in repr(part) for part in both[1][:1]) and self.one(0, 0, 1):
            both = ('sort', self.one('<', '>'), ('and', [chosen]))
        return self.one(both, both, ('first', both))

    def effects(self) -> list[tuple[str, str, str]]:
        kinds = ['add', 'add', 'add', 'del', 'del', 'all', 'when', 'protect', 'free']
        return [
            (self.one(*kinds), self.one('p', 'q', 'r'), self.one('?x', '?x', '1', '2'))
            for _ in range(self.random.randint(0, 2))
        ]

    def network(self, names: list[str], words: tuple[str, ...], depth: int = 1) -> Form:
        parts: list[Form] = []
        for _ in range(self.random.randint(1, 2 + depth)):
            if depth and self.random.random() < 0.25:
                parts.append(self.network(names, words, depth - 1))
            else:
                kind = self.one('task', 'task', 'task', 'now')
                parts.append((kind, self.one(*names), self.one(*words)))
        return (self.one('ordered', 'unordered'), tuple(parts))

    def mission(self) -> Mission:
        nothing: Form = ('and', [])
        actions = [
            (self.one(nothing, nothing, self.literal('?x'), self.condition()), self.effects())
            for _ in range(3)
        ]
        primitive = ['!o0', '!o1', '!o2']
        tasks = []
        for names in ([*primitive, 't1'], primitive):
            methods = []
            for _ in range(self.random.randint(1, 2)):
                branches = []
                for _ in range(self.random.randint(1, 2)):
                    words = self.one(('?x', '1', '2'), ('?y', '?y', '?x'))
                    condition = self.choosing() if '?y' in words else self.condition()
                    branches.append((condition, self.network(names, words, 0)))
                methods.append(branches)
            tasks.append(methods)
        every = [(name, thing) for name in 'pqr' for thing in OBJECTS]
        facts = self.random.sample(every, self.random.randint(2, 5))
        axioms: list[Form] = []
        while len(axioms) < 2:
            body = self.condition()
            if "'ax'" not in repr(body):
                axioms.append(body)
        top = self.network(['t0', 't0', 't1', *primitive[:1]], OBJECTS, 1)
        return Mission(actions, tasks, axioms, tuple(facts), top)


@dataclass(frozen=True)
class Mission:
    """Tasks t0, t1 ... each with methods of branches; a task only leads to later ones."""

    actions: list[tuple[Form, list[tuple[str, str, str]]]]
    tasks: list[list[list[tuple[Form, Form]]]]
    axioms: list[Form]
    facts: tuple[Fact, ...]
    top: Form


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
    value = "'(1 2)" if word == 'each' else f"'{rest[1]}"
    return f'({"assign*" if word == "each" else "assign"} {rest[0]} {value})'


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


@settings(max_examples=300, deadline=None)
@given(st.integers(0, 2**32))
@example(13582447)
@example(1138)
def test_the_search_finds_all_plans_and_no_others(plan: Planned, seed: int) -> None:
    mission = Draw(seed).mission()
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
