"""The functions that a domain may call in ``eval``, ``call``, ``assign``, costs and sorting; docs/htn.md lists them.

Pure functions over ground terms: nothing of a domain is ever evaluated as code.
"""

from task_planner_node.language.functions.evaluation import Compute, comparison_of, compile_term
from task_planner_node.language.functions.function import Function, FunctionFailed
from task_planner_node.language.functions.library import FUNCTIONS
from task_planner_node.language.functions.plugins import PluginError, load_plugins

__all__ = [
    'FUNCTIONS',
    'Compute',
    'Function',
    'FunctionFailed',
    'PluginError',
    'comparison_of',
    'compile_term',
    'load_plugins',
]
