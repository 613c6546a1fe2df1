"""The paper's language of geometric preconditions: reading, writing and checking it."""

from motion_planner_node.language.check import check
from motion_planner_node.language.grammar import MAXIMUM_DEPTH, MAXIMUM_ITEMS
from motion_planner_node.language.parser import (
    MAXIMUM_SIZE,
    parse,
    read,
)
from motion_planner_node.language.printer import number_to_text, to_text
from motion_planner_node.language.syntax import (
    Command,
    Condition,
    Constraint,
    Expression,
    Preconditions,
    Statement,
)

__all__ = [
    'MAXIMUM_DEPTH',
    'MAXIMUM_ITEMS',
    'MAXIMUM_SIZE',
    'Command',
    'Condition',
    'Constraint',
    'Expression',
    'Preconditions',
    'Statement',
    'check',
    'number_to_text',
    'parse',
    'read',
    'to_text',
]
