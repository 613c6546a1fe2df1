"""CELL-RRT, the paper's path planner: a tree of commands that a decomposition into cells leads.

J. Guitton, J.-L. Farges and R. Chatila, "Cell-RRT: decomposing the environment for better plan",
IROS 2009.  The lead is a shortest chain of cells.  The tree (S. M. LaValle and J. J. Kuffner,
"Randomized kinodynamic planning", ICRA 1999; OMPL's) grows by the robot's commands inside of the
corridor along that chain.  When it does not arrive, the cells of the chain that it did not get to
weigh more and the corridor is wider the next time.
"""

from __future__ import annotations

from math import inf, pi

import numpy as np
from numpy.typing import NDArray
from ompl import base, control, util

from motion_planner_node.paths.cells import Cell, Decomposition
from motion_planner_node.paths.edges import Frame, Row, Rows
from motion_planner_node.paths.lattice_end import moves_of
from motion_planner_node.paths.ompl_problem import ONE_AT_A_TIME, Iterations, drawn_seed, state_at
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.shots import best_ending
from motion_planner_node.robots.arcs import advance, wrap_angle
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.world.sweeps import word_is_free

#: Leads that are followed before the search is given up.
LEADS = 8
#: Side of a cell, and length of one step of a command, in turning radii or radii.
CELL_SIDE, STEP = 2.0, 0.3
#: Steps that one command is held.
LONGEST_COMMAND = 8
#: Share of samples that are destinations.
GOAL_BIAS = 0.1


@kernel
def _step(frame: Frame, row: Row, piece: Rows) -> tuple[bool, float, float, float]:
    """Whether a piece (1, 4) is free from an attitude on, and where it leads."""
    free = word_is_free(frame.shapes, frame.body, (row[0], row[1], row[2]), piece)
    bend, length, direction, turn = piece[0]
    x, y, heading = advance(row[0], row[1], row[2], bend, length, direction, turn)
    return free, x, y, wrap_angle(heading)


class _Destinations(base.GoalSampleableRegion):
    """All attitudes from which a shortest motion to a destination is free."""

    def __init__(self, information: control.SpaceInformation, query: Query, near: float) -> None:
        super().__init__(information)
        self.setThreshold(1e-9)
        self._query = query
        self._near = near
        self._next = 0

    def ending(self, row: Row) -> int:
        """Number of the destination that a short free motion leads to; -1 for none."""
        query = self._query
        ends = best_ending(query.frame, row[None, :], np.zeros(1), query.goals, self._near)
        return ends[2]

    def distanceGoal(self, state: base.State) -> float:
        """Distance [m] from the nearest destination, 0 where one can be driven to."""
        row = np.array([state.getX(), state.getY(), state.getYaw()], np.float64)
        away = np.hypot(*(self._query.goals[:, :2] - row[:2]).T)
        nearest = float(away.min())
        if nearest > self._near or self.ending(row) < 0:
            return nearest + 1.0
        return 0.0

    def sampleGoal(self, state: base.State) -> None:
        """Write the next destination to ``state``."""
        x, y, heading = self._query.goals[self._next % len(self._query.goals)]
        self._next += 1
        state.setXY(float(x), float(y))
        state.setYaw(min(wrap_angle(float(heading)), np.nextafter(pi, 0.0)))

    def maxSampleCount(self) -> int:
        """How many destinations there are."""
        return len(self._query.goals)


class _Tree:
    """The tree of one lead."""

    def __init__(
        self, query: Query, cells: Decomposition, corridor: NDArray[np.bool_], step: float
    ) -> None:
        self._query, self._cells, self._corridor = query, cells, corridor
        self._moves = moves_of(query.robot, step, pi / 8.0, (1.0,))
        self._near = 4.0 * query.reach
        #: Cells that the tree has got to.
        self.reached: set[Cell] = set()

    def _is_valid(self, state: base.State) -> bool:
        x, y = state.getX(), state.getY()
        if not (abs(x) < inf and abs(y) < inf):
            return False
        cell = self._cells.cell_of(x, y)
        if not self._corridor[cell]:
            return False
        self.reached.add(cell)
        return True

    def _propagate(
        self, state: base.State, command: control.Control, _duration: float, result: base.State
    ) -> None:
        number = min(int(command[0]), len(self._moves) - 1)
        row = np.array([state.getX(), state.getY(), state.getYaw()], np.float64)
        free, x, y, heading = _step(self._query.frame, row, self._moves[number : number + 1])
        result.setXY(x if free else inf, y)
        result.setYaw(heading)

    def grow(self, seed: int, iterations: int) -> Rows | None:
        """Attitudes (n, 3) from the start to a destination, by free commands and a last motion."""
        query = self._query
        x_min, y_min, x_max, y_max = self._cells.box(self._corridor)
        space = query.robot.space((x_min, y_min, x_max, y_max))
        commands = control.RealVectorControlSpace(space, 1)
        bounds = base.RealVectorBounds(1)
        bounds.setLow(0.0)
        bounds.setHigh(float(len(self._moves)) - 1e-9)
        commands.setBounds(bounds)
        information = control.SpaceInformation(space, commands)
        information.setStateValidityChecker(self._is_valid)
        information.setStatePropagator(self._propagate)
        information.setPropagationStepSize(1.0)
        information.setMinMaxControlDuration(1, LONGEST_COMMAND)
        problem = base.ProblemDefinition(information)
        enough = base.PlannerTerminationCondition(Iterations(query, iterations))
        with ONE_AT_A_TIME:
            util.RNG.setSeed(seed)
            problem.addStartState(state_at(query, space, query.start))
            goal = _Destinations(information, query, self._near)
            problem.setGoal(goal)
            information.setup()
            planner = control.RRT(information)
            planner.setGoalBias(GOAL_BIAS)
            planner.setProblemDefinition(problem)
            planner.setup()
            planner.solve(enough)
            if not problem.hasExactSolution():
                return None
            states = problem.getSolutionPath().getStates()
            path = np.array([(s.getX(), s.getY(), s.getYaw()) for s in states])
        path[0] = query.start
        return np.vstack((path, query.goals[goal.ending(path[-1])]))


def cell_rrt(query: Query) -> Rows | None:
    """A path along one of several leads, as attitudes (n, 3)."""
    free = query.scene.free_space(query.robot.body)
    part = free.component_of(float(query.start[0]), float(query.start[1]))
    cells = Decomposition(free, part, CELL_SIDE * query.reach)
    for number in range(LEADS):
        lead = cells.lead(query.start[None, :], query.goals)
        if not lead:
            break
        tree = _Tree(query, cells, cells.corridor(lead, 1 + number), STEP * query.reach)
        path = tree.grow(drawn_seed(query), query.budget.iterations)
        if path is not None:
            return path
        for cell in lead:
            if cell not in tree.reached:
                cells.weights[cell] *= 2.0
    query.efforts.append(f'{LEADS} leads of CELL-RRT, {query.budget.iterations} iterations each')
    return None
