"""Rehearsals: the rest of a mission as the facts alone have it, all motions granted."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, field

from task_planner_node.errors import MissionError, TermRefused
from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Purpose,
    Query,
    Status,
    TextCheck,
    Token,
)
from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.engine import Search
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Itinerary
from task_planner_node.search.network import Network
from task_planner_node.search.partial_plan import Expansion, Limits
from task_planner_node.search.plans import Plans
from task_planner_node.search.precedences import waiting
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.tours import Following, Tour

# What one rehearsal may take: motions granted, choices taken back, and looks at the limits, one for each
# CHECK_INTERVAL decompositions.
MOST_GRANTED = 4000
MOST_BACKTRACKS = 1000
MOST_LOOKS = 2000
# Rehearsals of an order that came of another one.
MOST_SETTLING = 4
NO_TOUR = Tour((), {}, lasting=True)
# How far [m] texts are from one that was met, None being where the robots stand at first.
Apart = Callable[[str | None, Sequence[str]], Sequence[float]]


class TooLong(Exception):
    """A rehearsal takes more than it is worth."""


class Granting:
    """An Oracle that grants every motion but those that ``known`` proves impossible.

    Where the robots stand is what was met last, and whether an attitude was assigned since ``lineage``, which was the
    last one.  ``alternatives`` has, for each text of which another one could have
    been met, all that could.  Where ``apart`` tells how far texts are from one that was met, advice is nearest first.
    """

    def __init__(
        self,
        known: Geometry,
        assigning: Collection[str],
        lineage: Token,
        apart: Apart | None = None,
    ) -> None:
        self.alternatives: dict[str, tuple[str, ...]] = {}
        self._known = known
        self._assigning = assigning
        self._lineage = lineage
        self._apart = apart
        self._granted = 0

    def check(self, _text: str, _source: str, _line: int, _column: int) -> TextCheck:
        """Oracle.check."""
        return TextCheck(assigns=False)

    def satisfy(self, query: Query) -> Answer:
        """Oracle.satisfy."""
        self._granted += 1
        if self._granted > MOST_GRANTED:
            raise TooLong
        put = isinstance(query.start, tuple) and query.start[2:] == (True,)
        lineage = None if put else self._lineage
        if self._known.lasting_nogood(query.preconditions, lineage) is not None:
            return Answer(Status.IMPOSSIBLE)
        assigned = query.action[0] in self._assigning
        end = ('met', query.preconditions, put or assigned)
        return Answer(Status.FOUND, end=end, assigned=assigned)

    def advise(self, query: AdviceQuery) -> Advice:
        """Oracle.advise."""
        texts = query.preconditions
        if self._apart is not None:
            start = query.start
            met = start[1] if isinstance(start, tuple) and start[:1] == ('met',) else None
            lengths = self._apart(met, texts)
            order = sorted(range(len(texts)), key=lambda index: (lengths[index], index))
            return Advice((CandidateAdvice(),) * len(texts), tuple(order))
        for text in texts:
            self.alternatives.setdefault(text, texts)
        return Advice((), ())


@dataclass(frozen=True)
class Rest:
    """What is left to do as something to begin with."""

    network: Network
    beginning: Start

    def networks(self, _state: State) -> Iterator[Network]:
        """The only network."""
        yield self.network

    def reached(self, state: State) -> bool:
        """Whether the goal holds."""
        return self.beginning.reached(state)

    def unmet(self, state: State) -> str:
        """The first part of the goal that does not hold."""
        return self.beginning.unmet(state)


@dataclass(frozen=True, eq=False)
class Rehearsal:
    """Searches for what is left of a mission from ``start`` on, ``done`` being the log of what led there.

    ``lineage`` is the attitude that was last assigned.  ``root`` is the network of the problem, None where the plan began
    with something else; ``check`` raises what ends the mission.  ``alternatives`` are those that the rehearsals came
    upon (Granting).
    """

    domain: CompiledDomain
    beginning: Start
    root: TaskNetwork | None
    state: State
    known: Geometry
    check: Callable[[], None]
    start: Token
    lineage: Token
    done: Sequence[Expansion] = ()
    alternatives: dict[str, tuple[str, ...]] = field(default_factory=dict)

    def along(self, tour: Tour = NO_TOUR) -> Itinerary | None:
        """The first plan along a tour: all that is done before, and then the rest with motions to nowhere.

        None where there is none within limits, as far as a search that looks no further can tell.
        """
        granting = Granting(self.known, self.domain.may_assign, self.lineage)
        found = self._found(granting, Following(tour))
        for text, others in granting.alternatives.items():
            self.alternatives.setdefault(text, others)
        return found

    def nearest_first(self, apart: Apart) -> Itinerary | None:
        """The plan that always goes on with what is nearest."""
        return self._found(Granting(self.known, self.domain.may_assign, self.lineage, apart), None)

    def _found(self, granting: Granting, following: Following | None) -> Itinerary | None:
        statistics = Statistics()
        limits = Limits(
            most_backtracks=MOST_BACKTRACKS, examined=False, purpose=Purpose.NEAREST_FIRST
        )
        plans = Plans(limits, lambda _: None)
        looks = 0

        def look() -> None:
            nonlocal looks
            looks += 1
            if looks > MOST_LOOKS:
                raise TooLong
            self.check()

        search = Search(
            self.domain,
            self.beginning,
            self.state,
            Geometry(granting, statistics, 1, look),
            statistics,
            limits,
            look,
            plans,
        )
        mark = self.state.mark()
        try:
            search.run(self.start, following)
        except (TooLong, MissionError, TermRefused, RecursionError):
            # What is wrong is told when the search itself comes to it.
            return None
        finally:
            self.state.undo(mark)
        if plans.best is None:
            return None
        log = (*self.done, *plans.best.log)
        return Itinerary(log, self.root, self.domain.recursive, len(self.done))

    def is_free(self, itinerary: Itinerary) -> bool:
        """Whether the facts seem to leave the order open, and what is met.

        That is whether two quite other orders can be rehearsed, as far as the task networks allow them: the last stops
        first, and every other one first.
        """
        if self.alternatives:
            return False
        earlier = waiting(itinerary.precedences(strict=False))
        stops = range(len(itinerary.texts))
        for wanted in (stops[::-1], [*stops[1::2], *stops[::2]]):
            left = list(wanted)
            order: list[int] = []
            while left:
                following = next(i for i in left if earlier.get(i, set()).isdisjoint(left))
                left.remove(following)
                order.append(following)
            found = self.along(itinerary.tour([(index, None) for index in order]))
            if found is None or found.texts != tuple([itinerary.texts[i] for i in order]):
                return False
        return not self.alternatives

    def settled(self, itinerary: Itinerary) -> Itinerary:
        """The itinerary that comes of its own order, so that a search along that takes nothing back."""
        for _ in range(MOST_SETTLING):
            again = self.along(itinerary.tour(itinerary.own))
            if again is None:
                break
            settled = again.texts == itinerary.texts
            itinerary = again
            if settled:
                break
        return itinerary
