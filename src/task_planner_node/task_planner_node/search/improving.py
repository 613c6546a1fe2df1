"""Shorter plans: what the motion planner proposes for a whole plan is searched along."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from random import Random

from task_planner_node.language.model import TaskNetwork
from task_planner_node.oracle import AdviceQuery, Purpose
from task_planner_node.search.advice import MOST_ADVISED, tour_through
from task_planner_node.search.arranging import MOST_ARRANGED, Arranging, moved
from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.itinerary import Itinerary, Order, without_ends
from task_planner_node.search.lengths import expected_lengths
from task_planner_node.search.partial_plan import Limits, Whereabouts
from task_planner_node.search.plans import Plan, Plans
from task_planner_node.search.rehearsal import Rehearsal
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.tours import Tour

# Rounds without a gain after which no more is expected, and rounds in all.
MOST_FRUITLESS = 3
MOST_ROUNDS = 16
# What a plan has to be cheaper, as a share of its cost.
LEAST_GAIN = 1e-4
# What another order has to be expected to be shorter, as a share of the length.
LEAST_EXPECTED = 1e-3
# Requests and choices taken back while a proposal is searched along, beside those that each stop takes.
SPARE_REQUESTS = 8
SPARE_BACKTRACKS = 200
# Orders of robots that wait for each other that are tried in one round, at most.
MOST_VARIED = 40
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
        rehearsal: Rehearsal,
    ) -> None:
        self._domain = domain
        self._root = root
        self._geometry = geometry
        self._statistics = statistics
        self._plans = plans
        self._limits = limits
        self._follow = follow
        self._rehearsal = rehearsal
        self._searched: Plan | None = None
        self._tried: set[object] = set()
        self._strict = False

    def rounds(self) -> None:
        """Improve the best plan until several rounds of growing effort gained nothing."""
        fruitless = 0
        for effort in range(1, MOST_ROUNDS + 1):
            before = self._plans.best
            self.take_opportunities()
            if self._is_free:
                self._reorder(effort)
            else:
                self._rearrange(effort)
                if self._is_open:
                    self._vary(effort)
            self._move(effort)
            fruitless = 0 if self._plans.best is not before else fruitless + 1
            if fruitless == MOST_FRUITLESS:
                return

    def once(self) -> None:
        """What is done for a first plan: opportunities are taken, and robots that wait for each other wait less."""
        self.take_opportunities()
        if self._is_open and not self._is_free:
            self._rearrange(0)

    @property
    def _is_open(self) -> bool:
        """Whether where a robot has to stand depends on where others have gone before."""
        itinerary = self._itinerary()
        return itinerary is not None and bool(itinerary.open)

    def take_opportunities(self) -> None:
        """Meet what comes later on the way of earlier motions, where it is met there."""
        plan, itinerary = self._plans.best, self._itinerary()
        if itinerary is None or plan is self._searched:
            return
        self._searched = plan
        answers = itinerary.answers
        leading = [i for i, a in enumerate(answers) if not a.assigned and a.length > 0]
        texts = tuple(dict.fromkeys(itinerary.texts[i] for run in itinerary.runs for i in run))[
            :MOST_ADVISED
        ]
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
            wanted = tuple([itinerary.texts[index] for index, _ in order])
            better = self._itinerary()
            if better and better.texts == wanted:
                self._statistics.opportunities += taken

    @cached_property
    def _is_free(self) -> bool:
        """Whether the motion planner's tours, which know nothing of the facts, can be followed."""
        return self._rehearsed is None or self._rehearsal.is_free(self._rehearsed)

    @cached_property
    def _rehearsed(self) -> Itinerary | None:
        """What comes of a rehearsal without a tour; None where rehearsals lead to nothing."""
        return self._rehearsal.along()

    def _rearrange(self, effort: int) -> None:
        """Make other stops, or the same ones in another order, as far as that can be rehearsed."""
        itinerary = self._itinerary()
        if itinerary is None or not itinerary.runs or len(itinerary.texts) > MOST_ARRANGED:
            return
        run = itinerary.runs[-1]
        where = _beginning(itinerary, run)
        alternatives = self._rehearsal.alternatives
        ends = {itinerary.texts[i]: end for i, end in itinerary.order if end is not None}
        lengths = expected_lengths(self._geometry, where, itinerary, alternatives, ends)
        if lengths is None:
            return
        arranging = Arranging(self._rehearsal.along, lengths, alternatives, seed=effort)
        found = self._rehearsal.settled(arranging.best(itinerary))
        expected = lengths.expected(found.texts)
        if found.runs[-1:] != (run,) or expected > (1 - LEAST_EXPECTED) * lengths.expected(
            itinerary.texts
        ):
            return
        known = [(index, None) for index in run if index not in found.open]
        purpose = Purpose.FIXED_ORDER
        order = tour_through(self._geometry, where, found.texts, known, purpose, effort=effort)
        better = dict(order or ())
        self._try(found, [(index, better.get(index)) for index in range(len(found.texts))])

    def _vary(self, effort: int) -> None:
        """Do tasks at other times where only the search itself tells what a motion comes to.

        These are plans in which robots wait for each other: where one has to stand depends on the others.
        """
        itinerary = self._itinerary()
        if itinerary is None or len(itinerary.texts) > MOST_ARRANGED:
            return
        orders = list(moved(len(itinerary.texts), itinerary.parts))
        for order in Random(effort).sample(orders, min(MOST_VARIED, len(orders))):
            ends = [
                None if index in itinerary.open else itinerary.order[index][1] for index in order
            ]
            if self._try(itinerary, list(zip(order, ends, strict=True))):
                return

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
            if len(run) > 1:
                stops = order[run.start : run.stop]
                where = _beginning(itinerary, run)
                texts = itinerary.texts
                better = tour_through(self._geometry, where, texts, stops, purpose, pairs, effort)
                order[run.start : run.stop] = better or stops
        return self._try(itinerary, order)

    def _try(self, itinerary: Itinerary, order: Order) -> bool:
        """Search along an order of the stops; whether that led to a better plan."""
        best = self._plans.best
        tour = itinerary.tour(order)
        proposal = tuple(tour.stops)
        if best is None or proposal in self._tried or order == itinerary.order:
            return False
        self._tried.add(proposal)
        if self._rehearsed is not None:
            came = self._rehearsal.along(itinerary.tour(without_ends(order)))
            if came is None or came.texts != tuple([stop.text for stop in tour.stops]):
                return False
        limits = Limits(
            self._limits.max_depth,
            optimise=True,
            most_requests=2 * len(order) + SPARE_REQUESTS,
            most_backtracks=2 * len(best.log) + SPARE_BACKTRACKS,
        )
        bound = best.cost * (1 - LEAST_GAIN)
        plan = self._follow(tour, limits, bound)
        if plan is None:
            return False
        self._plans.improve(plan)
        return True

    def _itinerary(self) -> Itinerary | None:
        best = self._plans.best
        if best is None:
            return None
        return Itinerary(best.log, self._root, self._domain.recursive)


def _beginning(itinerary: Itinerary, run: range) -> Whereabouts:
    """Where the robots are before a run of stops."""
    start = itinerary.motions[run.start].start
    return Whereabouts(start, start, 0.0)
