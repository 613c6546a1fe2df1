"""Why a mission ended as it did, and how a plan came about, for people and for programs."""

from task_planner_node.explanation.failure import details_of, explain_failure, explain_solution
from task_planner_node.explanation.formats import FORMATS, written
from task_planner_node.explanation.refusal import place_refusal

__all__ = [
    'FORMATS',
    'details_of',
    'explain_failure',
    'explain_solution',
    'place_refusal',
    'written',
]
