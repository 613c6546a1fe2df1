"""The default planner: a direct shot, then the lattice, then sampling with growing effort."""

from __future__ import annotations

from math import inf

from motion_planner_node.paths.edges import Rows
from motion_planner_node.paths.lattice_search import search_lattice
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.sampling import rrt_connect
from motion_planner_node.paths.shots import shortest_shot


def default(query: Query) -> Rows | None:
    """A path that is short before it is improved, as attitudes (n, 3)."""
    shot, length = shortest_shot(query)
    if shot is not None:
        if length <= query.budget.good_enough * float(query.estimates.min()):
            return shot
        path = search_lattice(query, length)
        return shot if path is None else path
    path = search_lattice(query, query.longest)
    if path is None and not query.hopeless and query.longest == inf:
        path = rrt_connect(query)
    return path
