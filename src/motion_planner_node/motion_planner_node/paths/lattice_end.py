"""The lattice search of one query from one of its ends, at one grain."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np

from motion_planner_node.paths.edges import Row, Rows
from motion_planner_node.paths.lattice import (
    GOES_ON,
    Grain,
    Lattice,
    Task,
    attitudes,
    best_root,
    enlarged,
    expanded,
    grow,
    last_of_best,
    new_lattice,
    plant,
    way_to,
)
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.registry import MODELS
from motion_planner_node.robots.robot import Robot

#: Attitudes that are expanded between two looks at the clock.
CHUNK = 250
#: Turning radii within which destinations are shot at from where a search has been.
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
    any_word: as in `Task`.
    """

    turn: float
    cell: float
    headings: int
    weight: float
    effort: int
    any_word: bool


class Roots(NamedTuple):
    """Where a search begins.

    rows: (k, 3) attitudes.
    costs: (k,) lengths [m] of the ways that have led to them.
    origin: the lattice of those ways, of which they are the first k; None where there are no ways.
    """

    rows: Rows
    costs: Row
    origin: Lattice | None = None


def roots_at(rows: Rows) -> Roots:
    """A search that begins at attitudes (k, 3) themselves."""
    return Roots(rows, np.zeros(len(rows)))


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


class End:
    """The search from ``roots``: on to ``target`` where ``sign`` is 1, back to it where it is -1."""

    def __init__(
        self, query: Query, level: Level, target: Row, sign: float, roots: Roots, longest: float
    ) -> None:
        self._query = query
        self._roots = roots
        self.field = query.field_from(target)
        robot = query.robot
        unit = robot.turning_radius or STEP * max(self.field.cell, robot.radius)
        corner = query.scene.shapes.bounds[:2]
        self._grain = Grain(corner, level.cell * unit, level.headings, level.weight)
        step = level.turn * unit
        moves = moves_of(robot, step, 2.0 * pi / level.headings, LEAPS)
        prices = np.abs(moves[:, 1]) + TURN_PRICE * step * np.abs(moves[:, 3])
        self._task = Task(target, sign, moves, prices, level.any_word)
        #: Attitudes that there may be, and by how many one look at most adds to them.
        self._most = level.effort * query.budget.attitudes + len(roots.rows)
        self._step = CHUNK * len(moves)
        room = min(len(roots.rows) + self._step, self._most)
        self.lattice: Lattice = new_lattice(room, longest, query.budget.improving)
        frame = query.frame
        plant(self.lattice, frame, self.field, self._grain, self._task, roots.rows, roots.costs)
        self.state = GOES_ON

    @property
    def expanded(self) -> int:
        """How many attitudes were looked at."""
        return expanded(self.lattice)

    def go_on(self, expansions: int) -> Rows | None:
        """Expand so many attitudes, and more once there is a path, which is returned."""
        query = self._query
        while self.state == GOES_ON and (expansions > 0 or self.has_path):
            query.check_time()
            self._make_room()
            self.state = grow(self.lattice, query.frame, self.field, self._grain, self._task, CHUNK)
            expansions -= CHUNK
        return self.path

    def _make_room(self) -> None:
        """Room for what one more look adds: most searches end long before they use all they may."""
        room = len(self.lattice.costs)
        needed = min(attitudes(self.lattice) + self._step, self._most)
        if needed > room:
            self.lattice = enlarged(self.lattice, min(max(needed, 2 * room), self._most))

    def shot(self, goals: Rows, longest: float) -> Rows | None:
        """A path of less than ``longest`` [m] from what was looked at on to another of the ``goals``.

        For searches from the start.
        """
        query, lattice = self._query, self.lattice
        rows, costs = self.rows, lattice.costs[: attitudes(lattice)]
        for goal in goals:
            away = np.hypot(rows[:, 0] - goal[0], rows[:, 1] - goal[1])
            near = np.flatnonzero(away < SHOT * query.reach)
            for first in range(0, len(near), CHUNK):
                query.check_time()
                some = near[first : first + CHUNK]
                ends = best_ending(query.frame, rows[some], costs[some], goal[None, :], longest)
                if ends[1] >= 0:
                    return self._way_to(int(some[ends[1]]), goal)
        return None

    @property
    def rows(self) -> Rows:
        """The attitudes (n, 3) that were found."""
        return self.lattice.rows[: attitudes(self.lattice)]

    def as_roots(self) -> Roots:
        """Another search that begins where this one has been; this one had no way behind its roots."""
        rows = self.rows
        return Roots(rows, self.lattice.costs[: len(rows)], self.lattice)

    def way_to_best_root(self) -> Rows:
        """The attitudes (n, 3) from where all began to the root that is the most promising now."""
        return self._way_to_root(best_root(self.lattice))

    @property
    def has_path(self) -> bool:
        """Whether there is a path."""
        return last_of_best(self.lattice) >= 0

    @property
    def path(self) -> Rows | None:
        """The best path so far, in the order in which it is driven."""
        last = last_of_best(self.lattice)
        if last < 0:
            return None
        path = self._way_to(last, self._task.target)
        return path if self._task.sign > 0.0 else path[::-1].copy()

    def _way_to(self, i: int, target: Row) -> Rows:
        """The attitudes (n, 3) from where all began to number ``i``, and then ``target``."""
        root, way = way_to(self.lattice, i)
        return np.vstack((self._way_to_root(root), way[1:], target))

    def _way_to_root(self, root: int) -> Rows:
        rows, _, origin = self._roots
        return rows[root : root + 1] if origin is None else way_to(origin, root)[1]
