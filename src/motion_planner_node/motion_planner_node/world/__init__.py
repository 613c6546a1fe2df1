"""The world: read from text, immutable, and made ready for exact geometry."""

from motion_planner_node.world.free_space import Cells, FreeSpace, TravelField
from motion_planner_node.world.reader import read_world
from motion_planner_node.world.scene import MAP_EDGE, Scene

__all__ = ['MAP_EDGE', 'Cells', 'FreeSpace', 'Scene', 'TravelField', 'read_world']
