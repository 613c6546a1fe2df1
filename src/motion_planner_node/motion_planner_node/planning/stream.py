"""The motions that answer one request, worked out as far as they were asked for."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import hypot, inf, pi, remainder, tau
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.codes import AttemptResult
from motion_planner_node.errors import Stopped
from motion_planner_node.parameters import Parameters
from motion_planner_node.paths import DEFAULT_PLANNER, PathBudget, Region, plan_path
from motion_planner_node.planning.blocked_ahead import blocked_ahead
from motion_planner_node.planning.ground import Ground
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
from motion_planner_node.satisfaction import descend, destinations

#: Destinations that are as near as this [m] and [rad] are the same one, found again.
SAME = 1e-3

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
#: Rounds of destinations after which it is taken then.
ROUNDS_FOR_OTHERS = 2

#: A motion, and where it ends.
Way = tuple[Motion, Attitude]


class Candidate(NamedTuple):
    """A destination, ``length`` [m] away by estimate.

    The next action has to start there: one that may be a dead end is taken where others are far.
    """

    number: int
    attitude: Attitude
    length: float = 0.0
    dead_end: bool = False


class Stream:
    """Motions to really different destinations, each as short as can be found.

    The first is to the ``preferred`` end, where there is one that will do.  Those that come after
    the first are on another side or at another distance, as far as there is
    any; when there is no more, they may be nearer to those before them.

    What comes k-th depends on the problem, the seed and the parameters alone: not on who asked
    before, nor on time.  Counts bound the work; ``should_stop`` only breaks it off.
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
        #: The connected part of the free space that the start is in.
        self._here = ground.part_of(problem.start)
        self._restart()

    def _restart(self) -> None:
        self.tried = Tried(self._problem.agent)
        self._found: list[Found] = []
        self._candidates: list[Candidate] = []
        self._rounds = 0
        self._share = SHARES[0]
        self._spread = 0.0
        self._seen: list[Attitude] = []
        self._failures = 0
        #: Whether a close look at all that the start leads to has found no destination.
        self._is_shut_in = False
        self.proof: Impossible | None = None
        self._more = self._preferred_first()
        self._broken = False

    def find(self, alternative: int, should_stop: Callable[[], bool]) -> Found | None:
        """Return the motion number ``alternative``, or None when there are not so many.

        Then ``tried`` says what was looked at in vain, and ``proof``, where there is one, why no
        motion can exist.

        :raises Stopped: when ``should_stop`` said so; the next call starts over
        """
        if self._broken:
            self._restart()
        self._should_stop = should_stop
        self._broken = True
        with self._problem.program.broken_off_by(should_stop):
            while len(self._found) <= alternative:
                found = next(self._more, None)
                if found is None:
                    break
                self._found.append(found)
            if not self._found and self.proof is None:
                self.proof = blocked_ahead(self._problem, self._ground)
        self._broken = False
        return self._found[alternative] if alternative < len(self._found) else None

    def _preferred_first(self) -> Iterator[Found]:
        way = self._to_preferred()
        # What was tried on the way leaves no trace: all else is as without a preferred end.
        self._candidates = []
        self.tried = Tried(self._problem.agent)
        self._failures = 0
        if way:
            yield self._answer(way)
        yield from self._generate()

    def _to_preferred(self) -> Way | None:
        """A motion to exactly the preferred end, where that will do and can be driven to."""
        end = self._preferred
        if end is None or not self._problem.program.holds_at(end):
            return None
        rows = np.array([[end.x, end.y, end.heading]])
        if not (self._ground.is_free(rows)[0] and self._ground.part_of(end) == self._here):
            return None
        self._candidates = [Candidate(0, end)]
        return self._plan(self._candidates, None)

    def _generate(self) -> Iterator[Found]:
        start = self._problem.start
        if self._is_new(start) and self._problem.program.holds_at(start):
            # Nothing is nearer than here; other destinations are for those who ask for them.
            stay = Motion(self._problem.agent, self._problem.start)
            yield self._answer((stay, self._problem.start))
        while self._rounds < self._parameters.rounds:
            self._add_candidates()
            if self._rounds == 1 and not self._candidates and not self._found:
                self.proof = self._prove()
                if self.proof:
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
        also when others have been looked for once more.
        """
        way, is_dead_end = self._best_way()
        while is_dead_end and self._rounds < min(ROUNDS_FOR_OTHERS, self._parameters.rounds):
            self._add_candidates()
            way, is_dead_end = self._best_way()
        return way

    def _best_way(self) -> tuple[Way | None, bool]:
        """A motion to a new candidate, and whether that is a dead end."""
        new = [candidate for candidate in self._candidates if self._is_new(candidate.attitude)]
        open_ends = [candidate for candidate in new if not candidate.dead_end]
        way = self._plan(open_ends, self._region(dead_end=False)) if open_ends else None
        longest = inf if way is None else way[0].length
        dead_ends = [item for item in new if item.dead_end and item.length * DETOUR < longest]
        if not dead_ends or self._failures >= self._parameters.failures_per_answer:
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

    def _answer(self, way: Way) -> Found:
        tried, self.tried = self.tried, Tried(self._problem.agent)
        self._failures, self._is_shut_in = 0, False
        return Found(*way, tried)

    def _add_candidates(self) -> None:
        """Look for destinations, and keep those that the robot can stand in and may get to."""
        self._check_time()
        states = destinations(
            self._problem.program,
            self._problem.start,
            self._ground.scene.world.bounds,
            np.random.default_rng([self._seed, self._rounds]),
            self._parameters.destinations,
            self._ground.room,
            self._ground.travel_from(self._problem.start),
        )
        self._rounds += 1
        free = self._ground.is_free(states)
        near = self._ground.parts_of(states) == self._here
        roomy = self._ground.can_turn_round(states, self._check_time)
        estimates = self._ground.estimates(self._problem.start, states)
        if len(states):
            self._spread = max(self._spread, float(np.ptp(states[:, :2], axis=0).max()))
        # Those of one round differ from each other.
        earlier = tuple(self._seen)
        columns = (free.tolist(), near.tolist(), roomy.tolist(), estimates.tolist())
        for state, is_free, is_near, is_roomy, length in zip(
            states.tolist(), *columns, strict=True
        ):
            attitude = Attitude(*state)
            if earlier and not all(_differ(attitude, seen, SAME, SAME) for seen in earlier):
                continue
            self._seen.append(attitude)
            if not is_free:
                trouble = self._ground.trouble(attitude)
                self.tried.add(attitude, AttemptResult.IN_OBSTACLE, trouble)
            elif not is_near:
                reason = 'walled off from the start'
                self.tried.add(attitude, AttemptResult.NO_PATH, reason)
            else:
                dead_end = not is_roomy and attitude != self._problem.start
                self._candidates.append(Candidate(len(self._seen), attitude, length, dead_end))
        self._candidates.sort(key=lambda candidate: (candidate.length, candidate.number))

    def _plan(
        self, candidates: list[Candidate], region: Region | None, longest: float = inf
    ) -> Way | None:
        """Find a motion to one of ``candidates``, or into ``region``, and verify it where it ends.

        Those that turn out not to be reached, or not to do, are candidates no longer.  Where only
        motions of less than ``longest`` [m] are looked for, nothing is known of the others.
        """
        left = list(candidates)
        while left:
            self._check_time()
            if self._problem.start in (candidate.attitude for candidate in left):
                return Motion(self._problem.agent, self._problem.start), self._problem.start
            seed = np.random.SeedSequence([self._seed, left[0].number]).generate_state(1)
            result = plan_path(
                self._ground.scene,
                self._ground.robot,
                self._problem.start,
                [candidate.attitude for candidate in left],
                int(seed[0]),
                self._should_stop,
                self._budget,
                self._planner,
                region,
                longest,
            )
            if result.motion is None:
                if longest == inf:
                    self._drop(left, AttemptResult.NO_PATH, result.reason)
                    self._is_shut_in |= result.shut_in
                break
            end = end_of(result.motion, self._ground.robot)
            if self._problem.program.holds_at(end):
                return result.motion, end
            reason = self._problem.program.unmet(end)[0]
            self.tried.add(end, AttemptResult.NOT_SATISFIED, reason)
            if result.goal_index >= 0:
                self._candidates.remove(left.pop(result.goal_index))
            else:
                region = None
        return None

    def _drop(self, candidates: list[Candidate], result: AttemptResult, reason: str) -> None:
        self._failures += len(candidates)
        for candidate in candidates:
            self.tried.add(candidate.attitude, result, reason)
            self._candidates.remove(candidate)

    def _region(self, *, dead_end: bool) -> Region:
        """Further destinations near attitudes: new ones, and no dead end unless that is wanted."""

        def region(rows: NDArray[np.float64]) -> NDArray[np.float64]:
            ground = self._ground
            descent = descend(self._problem.program, rows, room=ground.room)
            states = descent.states[descent.satisfied]
            states = states[ground.is_free(states)] if len(states) else states
            if not len(states):
                return states
            good = ground.parts_of(states) == self._here
            if not dead_end:
                good &= ground.can_turn_round(states, self._check_time)
            if self._found:
                good &= [self._is_new(Attitude(*state)) for state in states.tolist()]
            return np.ascontiguousarray(states[good])

        return region

    def _is_new(self, attitude: Attitude) -> bool:
        """Whether ``attitude`` differs from all that was answered before, as much as asked for now."""
        if not self._found:
            return True
        parameters, share = self._parameters, self._share
        far = max(parameters.alternative_distance, share * self._spread)
        turned = max(parameters.alternative_heading, share * pi)
        return all(_differ(attitude, found.end, far, turned) for found in self._found)

    def _check_time(self) -> None:
        if self._should_stop():
            raise Stopped


def _differ(one: Attitude, other: Attitude, distance: float, angle: float) -> bool:
    """Whether two attitudes are ``distance`` [m] apart or turned by ``angle`` [rad]."""
    return (
        hypot(one.x - other.x, one.y - other.y) >= distance
        or abs(remainder(one.heading - other.heading, tau)) >= angle
    )
