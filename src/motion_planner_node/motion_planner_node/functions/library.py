"""The functions that constraints can use, by name."""

from __future__ import annotations

from motion_planner_node.functions.function import Function
from motion_planner_node.functions.numbers import NUMBERS
from motion_planner_node.functions.places import PLACES
from motion_planner_node.functions.regions import REGIONS

#: All functions that there are; plugins add theirs.
FUNCTIONS: dict[str, Function] = {
    function.name: function for function in (*PLACES, *NUMBERS, *REGIONS)
}
