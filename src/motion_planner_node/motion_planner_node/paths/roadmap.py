"""PRM*: a roadmap of random attitudes, and the shortest way through it.

S. Karaman and E. Frazzoli, "Sampling-based algorithms for optimal motion planning", IJRR 30 (2011).
OMPL grows the roadmap.  Its own search for ways runs in a second thread by the clock, never twice
the same, and takes an edge that is free in one direction for free in both: here is another.
"""

from __future__ import annotations

from math import inf

import numpy as np
from numpy.typing import NDArray
from ompl import base, geometric, util

from motion_planner_node.paths.edges import Frame, Row, Rows, free_word
from motion_planner_node.paths.ompl_problem import (
    ONE_AT_A_TIME,
    Iterations,
    drawn_seed,
    information_of,
    space_of,
    state_at,
)
from motion_planner_node.paths.open_list import OpenList, empty_open_list, pop, push
from motion_planner_node.paths.query import Query
from motion_planner_node.robots.kernel import kernel
from motion_planner_node.robots.steering import MOST_PIECES

#: Destinations that ways are looked for to, the nearest by estimate.
MOST_GOALS = 4
#: Attitudes of the roadmap that are expanded between two looks at the clock.
EXPANSIONS = 8


@kernel
def _shortest_ways(
    frame: Frame,
    rows: Rows,
    first: NDArray[np.int64],
    neighbours: NDArray[np.int64],
    goals: int,
    queue: OpenList,
    before: NDArray[np.int64],
    costs: Row,
    done: NDArray[np.bool_],
) -> int:
    """Go on with ``before``, ``costs`` and ``done`` (n,) for `EXPANSIONS` rows from the ``queue``.

    Returns the goal that is reached, or -1.
    The last ``goals`` of ``rows`` (n, 3) are the goals; ``neighbours`` from ``first[i]`` to
    ``first[i + 1]`` are those of row i.  An edge is checked when a way may lead along it.
    """
    pieces = np.zeros((MOST_PIECES, 4))
    for _ in range(EXPANSIONS):
        if queue.size[0] == 0:
            break
        _, i = pop(queue)
        if done[i]:
            continue
        done[i] = True
        if i >= len(rows) - goals:
            return i
        count = first[i + 1] - first[i]
        for k in range(count + goals):
            j = neighbours[first[i] + k] if k < count else len(rows) - goals + k - count
            if done[j]:
                continue
            longest = costs[j] - costs[i]
            length = free_word(frame, rows[i], rows[j], longest, pieces)[0]
            if length < longest and queue.size[0] < len(queue.keys):
                costs[j], before[j] = costs[i] + length, i
                push(queue, costs[j], j)
    return -1


def _roadmap(query: Query, iterations: int) -> tuple[Rows, list[list[int]]]:
    """Attitudes (n, 3) and the neighbours of each."""
    space = space_of(query)
    information = information_of(query, space)
    problem = base.ProblemDefinition(information)
    with ONE_AT_A_TIME:
        util.RNG.setSeed(drawn_seed(query))
        problem.addStartState(state_at(query, space, query.start))
        goals = base.GoalStates(information)
        goals.addState(state_at(query, space, query.goals[0]))
        problem.setGoal(goals)
        information.setup()
        planner = geometric.PRMstar(information)
        planner.setProblemDefinition(problem)
        planner.setup()
        planner.constructRoadmap(base.PlannerTerminationCondition(Iterations(query, iterations)))
        data = base.PlannerData(information)
        planner.getPlannerData(data)
        count = data.numVertices()
        states = [data.getVertex(i).getState() for i in range(count)]
        rows = np.array([(s.getX(), s.getY(), s.getYaw()) for s in states]).reshape(-1, 3)
        links: list[list[int]] = [[] for _ in range(count)]
        for i in range(count):
            query.check_time()
            for j in data.getEdges(i):
                links[i].append(int(j))
                links[int(j)].append(i)
    return rows, [sorted(set(neighbours)) for neighbours in links]


def prm_star(query: Query) -> Rows | None:
    """The shortest way through the roadmap, as attitudes (n, 3)."""
    rows, links = _roadmap(query, query.budget.iterations)
    nearest = np.argsort(query.estimates, kind='stable')[:MOST_GOALS]
    goals = query.goals[nearest]
    everything = np.vstack((query.start, rows, goals))
    lists = [list(range(1, len(rows) + 1)), *([j + 1 for j in near] for near in links)]
    first = np.concatenate(([0], np.cumsum([len(near) for near in lists])))
    first = np.concatenate((first, np.full(len(goals), first[-1]))).astype(np.int64)
    neighbours = np.array([j for near in lists for j in near], np.int64)
    before = np.full(len(everything), -1, np.int64)
    costs = np.full(len(everything), inf)
    queue = empty_open_list(len(neighbours) + len(goals) * len(everything) + 1)
    done = np.zeros(len(everything), np.bool_)
    costs[0] = 0.0
    push(queue, 0.0, 0)
    i = -1
    while i < 0 and queue.size[0] > 0:
        query.check_time()
        i = _shortest_ways(
            query.frame, everything, first, neighbours, len(goals), queue, before, costs, done
        )
    if i < 0:
        query.efforts.append(f'a roadmap of {len(rows)} attitudes')
        return None
    path = []
    while i >= 0:
        path.append(everything[i])
        i = int(before[i])
    return np.array(path[::-1])
