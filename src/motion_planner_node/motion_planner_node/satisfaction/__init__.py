"""Satisfying geometric constraints: penalty descent from many starts, and proofs that none can."""

from motion_planner_node.satisfaction.branch_and_prune import branch_and_prune
from motion_planner_node.satisfaction.cells import possible_cells
from motion_planner_node.satisfaction.compiling import compile_program
from motion_planner_node.satisfaction.conflicts import separation, together, unsolved
from motion_planner_node.satisfaction.descent import Descent, DescentOptions, descend
from motion_planner_node.satisfaction.destinations import (
    Travel,
    destinations,
    destinations_by_travel,
    from_start,
    restarts,
)
from motion_planner_node.satisfaction.program import TOLERANCE, Program
from motion_planner_node.satisfaction.room import Room
from motion_planner_node.satisfaction.row import wrap

__all__ = [
    'TOLERANCE',
    'Descent',
    'DescentOptions',
    'Program',
    'Room',
    'Travel',
    'branch_and_prune',
    'compile_program',
    'descend',
    'destinations',
    'destinations_by_travel',
    'from_start',
    'possible_cells',
    'restarts',
    'separation',
    'together',
    'unsolved',
    'wrap',
]
