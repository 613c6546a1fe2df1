"""Shorter plans: what the motion planner proposes for a whole plan is searched along."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import AdviceQuery, Purpose, Token
from task_planner_node.search.advice import MOST_ADVISED
from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Itinerary, Order
from task_planner_node.search.partial_plan import Limits
from task_planner_node.search.plans import Plan, Plans
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.tours import Tour

# Rounds without a gain after which no more is expected, and rounds in all.
MOST_FRUITLESS = 3
MOST_ROUNDS = 16
# What a plan has to be cheaper, as a share of its cost.
LEAST_GAIN = 1e-4
# Requests and choices taken back while a proposal is searched along, beside those that each stop takes.
SPARE_REQUESTS = 8
SPARE_BACKTRACKS = 200
# Searches along a tour within limits, for a plan that costs less than a bound.
Follow = Callable[[Tour, Limits, float], 'Plan | None']


class Improvement:
    """Proposals for the best plan so far; those that the domain allows and that are cheaper are kept in ``plans``."""

    def __init__(
        self,
        domain: CompiledDomain,
        root: TaskNetwork,
        geometry: Geometry,
        statistics: Statistics,
        plans: Plans,
        limits: Limits,
        follow: Follow,
    ) -> None:
        self._domain = domain
        self._root = root
        self._geometry = geometry
        self._statistics = statistics
        self._plans = plans
        self._limits = limits
        self._follow = follow
        self._searched: Plan | None = None
        self._tried: set[object] = set()
        self._strict = False

    def rounds(self) -> None:
        """Improve the best plan until several rounds of growing effort gained nothing."""
        fruitless = 0
        for effort in range(1, MOST_ROUNDS + 1):
            before = self._plans.best
            self.take_opportunities()
            self._reorder(effort)
            self._move(effort)
            fruitless = 0 if self._plans.best is not before else fruitless + 1
            if fruitless == MOST_FRUITLESS:
                return

    def take_opportunities(self) -> None:
        """Meet what comes later on the way of earlier motions, where it is met there."""
        itinerary = self._itinerary()
        if itinerary is None or itinerary.plan is self._searched:
            return
        self._searched = itinerary.plan
        answers = itinerary.answers
        leading = [i for i, a in enumerate(answers) if not a.assigned and a.length > 0]
        texts = tuple(
            dict.fromkeys(itinerary.motions[i].preconditions for run in itinerary.runs for i in run)
        )[:MOST_ADVISED]
        if len(leading) < 2 or len(texts) < 2:
            return
        start = itinerary.motions[leading[0]].start
        advice = self._geometry.advise(
            AdviceQuery(
                start,
                texts,
                Purpose.OPPORTUNITIES,
                motions=tuple([answers[i] for i in leading]),
            ),
            start,
        )
        found = [
            (leading[opportunity.motion], opportunity)
            for opportunity in advice.opportunities
            if opportunity.motion < len(leading) and opportunity.candidate < len(texts)
        ]
        order, taken = itinerary.with_opportunities(found, texts)
        if taken and self._try(itinerary, order):
            wanted = [itinerary.motions[index].preconditions for index, _ in order]
            better = self._itinerary()
            if better and [motion.preconditions for motion in better.motions] == wanted:
                self._statistics.opportunities += taken

    def _reorder(self, effort: int) -> None:
        """Make the stops in a shorter order, with attitudes to suit."""
        itinerary = self._itinerary()
        if itinerary is None:
            return
        pairs = itinerary.precedences(self._strict)
        relaxed = not self._strict and pairs != itinerary.precedences(strict=True)
        gained = self._propose(itinerary, Purpose.SHORTEST_TOUR, pairs, effort)
        self._strict = self._strict or (relaxed and not gained)

    def _move(self, effort: int) -> None:
        """Keep the order, with attitudes that suit it better."""
        itinerary = self._itinerary()
        if itinerary is not None:
            self._propose(itinerary, Purpose.FIXED_ORDER, [], effort)

    def _propose(
        self,
        itinerary: Itinerary,
        purpose: Purpose,
        pairs: Sequence[tuple[int, int]],
        effort: int,
    ) -> bool:
        order = list(itinerary.order)
        for run in itinerary.runs:
            if 1 < len(run) <= MOST_ADVISED:
                order[run.start : run.stop] = self._advised(itinerary, run, purpose, pairs, effort)
        return self._try(itinerary, order)

    def _advised(
        self,
        itinerary: Itinerary,
        run: range,
        purpose: Purpose,
        pairs: Sequence[tuple[int, int]],
        effort: int,
    ) -> Order:
        """The stops of a run as the motion planner would make them."""
        order = itinerary.order[run.start : run.stop]
        start = itinerary.motions[run.start].start
        inside = [(a - run.start, b - run.start) for a, b in pairs if a in run and b in run]
        advice = self._geometry.advise(
            AdviceQuery(
                start,
                tuple([itinerary.motions[index].preconditions for index in run]),
                purpose,
                tuple(inside),
                tuple([end for _, end in order]),
                effort,
            ),
            start,
        )
        if sorted(advice.order) != list(range(len(run))):
            return order
        ends: Sequence[Token | None] = advice.ends
        if len(ends) != len(run):
            ends = [None] * len(run)
        return [(run[i], ends[i] if ends[i] is not None else order[i][1]) for i in advice.order]

    def _try(self, itinerary: Itinerary, order: Order) -> bool:
        """Search along an order of the stops; whether that led to a better plan."""
        tour = itinerary.tour(order)
        proposal = tuple(tour.stops)
        if proposal in self._tried or order == itinerary.order:
            return False
        self._tried.add(proposal)
        limits = Limits(
            self._limits.max_depth,
            optimise=True,
            most_requests=2 * len(order) + SPARE_REQUESTS,
            most_backtracks=2 * len(itinerary.plan.log) + SPARE_BACKTRACKS,
        )
        bound = itinerary.plan.cost * (1 - LEAST_GAIN)
        plan = self._follow(tour, limits, bound)
        if plan is None:
            return False
        self._plans.improve(plan)
        return True

    def _itinerary(self) -> Itinerary | None:
        best = self._plans.best
        return Itinerary(best, self._root, self._domain.recursive) if best is not None else None
