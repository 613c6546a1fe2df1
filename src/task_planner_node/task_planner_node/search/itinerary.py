"""The motions of a plan as stops, and other orders of them as tours to search along."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import Answer, Opportunity, Token
from task_planner_node.search.network import Task
from task_planner_node.search.partial_plan import Expansion, Motion
from task_planner_node.search.plans import Plan
from task_planner_node.search.precedences import Pair, Precedences
from task_planner_node.search.tours import Stop, Tour

# Indices of stops, with the attitude to meet each at.
Order = Sequence[tuple[int, 'Token | None']]


@dataclass(frozen=True, eq=False)
class Itinerary:
    """The stops of a plan, in its order; ``root`` is the network of the problem."""

    plan: Plan
    root: TaskNetwork
    recursive: frozenset[str]

    @cached_property
    def _places(self) -> tuple[int, ...]:
        return tuple(
            [
                place
                for place, expansion in enumerate(self.plan.log)
                if expansion.motion is not None and expansion.motion.answer is not None
            ]
        )

    @cached_property
    def motions(self) -> tuple[Motion, ...]:
        """What was asked and answered for each stop."""
        motions = [self.plan.log[place].motion for place in self._places]
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
    def runs(self) -> tuple[range, ...]:
        """Stops between attitudes that were assigned, which stay where they are."""
        fixed = [-1, *(i for i, a in enumerate(self.answers) if a.assigned), len(self.answers)]
        runs = [range(one + 1, other) for one, other in pairwise(fixed)]
        return tuple([run for run in runs if run])

    def precedences(self, strict: bool) -> list[Pair]:
        """Pairs of stops, of which the first has to be made before the second."""
        stops = {place: index for index, place in enumerate(self._places)}
        return Precedences(self.plan, stops, self.root, self.recursive, strict).find()

    def tour(self, order: Order) -> Tour:
        """The tour that makes the stops in another order."""
        stops = [Stop(self.motions[index].preconditions, end) for index, end in order]
        made_for: dict[int, list[int]] = {}
        tasks: dict[int, Task] = {}
        for position, (index, _) in enumerate(order):
            expansion: Expansion | None = self.plan.log[self._places[index]]
            while expansion is not None:
                made_for.setdefault(id(expansion), []).append(position)
                tasks[id(expansion)] = expansion.task
                expansion = expansion.parent
        # A task that was done several times is one: whichever comes next does it.
        indices: dict[Task, list[int]] = {}
        for key, positions in made_for.items():
            indices.setdefault(tasks[key], []).extend(positions)
        return Tour(stops, {task: sorted(set(p)) for task, p in indices.items()}, lasting=True)

    def with_opportunities(
        self, found: Iterable[tuple[int, Opportunity]], texts: Sequence[str]
    ) -> tuple[Order, int]:
        """The order that meets later stops on the way of earlier ones, and how many of them there are.

        Each opportunity comes with the stop to which its motion leads, and its candidate is one of ``texts``.
        """
        waiting: dict[int, set[int]] = {}
        for one, other in self.precedences(strict=True):
            waiting.setdefault(other, set()).add(one)
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
                and not any(leading <= before < index for before in waiting.get(index, ()))
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


def _by(place: tuple[float, int, Token]) -> tuple[float, int]:
    return place[:2]
