"""The tasks of a tree as numbered rows, for all who write it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from task_planner_node.language.model import shorten, show
from task_planner_node.search.tree import Tree, TreeNode


@dataclass(frozen=True, slots=True)
class Row:
    """A task with its number (from 0), that of the task it comes from (None at the top), and its depth."""

    number: int
    parent: int | None
    depth: int
    node: TreeNode

    @property
    def words(self) -> list[str]:
        """The name of the task and its arguments."""
        return [show(part) for part in self.node.task]

    @property
    def way(self) -> str:
        """The method and branch by their names, or by their numbers; empty for an operator."""
        node = self.node
        if node.primitive:
            return ''
        names = [name for name in (node.method, node.branch) if name]
        names = names[:1] if len(set(names)) == 1 else names
        return ' '.join(names) or f'method {node.method_number}, branch {node.branch_number}'


def rows_of(tree: Tree) -> Iterator[Row]:
    """Parents before children, in the order of the text."""
    above: list[int] = []
    for number, (node, depth) in enumerate(tree.nodes()):
        del above[depth:]
        yield Row(number, above[-1] if above else None, depth, node)
        above.append(number)


def title(node: TreeNode) -> str:
    """The task as it is written in a mission."""
    return shorten(show(node.task))


def more(tree: Tree, most: int) -> list[str]:
    """How many tasks a tree has beyond ``most``, as a line; empty without any."""
    count = sum(1 for _ in tree.nodes())
    return [f'... and {count - most} more'] if count > most else []
