"""The planners by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError
from motion_planner_node.paths.cell_rrt import cell_rrt
from motion_planner_node.paths.edges import Rows
from motion_planner_node.paths.portfolio import default
from motion_planner_node.paths.query import Query
from motion_planner_node.paths.roadmap import prm_star
from motion_planner_node.paths.sampling import bit_star, rrt_connect, rrt_star
from motion_planner_node.paths.shots import direct

DEFAULT_PLANNER = 'default'


class Planner(NamedTuple):
    """A way to plan paths.

    find: gives a path from the start to one of the goals as attitudes (n, 3), or None.
    improves: whether the path is made shorter before it is handed out.
    """

    find: Callable[[Query], Rows | None]
    improves: bool = True


PLANNERS = {
    DEFAULT_PLANNER: Planner(default),
    'direct': Planner(direct, improves=False),
    'rrt_connect': Planner(rrt_connect),
    'rrt_star': Planner(rrt_star),
    'bit_star': Planner(bit_star),
    'prm_star': Planner(prm_star),
    'cell_rrt': Planner(cell_rrt),
}


def planner_named(name: str) -> Planner:
    """The planner of this name.

    :raises MotionPlannerError: UNSUPPORTED, with the names that there are
    """
    if name not in PLANNERS:
        raise MotionPlannerError(
            Code.UNSUPPORTED, f'there is no planner {name!r}; there are {", ".join(PLANNERS)}'
        )
    return PLANNERS[name]
