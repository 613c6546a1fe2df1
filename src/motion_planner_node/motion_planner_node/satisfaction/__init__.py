"""Satisfying geometric constraints: penalty descent from many starts, and proofs that none can."""

from motion_planner_node.satisfaction.cells import Cells, possible_cells
from motion_planner_node.satisfaction.descent import Descent, DescentOptions, descend
from motion_planner_node.satisfaction.destinations import destinations, from_start, restarts
from motion_planner_node.satisfaction.program import TOLERANCE, Program, compile_program
from motion_planner_node.satisfaction.row import wrap

__all__ = [
    'TOLERANCE',
    'Cells',
    'Descent',
    'DescentOptions',
    'Program',
    'compile_program',
    'descend',
    'destinations',
    'from_start',
    'possible_cells',
    'restarts',
    'wrap',
]
