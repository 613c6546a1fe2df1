"""The mission language: text to a checked model, every error with its file, line and column."""

from task_planner_node.language.checks import check_mission
from task_planner_node.language.domain import read_domain
from task_planner_node.language.problem import problem_names, read_problem
from task_planner_node.language.source import Source, load_source, split_name
from task_planner_node.language.spelling import Spelling

__all__ = [
    'Source',
    'Spelling',
    'check_mission',
    'load_source',
    'problem_names',
    'read_domain',
    'read_problem',
    'split_name',
]
