"""Messages to the planner's own dataclasses and back; every number becomes a plain float."""

from __future__ import annotations

from array import array
from collections.abc import Iterable, Sequence

from geohtn_msgs import msg
from geometry_msgs.msg import Point
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.map_conversions import map_to_msg
from motion_planner_node.motion_conversions import (
    agent_state_to_msg,
    attitude_from_msg,
    motion_from_msg,
    motion_to_msg,
    robot_to_msg,
)
from motion_planner_node.parameters import Specification
from motion_planner_node.requests import (
    AdviceAnswer,
    AdviceRequest,
    CandidateAdvice,
    GeometricAnswer,
    GeometricRequest,
)
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.world.holes import chain
from motion_planner_node.world.model import Obstacle, Polygon, Region, World


def state_from_msg(states: Sequence[msg.AgentState], what: str = 'start') -> GeometricState:
    """Attitudes by label; a heading outside (-pi, pi] is wrapped, one inside is left bit for bit.

    :raises MotionPlannerError: INVALID_START when a number is not finite or an agent comes twice
    """
    result: dict[str, Attitude] = {}
    for state in states:
        if state.agent in result:
            raise MotionPlannerError(
                Code.INVALID_START, f'the {what} names agent {state.agent} twice'
            )
        result[state.agent] = attitude_from_msg(state, what)
    return result


def state_to_msg(state: GeometricState) -> list[msg.AgentState]:
    """Attitudes in the order of ``state``."""
    return [agent_state_to_msg(agent, attitude) for agent, attitude in state.items()]


def request_from_msg(request: msg.GeometricRequest) -> GeometricRequest:
    """The request; ``mission`` and ``action`` are for people and stay in the message.

    :raises MotionPlannerError: INVALID_START as in `state_from_msg`
    """
    return GeometricRequest(
        preconditions=request.preconditions,
        start=state_from_msg(request.start),
        agent=request.agent,
        behaviour=request.behaviour,
        alternative=request.alternative,
        world_revision=request.world_revision,
        seed=request.seed,
        time_budget=request.time_budget,
        request_id=request.request_id,
        mode=request.mode,
        planner=request.planner,
        preferred_end=state_from_msg(request.preferred_end, 'preferred end'),
    )


def advice_request_from_msg(request: msg.AdviceRequest) -> AdviceRequest:
    """The request for advice.

    :raises MotionPlannerError: INVALID_START as in `state_from_msg`
    """
    return AdviceRequest(
        preconditions=tuple(request.preconditions),
        start=state_from_msg(request.start),
        world_revision=request.world_revision,
        seed=request.seed,
        request_id=request.request_id,
        pairwise=request.pairwise,
        places=request.places,
        purpose=request.purpose,
        before=tuple(request.before),
        after=tuple(request.after),
        ends=tuple(
            (end.agent, attitude_from_msg(end, 'end')) if end.agent else None
            for end in request.ends
        ),
        effort=request.effort,
        motions=tuple(motion_from_msg(motion) for motion in request.motions),
    )


def answer_to_msg(
    answer: GeometricAnswer, request: msg.GeometricRequest, time_spent: float
) -> msg.GeometricAnswer:
    """The answer to ``request``, which took ``time_spent`` [s]."""
    return msg.GeometricAnswer(
        request_id=request.request_id,
        agent=answer.agent,
        objects=list(answer.objects),
        alternative=request.alternative,
        world_revision=answer.world_revision,
        status=int(answer.status),
        code=int(answer.code),
        scope=int(answer.scope),
        message=answer.message,
        end=state_to_msg(answer.end),
        assigned=bool(answer.assigned),
        motion=(
            motion_to_msg(answer.motion, answer.duration, answer.clearance)
            if answer.motion
            else msg.Motion()
        ),
        length=float(answer.length),
        residuals=[
            msg.ConstraintResidual(
                constraint=residual.constraint,
                violation=float(residual.violation),
                satisfied=bool(residual.satisfied),
            )
            for residual in answer.residuals
        ],
        attempts=[
            msg.Attempt(
                destination=agent_state_to_msg(attempt.agent, attempt.destination),
                result=int(attempt.result),
                reason=attempt.reason,
            )
            for attempt in answer.attempts
        ],
        diagnostics=diagnostics_to_msg(answer.diagnostics),
        advice=answer.advice,
        time_spent=float(time_spent),
    )


def advice_to_msg(
    answer: AdviceAnswer, request: msg.AdviceRequest, time_spent: float
) -> msg.AdviceAnswer:
    """The advice on ``request``, which took ``time_spent`` [s]."""
    return msg.AdviceAnswer(
        request_id=request.request_id,
        world_revision=answer.world_revision,
        candidates=[_candidate_to_msg(candidate) for candidate in answer.candidates],
        order=[int(index) for index in answer.order],
        # An array is taken as it is; of a list a million numbers would be checked one by one.
        pairwise_lower_bounds=array('d', answer.pairwise_lower_bounds),
        pairwise_estimates=array('d', answer.pairwise_estimates),
        places=[agent_state_to_msg(place.agent, place.attitude) for place in answer.places],
        place_candidates=[place.candidate for place in answer.places],
        place_lengths=array('d', answer.place_lengths),
        ends=[agent_state_to_msg(*end) if end else msg.AgentState() for end in answer.ends],
        tour_length=float(answer.tour_length),
        opportunities=[
            msg.Opportunity(
                candidate=item.candidate,
                motion=item.motion,
                distance=float(item.distance),
                end=agent_state_to_msg(*item.end),
            )
            for item in answer.opportunities
        ],
        time_spent=float(time_spent),
    )


def advice_error_to_msg(
    error: MotionPlannerError, request: msg.AdviceRequest, revision: str, time_spent: float
) -> msg.AdviceAnswer:
    """Why there is no advice at all on ``request``."""
    return msg.AdviceAnswer(
        request_id=request.request_id,
        world_revision=revision,
        code=int(error.code),
        message=error.message,
        time_spent=float(time_spent),
    )


def diagnostics_to_msg(diagnostics: Iterable[Diagnostic]) -> list[msg.Diagnostic]:
    """Remarks in their order."""
    return [
        msg.Diagnostic(
            severity=int(diagnostic.severity),
            source=diagnostic.source,
            line=diagnostic.line,
            column=diagnostic.column,
            text=diagnostic.text,
            message=diagnostic.message,
        )
        for diagnostic in diagnostics
    ]


def world_to_msg(world: World) -> msg.World:
    """The world, its objects, obstacles, robots, regions and map, in their order."""
    return msg.World(
        source=world.source,
        revision=world.revision,
        x_min=float(world.bounds.x_min),
        y_min=float(world.bounds.y_min),
        x_max=float(world.bounds.x_max),
        y_max=float(world.bounds.y_max),
        objects=[
            msg.WorldObject(
                label=label,
                field_names=sorted(item.fields),
                field_values=[float(item.fields[name]) for name in sorted(item.fields)],
            )
            for label, item in world.objects.items()
        ],
        obstacles=[_obstacle_to_msg(obstacle) for obstacle in world.obstacles],
        regions=[_region_to_msg(region) for region in world.regions.values()],
        robots=[robot_to_msg(robot) for robot in world.robots.values()],
        map=[map_to_msg(world.map)] if world.map else [],
    )


def descriptor_of(row: Specification) -> ParameterDescriptor:
    """What ``ros2 param describe`` shows; typed dynamically, so that 50 will do for 50.0."""
    descriptor = ParameterDescriptor(
        description=f'{row.description} [{row.unit}]' if row.unit else row.description,
        read_only=row.read_only,
        dynamic_typing=True,
    )
    if row.low is not None and row.high is not None:
        if isinstance(row.default, int):
            span = IntegerRange(from_value=int(row.low), to_value=int(row.high), step=1)
            descriptor.integer_range = [span]
        else:
            descriptor.floating_point_range = [
                FloatingPointRange(from_value=row.low, to_value=row.high)
            ]
    return descriptor


def _region_to_msg(region: Region) -> msg.Region:
    if isinstance(region, Polygon):
        corners = [Point(x=float(x), y=float(y)) for x, y in chain(region)]
        return msg.Region(name=region.name, polygon=corners)
    x, y = region.center
    return msg.Region(
        name=region.name,
        center=Point(x=float(x), y=float(y)),
        radius=float(region.radius),
    )


def _obstacle_to_msg(obstacle: Obstacle) -> msg.Obstacle:
    if isinstance(obstacle, Polygon):
        corners = [Point(x=float(x), y=float(y)) for x, y in chain(obstacle)]
        return msg.Obstacle(name=obstacle.name, polygon=corners)
    x, y = obstacle.center
    return msg.Obstacle(
        name=obstacle.name,
        center=Point(x=float(x), y=float(y)),
        radius=float(obstacle.radius),
    )


def _candidate_to_msg(candidate: CandidateAdvice) -> msg.CandidateAdvice:
    return msg.CandidateAdvice(
        lower_bound=float(candidate.lower_bound),
        estimate=float(candidate.estimate),
        impossible=bool(candidate.impossible),
        scope=int(candidate.scope),
        code=int(candidate.code),
        message=candidate.message,
        objects=list(candidate.objects),
    )
