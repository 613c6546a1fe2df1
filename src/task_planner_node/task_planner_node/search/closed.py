"""What was searched through already: interleavings of parallel tasks lead to the same place in many ways."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field

from task_planner_node.oracle import Token
from task_planner_node.search.network import Network, Parallel, TooLarge, canonical
from task_planner_node.search.state import State

MOST_ENTRIES = 100_000
MOST_TASKS = 100
MOST_CHANGES = 200


@dataclass(slots=True)
class Closed:
    """Partial plans that were given up, by what is left to do, the facts, and where the robots stand.

    Each with the length [m] at which it was reached and whether something below it was left unproven.
    """

    _entries: dict[Hashable, tuple[float, bool]] = field(default_factory=dict)

    def add(
        self, network: Network, state: State, start: Token, length: float, unproven: bool
    ) -> None:
        """Remember a partial plan, unless it is too large or there are too many."""
        key = _key(network, state, start)
        if key is not None and len(self._entries) < MOST_ENTRIES:
            self._entries[key] = (length, unproven)

    def find(
        self, network: Network, state: State, start: Token, length: float, optimise: bool
    ) -> bool | None:
        """Whether something was left unproven below this partial plan; None when it has to be searched.

        When optimising, one that was reached by a longer way has to be searched again.
        """
        entry = self._entries.get(_key(network, state, start)) if self._entries else None
        if entry is None or (optimise and length < entry[0]):
            return None
        return entry[1]


def _key(network: Network, state: State, start: Token) -> Hashable | None:
    if network is None or not isinstance(network[0], Parallel):
        return None
    if len(state.changed) > MOST_CHANGES:
        return None
    try:
        return canonical(network, MOST_TASKS), frozenset(state.changed), start
    except TooLarge:
        return None
