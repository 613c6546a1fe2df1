"""Motions that every plan needs, and how much they cost at least: what advice proves about the cost of the rest."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from task_planner_node.oracle import Token
from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.network import Network, all_tasks
from task_planner_node.search.relaxation import needs
from task_planner_node.search.state import State

# A text is tested by a relaxation of the whole mission.
MOST_TESTED = 200


class Landmarks:
    """Ground geometric preconditions that have to be met at some time in every plan.

    As long as one of them has not been met, the rest of a plan is at least as long as the shortest motion that meets
    it from where the robots stand, whatever comes first on the way: unless an attitude may still be assigned.
    """

    def __init__(
        self, domain: CompiledDomain, beginning: Start, state: State, geometry: Geometry
    ) -> None:
        self._domain = domain
        self._beginning = beginning
        self._state = state
        self._geometry = geometry
        self._known: dict[str, bool] = {}

    def least_length(self, start: Token, met: Collection[str], network: Network) -> float:
        """A lower bound [m] of the motions that are left, as far as advice was heard at ``start``."""
        if any(task[0] in self._domain.may_assign for task in all_tasks(network)):
            return 0.0
        bounds = self._geometry.lower_bounds(start)
        ahead = sorted(
            ((bound, text) for text, bound in bounds.items() if text not in met), reverse=True
        )
        return next((bound for bound, text in ahead if self._necessary(text)), 0.0)

    def _necessary(self, text: str) -> bool:
        if text not in self._known:
            self._known[text] = len(self._known) < MOST_TESTED and self._test(text)
        return self._known[text]

    def _test(self, text: str) -> bool:
        """Whether there is no plan without it, not even in a relaxation, in any way to begin."""
        state = self._state.initial()
        networks: Iterable[Network] = self._beginning.networks(state)
        return all(
            needs(self._domain, state, self._geometry, all_tasks(network), text)
            for network in networks
        )
