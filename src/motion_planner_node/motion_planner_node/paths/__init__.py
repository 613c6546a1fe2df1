"""Paths in the car's own kinematics: exact shots, OMPL's sampling, shortening."""

from motion_planner_node.paths.planner import plan_path
from motion_planner_node.paths.result import PathBudget, PathOutcome, PathResult
from motion_planner_node.paths.warm_up import warm_up

__all__ = ['PathBudget', 'PathOutcome', 'PathResult', 'plan_path', 'warm_up']
