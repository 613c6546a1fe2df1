"""Which of several choices to try first: tasks that may come next, and ways to decompose one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

from task_planner_node.oracle import Purpose
from task_planner_node.search.advice import Advisor
from task_planner_node.search.domain import CompiledDomain, Fit, Start
from task_planner_node.search.geometry import Geometry, Request
from task_planner_node.search.guidance import leading_request
from task_planner_node.search.landmarks import Landmarks
from task_planner_node.search.methods import CompiledBranch
from task_planner_node.search.network import (
    Cell,
    Immediate,
    Network,
    Parallel,
    Path,
    Task,
    first_cells,
    urgent,
)
from task_planner_node.search.partial_plan import (
    Chosen,
    Limits,
    Moves,
    Position,
    Way,
    Whereabouts,
)
from task_planner_node.search.relaxation import no_definition_fits
from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame
from task_planner_node.search.tours import Following, Tour

if TYPE_CHECKING:
    from task_planner_node.search.engine import Search
    from task_planner_node.search.outlook import Outlook

# Ways to decompose a task that are put in order; the others come after them.
MOST_ORDERED = 64
Bindings = Iterator[tuple[CompiledBranch, Frame]]


class Candidates:
    """The order of choices: as the text has them, or as the motion planner advises."""

    def __init__(
        self,
        search: Search,
        domain: CompiledDomain,
        beginning: Start,
        state: State,
        geometry: Geometry,
        limits: Limits,
        outlook: Outlook | None,
    ) -> None:
        self._search = search
        self._domain = domain
        self._state = state
        self._geometry = geometry
        self._limits = limits
        self._outlook = outlook
        self._advisor = Advisor(geometry)
        self._landmarks = Landmarks(domain, beginning, state, geometry)

    def tasks(self, position: Position) -> Way:
        """The tasks that may come next, in the order to try."""
        if self._domain.geometric:
            return self._advised(position)
        network: Any = position[0]
        front, path = _front(network)
        chosen = _choosing(position, Chosen(front, path, focus=True))
        if not isinstance(front[0], Immediate):
            return self._in_order(position, chosen, first=not network[0].urgent)
        return chosen if network[0].urgent == 1 else self._in_order(position, chosen, first=True)

    def on_tour(self, position: Position) -> Position:
        """A position with the tour to follow, also where there is one task to go on with: where to end, it tells too."""
        network, where = position[:2]
        choice = network is None or isinstance(network[0], Parallel)
        if self._outlook is None or where.tour is not None or choice:
            return position
        tour = self._outlook.tour(position, self._search.log)
        return position if tour is None else _on_tour(position, Following(tour))

    def _in_order(self, position: Position, chosen: Position, first: bool) -> Moves:
        """All candidates, ``chosen`` before the others if it is the ``first``."""
        if first:
            yield chosen
        for part, path in urgent(first_cells(position[0]))[first:]:
            yield _choosing(position, Chosen(part, path, focus=True))

    def _advised(self, position: Position) -> Moves:
        network, where, focused = position[0], position[1], position[5]
        candidates = urgent(first_cells(network))
        for part, path in candidates:
            task = part[0]
            if task[0] in self._domain.operators:
                continue
            fit = self._domain.fit(task)
            if fit is Fit.NONE:
                reason = no_definition_fits(task, primitive=False)
                self._search.dead_ends.add(task, 'head', reason)
                return
            if fit is Fit.CERTAIN:
                # What it decomposes into depends on nothing that another task could change.
                yield _choosing(position, Chosen(part, path, focus=False))
                return
        if focused or len(candidates) == 1:
            yield _choosing(position, Chosen(*candidates[0], focus=True))
            candidates = candidates[1:]
        version = self._geometry.version
        ordered = self._best_first(position, candidates, ask=not focused)
        if self._is_too_long(position):
            self._search.placed += 1
            return
        if self._geometry.version != version:
            yield ()
        for tried, (index, tour) in enumerate(ordered):
            if tried == 1:
                requests = [self._leading(where, part) for part, _ in candidates]
                self._geometry.ask_together([request for request in requests if request])
            there = position if tour is where.tour else _on_tour(position, tour)
            yield _choosing(there, Chosen(*candidates[index], focus=True))

    def bindings(self, position: Position, found: Bindings) -> tuple[Position, Bindings]:
        """Ways to decompose a task, the best ones first, unless the text sorts them; and where to go on from.

        The best ones are those that the tour meets, or else those with the nearest first motions.
        """
        if not (self._domain.geometric and self._limits.use_advice):
            return position, found
        first = [(branch, frame.copy()) for branch, frame in islice(found, MOST_ORDERED)]
        if len(first) < 2 or any(branch.sorted for branch, _ in first):
            return position, chain(first, found)
        position = self.on_tour(position)
        where = position[1]
        requests = [
            self._leading(where, branch.grow(frame.copy(), None, None)) for branch, frame in first
        ]
        ordered = [first[i] for i in self._best_bindings(where, requests)]
        return position, chain(ordered, found)

    def _is_too_long(self, position: Position) -> bool:
        """Whether no better plan than those known can come of a position, as far as advice tells."""
        tour = position[1].tour
        if not self._limits.optimise or (tour is not None and tour.tour.lasting):
            return False
        network, where, cost, rest_cost, _, _, _ = position
        least = self._landmarks.least_length(where.start, where.met, network)
        return cost + rest_cost + least >= self._search.plans.bound

    def _leading(self, where: Whereabouts, network: Network) -> Request | None:
        if not self._limits.use_advice:
            return None
        return leading_request(self._domain, self._state, network, where)

    def _best_first(
        self, position: Position, candidates: Sequence[tuple[Cell, Path]], ask: bool
    ) -> list[tuple[int, Following | None]]:
        """The indices of tasks in the order to try, each with the tour to follow if it is chosen."""
        parts = [part for part, _ in candidates]
        where = position[1]
        tour = where.tour
        if tour is not None and tour.tour.lasting:
            return [(i, tour) for i in _sorted([tour.place(part) for part in parts])]
        if tour is not None and tour.covers(parts):
            order = _sorted([tour.place(part) for part in parts])
            if tour.tour.complete:
                return _first_on(tour, order)
            first = parts[order[0]]
            request = self._leading(where, first)
            if request is not None and tour.stop(request.text) == tour.place(first):
                return _first_on(tour, order)
        complete = self._outlook.tour(position, self._search.log) if self._outlook and ask else None
        if complete is not None:
            ahead_of_all = Following(complete)
            return _first_on(ahead_of_all, _sorted([ahead_of_all.place(part) for part in parts]))
        requests = [self._leading(where, part) for part in parts]
        wanted = [request.text for request in requests if request is not None]
        stops = self._advisor.order(self._limits.purpose, where, wanted, ask) if wanted else {}
        places = {text: place for place, text in enumerate(stops)}
        ahead: dict[Task | int, list[int]] = {}
        ranks: list[int | None] = []
        for part, request in zip(parts, requests, strict=True):
            text = request.text if request is not None else _expected(tour, part)
            rank = places.get(text) if text is not None else None
            ahead[part[4]] = [rank] if rank is not None else []
            ranks.append(rank)
        fresh = Following(Tour(list(stops.values()), ahead, lasting=False)) if stops else None
        return _first_on(fresh, _sorted(ranks))

    def _best_bindings(
        self, where: Whereabouts, requests: Sequence[Request | None]
    ) -> Sequence[int]:
        """The indices of ways to decompose a task, in the order to try."""
        tour = where.tour
        if tour is not None and (tour.tour.lasting or tour.tour.complete):
            places = [tour.stop(r.text) if r is not None else None for r in requests]
            if any(place is not None for place in places):
                # What the tour does not meet comes last.
                return sorted(range(len(places)), key=lambda i: (places[i] is None, places[i] or 0))
        texts = [request.text for request in requests if request is not None]
        if not texts:
            return range(len(requests))
        stops = self._advisor.order(Purpose.NEAREST_FIRST, where, texts, ask=True)
        ranks = {text: place for place, text in enumerate(stops)}
        return _sorted([ranks.get(r.text) if r is not None else None for r in requests])


def _front(network: Network) -> tuple[Cell, Path]:
    """The first of the tasks that may come next."""
    path: list[int] = []
    part: Any = network
    while isinstance(part[0], Parallel):
        index = part[0].open()[0]
        path.append(index)
        part = part[0].branches[index]
    return part, tuple(path)


def _choosing(position: Position, chosen: Chosen) -> Position:
    return (*position[:6], chosen)


def _on_tour(position: Position, tour: Following | None) -> Position:
    return (position[0], replace(position[1], tour=tour), *position[2:])


def _expected(tour: Following | None, part: Cell) -> str | None:
    """What a branch will lead to once something else is done, as far as a tour tells."""
    place = tour.place(part) if tour is not None else None
    return tour.tour.stops[place].text if tour is not None and place is not None else None


def _first_on(tour: Following | None, order: Sequence[int]) -> list[tuple[int, Following | None]]:
    """The first candidate follows the tour; what is tried instead of it leads away from it."""
    return [(index, None if place else tour) for place, index in enumerate(order)]


def _sorted(places: Sequence[int | None]) -> list[int]:
    """The indices of the places in ascending order; those without a place stay where they are."""
    known = [index for index, place in enumerate(places) if place is not None]
    order = list(range(len(places)))
    for target, source in zip(known, sorted(known, key=lambda i: places[i] or 0), strict=True):
        order[target] = source
    return order
