"""Drive from an attitude to one of several, by the planner of one's choice."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf

import numpy as np

from motion_planner_node.errors import Stopped
from motion_planner_node.paths.finishing import first_valid
from motion_planner_node.paths.improving import refined, simplified
from motion_planner_node.paths.planners import DEFAULT_PLANNER, planner_named
from motion_planner_node.paths.query import Query, Region
from motion_planner_node.paths.result import PathBudget, PathOutcome, PathResult
from motion_planner_node.robots.motion import Attitude
from motion_planner_node.robots.robot import Robot
from motion_planner_node.world.scene import Scene


def plan_path(
    scene: Scene,
    robot: Robot,
    start: Attitude,
    goals: Sequence[Attitude],
    seed: int,
    should_stop: Callable[[], bool],
    budget: PathBudget | None = None,
    planner: str = DEFAULT_PLANNER,
    region: Region | None = None,
    longest: float = inf,
) -> PathResult:
    """A short motion of ``robot`` from ``start`` to one of ``goals``, re-validated exactly.

    ``region`` names further destinations near attitudes (n, 3), which may be driven to instead.  A
    motion of ``longest`` [m] or more is not looked for by the default planner.
    The same arguments give the same result bit for bit.

    :raises Stopped: when ``should_stop`` says so
    :raises MotionPlannerError: UNSUPPORTED for a name that no ``planner`` has
    """
    planner_named(planner)
    if should_stop():
        raise Stopped
    if not goals:
        return PathResult(PathOutcome.NO_PATH, reason='there is no destination to drive to')
    rows = np.array([(goal.x, goal.y, goal.heading) for goal in goals], np.float64)
    if not scene.is_free([(start.x, start.y, start.heading)], robot.body)[0]:
        return PathResult(
            PathOutcome.START_IN_OBSTACLE, reason=_blocked(scene, robot, 'start', start)
        )
    free = np.flatnonzero(scene.is_free(rows, robot.body))
    if not len(free):
        reason = _blocked(scene, robot, 'destination', goals[0])
        return PathResult(PathOutcome.GOAL_IN_OBSTACLE, reason=reason)
    space = scene.free_space(robot.body)
    here = space.component_of(start.x, start.y)
    connected = free[space.components_of(rows[free, 0], rows[free, 1]) == here]
    if not len(connected):
        goal = goals[int(free[0])]
        return PathResult(
            PathOutcome.UNREACHABLE,
            reason=f'the destination ({goal.x:g}, {goal.y:g}) is walled off from the start '
            f'({start.x:g}, {start.y:g}): no gap is {2 * robot.body.inner_radius:g} m wide',
        )
    query = Query(
        scene,
        robot,
        start,
        rows[connected],
        (seed & (2**64 - 1),),
        budget or PathBudget(),
        should_stop,
        region,
        longest,
    )
    result = solved(query, planner)
    if result.goal_index < 0:
        return result
    return replace(result, goal_index=int(connected[result.goal_index]))


def solved(query: Query, planner: str = DEFAULT_PLANNER) -> PathResult:
    """The same for a ``query``, whose start and goals have been looked at."""
    chosen = planner_named(planner)
    raw = chosen.find(query)
    if raw is not None:
        paths = [raw]
        if chosen.improves:
            simple = simplified(query, raw)
            paths = [refined(query, simple), simple, raw]
        motion, which = first_valid(query, paths)
        if motion is not None:
            return PathResult(PathOutcome.FOUND, motion, which)
        query.efforts.append('the path that was found is not free by the exact check')
    reason = f'no path found: {"; ".join(query.efforts)}'
    return PathResult(PathOutcome.NO_PATH, reason=reason, shut_in=query.shut_in)


def _blocked(scene: Scene, robot: Robot, what: str, attitude: Attitude) -> str:
    name, clearance = scene.nearest_obstacle(attitude.x, attitude.y)
    return (
        f'the {what} ({attitude.x:g}, {attitude.y:g}) is {clearance:.3f} m from {name}, '
        f'{robot.lack}'
    )
