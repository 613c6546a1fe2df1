"""Answers in words and numbers: every way in which a request can end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from math import isfinite

import numpy as np

from motion_planner_node.codes import AttemptResult, Code, Scope
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import Impossible, scope_of
from motion_planner_node.planning.stream import Found
from motion_planner_node.planning.tried import Tried
from motion_planner_node.requests import GeometricAnswer
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.satisfaction import descend
from motion_planner_node.world.model import CarModel


def refused(error: MotionPlannerError, revision: str) -> GeometricAnswer:
    """The request is at fault."""
    return GeometricAnswer(
        code=error.code,
        message=error.message,
        world_revision=revision,
        diagnostics=error.diagnostics,
    )


def found(problem: Problem, ground: Ground, result: Found) -> GeometricAnswer:
    """A motion that ends where every constraint is met."""
    return replace(
        _about(problem, ground),
        end=problem.moved_to(result.end),
        motion=result.motion,
        residuals=problem.program.residuals(result.end),
        attempts=tuple(result.tried.attempts),
    )


def assigned(
    problem: Problem, ground_of: Callable[[CarModel], Ground], alternative: int
) -> GeometricAnswer:
    """What becomes of commands: the attitudes that they set, when the robots can be in them.

    Constraints that stand beside commands are checked at the attitude that is set.
    """
    ground = ground_of(problem.car)
    world = ground.scene.world
    state = problem.program.apply_commands(problem.state)
    end = state[problem.agent]
    about = replace(
        _about(problem, ground), assigned=True, residuals=problem.program.residuals(end)
    )
    for agent, attitude in state.items():
        if attitude == problem.state.get(agent):
            continue
        trouble = ground_of(world.robots[agent]).trouble(attitude)
        if trouble:
            return replace(
                about,
                code=Code.STATE_IN_OBSTACLE,
                scope=_scope_of_assignment(problem),
                message=f'the attitude set for {agent} is in an obstacle: {trouble}',
            )
    missed = problem.program.unmet(end)
    if missed:
        return replace(
            about,
            code=Code.CONTRADICTION,
            # The constraints may speak of other agents, who will not stand where they do now.
            scope=scope_of(problem, _scope_of_assignment(problem)),
            message=f'the attitude set for {problem.agent} will not do: {missed[0]}',
        )
    if alternative:
        return replace(
            about,
            code=Code.NO_MORE_ALTERNATIVES,
            message=f'the attitude of {problem.agent} is set by commands: there is only one',
        )
    return replace(about, end=state, motion=Motion(problem.agent, end))


def impossible(problem: Problem, ground: Ground, proof: Impossible) -> GeometricAnswer:
    """There is a proof that nothing can be found."""
    return replace(
        _about(problem, ground),
        code=proof.code,
        scope=proof.scope,
        message=proof.message,
        advice=proof.advice,
        residuals=problem.program.residuals(compromise(problem)),
    )


def out_of_time(problem: Problem, ground: Ground, tried: Tried) -> GeometricAnswer:
    """The request was broken off."""
    return replace(
        _about(problem, ground),
        code=Code.OUT_OF_TIME,
        message=f'the time budget ran out after {tried.total} destinations',
        attempts=tuple(tried.attempts),
    )


def exhausted(problem: Problem, ground: Ground, tried: Tried, alternative: int) -> GeometricAnswer:
    """All rounds are over and nothing (more) was found; nothing is proven."""
    about = replace(_about(problem, ground), attempts=tuple(tried.attempts))
    best = compromise(problem)
    about = replace(about, residuals=problem.program.residuals(best))
    if alternative:
        return replace(
            about,
            code=Code.NO_MORE_ALTERNATIVES,
            message=f'no destination number {alternative} was found that differs from those before',
        )
    without_path = tried.counts[AttemptResult.NO_PATH]
    if without_path:
        return replace(
            about,
            code=Code.NO_PATH,
            message=f'no path was found to any of {without_path} destinations, for example: '
            f'{tried.examples[AttemptResult.NO_PATH]}',
            advice='there may be too little room to turn: another heading could be reached',
        )
    blocked = tried.counts[AttemptResult.IN_OBSTACLE]
    if blocked:
        return replace(
            about,
            code=Code.IN_OBSTACLE,
            message=f'all {blocked} destinations that were found are blocked, for example: '
            f'{tried.examples[AttemptResult.IN_OBSTACLE]}',
            advice=_in_the_way(tried, ground),
        )
    missed = problem.program.unmet(best)
    return replace(
        about,
        code=Code.NOT_SATISFIED,
        message=missed[0] if missed else 'no attitude was found that meets all constraints',
    )


def compromise(problem: Problem) -> Attitude:
    """Where the descent from the start ends, which misses the constraints by the least it can."""
    start = problem.start
    state = np.array([[start.x, start.y, start.heading]])
    end = descend(problem.program, state).states[0]
    return Attitude(*(float(number) for number in end)) if all(map(isfinite, end)) else start


def _about(problem: Problem, ground: Ground) -> GeometricAnswer:
    return GeometricAnswer(
        code=Code.NONE,
        agent=problem.agent,
        objects=problem.program.objects,
        world_revision=ground.scene.world.revision,
    )


def _scope_of_assignment(problem: Problem) -> Scope:
    """Whether the commands set the same attitudes wherever everybody stands."""
    try:
        problem.program.apply_commands({})
    except MotionPlannerError:
        return Scope.THIS_START
    return Scope.ANY_START


def _in_the_way(tried: Tried, ground: Ground) -> str:
    names: Counter[str] = Counter()
    for attempt in tried.attempts:
        x, y = attempt.destination.x, attempt.destination.y
        names[ground.scene.nearest_obstacle(x, y)[0]] += 1
    return f'in the way: {", ".join(name for name, _ in names.most_common(4))}' if names else ''
