"""The motions that answer one request, worked out as far as they were asked for."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from math import hypot, pi, remainder, tau

import numpy as np

from motion_planner_node.codes import AttemptResult
from motion_planner_node.errors import Stopped
from motion_planner_node.parameters import Parameters
from motion_planner_node.paths import plan_path
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
from motion_planner_node.satisfaction import destinations

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


@dataclass(order=True, slots=True)
class Candidate:
    """A destination; ``length`` [m] is an estimate until there is a motion.

    One that may be a dead end comes after all others: the next action has to start there.
    """

    dead_end: bool
    length: float
    number: int
    attitude: Attitude = field(compare=False)
    motion: Motion | None = field(default=None, compare=False)


class Stream:
    """Motions to really different destinations, the shortest of a handful first.

    Those that come after the first are on another side or at another distance, as far as there is
    any; when there is no more, they may be nearer to those before them.

    What comes k-th depends on the problem, the seed and the parameters alone: not on who asked
    before, nor on time.  Counts bound the work; ``should_stop`` only breaks it off.
    """

    def __init__(self, problem: Problem, ground: Ground, parameters: Parameters, seed: int):
        self._problem = problem
        self._ground = ground
        self._parameters = parameters
        self._seed = seed
        self._restart()

    def _restart(self) -> None:
        self.tried = Tried(self._problem.agent)
        self._found: list[Found] = []
        self._candidates: list[Candidate] = []
        self._alike: list[Candidate] = []
        self._share = SHARES[0]
        self._spread = 0.0
        self._seen: list[Attitude] = []
        self._failures = 0
        self.proof: Impossible | None = None
        self._more = self._generate()
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
        while len(self._found) <= alternative:
            found = next(self._more, None)
            if found is None:
                break
            self._found.append(found)
        self._broken = False
        return self._found[alternative] if alternative < len(self._found) else None

    def _generate(self) -> Iterator[Found]:
        if not self._problem.program.unmet(self._problem.start):
            # Nothing is nearer than here; other destinations are for those who ask for them.
            stay = Candidate(dead_end=False, length=0.0, number=0, attitude=self._problem.start)
            stay.motion = Motion(self._problem.agent, self._problem.start)
            yield self._answer(stay)
        for round_number in range(self._parameters.rounds):
            self._add_candidates(round_number)
            if round_number == 0 and not self._candidates and not self._found:
                self.proof = self._prove()
                if self.proof:
                    return
            for share in SHARES:
                self._share = share
                yield from self._answers()
                if self._has_failed:
                    return
                self._candidates, self._alike = self._alike, []
                heapq.heapify(self._candidates)

    def _answers(self) -> Iterator[Found]:
        """Motions to candidates that are new, as much as is asked for now; others are laid aside."""
        planned: list[Candidate] = []
        while self._candidates or planned:
            best = min(planned, default=None)
            enough = len(planned) >= self._parameters.paths_per_answer or self._has_failed
            if best and (enough or not self._candidates or best < self._candidates[0]):
                planned.remove(best)
                yield self._answer(best)
                self._alike += [other for other in planned if not self._is_new(other.attitude)]
                planned = [other for other in planned if self._is_new(other.attitude)]
            elif self._has_failed:
                return
            else:
                candidate = heapq.heappop(self._candidates)
                if not self._is_new(candidate.attitude):
                    self._alike.append(candidate)
                elif candidate.motion or self._plan(candidate):
                    planned.append(candidate)

    @property
    def _has_failed(self) -> bool:
        return self._failures >= self._parameters.failures_per_answer

    def _prove(self) -> Impossible | None:
        hopeful = hopeful_cells(self._problem, self._ground)
        proof = walled_off(self._problem, self._ground, hopeful)
        return proof or no_attitude(self._problem, self._ground)

    def _answer(self, candidate: Candidate) -> Found:
        assert candidate.motion is not None
        tried, self.tried = self.tried, Tried(self._problem.agent)
        self._failures = 0
        return Found(candidate.motion, candidate.attitude, tried)

    def _add_candidates(self, round_number: int) -> None:
        """Look for destinations, and keep those that the robot can stand in and may get to."""
        self._check_time()
        states = np.asarray(
            destinations(
                self._problem.program,
                self._problem.start,
                self._ground.scene.world.bounds,
                np.random.default_rng([self._seed, round_number]),
                self._parameters.destinations,
                self._ground.room,
            )
        )
        free = self._ground.is_free(states)
        here = self._ground.part_of(self._problem.start)
        near = self._ground.parts_of(states) == here
        estimates = self._ground.estimates(self._problem.start, states)
        if len(states):
            self._spread = max(self._spread, float(np.ptp(states[:, :2], axis=0).max()))
        for state, is_free, is_near, estimate in zip(states, free, near, estimates, strict=True):
            attitude = Attitude(*(float(number) for number in state))
            if not all(_differ(attitude, seen, SAME, SAME) for seen in self._seen):
                continue
            self._seen.append(attitude)
            if not is_free:
                trouble = self._ground.trouble(attitude)
                self.tried.add(attitude, AttemptResult.IN_OBSTACLE, trouble)
            elif not is_near:
                reason = 'walled off from the start'
                self.tried.add(attitude, AttemptResult.NO_PATH, reason)
            else:
                stays = attitude == self._problem.start
                dead_end = not stays and not self._ground.can_turn_round(attitude)
                candidate = Candidate(dead_end, float(estimate), len(self._seen), attitude)
                heapq.heappush(self._candidates, candidate)

    def _plan(self, candidate: Candidate) -> bool:
        """Find a motion to the candidate and verify it where it ends."""
        self._check_time()
        start, goal = self._problem.start, candidate.attitude
        if goal == start:
            motion = Motion(self._problem.agent, start)
        else:
            seed = np.random.SeedSequence([self._seed, candidate.number]).generate_state(1)
            result = plan_path(
                self._ground.scene,
                self._ground.robot,
                start,
                [goal],
                int(seed[0]),
                self._should_stop,
            )
            if result.motion is None:
                self._failures += 1
                self.tried.add(goal, AttemptResult.NO_PATH, result.reason)
                return False
            motion = result.motion
        end = end_of(motion, self._ground.robot)
        missed = self._problem.program.unmet(end)
        if missed:
            self.tried.add(end, AttemptResult.NOT_SATISFIED, missed[0])
            return False
        candidate.motion, candidate.attitude, candidate.length = motion, end, motion.length
        return True

    def _is_new(self, attitude: Attitude) -> bool:
        """Whether ``attitude`` differs from all that was answered before, as much as asked for now."""
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
