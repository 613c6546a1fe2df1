"""Drive from an attitude to one of several: straight shots first, then sampling, then shortening."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from motion_planner_node.errors import Stopped
from motion_planner_node.paths.edges import free_word
from motion_planner_node.paths.result import PathBudget, PathOutcome, PathResult
from motion_planner_node.paths.sampling import sample_path
from motion_planner_node.paths.shortening import edge_lengths, shortened
from motion_planner_node.robots.body import Body, sufficient_clearance
from motion_planner_node.robots.driving import integrate, shortest_between
from motion_planner_node.robots.motion import Attitude, Motion, Segment, merged
from motion_planner_node.robots.robot import Robot
from motion_planner_node.robots.steering import MOST_PIECES
from motion_planner_node.world.scene import Scene
from motion_planner_node.world.shapes import Shapes

Rows = NDArray[np.float64]

#: Attitudes along a path, random moves and rounds: first for every way, then for the best.
FIRST_LOOK = (20, 100, 1)
LAST_LOOK = (30, 200, 2)
#: Clearance that is kept beyond the needed one where start and goal have it, per radius.
SPARE_CLEARANCE = 0.002


def _row(attitude: Attitude) -> Rows:
    return np.array([attitude.x, attitude.y, attitude.heading], float)


class _Search:
    """One search; nothing of it outlives the answer."""

    def __init__(
        self,
        scene: Scene,
        robot: Robot,
        start: Attitude,
        goals: Sequence[Attitude],
        seed: int,
        budget: PathBudget,
        should_stop: Callable[[], bool],
    ) -> None:
        self._scene = scene
        self._robot = robot
        self._start = start
        self._goals = goals
        self._rows = np.array([_row(goal) for goal in goals])
        self._seed = seed & (2**64 - 1)
        self._budget = budget
        self._should_stop = should_stop
        needed = sufficient_clearance(robot.body)
        start_clearance = scene.clearance([[start.x, start.y]])
        spare = np.minimum(scene.clearance(self._rows), start_clearance) - needed
        #: Clearance [m] that is kept on the way to each goal beyond the needed one.
        self._spare = np.clip(spare, 0.0, SPARE_CLEARANCE * robot.radius)

    def _body(self, goal: int) -> Body:
        body = self._robot.body
        return body._replace(margin=body.margin + float(self._spare[goal]))

    def _frame(self, goal: int) -> tuple[Shapes, Body, int, float]:
        robot = self._robot
        return self._scene.shapes, self._body(goal), robot.steering, robot.turning_radius

    def _motion(self, path: Rows, goal: int) -> Motion | None:
        """The motion along ``path`` (n, 3), each edge planned from where the one before ended."""
        here = self._start
        segments: list[Segment] = []
        pieces = np.zeros((MOST_PIECES, 4))
        for row in path[1:]:
            if free_word(*self._frame(goal), _row(here), row, np.inf, pieces)[1] < 0:
                return None
            edge = self._robot.segments_of(pieces)
            segments += edge
            here = integrate(here, edge, self._robot)
        motion = Motion(self._robot.label, self._start, merged(segments))
        return motion if self._scene.motion_is_free(motion, self._robot) else None

    def _shortened(self, path: Rows, goal: int, look: tuple[int, int, int], number: int) -> Rows:
        points, moves, rounds = look
        random = np.random.default_rng([self._seed, goal, number])
        draws = random.uniform(-1.0, 1.0, (rounds, moves, 3))
        return shortened(*self._frame(goal), path, points, draws)

    def _sampled(self, goal: int, estimate: float) -> Motion | None:
        """The shortest of several sampled motions; the ways round obstacles differ among them."""
        best: Rows | None = None
        length = np.inf
        for number in range(self._budget.attempts):
            seeds = np.random.SeedSequence([self._seed, goal, number]).generate_state(1)
            path = sample_path(
                self._scene.shapes,
                self._body(goal),
                self._robot,
                self._start,
                self._goals[goal],
                int(seeds[0]) or 1,
                self._budget.iterations,
                self._should_stop,
            )
            if path is None:
                break
            path = self._shortened(path, goal, FIRST_LOOK, number)
            shorter = float(edge_lengths(*self._frame(goal), path).sum())
            if shorter < length:
                best, length = path, shorter
            if length <= self._budget.good_enough * estimate:
                break
        if best is None:
            return None
        last = self._shortened(best, goal, LAST_LOOK, self._budget.attempts)
        return self._motion(last, goal) or self._motion(best, goal)

    def _shot(self) -> tuple[Motion | None, int]:
        """The shortest free word to any of the goals."""
        shortest, which = np.inf, -1
        pieces = np.zeros((MOST_PIECES, 4))
        for goal, row in enumerate(self._rows):
            length, word = free_word(*self._frame(goal), _row(self._start), row, shortest, pieces)
            if word >= 0:
                shortest, which = length, goal
        if which < 0:
            return None, -1
        return self._motion(np.array([_row(self._start), self._rows[which]]), which), which

    def run(self) -> tuple[Motion | None, int]:
        """The best motion found, and to which goal; None and -1 when there is none."""
        best, which = self._shot()
        least = shortest_between(_row(self._start), self._rows, self._robot)
        field = self._scene.free_space(self._robot.body).distance_from(
            float(self._start.x), float(self._start.y)
        )
        estimates = np.maximum(least, field.at(self._rows[:, 0], self._rows[:, 1]))
        for goal in np.argsort(estimates, kind='stable')[: self._budget.goals]:
            if best and best.length <= self._budget.good_enough * estimates[goal]:
                break
            motion = self._sampled(int(goal), float(estimates[goal]))
            if motion and (best is None or motion.length < best.length):
                best, which = motion, int(goal)
        return (best, which) if best else (None, -1)


def plan_path(
    scene: Scene,
    robot: Robot,
    start: Attitude,
    goals: Sequence[Attitude],
    seed: int,
    should_stop: Callable[[], bool],
    budget: PathBudget | None = None,
) -> PathResult:
    """A short motion of ``robot`` from ``start`` to one of ``goals``, re-validated exactly.

    The same arguments give the same result bit for bit.  Raises Stopped when ``should_stop``
    says so.
    """
    if should_stop():
        raise Stopped
    if not goals:
        return PathResult(PathOutcome.NO_PATH, reason='there is no destination to drive to')
    needed = sufficient_clearance(robot.body)
    name, clearance = scene.nearest_obstacle(start.x, start.y)
    if clearance < needed:
        return PathResult(
            PathOutcome.START_IN_OBSTACLE,
            reason=f'the start ({start.x:g}, {start.y:g}) is {clearance:.3f} m from {name}, '
            f'closer than the radius {robot.radius:g} m',
        )
    free = [i for i, goal in enumerate(goals) if scene.clearance([[goal.x, goal.y]])[0] >= needed]
    if not free:
        goal = goals[0]
        name, clearance = scene.nearest_obstacle(goal.x, goal.y)
        return PathResult(
            PathOutcome.GOAL_IN_OBSTACLE,
            reason=f'the destination ({goal.x:g}, {goal.y:g}) is {clearance:.3f} m from {name}, '
            f'closer than the radius {robot.radius:g} m',
        )
    space = scene.free_space(robot.body)
    here = space.component_of(start.x, start.y)
    connected = [i for i in free if space.component_of(goals[i].x, goals[i].y) == here]
    if not connected:
        goal = goals[free[0]]
        return PathResult(
            PathOutcome.UNREACHABLE,
            reason=f'the destination ({goal.x:g}, {goal.y:g}) is walled off from the start '
            f'({start.x:g}, {start.y:g}): no gap is {2 * robot.radius:g} m wide',
        )
    budget = budget or PathBudget()
    candidates = [goals[i] for i in connected]
    search = _Search(scene, robot, start, candidates, seed, budget, should_stop)
    motion, which = search.run()
    if motion is None:
        reason = f'no path found in {budget.iterations} iterations'
        return PathResult(PathOutcome.NO_PATH, reason=reason)
    return PathResult(PathOutcome.FOUND, motion, connected[which])
