"""Why parts of the search failed: tasks and reasons, counted, in the order of first appearance."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from task_planner_node.language.model import shorten, show
from task_planner_node.search.network import Task

MOST_RECORDED = 1000


@dataclass(slots=True)
class DeadEnd:
    """A task that could not be done.

    ``objects`` are labels to look for in the problem, ``unmet`` the literals that nothing can make true.
    """

    task: Task
    reason: str
    objects: tuple[str, ...] = ()
    count: int = 0
    unmet: tuple[str, ...] = ()


@dataclass(slots=True)
class DeadEnds:
    """Dead ends grouped by task and kind; the reason of each group is that of its first."""

    groups: dict[tuple[Task, str], DeadEnd] = field(default_factory=dict)

    def add(
        self,
        task: Task,
        kind: str,
        reason: str | Callable[[], str],
        objects: tuple[str, ...] = (),
    ) -> None:
        """Count a dead end; a callable ``reason`` is only asked when it is the first of its group."""
        group = self.groups.get((task, kind))
        if group is None:
            if len(self.groups) >= MOST_RECORDED:
                return
            group = self.groups[(task, kind)] = DeadEnd(
                task, reason if isinstance(reason, str) else reason(), objects
            )
        group.count += 1

    def lines(self, limit: int) -> list[str]:
        """The groups as text, the most frequent first, at most ``limit`` of them."""
        return describe(sorted(self.groups.values(), key=lambda group: -group.count), limit)


def not_satisfied(literals: Iterable[str]) -> str:
    """The reason when preconditions fail, each with its first literal that fails."""
    known = [literal for literal in dict.fromkeys(literals) if literal]
    return f'precondition not met: {" or ".join(known)}' if known else 'preconditions not met'


def describe(groups: Iterable[DeadEnd], limit: int) -> list[str]:
    """One line for each of the first ``limit`` dead ends, and how many more there are."""
    found = list(groups)
    lines = []
    for group in found[:limit]:
        times = f' ({group.count} times)' if group.count > 1 else ''
        lines.append(f'{shorten(show(group.task))}: {group.reason}{times}')
    if len(found) > limit:
        lines.append(f'... and {len(found) - limit} more')
    return lines
