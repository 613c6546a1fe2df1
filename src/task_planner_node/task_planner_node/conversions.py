"""Between the messages of geohtn_msgs and the pure types of the task planner."""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot, isfinite, remainder, tau

from geohtn_msgs.action import PlanTasks
from geohtn_msgs.msg import (
    AdviceAnswer,
    AdviceRequest,
    AgentState,
    GeometricAnswer,
    PlanningProgress,
    PlanningStatistics,
    SourceText,
    TaskPlan,
)
from geohtn_msgs.msg import CandidateAdvice as CandidateAdviceMessage
from geohtn_msgs.msg import Diagnostic as DiagnosticMessage
from geohtn_msgs.msg import Outcome as OutcomeMessage
from geohtn_msgs.msg import Step as StepMessage

from task_planner_node.errors import Diagnostic, GeometryFailed, Severity
from task_planner_node.mission import MissionText
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Opportunity,
    Place,
    Scope,
    Status,
    Token,
)
from task_planner_node.outcomes import Progress, Result
from task_planner_node.search.plans import Plan, Step
from task_planner_node.search.statistics import Statistics

MAX_UINT32 = 2**32 - 1
# [m] and [rad] by which the end of a motion, integrated, may miss the attitude that was preferred.
NEAR = 1e-3
MOST_TOLD = 1000


def token_from_states(states: list[AgentState]) -> Token:
    """Attitudes as a hashable value."""
    return tuple((s.agent, float(s.x), float(s.y), float(s.heading)) for s in states)


def states_from_token(token: Token) -> list[AgentState]:
    """The attitudes that a token of token_from_states stands for."""
    if not isinstance(token, tuple):
        raise TypeError(f'not a geometric state: {token!r}')
    return [AgentState(agent=agent, x=x, y=y, heading=heading) for agent, x, y, heading in token]


def answer_from_message(message: GeometricAnswer, preferred: Token | None = None) -> Answer:
    """An answer with the message itself as payload; raises GeometryFailed for an unknown status.

    ``preferred`` is the attitude that the query preferred.
    """
    try:
        status, scope = Status(message.status), Scope(message.scope)
    except ValueError as error:
        raise GeometryFailed(f'the motion planner answered nonsense: {error}') from error
    moved = [state for state in message.end if state.agent == message.agent]
    wanted = states_from_token(preferred) if preferred is not None else []
    return Answer(
        status,
        int(message.code),
        scope,
        message.message,
        token_from_states(message.end),
        bool(message.assigned),
        float(message.length),
        tuple(message.objects),
        tuple(diagnostic_from_message(diagnostic) for diagnostic in message.diagnostics),
        float(message.time_spent),
        message,
        token_from_states(moved) if moved else None,
        bool(moved and wanted) and _near(moved[0], wanted[0]),
    )


def _near(one: AgentState, other: AgentState) -> bool:
    turn = remainder(one.heading - other.heading, tau)
    return (
        one.agent == other.agent
        and hypot(one.x - other.x, one.y - other.y) <= NEAR
        and abs(turn) <= NEAR
    )


def advice_to_message(query: AdviceQuery) -> AdviceRequest:
    """What is to be known of candidates, without what belongs to the mission."""
    return AdviceRequest(
        start=states_from_token(query.start),
        preconditions=list(query.preconditions),
        purpose=int(query.purpose),
        before=[first for first, _ in query.precedences],
        after=[later for _, later in query.precedences],
        ends=[AgentState() if end is None else states_from_token(end)[0] for end in query.ends],
        effort=query.effort,
        places=query.places,
        motions=[
            answer.payload.motion
            for answer in query.motions
            if isinstance(answer.payload, GeometricAnswer)
        ],
    )


def advice_from_message(message: AdviceAnswer) -> Advice:
    """Advice; without candidates when the motion planner gave a code instead."""
    candidates = () if message.code else tuple(_candidate(c) for c in message.candidates)
    return Advice(
        candidates,
        tuple(int(i) for i in message.order),
        float(message.time_spent),
        tuple(token_from_states([end]) if end.agent else None for end in message.ends),
        tuple(
            Opportunity(
                int(found.candidate),
                int(found.motion),
                float(found.distance),
                token_from_states([found.end]),
            )
            for found in message.opportunities
        ),
        tuple(
            Place(int(index), token_from_states([state]))
            for index, state in zip(message.place_candidates, message.places, strict=False)
        ),
        tuple(message.place_lengths),
    )


def _candidate(message: CandidateAdviceMessage) -> CandidateAdvice:
    known = message.scope in (Scope.THIS_START, Scope.CONNECTED_STARTS, Scope.ANY_START)
    return CandidateAdvice(
        bool(message.impossible) and known,
        Scope(message.scope) if known else Scope.THIS_START,
        int(message.code),
        message.message,
        tuple(message.objects),
        max(0.0, float(message.lower_bound)) if isfinite(message.lower_bound) else 0.0,
    )


def diagnostic_from_message(message: DiagnosticMessage) -> Diagnostic:
    """A remark of the motion planner."""
    severity = Severity.WARNING if message.severity == Severity.WARNING else Severity.ERROR
    return Diagnostic(
        message.message,
        int(message.line),
        int(message.column),
        message.text,
        message.source,
        severity,
    )


def diagnostic_to_message(diagnostic: Diagnostic) -> DiagnosticMessage:
    """A remark for a client."""
    return DiagnosticMessage(
        severity=int(diagnostic.severity),
        source=diagnostic.source,
        line=diagnostic.line,
        column=diagnostic.column,
        text=diagnostic.text,
        message=diagnostic.message,
    )


def mission_text(message: SourceText) -> MissionText:
    """A text and where it came from."""
    return MissionText(message.path, message.text)


def step_to_message(step: Step) -> StepMessage:
    """One action of a plan, with the motion planner's own answer."""
    answer = step.answer.payload if step.answer is not None else None
    return StepMessage(
        action=list(step.action),
        cost=step.cost,
        preconditions=step.preconditions,
        start=states_from_token(step.start),
        answer=[answer] if isinstance(answer, GeometricAnswer) else [],
    )


def statistics_to_message(statistics: Statistics) -> PlanningStatistics:
    """Counters and times."""
    return PlanningStatistics(
        requests=statistics.requests,
        answers=statistics.answers,
        found=statistics.found,
        impossible=statistics.impossible,
        unknown=statistics.unknown,
        advices=statistics.advices,
        decompositions=min(statistics.decompositions, MAX_UINT32),
        backtracks=min(statistics.backtracks, MAX_UINT32),
        geometric_backtracks=statistics.geometric_backtracks,
        improvements=statistics.improvements,
        opportunities=statistics.opportunities,
        planning_time=statistics.planning_time,
        request_time=statistics.request_time,
        transport_time=statistics.transport_time,
        search_time=statistics.search_time,
    )


def progress_to_message(progress: Progress) -> PlanningProgress:
    """Where a search stands."""
    return PlanningProgress(
        phase=progress.phase,
        goals_reached=progress.goals_reached,
        goals_total=progress.goals_total,
        requests=progress.requests,
        backtracks=min(progress.backtracks, MAX_UINT32),
        depth=progress.depth,
        current_length=progress.current_length,
        best_length=progress.best_length,
        best_cost=progress.best_cost,
        improved=[f'({" ".join(action)})' for action in _actions(progress.improved)],
        elapsed=progress.elapsed,
    )


def _actions(plan: Plan | None) -> Iterable[tuple[str, ...]]:
    """The actions of an improved plan; a very long one is not told on the way."""
    return plan.actions if plan is not None and len(plan.actions) <= MOST_TOLD else ()


def plan_to_message(plan: Plan) -> TaskPlan:
    """One of several plans."""
    return TaskPlan(
        steps=[step_to_message(step) for step in plan.steps], cost=plan.cost, length=plan.length
    )


def result_to_message(result: Result) -> PlanTasks.Result:
    """The end of a mission."""
    return PlanTasks.Result(
        outcome=OutcomeMessage(
            value=int(result.outcome),
            explanation=result.explanation,
            diagnostics=[diagnostic_to_message(d) for d in result.diagnostics],
        ),
        steps=[step_to_message(step) for step in result.steps],
        others=[plan_to_message(plan) for plan in result.plans[1:]],
        statistics=statistics_to_message(result.statistics),
        improvements=[progress_to_message(progress) for progress in result.improvements],
    )
