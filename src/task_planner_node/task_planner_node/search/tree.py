"""The decomposition tree of a plan: which task was done by which way, down to the actions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True, eq=False)
class TreeNode:
    """One ground task of a plan, ``(name, argument, ...)``, and what it was decomposed into.

    For a task that a method did: ``method`` and ``branch`` are their names, empty when they have none,
    ``method_number`` counts the methods of that task's name from 1 in the order of the text, ``branch_number``
    the branches of the method from 1.  ``children`` are in the order of the text of the branch.

    For an operator both numbers are 0 and there are no children; ``step`` is its index among the steps of the
    plan, None for one that is no action (``!!``).  ``began`` is the place of the choice of the operator, method
    and branch in the order in which all of them were made, from 0.
    """

    task: tuple[Any, ...]
    primitive: bool
    children: tuple[TreeNode, ...] = ()
    method: str = ''
    branch: str = ''
    method_number: int = 0
    branch_number: int = 0
    step: int | None = None
    began: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class Tree:
    """The trees of the tasks of a problem, in the order of the text."""

    roots: tuple[TreeNode, ...] = ()

    def nodes(self) -> Iterator[tuple[TreeNode, int]]:
        """Every node with its depth, from 0, parents before children, in the order of the text."""
        agenda = [(node, 0) for node in reversed(self.roots)]
        while agenda:
            node, depth = agenda.pop()
            yield node, depth
            agenda.extend((child, depth + 1) for child in reversed(node.children))
