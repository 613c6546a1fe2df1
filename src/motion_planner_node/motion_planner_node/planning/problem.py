"""What a request asks for, read, checked and compiled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import isfinite

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.language import Preconditions
from motion_planner_node.parameters import MODES
from motion_planner_node.paths.planners import planner_named
from motion_planner_node.requests import GeometricRequest
from motion_planner_node.robots.motion import Attitude, GeometricState
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import Program, compile_program
from motion_planner_node.world.model import World


@dataclass(frozen=True, slots=True)
class Problem:
    """Ground preconditions, compiled, and where everybody stands before the action."""

    program: Program
    robot: Robot
    state: GeometricState

    @property
    def agent(self) -> str:
        """Label of the robot that moves."""
        return self.program.agent

    @property
    def start(self) -> Attitude:
        """Where the robot that moves stands."""
        return self.state[self.agent]

    def starting_at(self, start: Attitude) -> Problem:
        """The same problem from another attitude of the robot that moves."""
        return replace(self, state=self.moved_to(start))

    def moved_to(self, end: Attitude) -> GeometricState:
        """The attitudes of all agents when the robot has moved to ``end``."""
        return {**self.state, self.agent: end}


def read_problem(
    world: World,
    preconditions: Preconditions,
    state: GeometricState,
    agent: str = '',
    remarks: Sequence[Diagnostic] | None = None,
    compiled: Program | None = None,
) -> Problem:
    """Compile ``preconditions`` for ``state``; ``agent`` moves, or the first one stated.

    ``remarks`` are those of ``language.check``, where they are known; ``compiled`` is the program
    of the same text and agent for another state, where there is one.

    :raises MotionPlannerError: UNKNOWN_AGENT, UNKNOWN_OBJECT, UNKNOWN_FUNCTION,
        UNKNOWN_PROPERTY, NO_START or INVALID_PRECONDITIONS
    """
    program = compiled.starting_at(state) if compiled else None
    if program is None:
        program = compile_program(preconditions, world, state, agent, remarks)
    if not program.assigns and program.agent not in state:
        raise MotionPlannerError(
            Code.NO_START, f'{program.agent} has no attitude yet: nothing has assigned one'
        )
    return Problem(program, world.robots[program.agent], state)


def check_request(world: World, request: GeometricRequest) -> None:
    """Refuse what is wrong with a request apart from its preconditions.

    :raises MotionPlannerError: WORLD_CHANGED, UNSUPPORTED, or as `check_attitudes`
    """
    check_revision(world, request.world_revision)
    if request.behaviour.strip():
        raise MotionPlannerError(
            Code.UNSUPPORTED, 'behaviour constraints are not supported yet: leave them empty'
        )
    if request.mode and request.mode not in MODES:
        raise MotionPlannerError(
            Code.UNSUPPORTED, f'there is no mode {request.mode!r}; there are {", ".join(MODES)}'
        )
    if request.planner:
        planner_named(request.planner)
    check_attitudes(world, request.preferred_end, 'preferred end')
    if not 0.0 <= request.time_budget < float('inf'):
        raise MotionPlannerError(
            Code.UNSUPPORTED,
            f'a time budget of {request.time_budget} s makes no sense: give seconds, or 0',
        )


def preferred_end(problem: Problem, request: GeometricRequest) -> Attitude | None:
    """Where the robot that moves should end, if anybody cares.

    :raises MotionPlannerError: UNKNOWN_AGENT when the end is another robot's
    """
    for agent, attitude in request.preferred_end.items():
        if agent != problem.agent:
            raise MotionPlannerError(
                Code.UNKNOWN_AGENT,
                f'the preferred end is one of {agent}, but {problem.agent} is what moves',
            )
        return positive_zeros(attitude)
    return None


def check_revision(world: World, revision: str) -> None:
    """Refuse a request that was made for another world.

    :raises MotionPlannerError: WORLD_CHANGED with both revisions
    """
    if revision and revision != world.revision:
        raise MotionPlannerError(
            Code.WORLD_CHANGED,
            f'the request is for revision {revision} of the world, '
            f'the motion planner holds {world.revision}',
        )


def checked_state(world: World, state: GeometricState) -> dict[str, Attitude]:
    """Where everybody stands: ``state``, and the world's own starts of robots that it leaves out.

    Labels come in order, and negative zeros are made positive ones, so that equal states are
    answered alike.

    :raises MotionPlannerError: UNKNOWN_AGENT, or INVALID_START for a number that is not finite
    """
    known = {label: car.start for label, car in world.robots.items() if car.start} | dict(state)
    check_attitudes(world, known, 'start')
    return {agent: positive_zeros(attitude) for agent, attitude in sorted(known.items())}


def positive_zeros(attitude: Attitude) -> Attitude:
    """The same attitude without negative zeros, so that equal ones have equal bits."""
    return Attitude(attitude.x + 0.0, attitude.y + 0.0, attitude.heading + 0.0)


def check_attitudes(world: World, state: GeometricState, what: str) -> None:
    """Refuse attitudes of agents that ``world`` lacks, or with numbers that are not finite.

    ``what`` they are of their agents, for errors.

    :raises MotionPlannerError: UNKNOWN_AGENT or INVALID_START
    """
    for agent, attitude in sorted(state.items()):
        if agent not in world.robots:
            raise MotionPlannerError(
                Code.UNKNOWN_AGENT,
                f'the {what} names agent {agent}; the world has {_listed(sorted(world.robots))}',
            )
        numbers = (attitude.x, attitude.y, attitude.heading)
        if not all(isfinite(number) for number in numbers):
            raise MotionPlannerError(
                Code.INVALID_START, f'the {what} of {agent} is not finite: {numbers}'
            )


def _listed(labels: Sequence[str]) -> str:
    shown = ', '.join(labels[:8]) or 'no robot'
    return f'{shown}, ...' if len(labels) > 8 else shown
