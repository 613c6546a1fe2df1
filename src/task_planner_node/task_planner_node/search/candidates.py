"""Which of several choices to try first: tasks that may come next, and ways to decompose one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain, islice
from typing import TYPE_CHECKING, Any, TypeVar

from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.geometry import Geometry, Request
from task_planner_node.search.guidance import leading_request
from task_planner_node.search.landmarks import Landmarks
from task_planner_node.search.methods import CompiledBranch, CompiledMethod
from task_planner_node.search.network import (
    Cell,
    Immediate,
    Network,
    Parallel,
    Path,
    Task,
    cell,
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
from task_planner_node.search.unbound import ground

if TYPE_CHECKING:
    from task_planner_node.search.engine import Search

# Ways to decompose a task that are put in order; the others come after them.
MOST_ORDERED = 64
T = TypeVar('T')
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
    ) -> None:
        self._search = search
        self._domain = domain
        self._state = state
        self._geometry = geometry
        self._limits = limits
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
            fitting = self._fitting(task)
            if not fitting:
                reason = no_definition_fits(task, primitive=False)
                self._search.dead_ends.add(task, 'head', reason)
                return
            if len(fitting) == 1 and fitting[0].unconditional:
                # What it decomposes into depends on nothing that another task could change.
                yield _choosing(position, Chosen(part, path, focus=False))
                return
        if focused or len(candidates) == 1:
            yield _choosing(position, Chosen(*candidates[0], focus=True))
            candidates = candidates[1:]
        version = self._geometry.version
        requests = [self._leading(where, cell(part[0], None)) for part, _ in candidates]
        ordered = self._best_first(where, candidates, requests, ask=not focused)
        if self._is_too_long(position):
            return
        if self._geometry.version != version:
            yield ()
        for tried, (part, path) in enumerate(ordered):
            if tried == 1:
                self._geometry.ask_together([request for request in requests if request])
            yield _choosing(position, Chosen(part, path, focus=True))

    def bindings(self, where: Whereabouts, found: Bindings) -> Bindings:
        """Ways to decompose a task, those with the nearest first motions first, unless the text sorts them."""
        if not (self._domain.geometric and self._limits.use_advice):
            return found
        first = [(branch, frame.copy()) for branch, frame in islice(found, MOST_ORDERED)]
        if len(first) < 2 or any(branch.sorted for branch, _ in first):
            return chain(first, found)
        requests = [
            self._leading(where, branch.grow(frame.copy(), None, None)) for branch, frame in first
        ]
        return chain(self._best_first(where, first, requests, ask=True), found)

    def _is_too_long(self, position: Position) -> bool:
        """Whether no better plan than those known can come of a position, as far as advice tells."""
        if not self._limits.optimise:
            return False
        network, where, cost, rest_cost, _, _, _ = position
        least = self._landmarks.least_length(where.start, where.met, network)
        return cost + rest_cost + least >= self._search.plans.bound

    def _leading(self, where: Whereabouts, network: Network) -> Request | None:
        if not self._limits.use_advice:
            return None
        return leading_request(self._domain, self._state, network, where)

    def _best_first(
        self,
        where: Whereabouts,
        choices: Sequence[T],
        requests: Sequence[Request | None],
        ask: bool,
    ) -> list[T]:
        """Choices whose first motion is known change places among themselves, the others stay."""
        texts = [request.text for request in requests if request is not None]
        ranks = self._geometry.ranks(where.start, where.lineage, texts, ask) if texts else {}
        rank = {i: ranks[r.text] for i, r in enumerate(requests) if r and r.text in ranks}
        ordered = list(choices)
        for place, chosen in zip(rank, sorted(rank, key=rank.__getitem__), strict=True):
            ordered[place] = choices[chosen]
        return ordered

    def _fitting(self, task: Task) -> list[CompiledMethod]:
        if ground(task):
            methods = self._domain.methods.get(task[0], ())
            return [method for method in methods if method.bind(task) is not None]
        return self._domain.methods_for(task)


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
