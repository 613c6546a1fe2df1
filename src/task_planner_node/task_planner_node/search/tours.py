"""Tours: an order of motions with the attitudes to end at, and how far one was followed."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from task_planner_node.oracle import Answer, Token
from task_planner_node.search.network import Cell, Task
from task_planner_node.search.partial_plan import origin_of

# How far up a task looks for one that the tour makes a stop for.
MOST_ABOVE = 8


@dataclass(frozen=True, slots=True)
class Stop:
    """Ground preconditions to be met on a tour, and the attitude to meet them at, if one is known."""

    text: str
    end: Token | None = None


class Tour:
    """Stops in their order, each of which may come up several times.

    ``purposes`` has the indices, ascending, of the stops that are made for a task, or for all that is left to do of a
    branch, by the key of that network; ``origins`` has those for a task by what it came from too (origin_of).  A
    ``lasting`` tour is followed as far as that goes, any other one is given up once the search leaves it.  A ``complete``
    one was rehearsed: it has all motions up to the end of the mission, or up to where an attitude is assigned.
    """

    def __init__(
        self,
        stops: Sequence[Stop],
        purposes: Mapping[Task | int, Sequence[int]],
        lasting: bool,
        complete: bool = False,
        origins: Mapping[int, Sequence[int]] | None = None,
    ) -> None:
        self.stops = stops
        self.lasting = lasting
        self.complete = complete
        self._purposes = purposes
        self._origins = origins or {}
        self._texts: dict[str, list[int]] = {}
        for index, stop in enumerate(stops):
            self._texts.setdefault(stop.text, []).append(index)

    def stops_for(self, part: Cell) -> Iterator[Sequence[int]]:
        """The stops for what a branch begins with, ascending, and then those for the tasks that it belongs to.

        Nothing where the tour does not know whether there are any.
        """
        first, _, belongs_to, _, key = part
        known = key in self._purposes
        if known:
            yield self._purposes[key]
        task, parent = first, belongs_to
        for _ in range(MOST_ABOVE if self._origins else 0):
            origin = origin_of(task, parent)
            if origin in self._origins:
                known = True
                yield self._origins[origin]
            if parent is None:
                break
            task, parent = parent.task, parent.parent
        if known:
            return
        # The same task may be done in another way, and an operator when the task that it belongs to is.
        for other in (first, belongs_to.task if belongs_to is not None else ()):
            if other in self._purposes:
                yield self._purposes[other]
                return

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
        for stops in self.tour.stops_for(part):
            ahead = self._ahead(stops)
            if ahead is not None:
                return ahead
        return None

    def stop(self, text: str) -> int | None:
        """The next stop at which ``text`` is met."""
        return self._ahead(self.tour.of_text(text))

    def covers(self, parts: Sequence[Cell]) -> bool:
        """Whether the tour says when to do each of what may come next, or that it makes no stop for it."""
        if self.tour.complete:
            return True
        known = [list(self.tour.stops_for(part)) for part in parts]
        return any(any(stops) for stops in known) and all(
            stops and (not any(stops) or self.place(part) is not None)
            for stops, part in zip(known, parts, strict=True)
        )

    def end(self, text: str) -> Token | None:
        """The attitude at which the tour meets ``text``."""
        index = self.stop(text)
        return None if index is None else self.tour.stops[index].end

    def after(self, text: str, answer: Answer) -> Following | None:
        """What is left of the tour after a motion that met ``text``; None when that led away from it."""
        index = self.stop(text)
        if not self.tour.lasting and not self._goes_on(index, answer):
            return None
        if index is None:
            return self
        done = self.done | {index}
        first = self.first
        while first in done:
            first += 1
        return Following(self.tour, first, frozenset(i for i in done if i > first))

    def _goes_on(self, index: int | None, answer: Answer) -> bool:
        """Whether a motion to a stop leaves the rest of the tour as it is."""
        if index is None:
            return False
        return answer.as_preferred or (self.tour.complete and self.tour.stops[index].end is None)

    def _ahead(self, stops: Sequence[int]) -> int | None:
        for place in range(bisect_left(stops, self.first), len(stops)):
            if stops[place] not in self.done:
                return stops[place]
        return None
