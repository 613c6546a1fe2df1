"""The decomposition tree of a plan: as text, JSON, for Graphviz, as a picture, and as competitions have it."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from itertools import islice

from task_planner_node.explanation.picture import svg
from task_planner_node.explanation.rows import Row, more, rows_of, title
from task_planner_node.hddl import plan_text
from task_planner_node.search.tree import Tree

#: Lines and nodes of a tree that are written for people.
MOST_NODES = 20_000
DEEPEST_INDENT = 40


def text(tree: Tree) -> str:
    """One task a line, indented below the task that it comes from; actions have their number in the plan."""
    lines = []
    for row in islice(rows_of(tree), MOST_NODES):
        depth = '' if row.depth <= DEEPEST_INDENT else f'[{row.depth}] '
        number = '' if row.node.step is None else f'{row.node.step + 1}. '
        way = f'  <- {row.way}' if row.way else ''
        lines.append(
            f'{"  " * min(row.depth, DEEPEST_INDENT)}{depth}{number}{title(row.node)}{way}'
        )
    return '\n'.join([*lines, *more(tree, MOST_NODES)]) + '\n'


def as_json(tree: Tree) -> str:
    """``{"nodes": [...]}``, parents before children, so that no reader has to follow a deep nesting.

    A node has ``id`` (from 0), ``parent`` (null for a task of the problem), ``task`` (name and arguments as text),
    ``step`` (index among the steps of the plan, null for what is no action), and for a task that was
    decomposed ``method``, ``branch``, ``method_number`` and ``branch_number``.
    """
    nodes = [_node(row) for row in rows_of(tree)]
    return json.dumps({'nodes': nodes}, indent=1) + '\n'


def _node(row: Row) -> dict[str, object]:
    node = row.node
    found: dict[str, object] = {
        'id': row.number,
        'parent': row.parent,
        'task': row.words,
        'step': node.step,
    }
    if not node.primitive:
        found |= {
            'method': node.method,
            'branch': node.branch,
            'method_number': node.method_number,
            'branch_number': node.branch_number,
        }
    return found


def dot(tree: Tree) -> str:
    """A directed graph for Graphviz: actions are boxes with their number, other tasks ellipses."""
    lines = ['digraph plan {', '  node [fontname="sans-serif"];']
    for row in islice(rows_of(tree), MOST_NODES):
        step = row.node.step
        label = title(row.node) if step is None else f'{step + 1}. {title(row.node)}'
        label = label.replace('\\', '\\\\').replace('"', '\\"')
        shape = 'box' if row.node.primitive else 'ellipse'
        lines.append(f'  n{row.number} [shape={shape}, label="{label}"];')
        if row.parent is not None:
            lines.append(f'  n{row.parent} -> n{row.number};')
    lines += [f'  more [shape=plaintext, label="{line}"];' for line in more(tree, MOST_NODES)]
    return '\n'.join([*lines, '}']) + '\n'


FORMATS: Mapping[str, Callable[[Tree], str]] = {
    'tree': text,
    'json': as_json,
    'dot': dot,
    'svg': svg,
    'ipc': plan_text,
}


def written(tree: Tree, name: str) -> str:
    """The tree in a format of FORMATS; raises ValueError for another name."""
    if name not in FORMATS:
        raise ValueError(f'{name} is no format of a tree: expected {", ".join(FORMATS)}')
    return FORMATS[name](tree)
