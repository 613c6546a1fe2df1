"""What the motion planner advises on the order of motions, and what is remembered of it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from task_planner_node.oracle import INVALID_CODES, Advice, AdviceQuery, Purpose, Token
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Order
from task_planner_node.search.partial_plan import Whereabouts
from task_planner_node.search.precedences import Pair
from task_planner_node.search.tours import Stop

MOST_ADVISED = 1000


class Advisor:
    """Asks for an order of ground texts, once for each purpose and start."""

    def __init__(self, geometry: Geometry) -> None:
        self._geometry = geometry
        self._known: dict[tuple[Purpose, Token], dict[str, Stop]] = {}

    def order(
        self, purpose: Purpose, where: Whereabouts, texts: Sequence[str], ask: bool
    ) -> Mapping[str, Stop]:
        """The stops to make, in the order to try, by ground text; asked for where one is not known.

        With ``ask`` False only what is known already counts.  Texts that the motion planner cannot work on come
        first of all, so that their fault is told at once.  Where it knows of no tour it is asked for the
        nearest ones.
        """
        known = self._known.get((purpose, where.start), {})
        wanted = tuple(dict.fromkeys(texts))[:MOST_ADVISED]
        if not ask or len(wanted) < 2 or all(text in known for text in wanted):
            return known
        advice = self._geometry.advise(AdviceQuery(where.start, wanted, purpose), where.lineage)
        if purpose != Purpose.NEAREST_FIRST and not advice.candidates:
            return self.order(Purpose.NEAREST_FIRST, where, texts, ask)
        stops = self._known[purpose, where.start] = _stops(wanted, advice)
        return stops


def tour_through(
    geometry: Geometry,
    where: Whereabouts,
    texts: Sequence[str],
    stops: Order,
    purpose: Purpose,
    pairs: Iterable[Pair] = (),
    effort: int = 0,
) -> Order | None:
    """The ``stops``, whose ground texts are told by index, in the order and with the attitudes that are advised.

    Of ``pairs`` of indices the first comes before the second; those of other stops count for nothing.  A stop whose
    attitude is not advised keeps its own.  None where there are too many stops, or where no tour is known.
    """
    if not 1 <= len(stops) <= MOST_ADVISED:
        return None
    places = {index: number for number, (index, _) in enumerate(stops)}
    query = AdviceQuery(
        where.start,
        tuple([texts[index] for index, _ in stops]),
        purpose,
        tuple([(places[a], places[b]) for a, b in pairs if a in places and b in places]),
        tuple([end for _, end in stops]) if any(end is not None for _, end in stops) else (),
        effort,
    )
    advice = geometry.advise(query, where.lineage)
    if sorted(advice.order) != list(range(len(stops))):
        return None
    ends = advice.ends if len(advice.ends) == len(stops) else [None] * len(stops)
    return [(stops[n][0], ends[n] if ends[n] is not None else stops[n][1]) for n in advice.order]


def _stops(wanted: Sequence[str], advice: Advice) -> dict[str, Stop]:
    faulty = [i for i, c in enumerate(advice.candidates) if c.code in INVALID_CODES]
    advised = [i for i in advice.order if 0 <= i < len(wanted)]
    order = dict.fromkeys([*faulty, *advised, *range(len(wanted))])
    ends = advice.ends if len(advice.ends) == len(wanted) else [None] * len(wanted)
    return {wanted[i]: Stop(wanted[i], ends[i]) for i in order}
