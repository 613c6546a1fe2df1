"""What the motion planner advises on the order of motions, and what is remembered of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from task_planner_node.oracle import INVALID_CODES, Advice, AdviceQuery, Purpose, Token
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.partial_plan import Whereabouts
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


def _stops(wanted: Sequence[str], advice: Advice) -> dict[str, Stop]:
    faulty = [i for i, c in enumerate(advice.candidates) if c.code in INVALID_CODES]
    advised = [i for i in advice.order if 0 <= i < len(wanted)]
    order = dict.fromkeys([*faulty, *advised, *range(len(wanted))])
    ends = advice.ends if len(advice.ends) == len(wanted) else [None] * len(wanted)
    return {wanted[i]: Stop(wanted[i], ends[i]) for i in order}
