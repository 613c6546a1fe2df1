"""Paths in the robot's own kinematics: shots, lattices, OMPL's sampling, shortening, checking."""

from motion_planner_node.paths.planner import plan_path, solved
from motion_planner_node.paths.planners import DEFAULT_PLANNER, PLANNERS
from motion_planner_node.paths.query import Query, Region
from motion_planner_node.paths.result import PathBudget, PathOutcome, PathResult

__all__ = [
    'DEFAULT_PLANNER',
    'PLANNERS',
    'PathBudget',
    'PathOutcome',
    'PathResult',
    'Query',
    'Region',
    'plan_path',
    'solved',
]
