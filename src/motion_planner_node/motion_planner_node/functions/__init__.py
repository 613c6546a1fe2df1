"""The library of functions that geometric constraints are made of (Table 2 of the paper)."""

from motion_planner_node.functions.dual import Array, Dual
from motion_planner_node.functions.field import Field
from motion_planner_node.functions.function import Function, Kind
from motion_planner_node.functions.interval import Interval
from motion_planner_node.functions.library import FUNCTIONS
from motion_planner_node.functions.plugins import PluginError, load_plugins
from motion_planner_node.functions.scalar import Place, S, Scalar
from motion_planner_node.functions.surroundings import Surroundings, surroundings_of
from motion_planner_node.robots.motion import COMPONENTS

__all__ = [
    'COMPONENTS',
    'FUNCTIONS',
    'Array',
    'Dual',
    'Field',
    'Function',
    'Interval',
    'Kind',
    'Place',
    'PluginError',
    'S',
    'Scalar',
    'Surroundings',
    'load_plugins',
    'surroundings_of',
]
