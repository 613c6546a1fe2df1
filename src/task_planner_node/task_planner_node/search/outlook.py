"""A tour through all that is left to do: which motions these are, the facts tell; in which order and where, advice."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from task_planner_node.oracle import Purpose, Token
from task_planner_node.search.advice import tour_through
from task_planner_node.search.arranging import MOST_ARRANGED, Arranging
from task_planner_node.search.itinerary import Itinerary, Order, without_ends
from task_planner_node.search.lengths import expected_lengths
from task_planner_node.search.partial_plan import Expansion, Position, Whereabouts
from task_planner_node.search.precedences import Pair, without
from task_planner_node.search.rehearsal import Rehearsal, Rest
from task_planner_node.search.tours import Tour

# How often an order is searched for from positions of one search.
MOST_SEARCHES = 3
# Tours that are looked for in one search: where it steps back often, others are as good.
MOST_TOURS = 30


class Outlook:
    """Tours from positions of one search.

    The shortest tour of all motions that are left knows nothing of the facts.  Where a rehearsal cannot follow it, or
    could have met something else, an order is searched for among those that can be rehearsed.
    """

    def __init__(self, rehearsal: Rehearsal) -> None:
        """``rehearsal`` is that of the whole mission, with the state of the search."""
        self._whole = rehearsal
        self._geometry = rehearsal.known
        self._searches = 0
        self._known: dict[tuple[int, Token, int], Tour | None] = {}

    def tour(self, position: Position, done: Sequence[Expansion]) -> Tour | None:
        """The tour from a position, ``done`` being the log up to there; None where none is known."""
        network, where = position[:2]
        key = (self._whole.state.key, where.start, network[4] if network is not None else 0)
        if key not in self._known:
            many = len(self._known) >= MOST_TOURS
            self._known[key] = None if many else self._tour(position, done)
        return self._known[key]

    def _tour(self, position: Position, done: Sequence[Expansion]) -> Tour | None:
        where = position[1]
        rehearsal = self._rehearsal(position, done)
        first = rehearsal.along()
        if first is None or len(first.first) < 2:
            return None
        order = None
        if len(first.texts) > MOST_ARRANGED or rehearsal.is_free(first):
            version = self._geometry.version
            order = self._shortest(first, where)
            tour = _followed(first, order, rehearsal) if order is not None else None
            if tour is not None or self._geometry.version != version:
                return tour
        return self._arranged(first, order, rehearsal, where)

    def _rehearsal(self, position: Position, done: Sequence[Expansion]) -> Rehearsal:
        network, where = position[:2]
        return replace(
            self._whole,
            beginning=Rest(network, self._whole.beginning),
            start=where.start,
            lineage=where.lineage,
            done=tuple(done),
            alternatives={},
        )

    def _shortest(self, itinerary: Itinerary, where: Whereabouts) -> Order | None:
        """The stops that something is known of, as the shortest tour has them."""
        pairs = without(itinerary.open, itinerary.precedences(strict=False))
        return self._toured(itinerary, where, Purpose.SHORTEST_TOUR, pairs)

    def _toured(
        self, itinerary: Itinerary, where: Whereabouts, purpose: Purpose, pairs: Iterable[Pair] = ()
    ) -> Order | None:
        """The stops in the order of the tour that is advised, without those that it does not reach or that are open."""
        stops = [(index, None) for index in itinerary.first if index not in itinerary.open]
        if len(stops) < 2:
            return None
        order = tour_through(self._geometry, where, itinerary.texts, stops, purpose, pairs)
        return [stop for stop in order or () if stop[1] is not None] or None

    def _arranged(
        self, first: Itinerary, proposed: Order | None, rehearsal: Rehearsal, where: Whereabouts
    ) -> Tour | None:
        """A tour in an order that can be rehearsed, if need be the one that comes of what was ``proposed``."""
        found = first
        lengths = None
        if len(first.texts) <= MOST_ARRANGED and self._searches < MOST_SEARCHES:
            self._searches += 1
            version = self._geometry.version
            lengths = expected_lengths(self._geometry, where, first, rehearsal.alternatives, {})
            if self._geometry.version != version:
                # Something is impossible.
                again = rehearsal.along()
                if again is None:
                    return None
                found = first = again
        if lengths is not None:
            nearest = rehearsal.nearest_first(lengths.apart)
            starts = [first] if nearest is None else [first, nearest]
            found = min(starts, key=lambda start: lengths.expected(start.texts))
            arranging = Arranging(rehearsal.along, lengths, rehearsal.alternatives, seed=0)
            found = arranging.best(found)
        elif proposed is not None:
            found = rehearsal.along(first.tour(without_ends(proposed))) or first
        found = rehearsal.settled(found)
        order = self._toured(found, where, Purpose.FIXED_ORDER)
        if order is None and lengths is None:
            return None
        ends = dict(order or ())
        return found.tour([(index, ends.get(index)) for index in found.first], complete=True)


def _followed(itinerary: Itinerary, order: Order, rehearsal: Rehearsal) -> Tour | None:
    """The tour in an order of some stops, with all others where they come; None where it cannot be followed."""
    found = rehearsal.along(itinerary.tour(without_ends(order)))
    if found is None:
        return None
    known = [(index, found.texts[index]) for index in found.first if index not in found.open]
    if [text for _, text in known] != [itinerary.texts[index] for index, _ in order]:
        return None
    ends = {index: end for (index, _), (_, end) in zip(known, order, strict=True)}
    return found.tour([(index, ends.get(index)) for index in found.first], complete=True)
