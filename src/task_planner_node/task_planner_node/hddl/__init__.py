"""HDDL: domains and problems into the same model that the SHOP reader makes, and plans out of it.

Types become predicates, actions operators whose names begin with ``!``; see docs/hddl.md.
"""

from task_planner_node.hddl.mission import is_hddl, read_hddl
from task_planner_node.hddl.plan import plan_text

__all__ = ['is_hddl', 'plan_text', 'read_hddl']
