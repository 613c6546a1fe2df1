"""HDDL's task networks: subtasks with ordering constraints, as nested ordered and unordered tasks where possible."""

from __future__ import annotations

from task_planner_node.language.model import Atom, Ordered, Partial, TaskNetwork, Unordered
from task_planner_node.language.pddl.actions import operator_name
from task_planner_node.language.pddl.formulas import Vocabulary
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, children_of, is_nil
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_atom

ORDERED_WORDS = frozenset({':ordered-subtasks', ':ordered-tasks'})
TASK_WORDS = frozenset({':subtasks', ':tasks'}) | ORDERED_WORDS
MAX_TASKS = 5000
MAX_NESTING = 100


def read_network(
    reading: Reading, fields: dict[str, Node], vocabulary: Vocabulary, primitive: frozenset[str]
) -> TaskNetwork:
    """Read the subtasks and their ``:ordering`` among the fields of a method or of ``:htn``.

    ``primitive`` has the names of the actions, which become operators.
    """
    words = [word for word in fields if word in TASK_WORDS]
    if len(words) > 1:
        raise reading.refuse(
            fields[words[1]], f'{words[1]} beside {words[0]}: one of them suffices'
        )
    if not words:
        return Ordered(())
    names: dict[str, int] = {}
    tasks: list[Atom] = []
    for node in _parts(fields[words[0]]):
        name, task = _read_subtask(reading, node)
        if name in names:
            raise reading.refuse(node, f'two subtasks are called {name}')
        if name:
            names[name] = len(tasks)
        vocabulary.check_objects(reading, task)
        if task.name in primitive:
            task = Atom(operator_name(reading, task.name), task.args, task.node)
        tasks.append(task)
    if len(tasks) > MAX_TASKS:
        raise reading.refuse(fields[words[0]], f'more than {MAX_TASKS} subtasks')
    if words[0] in ORDERED_WORDS:
        return tasks[0] if len(tasks) == 1 else Ordered(tuple(tasks))
    ordering = fields.get(':ordering')
    pairs = [] if ordering is None else [_pair(reading, n, names) for n in _parts(ordering)]
    after = _closure(reading, len(tasks), pairs, ordering)
    return nested(tasks, list(range(len(tasks))), after)


def _parts(node: Node) -> list[Node]:
    """The parts of ``(and part ...)``, or one part alone."""
    if is_nil(node):
        return []
    word = first_word(node)
    if word == 'and':
        return children_of(node)[1:]
    return [node] if word else children_of(node)


def _read_subtask(reading: Reading, node: Node) -> tuple[str, Atom]:
    """``(task argument ...)``, or ``(name (task argument ...))``."""
    children = children_of(node)
    if len(children) == 2 and isinstance(children[0], Symbol) and isinstance(children[1], ListNode):
        return children[0].text.lower(), read_atom(reading, children[1], 'a task')
    return '', read_atom(reading, node, 'a task')


def _pair(reading: Reading, node: Node, names: dict[str, int]) -> tuple[int, int]:
    children = children_of(node)
    if first_word(node) not in ('<', '>') or len(children) != 3:
        raise reading.refuse(node, 'an ordering constraint is written (< name name)')
    numbers: list[int] = []
    for child in children[1:]:
        name = child.text.lower() if isinstance(child, Symbol) else ''
        if name not in names:
            text = reading.source.excerpt(child.start, child.end)
            raise reading.refuse(child, f'no subtask is called {text}{did_you_mean(name, names)}')
        numbers.append(names[name])
    first, second = numbers if first_word(node) == '<' else numbers[::-1]
    return first, second


def _closure(
    reading: Reading, count: int, pairs: list[tuple[int, int]], node: Node | None
) -> list[int]:
    """For each task the set of those that come after it, as bits."""
    after = [0] * count
    for first, second in pairs:
        after[first] |= 1 << second
    waiting = [0] * count
    for first in range(count):
        for second in _bits(after[first]):
            waiting[second] += 1
    order = [i for i in range(count) if not waiting[i]]
    for first in order:
        for second in _bits(after[first]):
            waiting[second] -= 1
            if not waiting[second]:
                order.append(second)
    if len(order) < count and node is not None:
        raise reading.refuse(node, 'the ordering constraints form a cycle')
    for first in reversed(order):
        for second in _bits(after[first]):
            after[first] |= after[second]
    return after


def _bits(number: int) -> list[int]:
    found = []
    while number:
        low = number & -number
        found.append(low.bit_length() - 1)
        number ^= low
    return found


def nested(tasks: list[Atom], members: list[int], after: list[int], depth: int = 0) -> TaskNetwork:
    """The tasks with the numbers ``members`` under a closed partial order, as simply as it can be said."""
    if len(members) == 1:
        return tasks[members[0]]
    whole = sum(1 << i for i in members)
    related = {i: after[i] & whole for i in members}
    for i in members:
        for j in _bits(after[i] & whole):
            related[j] |= 1 << i
    parallel = _components(members, related)
    if len(parallel) != 1 and depth < MAX_NESTING:
        return Unordered(tuple(nested(tasks, part, after, depth + 1) for part in parallel))
    unrelated = {i: whole & ~related[i] & ~(1 << i) for i in members}
    series = _components(members, unrelated)
    if len(series) > 1 and depth < MAX_NESTING:
        series.sort(key=lambda part: -(after[part[0]] & whole).bit_count())
        return Ordered(tuple(nested(tasks, part, after, depth + 1) for part in series))
    number = {member: i for i, member in enumerate(members)}
    pairs = []
    for i in members:
        later = after[i] & whole
        implied = 0
        for j in _bits(later):
            implied |= after[j]
        pairs += [(number[i], number[j]) for j in _bits(later & ~implied)]
    return Partial(tuple(tasks[i] for i in members), tuple(pairs))


def _components(members: list[int], neighbours: dict[int, int]) -> list[list[int]]:
    """The connected parts of a graph, each in order."""
    left = sum(1 << i for i in members)
    found: list[list[int]] = []
    while left:
        part = left & -left
        frontier = part
        while frontier:
            reached = 0
            for i in _bits(frontier):
                reached |= neighbours[i]
            frontier = reached & left & ~part
            part |= frontier
        found.append(_bits(part))
        left &= ~part
    return found
