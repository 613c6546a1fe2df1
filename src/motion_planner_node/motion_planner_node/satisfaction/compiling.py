"""From ground preconditions to a program, or to all that is wrong with them."""

from __future__ import annotations

from collections.abc import Sequence

from motion_planner_node.codes import Code
from motion_planner_node.errors import Diagnostic, MotionPlannerError
from motion_planner_node.language import Preconditions
from motion_planner_node.language.check import check
from motion_planner_node.robots.motion import GeometricState
from motion_planner_node.satisfaction.program import Program
from motion_planner_node.world.model import World


def compile_program(
    preconditions: Preconditions,
    world: World,
    start: GeometricState,
    agent: str = '',
    remarks: Sequence[Diagnostic] | None = None,
) -> Program:
    """Compile ground preconditions for ``agent``, or else for the first one that they state.

    ``remarks`` are those of ``language.check`` for the same text and world, where they are known.

    Raises MotionPlannerError with all that ``language.check`` finds except contradictions, which
    the program itself proves (``contradiction``); UNKNOWN_AGENT when ``agent`` is not stated;
    NO_START when ``start`` lacks a stated agent that no command sets.
    """
    if preconditions.variables:
        names = ', '.join(sorted(preconditions.variables))
        message = f'the preconditions are not ground: {names}'
        raise MotionPlannerError(Code.INVALID_PRECONDITIONS, message)
    found = check(preconditions, world) if remarks is None else remarks
    errors = [diagnostic for diagnostic in found if diagnostic.code is not Code.CONTRADICTION]
    if errors:
        raise MotionPlannerError.from_diagnostics(errors)
    stated = preconditions.agents
    if not stated:
        raise MotionPlannerError(
            Code.INVALID_PRECONDITIONS, 'no statement (agent ...) says which robot acts'
        )
    if agent and agent not in stated:
        message = f'the preconditions do not state (agent {agent}), only {", ".join(stated)}'
        raise MotionPlannerError(Code.UNKNOWN_AGENT, message)
    reasons = tuple(diagnostic.message for diagnostic in found)
    program = Program(preconditions, world, start, agent or stated[0], reasons)
    for label in stated:
        if label not in program.start:
            raise MotionPlannerError(Code.NO_START, f'the start has no attitude of {label}')
    return program
