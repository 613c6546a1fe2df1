"""Plans in the format of the International Planning Competition (IPC 2020, hierarchical tracks)."""

from __future__ import annotations

from task_planner_node.language.model import show
from task_planner_node.search.tree import Tree, TreeNode


def plan_text(tree: Tree) -> str:
    """The steps and decompositions of a plan: ``==>``, actions, ``root``, decompositions, ``<==``.

    Actions are numbered first, in the order of the plan, then the other tasks; internal operators (``!!``) and the
    marks of operators (``!``) are left out.  A method without a name is written as its task and its number.
    """
    numbers: dict[int, int] = {}
    actions: dict[int, TreeNode] = {}
    compound: list[TreeNode] = []
    for node, _ in tree.nodes():
        if node.step is not None:
            actions[node.step] = node
        elif not node.primitive:
            compound.append(node)
    ordered = [actions[step] for step in sorted(actions)]
    for number, node in enumerate([*ordered, *compound]):
        numbers[id(node)] = number
    lines = ['==>']
    lines += [f'{numbers[id(node)]} {_written(node)}' for node in ordered]
    lines.append(' '.join(['root', *_children(tree.roots, numbers)]))
    for node in compound:
        words = [str(numbers[id(node)]), _written(node), '->', _method(node)]
        lines.append(' '.join([*words, *_children(node.children, numbers)]))
    return '\n'.join([*lines, '<==', ''])


def _written(node: TreeNode) -> str:
    name, *arguments = node.task
    return ' '.join([str(name).lstrip('!'), *(show(argument) for argument in arguments)])


def _method(node: TreeNode) -> str:
    if node.method or node.branch:
        return node.method or node.branch
    return f'{node.task[0]}-{node.method_number}-{node.branch_number}'


def _children(nodes: tuple[TreeNode, ...], numbers: dict[int, int]) -> list[str]:
    return [str(numbers[id(node)]) for node in nodes if id(node) in numbers]
