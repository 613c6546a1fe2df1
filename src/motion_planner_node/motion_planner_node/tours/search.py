"""A short tour of one robot: order and attitudes in turn, on costs that become real ones."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, inf

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.paths.edges import Row, Rows
from motion_planner_node.planning.ground import Ground
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.tours.chains import Groups, Indices, best_chain
from motion_planner_node.tours.exact import best_tour, is_small
from motion_planner_node.tours.goals import Goal, attitudes, fit, passable
from motion_planner_node.tours.legs import Legs
from motion_planner_node.tours.local_search import LocalSearch
from motion_planner_node.tours.precedences import from_start, next_to
from motion_planner_node.tours.refining import refined
from motion_planner_node.tours.samples import Samples

#: For no more goals than these all rounds of an effort are made.
FEW = 16


@dataclass(frozen=True, slots=True)
class Work:
    """How much is tried: counts, so that the same is tried on every machine.

    attitudes: of each goal, where there are few goals
    rounds: times that fresh attitudes are looked for, an order is found and the attitudes refined
    sweeps: of one refinement
    bridges: double bridges of the local search, for each round
    corrections: times in a round, at most, that a tour is looked for again after costs became real ones
    """

    attitudes: int
    rounds: int
    sweeps: int
    bridges: int
    corrections: int

    @classmethod
    def of(cls, effort: int, goals: int) -> Work:
        """That of an effort for so many goals; 8 and more are alike, and many goals have fewer rounds."""
        level = min(effort, 8)
        rounds = (1, 4, 12, 32)[level] if level < 4 else 32 * 2 ** (level - 3)
        return cls(
            attitudes=min(16 + 8 * level, 40),
            rounds=ceil(rounds * FEW / max(goals, FEW)),
            sweeps=10 if level == 0 else 14,
            bridges=64 + 20 * level,
            corrections=24 + 2 * level,
        )


@dataclass(frozen=True, slots=True)
class Tour:
    """Goals in ``order`` (n,), the attitudes (n + 1, 3) from the start on, and the length [m]."""

    order: Indices
    rows: Rows
    length: float


#: Attitudes of all goals together at most, for one level of effort.
MOST_ATTITUDES = 2048
#: Descents from all over the map for fresh attitudes of a goal.
FRESH = 32


class TourSearch:
    """Looks for a short way from ``start`` over all ``goals``, which ``before`` (n, n) may order.

    ``ends`` (n, 3) are attitudes of a tour that is known, where there is one; a ``fixed`` tour
    meets the goals in the order in which they are given.
    """

    def __init__(
        self,
        ground: Ground,
        start: Row,
        goals: Sequence[Goal],
        before: NDArray[np.bool_],
        seed: int,
        effort: int,
        should_stop: ShouldStop,
        ends: Rows | None = None,
        fixed: bool = False,
    ) -> None:
        self._ground, self._goals, self._before = ground, goals, before
        self._start = np.ascontiguousarray(start, np.float64)
        self._part = int(ground.parts_of(self._start[None, :])[0])
        self._seed, self._should_stop = seed, should_stop
        self._ends, self._fixed = ends, fixed
        self._work = Work.of(effort, len(goals))
        leg_seed = np.random.SeedSequence([seed, 0]).generate_state(1)
        self._legs = Legs(ground, int(leg_seed[0]), should_stop)

    def run(self) -> Tour:
        """The best tour that was found; never longer than one over the known ends.

        :raises Stopped: when it is to stop
        """
        best = self._known()
        samples = self._sampled()
        for number in range(self._work.rounds):
            rng = np.random.default_rng([self._seed, number])
            if number:
                self._add_fresh(samples, rng)
            tour = self._on(samples, best, rng)
            for _ in range(2):
                go_on(self._should_stop)
                best = min(best, tour, key=lambda item: item.length)
                rows = refined(
                    [self._goals[g] for g in tour.order],
                    tour.rows,
                    self._legs,
                    self._ground,
                    self._work.sweeps,
                    rng,
                    self._should_stop,
                )
                shorter = Tour(tour.order, rows, self._legs.length(rows))
                samples.add(tour.order, rows[1:], self._should_stop)
                if not shorter.length < 0.998 * tour.length:
                    tour = min(tour, shorter, key=lambda item: item.length)
                    break
                tour = shorter
            best = min(best, tour, key=lambda item: item.length)
        if self._work.rounds > 1 or not best.length < inf:
            tour = self._on(samples, best, np.random.default_rng([self._seed, self._work.rounds]))
            best = min(best, tour, key=lambda item: item.length)
        return best

    def _known(self) -> Tour:
        """The tour over the known ends in the order given, if that may be; else an endless one."""
        rows = np.vstack((self._start, *(goal.states[:1] for goal in self._goals)))
        order = np.arange(len(self._goals))
        if self._ends is not None and not np.tril(self._before).any():
            rows = np.vstack((self._start, self._ends))
            return Tour(order, rows, self._legs.length(rows))
        return Tour(order, rows, inf)

    def _sampled(self) -> Samples:
        goals, work = self._goals, self._work
        share = MOST_ATTITUDES // max(1, len(goals))
        most = min(work.attitudes, max(4, share))
        states = attitudes(
            goals, self._ground, self._start[None, :], self._part, most, self._should_stop
        )
        samples = Samples(
            self._ground,
            self._legs,
            self._start,
            states,
            most,
            next_to(from_start(self._before)),
            self._should_stop,
        )
        if self._ends is not None:
            samples.add(np.arange(len(goals)), self._ends, self._should_stop)
        return samples

    def _add_fresh(self, samples: Samples, rng: np.random.Generator) -> None:
        """A few more attitudes of each goal."""
        bounds = self._ground.scene.world.bounds
        for index, goal in enumerate(self._goals):
            go_on(self._should_stop)
            cells = goal.program.places(bounds)
            x_lo, y_lo, x_hi, y_hi = cells[rng.integers(len(cells), size=FRESH)].T
            begin = np.column_stack(
                (
                    rng.uniform(x_lo, x_hi),
                    rng.uniform(y_lo, y_hi),
                    rng.uniform(-np.pi, np.pi, FRESH),
                )
            )
            states = fit(goal, self._ground, self._part, begin)[:4]
            states = states[passable(self._ground, states, self._should_stop)]
            for state in states:
                samples.add(np.array([index]), state[None, :], self._should_stop)

    def _on(self, samples: Samples, best: Tour, rng: np.random.Generator) -> Tour:
        """The tour over the samples, whose costs are made real ones as far as it uses them."""
        groups = Groups(
            samples.costs,
            samples.first,
            samples.count,
            from_start(self._before),
        )
        search = None if self._fixed or is_small(groups) else LocalSearch(groups, self._should_stop)
        known = np.concatenate(([0], best.order + 1)) if best.length < inf else None
        found = None
        changed = order = np.arange(len(groups.first))
        for number in range(self._work.corrections):
            if search is not None and number == 0:
                order = search.tour(known, self._work.bridges, rng)
            elif search is not None:
                order = search.improved(order, changed)[1]
            elif not self._fixed:
                order = best_tour(groups, self._should_stop)
            length, chosen = best_chain(groups, order)
            rows = samples.states[chosen]
            legs = [pair for pair in itertools.pairwise(chosen) if samples.make_real(*pair)]
            real = Tour(order[1:] - 1, rows, self._legs.length(rows))
            if found is None or real.length < found.length:
                found = real
            if not legs or not length < inf:
                break
            changed = samples.owner[np.ravel(legs)]
        assert found is not None
        return found
