"""What was searched already: a position that comes again is not searched again."""

from __future__ import annotations

from collections.abc import Hashable
from typing import Any

from task_planner_node.oracle import Token
from task_planner_node.search.network import Network, TooLarge, same
from task_planner_node.search.partial_plan import Node
from task_planner_node.search.state import State

MOST_ENTRIES = 500_000
MOST_TASKS = 100


class Entry:
    """A position that the search came to, at a ``cost``.

    It is open until all was tried below it; then ``unproven`` tells whether something was given up there.
    """

    __slots__ = ('cost', 'key', 'network', 'open', 'unproven')

    def __init__(self, key: Hashable, network: Network, cost: float) -> None:
        self.key = key
        self.network = network
        self.cost = cost
        self.open = True
        self.unproven = False


class Visited:
    """Positions by what is left to do, the facts, and where the robots stand.

    One that is open leads in a circle: whatever is below it is found above.  One that is closed is not searched
    again, unless it is now reached at a lower cost and the cheapest plan is wanted.
    """

    def __init__(self, optimise: bool, several: bool) -> None:
        self.entries: dict[Hashable, Entry] = {}
        self.order: list[Entry] = []
        self._optimise = optimise
        self._several = several

    def enter(self, network: Any, state: State, start: Token, cost: float) -> Entry | None:
        """Note a position; the earlier entry if it need not be searched."""
        key = (network[4], state.key, start)
        entry = self.entries.get(key)
        if entry is not None:
            if not self._is(entry, network):
                return None
            if entry.open or not (self._optimise and cost < entry.cost):
                return entry
        elif len(self.entries) >= MOST_ENTRIES:
            return None
        entry = self.entries[key] = Entry(key, network, cost)
        self.order.append(entry)
        return None

    def _is(self, entry: Entry, network: Any) -> bool:
        try:
            return same(entry.network, network, MOST_TASKS)
        except TooLarge:
            return False

    def close(self, node: Node) -> None:
        """All was tried below the last choice that was made at ``node``."""
        order = self.order
        for entry in order[node.entered :]:
            entry.open = False
            entry.unproven = node.unproven
            # What was left for later, or holds further plans that are wanted, is not done with.
            if (node.postponed or self._several) and self.entries.get(entry.key) is entry:
                del self.entries[entry.key]
        del order[node.entered :]

    def forget(self) -> None:
        """Begin anew."""
        self.entries.clear()
        self.order.clear()
