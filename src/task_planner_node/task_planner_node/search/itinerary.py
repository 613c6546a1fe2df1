"""The motions of a plan as stops, and other orders of them as tours to search along."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import Answer, Opportunity, Token
from task_planner_node.search.network import Task
from task_planner_node.search.partial_plan import Expansion, Motion, origin_of
from task_planner_node.search.precedences import Pair, Precedences, waiting
from task_planner_node.search.robots import robots_of
from task_planner_node.search.tours import Stop, Tour

# Indices of stops, with the attitude to meet each at.
Order = Sequence[tuple[int, 'Token | None']]


@dataclass(frozen=True, eq=False)
class Itinerary:
    """The stops of a plan's ``log`` from entry ``since`` on, in its order.

    ``root`` is the network of the problem, None where the plan began with something else.
    """

    log: Sequence[Expansion]
    root: TaskNetwork | None
    recursive: frozenset[str]
    since: int = 0

    @cached_property
    def _places(self) -> tuple[int, ...]:
        return tuple(
            [
                place
                for place, expansion in enumerate(self.log)
                if place >= self.since
                and expansion.motion is not None
                and expansion.motion.answer is not None
            ]
        )

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """What was asked and answered for each stop."""
        motions = [self.log[place].motion for place in self._places]
        return tuple([motion for motion in motions if motion is not None])

    @cached_property
    def answers(self) -> tuple[Answer, ...]:
        """The answer for each stop."""
        return tuple([m.answer for m in self.motions if m.answer is not None])

    @cached_property
    def order(self) -> Order:
        """The stops as they are."""
        return [
            (index, None if answer.assigned else answer.attitude)
            for index, answer in enumerate(self.answers)
        ]

    @cached_property
    def own(self) -> Order:
        """The stops as they are, wherever they are met."""
        return [(index, None) for index in range(len(self._places))]

    @cached_property
    def runs(self) -> tuple[range, ...]:
        """Stops between attitudes that were assigned, which stay where they are."""
        fixed = [-1, *(i for i, a in enumerate(self.answers) if a.assigned), len(self.answers)]
        runs = [range(one + 1, other) for one, other in pairwise(fixed)]
        return tuple([run for run in runs if run])

    @cached_property
    def texts(self) -> tuple[str, ...]:
        """What is met at each stop."""
        return tuple([motion.preconditions for motion in self.motions])

    @cached_property
    def parts(self) -> tuple[tuple[int, ...], ...]:
        """The stops of each task that has several, ascending, but not all of them."""
        stops: dict[int, list[int]] = {}
        for index in range(len(self._places)):
            for expansion in self._above(index):
                stops.setdefault(id(expansion), []).append(index)
        several = {tuple(part) for part in stops.values() if 1 < len(part) < len(self._places)}
        return tuple(sorted(several))

    @cached_property
    def made_for(self) -> tuple[tuple[Task, ...], ...]:
        """The tasks that each stop is made for, its operator's first."""
        return tuple(
            [tuple([e.task for e in self._above(index)]) for index in range(len(self._places))]
        )

    @cached_property
    def open(self) -> frozenset[int]:
        """The stops that also depend on where another robot stands, which has to move before."""
        robots = [robots_of(text) for text in self.texts]
        earlier_ones = waiting(self.precedences(strict=True))
        found = set()
        for index, named in enumerate(robots):
            agenda, before = list(earlier_ones.get(index, ())), set()
            while agenda and len(named) > 1:
                earlier = agenda.pop()
                if earlier not in before:
                    before.add(earlier)
                    agenda.extend(earlier_ones.get(earlier, ()))
            if any(robots[earlier][:1] and robots[earlier][0] in named[1:] for earlier in before):
                found.add(index)
        return frozenset(found)

    @cached_property
    def first(self) -> range:
        """The stops before the first attitude that is assigned."""
        run = self.runs[0] if self.runs else range(0)
        return run if run.start == 0 else range(0)

    def _above(self, index: int) -> Iterator[Expansion]:
        """The tasks that a stop is made for, from its operator on."""
        expansion: Expansion | None = self.log[self._places[index]]
        while expansion is not None:
            yield expansion
            expansion = expansion.parent

    def precedences(self, strict: bool) -> list[Pair]:
        """Pairs of stops, of which the first has to be made before the second."""
        stops = {place: index for index, place in enumerate(self._places)}
        return Precedences(self.log, stops, self.root, self.recursive, strict).find()

    def tour(
        self, order: Order, texts: Mapping[int, str] | None = None, complete: bool = False
    ) -> Tour:
        """The tour that makes the stops in another order; ``texts`` are met instead of those of some stops.

        It is lasting, or else ``complete``.
        """
        instead = texts or {}
        stops = [Stop(instead.get(index, self.texts[index]), end) for index, end in order]
        tasks: dict[Task, set[int]] = {}
        origins: dict[int, set[int]] = {}
        for position, (index, _) in enumerate(order):
            for expansion in self._above(index):
                # A task that was done several times is one: whichever comes next does it.
                tasks.setdefault(expansion.task, set()).add(position)
                origins.setdefault(origin_of(expansion.task, expansion.parent), set()).add(position)
        return Tour(
            stops,
            {task: sorted(positions) for task, positions in tasks.items()},
            lasting=not complete,
            complete=complete,
            origins={origin: sorted(positions) for origin, positions in origins.items()},
        )

    def with_opportunities(
        self, found: Iterable[tuple[int, Opportunity]], texts: Sequence[str]
    ) -> tuple[Order, int]:
        """The order that meets later stops on the way of earlier ones, and how many of them there are.

        Each opportunity comes with the stop to which its motion leads, and its candidate is one of ``texts``.
        """
        earlier_ones = waiting(self.precedences(strict=True))
        stops: dict[str, list[int]] = {}
        for index, motion in enumerate(self.motions):
            stops.setdefault(motion.preconditions, []).append(index)
        run_of = {index: run for run in self.runs for index in run}
        moved: dict[int, list[tuple[float, int, Token]]] = {}
        taken: set[int] = set()
        for leading, opportunity in found:
            later = [
                index
                for index in stops.get(texts[opportunity.candidate], ())
                if index > leading
                and index not in taken
                and run_of.get(index) == run_of.get(leading)
                and not any(leading <= before < index for before in earlier_ones.get(index, ()))
            ]
            if later:
                taken.add(later[0])
                place = (opportunity.distance, later[0], opportunity.end)
                moved.setdefault(leading, []).append(place)
        order: list[tuple[int, Token | None]] = []
        for index, end in self.order:
            order += [(stop, on_way) for _, stop, on_way in sorted(moved.get(index, ()), key=_by)]
            if index not in taken:
                order.append((index, end))
        return order, len(taken)


def without_ends(order: Order) -> Order:
    """The same stops, wherever they are met."""
    return [(index, None) for index, _ in order]


def _by(place: tuple[float, int, Token]) -> tuple[float, int]:
    return place[:2]
