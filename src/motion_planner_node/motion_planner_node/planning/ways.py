"""Looking for motions that answer one request, one after the other."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf, pi

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import AttemptResult
from motion_planner_node.functions import Array
from motion_planner_node.parameters import Parameters
from motion_planner_node.paths import DEFAULT_PLANNER, PathBudget, Query, Region, solved
from motion_planner_node.planning.blocked_ahead import blocked_ahead
from motion_planner_node.planning.candidates import (
    NO_CANDIDATES,
    Candidates,
    are_apart,
    attitude_of,
    row_of,
)
from motion_planner_node.planning.confined import confined, unapproachable
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.pool import Pool
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import (
    Impossible,
    hopeful_cells,
    no_attitude,
    walled_off,
)
from motion_planner_node.planning.tried import Tried
from motion_planner_node.robots.driving import end_of
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.stopping import ShouldStop, Watch

#: Alternatives first have to differ by this much of all that they can, then by less and less.
SHARES = (0.5, 0.25, 0.125, 0.0)


@dataclass(frozen=True, slots=True)
class Found:
    """A motion that meets the request, where it ends, and what was tried since the one before."""

    motion: Motion
    end: Attitude
    tried: Tried


#: A dead end is taken when others are farther away by this factor.
DETOUR = 1.3
#: Tells the randomness of paths from that of destinations.
FOR_PATHS = 1

#: A motion, and where it ends.
Way = tuple[Motion, Attitude]


class Ways:
    """Looks for motions to really different destinations, each as short as can be found.

    The first is to the ``preferred`` end, where there is one that will do.  Those that come after
    the first are on another side or at another distance, as far as there is
    any; when there is no more, they may be nearer to those before them.

    Counts bound the work; `broken_off_by` only breaks it off.

    Attributes:
        tried: what was looked at in vain since the last motion was found
    """

    def __init__(
        self,
        problem: Problem,
        ground: Ground,
        parameters: Parameters,
        seed: int,
        planner: str = DEFAULT_PLANNER,
        preferred: Attitude | None = None,
    ):
        self._planner = planner
        self._preferred = preferred
        self._budget = PathBudget(
            attitudes=parameters.path_attitudes,
            iterations=parameters.path_iterations,
            refinements=parameters.path_refinements,
        )
        self._problem = problem
        self._ground = ground
        self._parameters = parameters
        self._seed = seed
        self._watch = Watch()
        self.forget()

    def forget(self) -> None:
        """Begin anew."""
        self.tried = Tried(self._problem.agent)
        #: Where the motions end that were found.
        self._ends = np.empty((0, 3))
        self._pool = Pool(
            self._problem, self._ground, self._parameters, self._seed, self.tried, self._watch
        )
        self._share = SHARES[0]
        self._failures = 0
        #: Whether a close look at all that the start leads to has found no destination.
        self._is_shut_in = False
        self._proof: Impossible | None = None

    @contextmanager
    def broken_off_by(self, should_stop: ShouldStop) -> Iterator[None]:
        """Inside the block whatever is looked for raises Stopped when it is to stop."""
        self._watch.should_stop = should_stop
        with self._problem.program.broken_off_by(should_stop):
            yield

    def motions(self) -> Iterator[Found]:
        """The motions, one after the other."""
        way = self._to_preferred()
        # What was tried on the way leaves no trace: all else is as without a preferred end.
        self._pool.candidates = NO_CANDIDATES
        self.tried.forget()
        self._failures = 0
        if way:
            yield self._answer(way)
        yield from self._to_anywhere()

    def proof(self) -> Impossible | None:
        """Why there is none, where all `motions` were asked for in vain."""
        return self._proof or self._prove_after_all()

    def _to_preferred(self) -> Way | None:
        """A motion to exactly the preferred end, where that will do and can be driven to."""
        end = self._preferred
        if end is None or not self._problem.program.holds_at(end):
            return None
        row = row_of(end)
        if not (self._ground.is_free(row)[0] and self._pool.is_near(row)[0]):
            return None
        return self._plan(self._only(0, row), None)

    def _only(self, number: int, row: Array) -> Candidates:
        """One candidate (1, 3) in place of all that were known, whatever is beyond it."""
        lengths = self._ground.estimates(self._problem.start, row)
        only = Candidates(np.array([number]), row, lengths, np.zeros(1, np.bool_))
        self._pool.candidates = only
        return only

    def _to_anywhere(self) -> Iterator[Found]:
        start = self._problem.start
        if self._are_new(row_of(start))[0] and self._problem.program.holds_at(start):
            # Nothing is nearer than here; other destinations are for those who ask for them.
            stay = Motion(self._problem.agent, self._problem.start)
            yield self._answer((stay, self._problem.start))
        while self._pool.rounds < self._parameters.rounds:
            self._pool.look_everywhere()
            if self._pool.rounds == 1 and not len(self._pool.candidates) and not len(self._ends):
                self._proof = self._prove()
                if self._proof:
                    return
            for share in SHARES:
                self._share = share
                yield from self._answers()
                if self._has_failed:
                    return

    def _answers(self) -> Iterator[Found]:
        """Motions to candidates that are new, as much as is asked for now."""
        while not self._has_failed:
            way = self._way_on()
            if way is None:
                break
            yield self._answer(way)

    def _way_on(self) -> Way | None:
        """A motion to a new candidate from where there is a way on, or one that is far shorter.

        A dead end is taken when the motion into it is shorter than those to all others by `DETOUR`,
        also when others have been looked for beside it.
        """
        way, is_dead_end = self._best_way()
        if way is not None and is_dead_end:
            self._pool.look_beside(way[1])
            way, _ = self._best_way()
        return way

    def _best_way(self) -> tuple[Way | None, bool]:
        """A motion to a new candidate, and whether that is a dead end."""
        new = self._pool.candidates.where(self._are_new(self._pool.candidates.rows))
        open_ends = new.where(~new.dead_ends)
        way = self._plan(open_ends, self._region(dead_end=False)) if len(open_ends) else None
        longest = inf if way is None else way[0].length
        dead_ends = new.where(new.dead_ends & (new.lengths * DETOUR < longest))
        if not len(dead_ends) or self._failures >= self._parameters.failures_per_answer:
            return way, False
        shorter = self._plan(dead_ends, self._region(dead_end=True), longest)
        is_shorter = shorter is not None and shorter[0].length * DETOUR < longest
        return (shorter, True) if is_shorter else (way, False)

    @property
    def _has_failed(self) -> bool:
        return self._is_shut_in or self._failures >= self._parameters.failures_per_answer

    def _prove(self) -> Impossible | None:
        hopeful = hopeful_cells(self._problem, self._ground)
        proof = walled_off(self._problem, self._ground, hopeful)
        return proof or no_attitude(self._problem, self._ground)

    def _prove_after_all(self) -> Impossible | None:
        """What may be proven when all that was tried was in vain: how little room there is to turn."""
        problem, ground = self._problem, self._ground
        proof = blocked_ahead(problem, ground) or confined(problem, ground, self._watch.look)
        return proof or unapproachable(problem, ground, self._pool.known, self._watch.look)

    def _answer(self, way: Way) -> Found:
        self._ends = np.concatenate((self._ends, row_of(way[1])))
        self._failures, self._is_shut_in = 0, False
        return Found(*way, self.tried.taken())

    def _plan(
        self, candidates: Candidates, region: Region | None, longest: float = inf
    ) -> Way | None:
        """Find a motion to one of ``candidates``, or into ``region``, and verify it where it ends.

        Those that turn out not to be reached, or not to do, are candidates no longer.  Where only
        motions of less than ``longest`` [m] are looked for, nothing is known of the others.
        """
        problem, left = self._problem, candidates
        while len(left):
            self._watch.look()
            if (left.rows == row_of(problem.start)).all(axis=1).any():
                return Motion(problem.agent, problem.start), problem.start
            result = solved(
                Query(
                    self._ground.scene,
                    self._ground.robot,
                    problem.start,
                    left.rows,
                    (self._seed, int(left.numbers[0]), FOR_PATHS),
                    self._budget,
                    self._watch.should_stop,
                    region,
                    longest,
                    left.lengths,
                ),
                self._planner,
            )
            if result.motion is None:
                if longest == inf:
                    self._drop(left, AttemptResult.NO_PATH, result.reason)
                    self._is_shut_in |= result.shut_in
                break
            end = end_of(result.motion, self._ground.robot)
            if problem.program.holds_at(end):
                return result.motion, end
            reason = problem.program.unmet(end)[0]
            self.tried.add(end, AttemptResult.NOT_SATISFIED, reason)
            if result.goal_index >= 0:
                wrong = left.where(np.array([result.goal_index]))
                self._pool.candidates = self._pool.candidates.without(wrong)
                left = left.without(wrong)
            else:
                region = None
        return None

    def _drop(self, candidates: Candidates, result: AttemptResult, reason: str) -> None:
        self._failures += len(candidates)
        for row in candidates.rows:
            self.tried.add(attitude_of(row), result, reason)
        self._pool.candidates = self._pool.candidates.without(candidates)

    def _region(self, *, dead_end: bool) -> Region:
        """Further destinations near attitudes: new ones, and no dead end unless that is wanted."""

        def region(rows: NDArray[np.float64]) -> NDArray[np.float64]:
            states = self._pool.near(rows)
            if not len(states):
                return states
            good = self._are_new(states)
            if not dead_end:
                good &= self._pool.has_way_on(states)
            return np.ascontiguousarray(states[good])

        return region

    def _are_new(self, rows: Array) -> NDArray[np.bool_]:
        """Which attitudes (n, 3) differ from all that was answered before, as much as asked for now."""
        if not len(self._ends):
            return np.ones(len(rows), np.bool_)
        parameters, share = self._parameters, self._share
        far = max(parameters.alternative_distance, share * self._pool.spread)
        turned = max(parameters.alternative_heading, share * pi)
        return are_apart(rows, self._ends, far, turned)
