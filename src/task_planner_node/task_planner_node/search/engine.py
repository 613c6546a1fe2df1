"""The search itself: straight on while there is one way, an explicit stack of choices where there are several."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING

from task_planner_node.errors import LimitReached
from task_planner_node.language.model import shorten, show
from task_planner_node.oracle import Token
from task_planner_node.search.closed import Visited
from task_planner_node.search.dead_ends import DeadEnd, DeadEnds, Farthest
from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.loosely import shape
from task_planner_node.search.network import Network, Parallel, Task, all_tasks
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.partial_plan import (
    Expansion,
    Limits,
    Node,
    Position,
    Way,
    Whereabouts,
)
from task_planner_node.search.plans import Plans
from task_planner_node.search.relaxation import prove_dead
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.tours import Following
from task_planner_node.search.ways import Ways

if TYPE_CHECKING:
    from task_planner_node.search.outlook import Outlook

CHECK_INTERVAL = 64
# A relaxation of the whole mission is examined when this many choices were taken back.
PATIENCE = 1000
# So many of the last decompositions and actions of the longest partial plan are kept.
MOST_NOTED = 200
# A task is looked for among so many of those that it came from.
MOST_ANCESTORS = 100
# Names of tasks with the states in which they came up, as far as they are remembered.
MOST_BEGUN = 500_000


class Search:
    """Depth-first search over task choices, methods, bindings and geometric alternatives.

    ``check`` is called every CHECK_INTERVAL decompositions and raises to end the search; ``plans`` takes the plans.
    ``outlook`` knows tours through all that is left.
    """

    def __init__(
        self,
        domain: CompiledDomain,
        beginning: Start,
        state: State,
        geometry: Geometry,
        statistics: Statistics,
        limits: Limits,
        check: Callable[[], None],
        plans: Plans,
        outlook: Outlook | None = None,
    ) -> None:
        self.dead_ends = DeadEnds()
        self.proofs: dict[Task, DeadEnd] = {}
        self.deepest = 0
        self.farthest = Farthest()
        self.proven = True
        self.gave_up = False
        # Grows with all that depends on where the robots stand, and not on the facts alone.
        self.placed = 0
        self.stack: list[Node] = []
        self.position: Position | None = None
        self.log: list[Expansion] = []
        self.plans = plans
        self.visited = Visited(limits.optimise, limits.plans > 1)
        self._domain = domain
        self._beginning = beginning
        self._state = state
        self._geometry = geometry
        self._statistics = statistics
        self._limits = limits
        self._check = check
        self._ways = Ways(self, domain, beginning, state, geometry, limits, outlook)
        self._repeats = 0
        self._begun: set[tuple[object, tuple[int, Token]]] = set()
        self._steps = 0
        self._most_requests = self._most_backtracks = inf
        if limits.most_requests is not None:
            self._most_requests = statistics.requests + limits.most_requests
        if limits.most_backtracks is not None:
            self._most_backtracks = statistics.backtracks + limits.most_backtracks

    def run(self, start: Token, tour: Following | None = None) -> None:
        """Search along ``tour`` as far as that goes.

        The plans are left in ``plans``, and ``proven`` tells whether there are no others.
        Raises LimitReached, Cancelled, GeometryUnavailable, GeometryFailed and MissionError.
        """
        where = self._first = Whereabouts(start, start, 0.0, tour=tour)
        while True:
            root = self._node((None, where, 0.0, 0.0, 0, False, None))
            root.moves = self._ways.beginnings(where)
            self.stack.append(root)
            position = self._advance()
            while position is not None:
                if self._forward(position):
                    return
                position = self._backward()
            self.proven = not (root.unproven or self.gave_up)
            if not root.postponed:
                if not self.plans.kept and not self._domain.geometric:
                    self._hopeless_from_the_start()
                return
            # What leads back to the same task in the same state is tried once more often than before.
            self._repeats += 1
            self.visited.forget()

    def _node(self, position: Position) -> Node:
        return Node(
            position,
            self._state.mark(),
            len(self.log),
            len(self.visited.order),
            self._geometry.version,
        )

    def _advance(self) -> Position | None:
        """The next position of the last choice that has one."""
        stack, state, geometry = self.stack, self._state, self._geometry
        while stack:
            node = stack[-1]
            if node.tested != geometry.version:
                node.tested = geometry.version
                if self.hopeless(node.network, node.where):
                    self._leave()
                    continue
            child = next(node.moves, None)
            if child:
                return child
            if child is None:
                self._leave()
                if stack:
                    stack[-1].unproven |= node.unproven
                    stack[-1].postponed |= node.postponed
            else:
                state.undo(node.mark)
        return None

    def _leave(self) -> None:
        """Go back from the last choice to the one before it, and undo what was done between them."""
        node = self.stack.pop()
        self._statistics.backtracks += 1
        self._undo(self.stack[-1] if self.stack else node)

    def _backward(self) -> Position | None:
        self._statistics.backtracks += 1
        if (
            self._statistics.requests > self._most_requests
            or self._statistics.backtracks > self._most_backtracks
        ):
            self.gave_up = True
            self._end()
        waited = self._statistics.backtracks == PATIENCE and not self._domain.geometric
        if waited and self._hopeless_from_the_start():
            self._end()
        if self.stack:
            self._undo(self.stack[-1])
        return self._advance()

    def _end(self) -> None:
        """Leave everything that is still open."""
        if self.stack:
            self._undo(self.stack[0])
            self.stack[0].unproven = self.stack[0].postponed = False
            self.stack.clear()

    def _undo(self, node: Node) -> None:
        if self.deepest > self.farthest.actions:
            self.note_farthest()
        self._state.undo(node.mark)
        del self.log[node.logged :]
        self.visited.close(node)

    def _forward(self, position: Position) -> bool:
        """Go on from a position as far as there is a way; True when all plans that are wanted are found."""
        statistics, plans, ways = self._statistics, self.plans, self._ways
        optimise = self._limits.optimise
        way: Way
        while True:
            self.position = position
            network, where, cost, rest_cost, actions, _, chosen = position
            if actions > self.deepest:
                self.deepest = actions
                self.dead_ends.latest = None
            if optimise and cost + rest_cost >= plans.bound:
                self.placed += 1
                return False
            if network is None:
                return self._accept(where, cost)
            if chosen is not None:
                way = ways.expand(position, chosen.cell, chosen.path, chosen.focus)
            elif type(network[0]) is Parallel:
                if self.visits(network, where, cost):
                    return False
                way = ways.candidates(position)
            else:
                way = ways.expand(position, network, (), focus=False)
            if isinstance(way, tuple):
                position = way
            elif way is None:
                return False
            else:
                node = self._node(position)
                node.moves = way
                self.stack.append(node)
                following = self._advance()
                if following is None:
                    return False
                position = following
            if position[6] is None:
                statistics.decompositions += 1
            self._steps += 1
            if not self._steps % CHECK_INTERVAL:
                self._look(network)

    def visits(self, network: Network, where: Whereabouts, cost: float) -> bool:
        """Note that the search comes to a network; whether it need not go on there."""
        entry = self.visited.enter(network, self._state, where.start, cost)
        if entry is None:
            return False
        self.placed += 1
        self.stack[-1].unproven |= entry.unproven
        if entry.open:
            task = next(all_tasks(network))
            self.dead_ends.add(
                task, 'circle', 'it comes up again with the same left to do in the same state'
            )
        return True

    def repeats(self, task: Task, parent: Expansion | None, start: Token) -> bool:
        """Whether a task came up below itself in the same state more often than this round allows.

        It is then left for a later round.
        """
        since = (self._state.key, start)
        begun = (task[0], since)
        if begun not in self._begun:
            if len(self._begun) >= MOST_BEGUN:
                self._begun.clear()
            self._begun.add(begun)
            return False
        allowed = self._repeats
        loose = self._domain.loose
        wanted = shape(task) if loose else task
        for _ in range(MOST_ANCESTORS):
            if parent is None:
                return False
            if parent.since == since and (
                parent.task == task or (loose and shape(parent.task) == wanted)
            ):
                if not allowed:
                    self.placed += 1
                    self.stack[-1].postponed = True
                    return True
                allowed -= 1
            parent = parent.parent
        return False

    def give_up(self) -> None:
        """Note that something was left at the last choice without a proof."""
        self.stack[-1].unproven = True

    def note_farthest(self) -> None:
        """Keep the last actions of the partial plan on the log, and what it could not go on with."""
        last = tuple(
            [
                expansion.task
                for expansion in self.log[-MOST_NOTED:]
                if isinstance(expansion.by, CompiledOperator) and not expansion.by.internal
            ]
        )
        self.farthest = Farthest(self.deepest, last, self.dead_ends.latest)

    def _look(self, network: Network) -> None:
        self._check()
        if len(self.log) > self._limits.max_depth:
            task = next(iter(all_tasks(network)), ())
            raise LimitReached(
                f'more than {self._limits.max_depth} decompositions in one plan, the last one of '
                f'{shorten(show(task))}'
            )

    def _accept(self, where: Whereabouts, cost: float) -> bool:
        if not self._beginning.reached(self._state):
            unmet = self._beginning.unmet(self._state)
            self.dead_ends.add(('goal',), 'goal', f'not reached when all is done: {unmet}')
            return False
        self.placed += 1
        self.plans.add(self.log, self._state.history(), where.length, cost)
        return self.plans.enough

    def _hopeless_from_the_start(self) -> bool:
        """Whether the relaxation of the whole mission proves that there is no plan."""
        state = self._state.initial()
        networks = self._beginning.networks(state)
        self._state, now = state, self._state
        try:
            return all(self.hopeless(network, self._first) for network in networks)
        finally:
            self._state = now

    def hopeless(self, network: Network, where: Whereabouts) -> bool:
        """Whether a relaxation proves that some task of the network cannot be done any more."""
        self._check()
        tasks = all_tasks(network)
        reasons = prove_dead(self._domain, self._state, self._geometry, tasks, where.lineage)
        for reason in reasons:
            self.proofs.setdefault(reason.task, reason)
        return bool(reasons)
