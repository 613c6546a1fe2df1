"""The lattice search of one query: from both ends in turns, coarse first and then finer.

Where it is hard to leave the start, a search that comes from the destinations looks at all places
round the start; where it is hard to arrive, one from the start does so round the destination.  Each
in turns, with more and more effort, costs at most a few times what the luckier one would cost alone.
"""

from __future__ import annotations

from math import inf, pi
from typing import NamedTuple

import numpy as np

from motion_planner_node.paths.edges import Row, Rows, edge_lengths
from motion_planner_node.paths.lattice import (
    EXHAUSTED,
    GOES_ON,
    Grain,
    Lattice,
    Task,
    attitudes,
    best_root,
    expanded,
    grow,
    new_lattice,
    path_of,
    path_to,
    plant,
)
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot

#: Attitudes that are expanded between two looks at the clock.
CHUNK = 250
#: Attitudes that are expanded from one end before it is the other's turn; then twice as many.
FIRST_TURN = 500
#: Turning radii within which destinations are shot at from where a search from the start has been.
SHOT = 4.0
#: Straight moves are tried longer as well, so that open space is crossed in few steps.
LEAPS = (1.0, 4.0)
#: What a turn on the spot costs per radian, in steps, as it adds no length.
TURN_PRICE = 0.02
#: Length of a step of robots that turn on the spot, in cells of the travel field or radii.
STEP = 2.5


class Level(NamedTuple):
    """How fine a search is.

    turn: [rad] of a move along the sharpest arc.
    cell: places that count as one, in units of the turning radius.
    headings: that are told apart.
    weight: as `lattice.Grain` has it.
    effort: how many of the budget's attitudes it may look at.
    """

    turn: float
    cell: float
    headings: int
    weight: float
    effort: int


LEVELS = (Level(0.4, 0.35, 24, 1.1, 1), Level(0.2, 0.15, 48, 1.2, 4))


def moves_of(robot: Robot, step: float, turn: float, leaps: tuple[float, ...]) -> Rows:
    """What the robot can do in one step of ``step`` [m] or ``turn`` [rad]: pieces (m, 4).

    Straight ones are longer by each of the factors ``leaps``.
    """
    model = MODELS[robot.kind]
    rows: list[tuple[float, float, float, float]] = []
    for way in (step, -step) if model.reverses else (step,):
        if model.steers:
            bend = 1.0 / robot.turning_radius
            rows += [(bend, way, 0.0, 0.0), (-bend, way, 0.0, 0.0)]
        rows += [(0.0, leap * way, 0.0, 0.0) for leap in leaps]
    if model.slides:
        rows += [
            (0.0, leap * step, direction * pi / 4.0, 0.0)
            for direction in range(-3, 5)
            for leap in leaps
            if direction
        ]
    if model.turns:
        rows += [(0.0, 0.0, 0.0, turn), (0.0, 0.0, 0.0, -turn)]
    return np.array(rows, np.float64)


class _End:
    """The search from one end, at one level."""

    def __init__(
        self, query: Query, level: Level, target: Row, sign: float, roots: Rows, longest: float
    ) -> None:
        self._query = query
        self.field = query.field_from(target)
        robot = query.robot
        unit = robot.turning_radius or STEP * max(self.field.cell, robot.radius)
        corner = query.scene.shapes.bounds[:2]
        self._grain = Grain(corner, level.cell * unit, level.headings, level.weight)
        step = level.turn * unit
        moves = moves_of(robot, step, 2.0 * pi / level.headings, LEAPS)
        prices = np.abs(moves[:, 1]) + TURN_PRICE * step * np.abs(moves[:, 3])
        self._task = Task(target, sign, moves, prices)
        most = level.effort * query.budget.attitudes + len(roots)
        self.lattice: Lattice = new_lattice(most, longest, query.budget.improving)
        plant(self.lattice, query.frame, self.field, self._grain, self._task, roots)
        self.state = GOES_ON

    def go_on(self, expansions: int) -> Rows | None:
        """Expand so many attitudes, and more once there is a path, which is returned."""
        query = self._query
        while self.state == GOES_ON and (expansions > 0 or self.path is not None):
            query.check_time()
            self.state = grow(self.lattice, query.frame, self.field, self._grain, self._task, CHUNK)
            expansions -= CHUNK
        return self.path

    def shot(self, goals: Rows, longest: float) -> Rows | None:
        """A path of less than ``longest`` [m] from what was looked at on to another of the ``goals``."""
        lattice, query = self.lattice, self._query
        rows, costs = lattice.rows[: attitudes(lattice)], lattice.costs[: attitudes(lattice)]
        for goal in goals:
            away = np.hypot(rows[:, 0] - goal[0], rows[:, 1] - goal[1])
            near = np.flatnonzero(away < SHOT * query.reach)
            for first in range(0, len(near), CHUNK):
                query.check_time()
                some = near[first : first + CHUNK]
                ends = best_ending(query.frame, rows[some], costs[some], goal[None, :], longest)
                if ends[1] >= 0:
                    return path_to(lattice, int(some[ends[1]]), goal)
        return None

    @property
    def path(self) -> Rows | None:
        """The best path so far."""
        return path_of(self.lattice, self._task)


def search_lattice(query: Query, longest: float = inf) -> Rows | None:
    """A path to one of the goals shorter than ``longest`` [m], as attitudes (n, 3)."""
    for level in LEVELS:
        path = _search(query, level, longest)
        if path is not None or longest < inf:
            return path
    return None


def _search(query: Query, level: Level, longest: float) -> Rows | None:
    backward = _End(query, level, query.start, -1.0, query.goals, longest)
    ends, turn = [backward], FIRST_TURN
    path = backward.go_on(turn)
    if path is None and backward.state == GOES_ON:
        goal = query.goals[best_root(backward.lattice)]
        ends.append(_End(query, level, goal, 1.0, query.start[None, :], longest))
    while path is None and all(end.state == GOES_ON for end in ends):
        for end in reversed(ends):
            path = end.go_on(turn)
            if path is not None or end.state == EXHAUSTED:
                break
        turn *= 2
    if path is not None and backward.path is None and backward.state == GOES_ON:
        # Another destination may be nearer than the one that was driven to.
        backward.lattice.best[0] = edge_lengths(query.frame, path).sum()
        shorter = backward.go_on(turn)
        path = path if shorter is None else shorter
    query.shut_in = path is None and len(ends) > 1 and ends[-1].state == EXHAUSTED
    if query.shut_in:
        # It has looked for one of the destinations, but at all that the start leads to.
        path = ends[-1].shot(query.goals, longest)
        query.shut_in = path is None
    if path is None:
        count = sum(expanded(end.lattice) for end in ends)
        query.hopeless = any(end.state == EXHAUSTED for end in ends)
        query.efforts.append(
            f'{count} attitudes of a lattice{", all that there are" if query.hopeless else ""}'
        )
    return path
