"""Tours: an order of motions with the attitudes to end at, and how far one was followed."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from task_planner_node.oracle import Answer, Token
from task_planner_node.search.network import Cell, Task


@dataclass(frozen=True, slots=True)
class Stop:
    """Ground preconditions to be met on a tour, and the attitude to meet them at, if one is known."""

    text: str
    end: Token | None = None


class Tour:
    """Stops in their order, each of which may come up several times.

    ``purposes`` has the indices, ascending, of the stops that are made for a task, or for all that is left to do of a
    branch, by the key of that network.  A ``lasting`` tour is followed as far as that goes, any other one is given up
    once the search leaves it.
    """

    def __init__(
        self, stops: Sequence[Stop], purposes: Mapping[Task | int, Sequence[int]], lasting: bool
    ) -> None:
        self.stops = stops
        self.lasting = lasting
        self._purposes = purposes
        self._texts: dict[str, list[int]] = {}
        for index, stop in enumerate(stops):
            self._texts.setdefault(stop.text, []).append(index)

    def stops_for(self, part: Cell) -> Sequence[int] | None:
        """The stops for what a branch begins with, ascending; None where the tour does not know it.

        An operator for which there is none is done when the task that it belongs to is.
        """
        task, _, parent, _, key = part
        above: Task = parent.task if parent is not None else ()
        for purpose in (key, task, above):
            if purpose in self._purposes:
                return self._purposes[purpose]
        return None

    def of_text(self, text: str) -> Sequence[int]:
        """The stops at which ``text`` is met, ascending."""
        return self._texts.get(text, ())


@dataclass(frozen=True, slots=True, eq=False)
class Following:
    """A tour of which all stops before ``first``, and those in ``done``, were made."""

    tour: Tour
    first: int = 0
    done: frozenset[int] = frozenset()

    def place(self, part: Cell) -> int | None:
        """The next stop for what a branch begins with."""
        stops = self.tour.stops_for(part)
        return self._ahead(stops) if stops else None

    def stop(self, text: str) -> int | None:
        """The next stop at which ``text`` is met."""
        return self._ahead(self.tour.of_text(text))

    def covers(self, parts: Sequence[Cell]) -> bool:
        """Whether the tour says when to do each of what may come next, or that it makes no stop for it."""
        known = [self.tour.stops_for(part) for part in parts]
        return any(known) and all(
            stops is not None and (not stops or self._ahead(stops) is not None) for stops in known
        )

    def end(self, text: str) -> Token | None:
        """The attitude at which the tour meets ``text``."""
        index = self.stop(text)
        return None if index is None else self.tour.stops[index].end

    def after(self, text: str, answer: Answer) -> Following | None:
        """What is left of the tour after a motion that met ``text``; None when that led away from it."""
        index = self.stop(text)
        if not self.tour.lasting and (index is None or not answer.as_preferred):
            return None
        if index is None:
            return self
        done = self.done | {index}
        first = self.first
        while first in done:
            first += 1
        return Following(self.tour, first, frozenset(i for i in done if i > first))

    def _ahead(self, stops: Sequence[int]) -> int | None:
        for place in range(bisect_left(stops, self.first), len(stops)):
            if stops[place] not in self.done:
                return stops[place]
        return None
