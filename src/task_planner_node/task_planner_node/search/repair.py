"""Going on in the middle of a plan: what is left of it, from keeping everything to doing whole tasks anew."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from task_planner_node.language.model import Atom, Domain, Effect, ForEach, Operator
from task_planner_node.search.domain import Start
from task_planner_node.search.network import Kept, Network, Task, cell
from task_planner_node.search.plans import Plan
from task_planner_node.search.state import Fact, State
from task_planner_node.search.tree import TreeNode


@dataclass(frozen=True, slots=True)
class Interrupted:
    """A plan of which the first ``executed`` actions were done."""

    plan: Plan
    executed: int

    def facts(self, domain: Domain, now: Sequence[Fact]) -> list[Fact]:
        """The facts to go on from: those that hold ``now``, and the planner's own notes.

        Notes are facts of predicates that only internal operators (``!!``) change and that ``now`` does not
        speak of: nobody can observe them, so they are as the plan left them.
        """
        noted = {e.name for o in domain.operators if o.internal for e in _atoms(o)}
        noted -= {e.name for o in domain.operators if not o.internal for e in _atoms(o)}
        noted -= {fact[0] for fact in now}
        return [*now, *(f for f in self.plan.facts_after(self.executed) if f[0] in noted)]


def _atoms(operator: Operator) -> Iterator[Atom]:
    agenda: list[Effect] = [*operator.deletes, *operator.adds]
    while agenda:
        effect = agenda.pop()
        if isinstance(effect, ForEach):
            agenda.extend(effect.effects)
        elif isinstance(effect, Atom):
            yield effect


class Repair:
    """Networks to begin with, the one that keeps most of an interrupted plan first.

    First all operators that are left, as they are and with the effects that they had.  Where one of them cannot be applied any more, the task that it
    was done for is done anew, before and after it everything is kept; then the task above that, and so on.  In the
    end only the tasks of the problem that were not finished are left.

    ``reached_actions`` tells how many actions the search got done at best so far.
    """

    def __init__(
        self, beginning: Start, interrupted: Interrupted, reached_actions: Callable[[], int]
    ) -> None:
        self._plan = interrupted.plan
        tree = interrupted.plan.tree
        self._beginning = beginning
        self._reached_actions = reached_actions
        self._above: dict[int, TreeNode] = {}
        for node, _ in tree.nodes():
            self._above.update((child.began, node) for child in node.children)
        primitives = [node for node, _ in tree.nodes() if node.primitive]
        primitives.sort(key=lambda node: node.began)
        done = [node.began for node in primitives if node.step is not None][: interrupted.executed]
        last = done[-1] if done else -1
        self._left = [node for node in primitives if node.began > last]
        ahead = {node.began for node in self._left}
        self._roots = [root for root in tree.roots if any(p in ahead for p in _primitives(root))]

    def networks(self, _: State) -> Iterator[Network]:
        """What may be left to do, one after the other."""
        tried = [self._kept(node) for node in self._left]
        yield _in_order(tried)
        broken = self._broken()
        node = self._above.get(broken.began) if broken is not None else None
        while node is not None:
            tasks = self._with_anew(node)
            if tasks != tried:
                yield _in_order(tasks)
            tried, node = tasks, self._above.get(node.began)
        tasks = [root.task for root in self._roots]
        if tasks != tried:
            yield _in_order(tasks)

    def _kept(self, node: TreeNode) -> Task:
        """The task of an operator, to have the effects that it had."""
        log, changes = self._plan.log, self._plan.history.changes
        began = node.began - 1
        while began >= 0 and not log[began].mark:
            began -= 1
        first = log[began].mark if began >= 0 else 0
        last = dict(changes[first : log[node.began].mark])
        task = Kept(node.task)
        task.added = tuple([fact for fact, added in last.items() if added])
        task.removed = tuple([fact for fact, added in last.items() if not added])
        return task

    def _broken(self) -> TreeNode | None:
        """The first operator that could not be applied."""
        actions = [node for node in self._left if node.step is not None]
        reached = self._reached_actions()
        return actions[reached] if reached < len(actions) else None

    def _with_anew(self, node: TreeNode) -> list[Task]:
        below = set(_primitives(node))
        tasks: list[Task] = []
        placed = False
        for primitive in self._left:
            if primitive.began not in below:
                tasks.append(self._kept(primitive))
            elif not placed:
                tasks.append(node.task)
                placed = True
        return tasks

    def reached(self, state: State) -> bool:
        """Whether the goal of the problem holds."""
        return self._beginning.reached(state)

    def unmet(self, state: State) -> str:
        """The first part of the goal that does not hold."""
        return self._beginning.unmet(state)


def _primitives(node: TreeNode) -> Iterator[int]:
    agenda = [node]
    while agenda:
        current = agenda.pop()
        if current.primitive:
            yield current.began
        agenda.extend(current.children)


def _in_order(tasks: Sequence[Task]) -> Network:
    network: Network = None
    for place in range(len(tasks) - 1, -1, -1):
        network = cell(tasks[place], network, None, place)
    return network
