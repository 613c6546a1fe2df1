"""Task lists: from nodes to the model."""

from __future__ import annotations

from task_planner_node.language.model import Atom, Immediate, Ordered, TaskNetwork, Unordered
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, is_nil
from task_planner_node.language.terms import read_atom


def read_tasks(reading: Reading, node: Node) -> TaskNetwork:
    """Read a task list: a list of tasks, (:ordered ...), (:unordered ...), nested, or one task."""
    if is_nil(node):
        return Ordered(())
    if isinstance(node, Symbol):
        raise reading.refuse(node, f'expected tasks, a list, and not the symbol {node.text}')
    word = first_word(node)
    if word in (':ordered', ':unordered'):
        parts = tuple(read_tasks(reading, child) for child in node.children[1:])
        return Ordered(parts) if word == ':ordered' else Unordered(parts)
    if word in ('quote', 'backquote') and len(node.children) == 2:
        return read_tasks(reading, node.children[1])
    if word in (':task', ':immediate'):
        return _read_marked(reading, node, word)
    if word:
        return read_atom(reading, node, 'a task')
    return Ordered(tuple(read_tasks(reading, child) for child in node.children))


def _read_marked(reading: Reading, node: ListNode, word: str) -> TaskNetwork:
    """``(:task name ...)``, ``(:task :immediate name ...)``, ``(:immediate name ...)``, ``(:immediate task)``."""
    rest = node.children[1:]
    immediate = word == ':immediate'
    if rest and isinstance(rest[0], Symbol) and rest[0].text.lower() == ':immediate':
        immediate, rest = True, rest[1:]
    if not rest:
        raise reading.refuse(node, f'the task behind {word} is missing')
    if len(rest) == 1 and isinstance(rest[0], ListNode):
        inner = read_tasks(reading, rest[0])
        if not isinstance(inner, (Atom, Immediate)):
            raise reading.refuse(rest[0], f'{word} takes one task, not several')
        task = inner.task if isinstance(inner, Immediate) else inner
        return Immediate(task) if immediate else inner
    task = read_atom(reading, ListNode(rest, node.start, node.end), 'a task')
    return Immediate(task) if immediate else task
