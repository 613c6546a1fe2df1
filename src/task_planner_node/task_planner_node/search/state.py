"""The symbolic state: a set of facts, indexed per binding pattern, with an undo trail."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from math import inf
from operator import itemgetter
from random import Random
from typing import Any

Fact = tuple[Any, ...]
# Where a part of a fact is: (2,) is its second argument, (2, 0) the first element of that.
Path = tuple[int, ...]
# Goals tried between two looks at the limits of the search: some milliseconds.
LOOK_INTERVAL = 4096
# A bucket is rid of its dead entries once they are more than this and more than the living ones.
MOST_DEAD = 8


class TooMuchWork(Exception):
    """An enumeration took more work than it is worth, or cannot be told in a relaxed state."""


class _Misfit:
    """The key of a fact that does not have the shape of an index."""


MISFIT = _Misfit()


class Bucket(list[Fact]):
    """Facts with one key of an index; ``dead`` of them do not hold any more.

    Facts are only added at the end, so an enumeration survives changes that are undone before it goes on.
    """

    __slots__ = ('dead',)

    def __init__(self, facts: Iterable[Fact] = ()) -> None:
        super().__init__(facts)
        self.dead = 0


@dataclass(frozen=True, slots=True)
class Index:
    """Facts ``name`` with ``arity`` arguments by what is at ``paths``.

    ``shapes`` restricts it to facts with lists of a certain length at certain places.
    """

    name: str
    arity: int
    paths: tuple[Path, ...]
    shapes: tuple[tuple[Path, int], ...] = ()

    def key(self) -> Callable[[Fact], Any]:
        """How to get the key of a fact; MISFIT for one of another shape."""
        if not self.shapes:
            places = [path[0] for path in self.paths]
            return itemgetter(*places) if places else _no_key
        part_of = [at(path) for path in self.paths]
        single = len(part_of) == 1
        shapes = [(at(path), length) for path, length in self.shapes]

        def key(fact: Fact) -> Any:
            for part, length in shapes:
                value = part(fact)
                if not isinstance(value, tuple) or len(value) != length:
                    return MISFIT
            return part_of[0](fact) if single else tuple([part(fact) for part in part_of])

        return key


def at(path: Path) -> Callable[[Any], Any]:
    """How to get the part at ``path`` of a fact, or MISFIT."""
    if len(path) == 1:
        return itemgetter(path[0])

    def part(value: Any) -> Any:
        for place in path:
            value = value[place]
        return value

    return part


def fresh(fact: Fact) -> Fact:
    """Another tuple that is equal to ``fact``."""
    return (*fact[:1], *fact[1:])


def _no_key(_: Fact) -> tuple[()]:
    return ()


class IndexPlan:
    """The binding patterns that a compiled domain looks facts up by; it may still grow during a search."""

    def __init__(self) -> None:
        self.indices: list[Index] = []
        self._numbers: dict[Index, int] = {}

    def number(self, index: Index) -> int:
        """The number of an index."""
        number = self._numbers.setdefault(index, len(self.indices))
        if number == len(self.indices):
            self.indices.append(index)
        return number


@dataclass(frozen=True, slots=True)
class History:
    """The facts at first, and the changes in their order, each with whether the fact became true."""

    initial: tuple[Fact, ...]
    changes: tuple[tuple[Fact, bool], ...]

    def facts(self, mark: int) -> list[Fact]:
        """The facts that held at a mark of the state."""
        facts = dict.fromkeys(self.initial)
        for fact, added in self.changes[:mark]:
            if added:
                facts[fact] = None
            else:
                del facts[fact]
        return list(facts)


class _Buckets(dict[int, dict[Any, Bucket]]):
    """Indices by number, each built when it is first looked at."""

    def __init__(self, make: Callable[[int], dict[Any, Bucket]]) -> None:
        super().__init__()
        self._make = make

    def __missing__(self, number: int) -> dict[Any, Bucket]:
        made = self[number] = self._make(number)
        return made


class _Keys(dict[Fact, int]):
    """A random number of 128 bits for every fact, the same in every run."""

    def __init__(self) -> None:
        super().__init__()
        self._random = Random(0)

    def __missing__(self, fact: Fact) -> int:
        key = self[fact] = self._random.getrandbits(128)
        return key


# Buckets that were replaced by a change, each with its index and key.
_Replaced = list[tuple[dict[Any, Bucket], Any, Bucket]]


class State:
    """Facts that can be added, removed, looked up, and put back exactly as they were at a mark.

    ``facts`` maps each fact that holds to the tuple that indices hold; another tuple in a bucket, though equal,
    is dead.  ``key`` is the same for equal sets of facts, and differs for others in all probability (2^-128).
    With ``relaxed`` set, negative preconditions count as satisfied and every branch is open: an
    over-approximation of what can become true.

    ``work`` counts the goals tried by whoever enumerates; beyond ``next_look`` it calls look(), which calls
    ``watch`` and raises TooMuchWork beyond ``most_work``.
    """

    def __init__(
        self, plan: IndexPlan, facts: Iterable[Fact], watch: Callable[[], None] = lambda: None
    ) -> None:
        self.work = 0
        self.next_look = LOOK_INTERVAL
        self.most_work = inf
        self.relaxed = False
        self.key = 0
        self.buckets = _Buckets(self._build)
        self._watch = watch
        self._plan = plan
        self._initial = {fact: fresh(fact) for fact in facts}
        self.facts: dict[Fact, Fact] = {fact: fact for fact in self._initial.values()}
        self._indices: dict[str, list[tuple[int, dict[Any, Bucket], Callable[[Fact], Any]]]] = {}
        self._keys = _Keys()
        self._trail: list[tuple[Fact, _Replaced | None]] = []

    def _build(self, number: int) -> dict[Any, Bucket]:
        """An index as if it had been there from the start."""
        index = self._plan.indices[number]
        buckets: dict[Any, Bucket] = {}
        key_of = index.key()
        length = index.arity + 1

        def bucket_of(fact: Fact) -> Bucket:
            key = key_of(fact)
            bucket = buckets.get(key)
            if bucket is None:
                bucket = buckets[key] = Bucket()
            return bucket

        for fact in self._initial.values():
            if fact[0] == index.name and len(fact) == length:
                bucket_of(fact).append(fact)
        for fact, replaced in self._trail:
            if fact[0] == index.name and len(fact) == length:
                if replaced is None:
                    bucket_of(fact).append(fact)
                else:
                    bucket_of(fact).dead += 1
        self._indices.setdefault(index.name, []).append((length, buckets, key_of))
        return buckets

    def initial(self) -> State:
        """A state of its own as this one was at first."""
        return State(self._plan, self._initial, self._watch)

    def add(self, fact: Fact) -> bool:
        """Make ``fact``, a tuple that was not given before, true; False when it already was."""
        if fact in self.facts:
            return False
        self.facts[fact] = fact
        self.key ^= self._keys[fact]
        self._trail.append((fact, None))
        for length, buckets, key_of in self._indices.get(fact[0], ()):
            if length == len(fact):
                key = key_of(fact)
                bucket = buckets.get(key)
                if bucket is None:
                    bucket = buckets[key] = Bucket()
                bucket.append(fact)
        return True

    def remove(self, fact: Fact) -> bool:
        """Make ``fact`` false; False when it already was."""
        held = self.facts.pop(fact, None)
        if held is None:
            return False
        self.key ^= self._keys[fact]
        replaced: _Replaced = []
        self._trail.append((held, replaced))
        for length, buckets, key_of in self._indices.get(fact[0], ()):
            if length == len(fact):
                key = key_of(fact)
                bucket = buckets[key]
                dead = bucket.dead = bucket.dead + 1
                if dead > MOST_DEAD and dead + dead > len(bucket):
                    replaced.append((buckets, key, bucket))
                    buckets[key] = Bucket(self.living(bucket))
        return True

    def living(self, bucket: Bucket) -> Iterator[Fact]:
        """The facts of a bucket that hold."""
        get = self.facts.get
        return (fact for fact in bucket if get(fact) is fact)

    def only(self, bucket: Bucket) -> Fact:
        """The one fact of a bucket that holds."""
        get = self.facts.get
        for fact in reversed(bucket):
            if get(fact) is fact:
                return fact
        raise LookupError('no fact of the bucket holds')

    def worked(self, amount: int) -> None:
        """Count work that is no enumeration of goals."""
        self.work += amount
        if self.work > self.next_look:
            self.look()

    def look(self) -> None:
        """Raise what the limits of the search raise, and TooMuchWork."""
        if self.work > self.most_work:
            raise TooMuchWork
        self._watch()
        self.next_look = self.work + LOOK_INTERVAL

    def history(self) -> History:
        """All facts that hold at first, and all changes since."""
        changes = [(fact, replaced is None) for fact, replaced in self._trail]
        return History(tuple(self._initial), tuple(changes))

    def mark(self) -> int:
        """A point to undo to."""
        return len(self._trail)

    def undo(self, mark: int) -> None:
        """Put everything back as it was at ``mark``."""
        trail = self._trail
        while len(trail) > mark:
            fact, replaced = trail.pop()
            self.key ^= self._keys[fact]
            if replaced is None:
                del self.facts[fact]
                for length, buckets, key_of in self._indices.get(fact[0], ()):
                    if length == len(fact):
                        buckets[key_of(fact)].pop()
            else:
                self.facts[fact] = fact
                for buckets, key, bucket in replaced:
                    buckets[key] = bucket
                for length, buckets, key_of in self._indices.get(fact[0], ()):
                    if length == len(fact):
                        buckets[key_of(fact)].dead -= 1
