"""What sequences of motions are expected to cost, over attitudes at which each can end."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from task_planner_node.oracle import Advice, AdviceQuery, Token
from task_planner_node.search.advice import MOST_ADVISED
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Itinerary
from task_planner_node.search.partial_plan import Whereabouts
from task_planner_node.search.robots import anywhere

Row = NDArray[np.float64]
# Places of each text.
PLACES = 8


class Lengths:
    """Expected lengths [m] of sequences of texts, by the places that advice tells.

    Each robot has a way of its own: through places in the order of its texts, each way the shortest one over the
    places of the texts between.  Texts without a place are left out: where they are met is not known yet.
    """

    def __init__(self, texts: Sequence[str], advice: Advice, narrow: Collection[int] = ()) -> None:
        """``advice`` is on the ``texts``; of the ``narrow`` ones only the first place counts."""
        members: dict[int, list[int]] = {}
        for number, place in enumerate(advice.places):
            if place.candidate not in narrow or place.candidate not in members:
                members.setdefault(place.candidate, []).append(number)
        known = sorted(members)
        widest = max(map(len, members.values()), default=1)
        self.indices = {texts[candidate]: index for index, candidate in enumerate(known)}
        lengths = np.array(advice.place_lengths).reshape(len(advice.places) + 1, -1)
        # Rows of places, the last one repeated where a text has fewer than others.
        rows = [[*members[c], *[members[c][-1]] * (widest - len(members[c]))] for c in known]
        numbers = np.array(rows, np.intp).reshape(-1, widest)
        self._first = lengths[0][numbers]
        self._between = lengths[1:][numbers[:, :, None, None], numbers[None, None]].transpose(
            0, 2, 1, 3
        )
        # Driving from a place of a text to another one of the same text: nobody has to.
        same = np.where(np.eye(widest, dtype=np.bool_), 0.0, np.inf)
        for index in range(len(known)):
            self._between[index, index] = same
        finite = np.isfinite(self._between).any(axis=(2, 3))
        self._robots = _grouped(finite | finite.T)

    def of(self, sequences: NDArray[np.intp]) -> Row:
        """The expected lengths (m,) of sequences (m, n) of indices, negative ones for none."""
        total = np.zeros(len(sequences))
        for robot in range(int(self._robots.max(initial=-1)) + 1):
            total += self._way(sequences, robot)
        return total

    def expected(self, texts: Sequence[str]) -> float:
        """The expected length [m] of meeting texts one after the other."""
        return float(self.of(self.numbered(texts)[None, :])[0])

    def numbered(self, texts: Sequence[str]) -> NDArray[np.intp]:
        """The indices of texts, -1 for those that nothing is known of."""
        return np.array([self.indices.get(text, -1) for text in texts], np.intp)

    def apart(self, met: str | None, texts: Sequence[str]) -> list[float]:
        """The least expected lengths [m] from a place of ``met`` to ``texts``; from where the robot stands at first.

        0 for what nothing is known of; from where it stands at first for what another robot meets.
        """
        here = self.indices.get(met, -1) if met is not None else -1
        found = []
        for index in self.numbered(texts):
            if index < 0:
                found.append(0.0)
            elif here >= 0 and self._robots[here] == self._robots[index]:
                found.append(float(self._between[here, index].min()))
            else:
                found.append(float(self._first[index].min()))
        return found

    def _way(self, sequences: NDArray[np.intp], robot: int) -> Row:
        """What one robot drives in each."""
        reached = np.zeros((len(sequences), self._first.shape[1] if len(self._first) else 1))
        before = np.full(len(sequences), -1)
        for column in sequences.T:
            own = (column >= 0) & (self._robots[column] == robot)
            began = own & (before < 0)
            reached[began] = self._first[column[began]]
            on = np.flatnonzero(own & ~began)
            ways = self._between[before[on], column[on]] + reached[on][:, :, None]
            reached[on] = ways.min(axis=1)
            before[own] = column[own]
        return np.asarray(np.where(before < 0, 0.0, reached.min(axis=1)))


def _grouped(together: NDArray[np.bool_]) -> NDArray[np.intp]:
    """A number for each text, the same for all that one robot meets."""
    robots = np.arange(len(together))
    for one, other in np.argwhere(together):
        robots[robots == max(robots[one], robots[other])] = min(robots[one], robots[other])
    return np.asarray(np.unique(robots, return_inverse=True)[1], np.intp)


def expected_lengths(
    geometry: Geometry,
    where: Whereabouts,
    itinerary: Itinerary,
    alternatives: Mapping[str, Sequence[str]],
    ends: Mapping[str, Token],
) -> Lengths | None:
    """What lies between all that ``itinerary`` meets, or could have met; None where nothing is known.

    ``ends`` are attitudes at which texts are known to be met.  Of what is open, nothing else is known: the motion
    planner is asked for a place where nothing has to hold.
    """
    unknown = {text for index, text in enumerate(itinerary.texts) if index in itinerary.open}
    met = [text for text in itinerary.texts if text not in unknown or text in ends]
    others = [text for texts in alternatives.values() for text in texts if text not in unknown]
    texts = tuple(dict.fromkeys([*met, *others]))[:MOST_ADVISED]
    asked = [anywhere(text) if text in unknown else text for text in texts]
    known = tuple([ends.get(text) for text in texts]) if ends else ()
    query = AdviceQuery(where.start, tuple(asked), places=PLACES, ends=known)
    advice = geometry.advise(query, where.lineage)
    count = len(advice.places)
    numbered = all(0 <= place.candidate < len(texts) for place in advice.places)
    if not count or not numbered or len(advice.place_lengths) != (count + 1) * count:
        return None
    return Lengths(texts, advice, [index for index, text in enumerate(texts) if text in unknown])
