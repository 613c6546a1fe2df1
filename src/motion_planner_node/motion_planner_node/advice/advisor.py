"""Advice: what many sets of preconditions would cost from here, and which to try first."""

from __future__ import annotations

from collections.abc import Callable
from math import inf

import numpy as np

from motion_planner_node.advice.survey import Survey
from motion_planner_node.codes import Code, Status
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.language import Preconditions
from motion_planner_node.parameters import Parameters
from motion_planner_node.planning import answers
from motion_planner_node.planning.cache import Cache
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import (
    Problem,
    check_revision,
    checked_state,
    read_problem,
)
from motion_planner_node.planning.proofs import Impossible, blocked_start, contradiction
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, CandidateAdvice
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.model import World

#: Candidates of one request at most.
MOST_CANDIDATES = 1000


class Advisor:
    """Estimates costs without planning a motion; what it keeps depends on no start."""

    def __init__(
        self,
        world: World,
        parameters: Parameters,
        parsed: Callable[[str], Preconditions],
        ground_of: Callable[[Robot], Ground],
    ):
        self._world = world
        self._parsed = parsed
        self._ground_of = ground_of
        self._surveys: Cache[object, Survey] = Cache(parameters.cache_size)

    def advise(self, request: AdviceRequest, should_stop: Callable[[], bool]) -> AdviceAnswer:
        """Advice on every candidate; the order is nearest first, impossible ones last.

        :raises MotionPlannerError: WORLD_CHANGED, UNKNOWN_AGENT, INVALID_START, UNSUPPORTED
        :raises Stopped: when ``should_stop`` said so
        """
        check_revision(self._world, request.world_revision)
        count = len(request.preconditions)
        if count > MOST_CANDIDATES:
            raise MotionPlannerError(
                Code.UNSUPPORTED, f'{count} candidates are too many: {MOST_CANDIDATES} at most'
            )
        state = checked_state(self._world, request.start)
        candidates = []
        for text in request.preconditions:
            if should_stop():
                raise Stopped
            try:
                candidates.append(self._advice(text, state, request.seed))
            except MotionPlannerError as error:
                candidates.append(CandidateAdvice(code=error.code, message=error.message))
        order = sorted(
            range(count), key=lambda i: (candidates[i].impossible, candidates[i].estimate, i)
        )
        return AdviceAnswer(tuple(candidates), tuple(order), self._world.revision)

    def _advice(self, text: str, state: GeometricState, seed: int) -> CandidateAdvice:
        preconditions = self._parsed(text)
        mover = preconditions.agents[0] if preconditions.agents else ''
        if preconditions.assigns or mover not in state:
            return self._assigned(read_problem(self._world, preconditions, state))
        others = tuple(item for item in state.items() if item[0] != mover)
        survey = self._surveys.get(
            (text, others, seed), lambda: self._survey(preconditions, state, mover, seed)
        )
        start = state[mover]
        problem = survey.problem.starting_at(start)
        proof = contradiction(problem) or blocked_start(problem, survey.ground)
        proof = proof or survey.proof(start)
        return _impossible(problem, proof) if proof else _costs(survey, start)

    def _survey(
        self, preconditions: Preconditions, state: GeometricState, mover: str, seed: int
    ) -> Survey:
        bounds = self._world.bounds
        middle = Attitude(
            0.5 * (bounds.x_min + bounds.x_max), 0.5 * (bounds.y_min + bounds.y_max), 0.0
        )
        problem = read_problem(self._world, preconditions, {**state, mover: middle})
        return Survey.of(problem, self._ground_of(problem.robot), seed)

    def _assigned(self, problem: Problem) -> CandidateAdvice:
        answer = answers.assigned(problem, self._ground_of, 0)
        impossible = answer.status is Status.IMPOSSIBLE
        cost = inf if impossible else 0.0
        return CandidateAdvice(
            lower_bound=cost,
            estimate=cost,
            impossible=impossible,
            scope=answer.scope,
            code=answer.code,
            message=answer.message,
            objects=problem.program.objects,
        )


def _impossible(problem: Problem, proof: Impossible) -> CandidateAdvice:
    return CandidateAdvice(
        lower_bound=inf,
        estimate=inf,
        impossible=True,
        scope=proof.scope,
        code=proof.code,
        message=proof.message,
        objects=problem.program.objects,
    )


def _costs(survey: Survey, start: Attitude) -> CandidateAdvice:
    lower_bound = survey.lower_bound(start)
    if lower_bound == 0.0 and survey.holds_at(start):
        estimate = 0.0
    else:
        estimates = survey.ground.estimates(start, survey.states(start))
        estimate = max(lower_bound, float(np.min(estimates)))
    return CandidateAdvice(
        lower_bound=lower_bound, estimate=estimate, objects=survey.problem.program.objects
    )
