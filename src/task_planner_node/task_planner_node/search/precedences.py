"""Which motions of a plan have to come before which others, as far as the task networks of its decomposition say."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import count, pairwise

from task_planner_node.language.model import Atom, Immediate, Ordered, Partial, TaskNetwork
from task_planner_node.search.methods import CompiledBranch, closure
from task_planner_node.search.partial_plan import Expansion

Pair = tuple[int, int]


@dataclass(frozen=True, slots=True)
class _Ends:
    """The stops that nothing in a part of the plan comes before, and those that nothing comes after."""

    first: tuple[int, ...] = ()
    last: tuple[int, ...] = ()


NOTHING = _Ends()


@dataclass
class Precedences:
    """Pairs of stops, of which the first has to be made before the second.

    ``stops`` are the indices of stops by the place of their operator in the plan's ``log``, ``root`` is the network
    of the problem, if the plan is one for it.  A task that comes up again below itself is no part of an order that is
    not ``strict``: such a task often stands for what is left to do, in an order that a binding chose.
    """

    log: Sequence[Expansion]
    stops: Mapping[int, int]
    root: TaskNetwork | None
    recursive: frozenset[str]
    strict: bool
    pairs: list[Pair] = field(default_factory=list)

    def find(self) -> list[Pair]:
        """The pairs; those that follow from others are left out."""
        below: dict[int, dict[int, _Ends]] = {}
        free: dict[int, set[int]] = {}
        log = self.log
        # Children come after their parents in the log.
        for index in range(len(log) - 1, -1, -1):
            expansion = log[index]
            by = expansion.by
            if isinstance(by, CompiledBranch):
                ends = self._join(
                    by.network, below.pop(id(expansion), {}), free.pop(id(expansion), set())
                )
            elif index in self.stops:
                ends = _Ends((self.stops[index],), (self.stops[index],))
            else:
                ends = NOTHING
            parent = id(expansion.parent)
            below.setdefault(parent, {})[expansion.place] = ends
            if not self.strict and self._repeats(expansion):
                free.setdefault(parent, set()).add(expansion.place)
        if self.root is not None:
            self._join(self.root, below.get(id(None), {}), set())
        return self.pairs

    def _repeats(self, expansion: Expansion) -> bool:
        parent = expansion.parent
        return (
            parent is not None
            and parent.task[0] in self.recursive
            and expansion.task[0] in self.recursive
        )

    def _join(self, network: TaskNetwork, ends: Mapping[int, _Ends], free: set[int]) -> _Ends:
        """Note the pairs that ``network`` says; ``ends`` are those of its tasks by their place in the text."""
        outside: list[_Ends] = [ends[place] for place in sorted(free)]
        places = count()
        inside = self._network(network, ends, free, places)
        return _together([inside, *outside])

    def _network(
        self,
        network: TaskNetwork,
        ends: Mapping[int, _Ends],
        free: set[int],
        places: Iterator[int],
    ) -> _Ends:
        if isinstance(network, (Atom, Immediate)):
            place = next(places)
            return NOTHING if place in free else ends.get(place, NOTHING)
        parts = [self._network(item, ends, free, places) for item in network.items]
        if isinstance(network, Ordered):
            parts = [part for part in parts if part.first]
            for before, after in pairwise(parts):
                self._pair(before, after)
            return _Ends(parts[0].first, parts[-1].last) if parts else NOTHING
        if isinstance(network, Partial):
            for before_index, after_index in sorted(closure(network.before)):
                self._pair(parts[before_index], parts[after_index])
        return _together(parts)

    def _pair(self, before: _Ends, after: _Ends) -> None:
        self.pairs.extend((one, other) for one in before.last for other in after.first)


def waiting(pairs: Iterable[Pair]) -> dict[int, set[int]]:
    """For each stop that has to wait those that ``pairs`` name before it."""
    found: dict[int, set[int]] = {}
    for one, other in pairs:
        found.setdefault(other, set()).add(one)
    return found


def without(left_out: Collection[int], pairs: Iterable[Pair]) -> set[Pair]:
    """What ``pairs`` say of all other stops, also by way of those that are ``left_out``."""
    found = set(pairs)
    for stop in left_out:
        before = [one for one, other in found if other == stop]
        after = [other for one, other in found if one == stop]
        found = {pair for pair in found if stop not in pair}
        found.update((one, other) for one in before for other in after)
    return found


def _together(parts: Sequence[_Ends]) -> _Ends:
    return _Ends(
        tuple([stop for part in parts for stop in part.first]),
        tuple([stop for part in parts for stop in part.last]),
    )
