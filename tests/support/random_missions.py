"""Random missions with conditions, effects and tasks of every form, and their texts."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from task_planner_node.outcomes import Result

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
