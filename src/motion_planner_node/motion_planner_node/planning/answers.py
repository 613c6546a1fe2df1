"""Answers in words and numbers: every way in which a request can end."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from motion_planner_node.codes import AttemptResult, Code, Scope
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.planning.ground import Ground
from motion_planner_node.planning.problem import Problem
from motion_planner_node.planning.proofs import Impossible, scope_of
from motion_planner_node.planning.tried import Tried
from motion_planner_node.planning.ways import Found
from motion_planner_node.requests import GeometricAnswer
from motion_planner_node.robots.motion import Attitude, Motion
from motion_planner_node.robots.robot import Robot
from motion_planner_node.satisfaction import from_start, restarts, separation, together, unsolved

#: Descents among which the best compromise is chosen.
COMPROMISES = 64


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
        duration=ground.robot.duration(result.motion),
        clearance=ground.scene.motion_clearance(result.motion, ground.robot),
        residuals=problem.program.residuals(result.end),
        attempts=tuple(result.tried.attempts),
    )


def assigned(
    problem: Problem, ground_of: Callable[[Robot], Ground], alternative: int
) -> GeometricAnswer:
    """What becomes of commands: the attitudes that they set, when the robots can be in them.

    Constraints that stand beside commands are checked at the attitude that is set.
    """
    ground = ground_of(problem.robot)
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
        residuals=problem.program.residuals(compromise(problem, ground)),
    )


def out_of_time(problem: Problem, ground: Ground, tried: Tried) -> GeometricAnswer:
    """The request was broken off."""
    return replace(
        _about(problem, ground),
        code=Code.OUT_OF_TIME,
        message=f'the time budget ran out after {tried.total} destinations',
        attempts=tuple(tried.attempts),
    )


def as_cancelled(answer: GeometricAnswer) -> GeometricAnswer:
    """``answer`` when it was not the clock that broke the request off, but its client."""
    if answer.code is not Code.OUT_OF_TIME:
        return answer
    return replace(answer, code=Code.CANCELLED, message='the request was cancelled')


def exhausted(problem: Problem, ground: Ground, tried: Tried, alternative: int) -> GeometricAnswer:
    """All rounds are over and nothing (more) was found; nothing is proven."""
    about = replace(_about(problem, ground), attempts=tuple(tried.attempts))
    best = compromise(problem, ground)
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
    return replace(about, code=Code.NOT_SATISFIED, message=_fight(problem, ground, best))


def _fight(problem: Problem, ground: Ground, best: Attitude) -> str:
    """Which constraints fight each other, and what the ``best`` compromise makes of them."""
    program = problem.program
    rows = unsolved(program, ground.scene.world.bounds)
    if not rows:
        return 'no attitude was found that meets all constraints'
    apart = separation(program, rows)
    missed = '; '.join(program.only(rows).unmet(best))
    return (
        f'no attitude was found that meets {together(program, rows)}'
        f'{f", but {apart}" if apart else ""}; '
        f'the best compromise is ({best.x:.6g}, {best.y:.6g}, {best.heading:.4g}): {missed}'
    )


def compromise(problem: Problem, ground: Ground) -> Attitude:
    """The attitude on the map that misses the constraints least, of many descents."""
    bounds = ground.scene.world.bounds
    first = from_start(problem.program, problem.start)
    more = restarts(problem.program, bounds, np.random.default_rng(0), COMPROMISES)
    states = np.concatenate((first.states, more.states))
    x, y = states[:, 0], states[:, 1]
    inside = (x >= bounds.x_min) & (x <= bounds.x_max) & (y >= bounds.y_min) & (y <= bounds.y_max)
    violations = np.concatenate((first.violations, more.violations))
    with np.errstate(over='ignore'):
        missed = np.where(inside, (violations**2).sum(axis=1), np.inf)
    best = int(np.argmin(missed))
    if not np.isfinite(missed[best]):
        return problem.start
    return Attitude(*(float(number) for number in states[best]))


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
