"""The usual way: OMPL's RRTConnect in its Dubins space, checked point by point, with its simplifier.

States are valid where a map of distances to the nearest obstacle says so, a table lookup as cheap
as Python allows; motions are checked at points along them, as OMPL does unless told otherwise. The
simplifier breaks some paths: those are refused by the same exact check that ours have to pass, and
the path before it counts.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi
from time import perf_counter

import numpy as np
from ompl import base, geometric, util

from experiments.motion.geometry import Array, Ground, clearance, compiled, dubins_length, free_word
from experiments.motion.grounds import ground_of, inside_obstacles
from experiments.motion.worlds import Place
from motion_planner_node.robots.motion import Attitude

util.setLogLevel(util.LogLevel.LOG_NONE)
#: Share of a turning radius between two values of the map of distances.
FINE = 0.05
#: [m] per turning radius between two points of a motion that are looked at.
SPACING = 0.1


@compiled
def _distances(ground: Ground, corner: Array, cell: float, rows: int, columns: int) -> Array:
    table = np.empty((rows, columns))
    for j in range(rows):
        for i in range(columns):
            table[j, i] = clearance(
                ground, corner[0] + (i + 0.5) * cell, corner[1] + (j + 0.5) * cell
            )
    return table


@compiled
def _length(ground: Ground, rows: Array) -> float:
    pieces = np.empty((6, 3))
    total = 0.0
    for i in range(len(rows) - 1):
        shortest = dubins_length(ground.radius, rows[i], rows[i + 1])
        total += free_word(ground, rows[i], rows[i + 1], shortest + 1e-6, pieces)[0]
    return total


@dataclass(frozen=True)
class Solved:
    """How long one try took [s] and the length [m] of its path, infinite for none."""

    seconds: float
    length: float
    broken: bool


class Usual:
    """RRTConnect and simplifier in one world."""

    def __init__(self, place: Place) -> None:
        self._ground = ground_of(place)
        self._corner = place.bounds[:2]
        width, height = place.bounds[2:] - place.bounds[:2]
        self._cell = max(FINE * place.turning_radius, (width * height / 4e6) ** 0.5)
        columns, rows = int(np.ceil(width / self._cell)), int(np.ceil(height / self._cell))
        table = _distances(self._ground, self._corner, self._cell, rows, columns)
        x = self._corner[0] + (np.arange(columns) + 0.5) * self._cell
        y = self._corner[1] + (np.arange(rows) + 0.5) * self._cell
        points = np.column_stack([np.tile(x, rows), np.repeat(y, columns)])
        table[inside_obstacles(place, points).reshape(rows, columns)] = -1.0
        # As near as the table can tell.
        self._valid = table >= place.robot['radius'] + 0.25 * self._cell
        self._radius = place.turning_radius
        self._bounds = place.bounds

    def plan(self, start: Attitude, goal: Attitude, seed: int, patience: float) -> Solved:
        """Plan once from one attitude to another, for at most ``patience`` [s]."""
        began = perf_counter()
        util.RNG.setSeed(seed + 1)
        space = base.DubinsStateSpace(self._radius)
        bounds = base.RealVectorBounds(2)
        for axis in range(2):
            bounds.setLow(axis, float(self._bounds[axis]))
            bounds.setHigh(axis, float(self._bounds[axis + 2]))
        space.setBounds(bounds)
        information = base.SpaceInformation(space)
        information.setStateValidityChecker(self._is_valid)
        information.setStateValidityCheckingResolution(
            SPACING * self._radius / space.getMaximumExtent()
        )
        problem = base.ProblemDefinition(information)
        problem.setStartAndGoalStates(_state(space, start), _state(space, goal))
        information.setup()
        planner = geometric.RRTConnect(information)
        planner.setProblemDefinition(problem)
        planner.setup()
        planner.solve(patience)
        if not problem.hasExactSolution():
            return Solved(perf_counter() - began, inf, broken=False)
        path = problem.getSolutionPath()
        raw = _rows(path)
        geometric.PathSimplifier(information).simplifyMax(path)
        seconds = perf_counter() - began
        length = float(_length(self._ground, _rows(path)))
        if length < inf:
            return Solved(seconds, length, broken=False)
        return Solved(seconds, float(_length(self._ground, raw)), broken=True)

    def _is_valid(self, state: base.State) -> bool:
        i = int((state.getX() - self._corner[0]) / self._cell)
        j = int((state.getY() - self._corner[1]) / self._cell)
        rows, columns = self._valid.shape
        return 0 <= i < columns and 0 <= j < rows and bool(self._valid[j, i])


def _state(space: base.DubinsStateSpace, attitude: Attitude) -> base.State:
    state = space.allocState()
    state.setXY(attitude.x, attitude.y)
    heading = (attitude.heading + pi) % (2.0 * pi) - pi
    state.setYaw(heading)
    return state


def _rows(path: geometric.PathGeometric) -> Array:
    return np.array([(s.getX(), s.getY(), s.getYaw()) for s in path.getStates()])
