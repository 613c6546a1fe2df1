"""Advice: what many sets of preconditions would cost from here, and which to try first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import inf

from motion_planner_node.advice import pairwise
from motion_planner_node.advice.costs import Driven, estimates, grouped, lower_bounds
from motion_planner_node.advice.on_the_way import met_on_the_way
from motion_planner_node.advice.places import with_places
from motion_planner_node.advice.purposes import TOURS, check_purpose
from motion_planner_node.advice.survey import Survey
from motion_planner_node.advice.tours import with_tour
from motion_planner_node.codes import Code, Purpose, Status
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.parameters import Parameters
from motion_planner_node.planning import answers
from motion_planner_node.planning.blocked_ahead import Front, front_of, held_back
from motion_planner_node.planning.cache import Cache
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import (
    Problem,
    check_revision,
    checked_state,
)
from motion_planner_node.planning.proofs import Impossible, blocked_start
from motion_planner_node.planning.texts import Texts
from motion_planner_node.requests import AdviceAnswer, AdviceRequest, CandidateAdvice
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.robots.robot import Robot
from motion_planner_node.stopping import ShouldStop, go_on
from motion_planner_node.world.model import World

#: Candidates of one request at most.
MOST_CANDIDATES = 1000


class Advisor:
    """Estimates costs without planning a motion; what it keeps depends on no start."""

    def __init__(
        self,
        world: World,
        parameters: Parameters,
        texts: Texts,
        ground_of: Callable[[Robot], Ground],
    ):
        self._world = world
        self._texts = texts
        self._ground_of = ground_of
        self._surveys: Cache[object, Survey] = Cache(parameters.cache_size)

    def forget(self) -> None:
        """Drop what was kept; it is worked out again when it is needed."""
        self._surveys.clear()

    def advise(self, request: AdviceRequest, should_stop: ShouldStop) -> AdviceAnswer:
        """Advice on every candidate; the order is nearest first or a tour's, impossible ones last.

        :raises MotionPlannerError: WORLD_CHANGED, UNKNOWN_AGENT, INVALID_START, UNSUPPORTED
        :raises Stopped: when ``should_stop`` said so
        """
        check_revision(self._world, request.world_revision)
        count = len(request.preconditions)
        if count > MOST_CANDIDATES:
            raise MotionPlannerError(
                Code.UNSUPPORTED, f'{count} candidates are too many: {MOST_CANDIDATES} at most'
            )
        check_purpose(self._world, request)
        state = checked_state(self._world, request.start)
        if request.purpose == Purpose.OPPORTUNITIES:
            return self._along_motions(request, state, should_stop)
        candidates, driven = [], {}
        standing = _Standing(state)
        for index, text in enumerate(request.preconditions):
            go_on(should_stop)
            try:
                known = self._known(text, standing, request.seed, should_stop)
            except MotionPlannerError as error:
                known = CandidateAdvice(code=error.code, message=error.message)
            if isinstance(known, Driven):
                driven[index] = known
                known = CandidateAdvice(objects=known.survey.problem.program.objects)
            candidates.append(known)
        for index, (lower_bound, estimate) in _costs(driven).items():
            candidates[index] = replace(
                candidates[index], lower_bound=lower_bound, estimate=estimate
            )
        order = sorted(
            range(count), key=lambda i: (candidates[i].impossible, candidates[i].estimate, i)
        )
        answer = AdviceAnswer(tuple(candidates), tuple(order), self._world.revision)
        if request.purpose in TOURS:
            answer = with_tour(answer, request, driven, should_stop)
        if request.places:
            movers = [self._mover(text) for text in request.preconditions]
            answer = with_places(
                answer,
                request,
                driven,
                movers,
                state,
                lambda mover: self._ground_of(self._world.robots[mover]),
                should_stop,
            )
        if not request.pairwise:
            return answer
        bounds, estimates = pairwise.matrices(candidates, driven, should_stop)
        return replace(
            answer,
            pairwise_lower_bounds=tuple(bounds.ravel().tolist()),
            pairwise_estimates=tuple(estimates.ravel().tolist()),
        )

    def _mover(self, text: str) -> str:
        """The robot that meets a text, empty where none does."""
        try:
            agents = self._texts.parsed(text).agents
        except MotionPlannerError:
            return ''
        return agents[0] if agents else ''

    def _along_motions(
        self, request: AdviceRequest, state: GeometricState, should_stop: ShouldStop
    ) -> AdviceAnswer:
        """Opportunities; what candidates cost, or whether they are impossible, is not looked at."""
        met = met_on_the_way(self._world, self._texts, request, state, should_stop)
        candidates = tuple(self._readable(text, state) for text in request.preconditions)
        order = tuple(range(len(candidates)))
        return AdviceAnswer(candidates, order, self._world.revision, opportunities=tuple(met))

    def _readable(self, text: str, state: GeometricState) -> CandidateAdvice:
        """What is wrong with a text, if anything."""
        try:
            problem = self._texts.problem(text, state)
        except MotionPlannerError as error:
            return CandidateAdvice(code=error.code, message=error.message)
        return CandidateAdvice(objects=problem.program.objects)

    def _known(
        self, text: str, standing: _Standing, seed: int, should_stop: ShouldStop
    ) -> CandidateAdvice | Driven:
        """What is known of one candidate at once, or what its costs follow from."""
        state = standing.state
        preconditions = self._texts.parsed(text)
        mover = preconditions.agents[0] if preconditions.agents else ''
        if preconditions.assigns or mover not in state:
            return self._assigned(self._texts.problem(text, state))
        survey = self._surveys.get(
            (text, standing.others(mover), seed),
            lambda: self._survey(text, state, mover, seed, should_stop),
        )
        start = state[mover]
        proof = survey.contradiction or standing.blocked(survey)
        if proof:
            return _impossible(survey.problem, proof)
        with survey.problem.program.broken_off_by(should_stop):
            reach = survey.reach(start, standing.part(survey))
            proof = reach.proof or standing.held_back(survey)
        return _impossible(survey.problem, proof) if proof else Driven(survey, reach, start)

    def _survey(
        self,
        text: str,
        state: GeometricState,
        mover: str,
        seed: int,
        should_stop: ShouldStop,
    ) -> Survey:
        bounds = self._world.bounds
        middle = Attitude(
            0.5 * (bounds.x_min + bounds.x_max), 0.5 * (bounds.y_min + bounds.y_max), 0.0
        )
        problem = self._texts.problem(text, {**state, mover: middle})
        with problem.program.broken_off_by(should_stop):
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


class _Standing:
    """Where everybody stands in one request, and what follows from it for each robot."""

    def __init__(self, state: GeometricState) -> None:
        self.state = state
        self._others: dict[str, tuple[tuple[str, Attitude], ...]] = {}
        self._blocked: dict[str, Impossible | None] = {}
        self._parts: dict[str, int] = {}
        self._fronts: dict[str, Front | None] = {}

    def others(self, mover: str) -> tuple[tuple[str, Attitude], ...]:
        """Where all but ``mover`` stand."""
        if mover not in self._others:
            self._others[mover] = tuple(item for item in self.state.items() if item[0] != mover)
        return self._others[mover]

    def blocked(self, survey: Survey) -> Impossible | None:
        """Whether the robot of ``survey`` stands where it cannot."""
        mover = survey.problem.agent
        if mover not in self._blocked:
            problem = survey.problem.starting_at(self.state[mover])
            self._blocked[mover] = blocked_start(problem, survey.ground)
        return self._blocked[mover]

    def held_back(self, survey: Survey) -> Impossible | None:
        """Whether the robot of ``survey`` cannot get away from where it stands."""
        mover, ground = survey.problem.agent, survey.ground
        if mover not in self._fronts:
            self._fronts[mover] = front_of(self.state[mover], ground)
        front = self._fronts[mover]
        if front is None:
            return None
        return held_back(survey.problem.starting_at(self.state[mover]), ground, front)

    def part(self, survey: Survey) -> int:
        """The connected part of the free space that the robot of ``survey`` stands in."""
        mover = survey.problem.agent
        if mover not in self._parts:
            self._parts[mover] = survey.ground.part_of(self.state[mover])
        return self._parts[mover]


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


def _costs(driven: Mapping[int, Driven]) -> dict[int, tuple[float, float]]:
    """Lower bounds and estimates [m] by number, worked out together for each robot."""
    result = {}
    for _, members in grouped(driven):
        first = driven[members[0]]
        ground, start = first.survey.ground, first.start
        reaches = [driven[index].reach for index in members]
        bounds = lower_bounds(ground, start, reaches).tolist()
        expected = estimates(ground, start, reaches).tolist()
        for index, bound, estimate in zip(members, bounds, expected, strict=True):
            is_there = bound == 0.0 and driven[index].survey.holds_at(start)
            result[index] = (bound, 0.0 if is_there else max(bound, estimate))
    return result
