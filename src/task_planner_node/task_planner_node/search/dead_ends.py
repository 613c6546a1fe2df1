"""Why parts of the search failed: tasks and reasons, counted, in the order of first appearance."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import NamedTuple

from task_planner_node.search.network import Task

MOST_RECORDED = 1000


class Reason(NamedTuple):
    """Why a task could not be done; ``unmet`` are the literals that it failed at."""

    text: str
    unmet: tuple[str, ...] = ()


@dataclass(slots=True)
class DeadEnd:
    """A task that could not be done.

    ``objects`` are labels to look for in the problem, ``unmet`` the literals that do not hold, or in a proof those
    that nothing can make true.
    """

    task: Task
    reason: str
    objects: tuple[str, ...] = ()
    count: int = 0
    unmet: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Farthest:
    """The longest partial plan: how many actions it has, the last of them, and what it ended at, if that is known."""

    actions: int = 0
    last: tuple[Task, ...] = ()
    end: DeadEnd | None = None


@dataclass(slots=True)
class DeadEnds:
    """Dead ends grouped by task and kind; the reason of each group is that of its first.

    ``latest`` is the group that was counted last.
    """

    groups: dict[tuple[Task, str], DeadEnd] = field(default_factory=dict)
    latest: DeadEnd | None = None

    def add(
        self,
        task: Task,
        kind: str,
        reason: str | Callable[[], Reason],
        objects: tuple[str, ...] = (),
    ) -> None:
        """Count a dead end; a callable ``reason`` is only asked when it is the first of its group."""
        group = self.groups.get((task, kind))
        if group is None:
            if len(self.groups) >= MOST_RECORDED:
                self.latest = None
                return
            text, unmet = Reason(reason) if isinstance(reason, str) else reason()
            group = self.groups[task, kind] = DeadEnd(task, text, objects, unmet=unmet)
        group.count += 1
        self.latest = group

    def most_frequent(self) -> list[DeadEnd]:
        """The groups, those that were counted most often first."""
        return sorted(self.groups.values(), key=lambda group: -group.count)


def not_satisfied(failures: Iterable[tuple[str, str]]) -> Reason:
    """The reason when preconditions fail: the branch, empty if there is but one, and its first literal that fails."""
    branches: dict[str, list[str]] = {}
    for branch, literal in failures:
        if literal:
            branches.setdefault(literal, []).append(branch)
    if not branches:
        return Reason('preconditions not met')
    parts = [
        f'{literal} in {" and ".join(names)}' if all(names) else literal
        for literal, names in branches.items()
    ]
    return Reason(f'precondition not met: {", ".join(parts)}', tuple(branches))
