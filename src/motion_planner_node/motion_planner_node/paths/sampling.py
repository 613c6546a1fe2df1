"""OMPL's sampling planners in the robot's own kinematics, to several destinations at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from ompl import base, geometric, util

from motion_planner_node.paths.edges import Rows
from motion_planner_node.paths.ompl_problem import (
    ONE_AT_A_TIME,
    Iterations,
    drawn_seed,
    information_of,
    space_of,
    state_at,
)
from motion_planner_node.paths.query import Query

Planner = Callable[[base.SpaceInformation], base.Planner]


def _sampled(query: Query, make: Planner, iterations: int) -> Rows | None:
    """What the planner finds in so many iterations: attitudes (n, 3) with free shortest words."""
    space = space_of(query)
    information = information_of(query, space)
    problem = base.ProblemDefinition(information)
    enough = base.PlannerTerminationCondition(Iterations(query, iterations))
    with ONE_AT_A_TIME:
        util.RNG.setSeed(drawn_seed(query))
        problem.addStartState(state_at(query, space, query.start))
        goals = base.GoalStates(information)
        for row in query.goals:
            goals.addState(state_at(query, space, row))
        problem.setGoal(goals)
        information.setup()
        planner = make(information)
        planner.setProblemDefinition(problem)
        planner.setup()
        planner.solve(enough)
        if not problem.hasExactSolution():
            query.efforts.append(f'{iterations} iterations of {planner.getName()}')
            return None
        states = problem.getSolutionPath().getStates()
        path = np.array([(s.getX(), s.getY(), s.getYaw()) for s in states])
    path[0] = query.start
    last = np.abs(query.goals[:, :2] - path[-1, :2]).sum(axis=1)
    path[-1] = query.goals[int(np.argmin(last))]
    return path


def rrt_connect(query: Query) -> Rows | None:
    """Two trees that grow towards each other.

    J. J. Kuffner and S. M. LaValle, "RRT-Connect: an efficient approach to single-query path
    planning", ICRA 2000.
    """
    return _sampled(query, geometric.RRTConnect, query.budget.iterations)


def rrt_star(query: Query) -> Rows | None:
    """A tree that is rewired to ever shorter paths.

    S. Karaman and E. Frazzoli, "Sampling-based algorithms for optimal motion planning", IJRR 30
    (2011).
    """
    return _sampled(query, geometric.RRTstar, query.budget.iterations)


def bit_star(query: Query) -> Rows | None:
    """Batches of samples, searched in the order of what they may be good for.

    J. D. Gammell, S. S. Srinivasa and T. D. Barfoot, "Batch informed trees (BIT*)", ICRA 2015.
    """
    return _sampled(query, geometric.BITstar, query.budget.iterations)
