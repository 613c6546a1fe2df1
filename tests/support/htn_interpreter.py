"""An interpreter of missions that is written unlike the search: lists of all solutions, recursion over immutable values."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from tests.support.random_missions import OBJECTS, Binding, Fact, Form, Mission, Plan, State

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
