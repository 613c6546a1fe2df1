"""All functions by name; packages add theirs through entry points."""

from __future__ import annotations

from task_planner_node.language.functions.arithmetic import ARITHMETIC
from task_planner_node.language.functions.function import Function
from task_planner_node.language.functions.lists import LISTS

FUNCTIONS: dict[str, Function] = {function.name: function for function in (*ARITHMETIC, *LISTS)}
