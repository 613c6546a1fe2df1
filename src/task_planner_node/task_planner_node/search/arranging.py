"""Local search of orders: stops are moved, and what the facts make of that is rehearsed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from random import Random

import numpy as np

from task_planner_node.search.itinerary import Itinerary
from task_planner_node.search.lengths import Lengths
from task_planner_node.search.tours import Tour

# Neighbours that are moved together, at most.
LONGEST = 3
# Stops of an order that is searched for.
MOST_ARRANGED = 60
# Stops of all orders that are weighed in one step, and of all that are rehearsed.
WEIGHED, REHEARSED = 40_000, 3_400
# Rehearsals of one step, and of all steps for each stop.
MOST_REHEARSED, PER_STOP = 8, 12
# [m] that an order has to be shorter.
LEAST_GAIN = 1e-3

# Searches the rest of a mission along a tour.
Rehearse = Callable[[Tour], Itinerary | None]
# Stops in their order, and what is met at some of them instead.
Proposal = tuple[list[int], dict[int, str]]


@dataclass(frozen=True, eq=False)
class Arrangement:
    """An order that the facts allow, and its expected length [m]."""

    itinerary: Itinerary
    lengths: Lengths

    @cached_property
    def length(self) -> float:
        """The expected length [m]."""
        return self.lengths.expected(self.itinerary.texts)

    def proposals(self, alternatives: Mapping[str, Sequence[str]]) -> Iterator[Proposal]:
        """All orders in which neighbours or the stops of a task are elsewhere, or something else is met at one stop."""
        count = len(self.itinerary.texts)
        runs = [
            tuple(range(begin, begin + length))
            for length in range(1, min(LONGEST, count - 1) + 1)
            for begin in range(count - length + 1)
        ]
        for order in moved(count, dict.fromkeys([*runs, *self.itinerary.parts])):
            yield order, {}
        for index, text in enumerate(self.itinerary.texts):
            for other in alternatives.get(text, ()):
                if other != text:
                    yield list(range(count)), {index: other}


def moved(count: int, parts: Iterable[Sequence[int]]) -> Iterator[list[int]]:
    """All orders of ``count`` stops in which one of ``parts`` is elsewhere, and together."""
    for part in parts:
        rest = [index for index in range(count) if index not in part]
        for place in range(len(rest) + 1):
            order = [*rest[:place], *part, *rest[place:]]
            if order != sorted(order):
                yield order


class Barred:
    """What was wanted at some stop and did not come about, by the texts that had been met before."""

    def __init__(self, random: Random) -> None:
        self._random = random
        self._numbers: dict[object, int] = {}
        self._codes: set[int] = set()

    def bars(self, stops: Sequence[tuple[str, object]]) -> bool:
        """Whether one of ``stops``, texts and what they are met for, is known not to come about in its place."""
        return any(code in self._codes for code in self._coded(stops))

    def learn(self, stops: Sequence[tuple[str, object]], came: Sequence[str]) -> None:
        """Note the first of the stops in the place of which something else came."""
        codes = self._coded(stops)
        for (text, _), code, other in zip(stops, codes, came, strict=False):
            if text != other:
                self._codes.add(code)
                return

    def _coded(self, stops: Sequence[tuple[str, object]]) -> Iterator[int]:
        """A number for each stop and the texts before it, whatever their order."""
        before = 0
        for stop in stops:
            yield before ^ self._number(stop)
            before += self._number(stop[0])

    def _number(self, thing: object) -> int:
        if thing not in self._numbers:
            self._numbers[thing] = self._random.getrandbits(62)
        return self._numbers[thing]


class Arranging:
    """From one order to shorter ones, until as many as are allowed were rehearsed."""

    def __init__(
        self,
        rehearse: Rehearse,
        lengths: Lengths,
        alternatives: Mapping[str, Sequence[str]],
        seed: int,
    ) -> None:
        self._rehearse = rehearse
        self._lengths = lengths
        self._alternatives = alternatives
        self._random = Random(seed)
        self._left = 0
        self._tried: set[bytes] = set()
        self._barred = Barred(Random(seed))

    def best(self, itinerary: Itinerary) -> Itinerary:
        """The shortest order that is found, beginning with that of ``itinerary``."""
        best = here = Arrangement(itinerary, self._lengths)
        count = max(1, len(itinerary.texts))
        self._left = min(PER_STOP * count, REHEARSED // count)
        while self._left > 0:
            proposals = list(here.proposals(self._alternatives))
            if not proposals:
                break
            if len(proposals) > WEIGHED // count:
                proposals = self._random.sample(proposals, WEIGHED // count)
            found = self._shorter(here, proposals)
            if found is None:
                best = min(best, here, key=lambda order: order.length)
                # From the best one somewhere else, longer or not.
                proposals = list(best.proposals(self._alternatives))
                found = self._rehearsed(best, self._random.choice(proposals)) or best
            here = found
        return min(best, here, key=lambda order: order.length).itinerary

    def _shorter(self, here: Arrangement, proposals: Sequence[Proposal]) -> Arrangement | None:
        """The first order that is shorter, those that promise most first."""
        own = here.lengths.numbered(here.itinerary.texts)
        sequences = own[np.array([order for order, _ in proposals])]
        for number, (order, instead) in enumerate(proposals):
            for index, text in instead.items():
                sequences[number, order.index(index)] = here.lengths.indices.get(text, -1)
        lengths = here.lengths.of(sequences)
        promising = np.flatnonzero(lengths < here.length - LEAST_GAIN)
        tried = 0
        for number in promising[np.argsort(lengths[promising], kind='stable')]:
            key = sequences[number].tobytes()
            if key in self._tried or self._barred.bars(_stops(here, proposals[number])):
                continue
            self._tried.add(key)
            found = self._rehearsed(here, proposals[number])
            if found is not None and found.length < here.length - LEAST_GAIN:
                return found
            tried += 1
            if tried == MOST_REHEARSED:
                break
        return None

    def _rehearsed(self, here: Arrangement, proposal: Proposal) -> Arrangement | None:
        """What the facts make of a proposal."""
        self._left -= 1
        order, instead = proposal
        found = self._rehearse(here.itinerary.tour([(index, None) for index in order], instead))
        if found is None:
            return None
        self._barred.learn(_stops(here, proposal), found.texts)
        return Arrangement(found, self._lengths)


def _stops(here: Arrangement, proposal: Proposal) -> list[tuple[str, object]]:
    """What is met at each stop of a proposal, and for which tasks."""
    order, instead = proposal
    texts, tasks = here.itinerary.texts, here.itinerary.made_for
    return [(instead.get(index, texts[index]), tasks[index]) for index in order]
