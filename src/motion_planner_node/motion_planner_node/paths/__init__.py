"""Paths in the car's own kinematics: exact shots, OMPL's sampling, shortening."""

from motion_planner_node.paths.planner import plan_path
from motion_planner_node.paths.result import PathBudget, PathOutcome, PathResult

__all__ = ['PathBudget', 'PathOutcome', 'PathResult', 'plan_path']
