"""A first plan, then better ones as long as some are found, then the cheapest."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import Purpose, Token
from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.engine import Search
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.improving import Improvement
from task_planner_node.search.outlook import Outlook
from task_planner_node.search.partial_plan import Limits
from task_planner_node.search.plans import Plan, Plans
from task_planner_node.search.rehearsal import Rehearsal
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.tours import Following, Tour

# Choices that a search along tours takes back until one begins that tries the nearest motions first.
PATIENCE = 300


class Anytime:
    """The searches of one mission, all with the same memory of answers.

    ``search`` is the one that tells whether there is a plan, ``running`` the one that runs and ``state`` its facts.
    With ``root``, the tasks of the problem, plans are improved along the motion planner's proposals.

    A tour knows nothing of the facts: where it leads into many dead ends, another order may lead to a plan at once.
    So a first search along tours that took back too much is left for one that goes to the nearest first.
    """

    def __init__(
        self,
        domain: CompiledDomain,
        beginning: Start,
        root: TaskNetwork | None,
        state: State,
        geometry: Geometry,
        statistics: Statistics,
        limits: Limits,
        plans: Plans,
        check: Callable[[], None],
    ) -> None:
        self._domain = domain
        self._beginning = beginning
        self._root = root
        self._geometry = geometry
        self._statistics = statistics
        self._limits = limits
        self._plans = plans
        self._check = check
        self.state = state
        self._improves = (
            root is not None
            and domain.geometric
            and limits.use_advice
            and limits.purpose == Purpose.SHORTEST_TOUR
            and (limits.optimise or limits.plans == 1)
        )
        first = limits
        if self._improves:
            first = replace(limits, optimise=False, plans=1, most_backtracks=PATIENCE)
        self.search = self.running = self._search(first, self._first_plans(first))

    def run(self, start: Token) -> None:
        """Search; the plans are left in ``plans``.  Raises what Search.run raises."""
        self.search.run(start)
        if self.search.gave_up:
            self._begin_anew(start)
        if not self._improves or self._plans.best is None:
            return
        root = self._root
        assert root is not None

        def follow(tour: Tour, limits: Limits, bound: float) -> Plan | None:
            return self._follow(start, tour, limits, bound)

        improvement = Improvement(
            self._domain,
            root,
            self._geometry,
            self._statistics,
            self._plans,
            self._limits,
            follow,
            self._rehearsal(self.state.initial(), start),
        )
        improvement.once()
        if not self._limits.optimise:
            return
        improvement.rounds()
        self.state = self.state.initial()
        # What bounds the rest of a plan is known wherever the nearest motions were asked for.
        nearest = replace(self._limits, purpose=Purpose.NEAREST_FIRST)
        self.search = self.running = self._search(nearest, self._plans)
        self.search.run(start)

    def _begin_anew(self, start: Token) -> None:
        """Search for the first plan once more, without a limit and the nearest motions first."""
        limits = replace(self._limits, optimise=False, plans=1, purpose=Purpose.NEAREST_FIRST)
        self.state = self.state.initial()
        self.search = self.running = self._search(limits, self._first_plans(limits))
        self.search.run(start)

    def _first_plans(self, limits: Limits) -> Plans:
        """Where the first plan is left."""
        return Plans(limits, self._plans.keep) if self._improves else self._plans

    def _rehearsal(self, state: State, start: Token = ()) -> Rehearsal:
        """The rehearsal of the whole mission."""
        return Rehearsal(
            self._domain,
            self._beginning,
            self._root,
            state,
            self._geometry,
            self._check,
            start,
            start,
        )

    def _search(self, limits: Limits, plans: Plans) -> Search:
        outlook = None
        toured = limits.use_advice and limits.purpose == Purpose.SHORTEST_TOUR
        if toured and limits.plans == 1 and not limits.optimise:
            outlook = Outlook(self._rehearsal(self.state))
        return Search(
            self._domain,
            self._beginning,
            self.state,
            self._geometry,
            self._statistics,
            limits,
            self._check,
            plans,
            outlook,
        )

    def _follow(self, start: Token, tour: Tour, limits: Limits, bound: float) -> Plan | None:
        """The first plan along a tour that costs less than ``bound``."""
        self.state = self.state.initial()
        plans = Plans(limits, lambda _: None, bound, first=True)
        self.running = self._search(limits, plans)
        self.running.run(start, Following(tour))
        return plans.best
