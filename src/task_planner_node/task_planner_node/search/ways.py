"""How to go on from a position: which task next, by which operator or method, with which bindings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from task_planner_node.search.acting import act, unsatisfied
from task_planner_node.search.candidates import Bindings, Candidates
from task_planner_node.search.conditions import Found
from task_planner_node.search.dead_ends import Reason, not_satisfied
from task_planner_node.search.domain import CompiledDomain, Start
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.loosely import Loosely
from task_planner_node.search.methods import CompiledBranch, CompiledMethod
from task_planner_node.search.motions import Motions
from task_planner_node.search.network import (
    Cell,
    Path,
    Task,
    all_tasks,
    replace,
)
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.partial_plan import (
    Expansion,
    Limits,
    Motion,
    Moves,
    Position,
    Way,
    Whereabouts,
)
from task_planner_node.search.relaxation import no_definition_fits
from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame
from task_planner_node.search.unbound import ground, resolved, substitute

if TYPE_CHECKING:
    from task_planner_node.search.engine import Search
    from task_planner_node.search.outlook import Outlook


@dataclass(frozen=True, slots=True)
class _Begun:
    """The first branch that may be satisfied: its method's and its own index, frames and solutions."""

    methods: Sequence[CompiledMethod]
    index: int
    frame: Frame
    number: int
    trial: Frame
    found: Found


class Ways:
    """The choices of a search.  Iterators expect the state as it was at their choice whenever they are asked."""

    def __init__(
        self,
        search: Search,
        domain: CompiledDomain,
        beginning: Start,
        state: State,
        geometry: Geometry,
        limits: Limits,
        outlook: Outlook | None,
    ) -> None:
        self._search = search
        self._domain = domain
        self._beginning = beginning
        self._state = state
        self._geometry = geometry
        self._limits = limits
        self._log = search.log
        self._motions = Motions(search, state, geometry, limits)
        self._loosely = Loosely(domain, state)
        self._candidates = Candidates(search, domain, beginning, state, geometry, limits, outlook)

    def beginnings(self, where: Whereabouts) -> Moves:
        """The networks of the problem."""
        least = self._domain.least_costs
        for network in self._beginning.networks(self._state):
            examined = self._limits.examined and self._domain.geometric
            if examined and self._search.hopeless(network, where):
                continue
            rest = sum(least.get(task[0], 0.0) for task in all_tasks(network))
            yield network, where, 0.0, rest, 0, False, None

    def candidates(self, position: Position) -> Way:
        """The tasks that may come next, in the order to try."""
        return self._candidates.tasks(position)

    def expand(self, position: Position, cell: Cell, path: Path, focus: bool) -> Way:
        """What may be done with a task."""
        task = cell[0]
        if self._domain.loose and not ground(task):
            return self._bind(position, cell, path, focus)
        operator = self._domain.operators.get(task[0])
        if operator is None:
            return self._decompose(position, cell, path, focus)
        if operator.text is not None:
            return self._motions.moves(self._candidates.on_tour(position), cell, path, operator)
        return self._apply(position, cell, path, operator)

    def _bind(self, position: Position, cell: Cell, path: Path, focus: bool) -> Moves:
        """The ways of a task that has arguments without a value."""
        task = cell[0]
        if self._search.repeats(task, cell[2], position[1].start):
            return
        mark = self._state.mark()
        tried = False
        for by, frame, values in self._loosely.bindings(task):
            tried = True
            following: Iterable[Position | tuple[()] | None]
            if isinstance(by, CompiledBranch):
                following = [self._grow(position, cell, path, focus, by, frame)]
            elif by.text is not None:
                bound = (resolved(task, values), *cell[1:])
                following = self._motions.answered(position, bound, path, by, frame)
            else:
                following = [self._act(position, cell, path, by, frame)]
            for way in following:
                if way:
                    self._log[-1].values = values
                    yield (substitute(way[0], values), *way[1:])
                elif way is None:
                    self._state.undo(mark)
                else:
                    yield way
        if not tried:
            reason = 'no operator or method binds its arguments and can be applied'
            self._search.dead_ends.add(task, 'unbound', reason)

    def _apply(self, position: Position, cell: Cell, path: Path, operator: CompiledOperator) -> Way:
        task = cell[0]
        frame = operator.bind(task)
        if frame is None:
            reason = no_definition_fits(task, primitive=True)
            self._search.dead_ends.add(task, 'head', reason)
            return None
        found = operator.condition.begin(self._state, frame)
        if found is True:
            return self._act(position, cell, path, operator, frame)
        if found is False:
            unsatisfied(self._search, self._state, task, operator, frame)
            return None
        return self._each(position, cell, path, operator, frame, found)

    def _each(
        self,
        position: Position,
        cell: Cell,
        path: Path,
        operator: CompiledOperator,
        frame: Frame,
        found: Iterator[None],
    ) -> Moves:
        satisfied = False
        mark = self._state.mark()
        for _ in found:
            satisfied = True
            following = self._act(position, cell, path, operator, frame)
            if following is not None:
                yield following
            else:
                self._state.undo(mark)
        if not satisfied:
            unsatisfied(self._search, self._state, cell[0], operator, frame)

    def _act(
        self,
        position: Position,
        cell: Cell,
        path: Path,
        operator: CompiledOperator,
        frame: Frame,
    ) -> Position | None:
        network, where, cost, rest_cost, actions, _, _ = position
        acted = act(self._search, self._state, cell, operator, frame)
        if acted is None:
            return None
        price, expansion = acted
        if price != operator.least_cost:
            expansion.motion = Motion(price)
        return (
            replace(network, path, cell[1], to_front=True) if path else cell[1],
            where,
            cost + price,
            rest_cost - operator.least_cost,
            actions if operator.internal else actions + 1,
            False,
            None,
        )

    def _decompose(self, position: Position, cell: Cell, path: Path, focus: bool) -> Way:
        """SHOP2: every method whose head fits; of each the first branch that can be satisfied."""
        task = cell[0]
        if task[0] in self._domain.recursive:
            if not path and self._search.visits(cell, position[1], position[2]):
                return None
            if self._search.repeats(task, cell[2], position[1].start):
                return None
        state = self._state
        methods = self._domain.methods.get(task[0], ())
        for index, method in enumerate(methods):
            frame = method.bind(task)
            if frame is None:
                continue
            for number, branch in enumerate(method.branches):
                condition = branch.condition
                trial = frame.copy() if condition.binds else frame
                found = condition.begin(state, trial)
                if found is False:
                    continue
                if found is True and index + 1 == len(methods) and branch.early is None:
                    return self._grow(position, cell, path, focus, branch, trial)
                begun = _Begun(methods, index, frame, number, trial, found)
                return self._solutions(position, cell, path, focus, begun)
        self._undecomposed(task, methods)
        return None

    def _solutions(
        self, position: Position, cell: Cell, path: Path, focus: bool, begun: _Begun
    ) -> Moves:
        """The solutions from the one on that was begun."""
        position, found = self._candidates.bindings(position, self._bindings(cell, begun))
        for branch, frame in found:
            yield self._grow(position, cell, path, focus, branch, frame)

    def _bindings(self, cell: Cell, begun: _Begun) -> Bindings:
        state = self._state
        found: Found | None = begun.found
        applied = False
        first, skipped, frame = begun.index, begun.number, begun.frame
        for method in begun.methods[first:]:
            if found is None:
                fresh = method.bind(cell[0])
                if fresh is None:
                    continue
                frame, skipped = fresh, 0
            for branch in method.branches[skipped:]:
                if found is None:
                    trial = frame.copy() if branch.condition.binds else frame
                    found = branch.condition.begin(state, trial)
                else:
                    trial = begun.trial
                satisfied = found is True
                if found is True:
                    if self._promising(cell[0], branch, trial):
                        yield branch, trial
                elif found is not False:
                    for _ in found:
                        satisfied = True
                        if self._promising(cell[0], branch, trial):
                            yield branch, trial
                found = None
                if satisfied:
                    applied = True
                    break
        if not applied:
            self._undecomposed(cell[0], begun.methods)

    def _grow(
        self,
        position: Position,
        cell: Cell,
        path: Path,
        focus: bool,
        branch: CompiledBranch,
        frame: Frame,
    ) -> Position:
        network, where, cost, rest_cost, actions, focused, _ = position
        task = cell[0]
        expansion = Expansion(task, cell[2], cell[3], branch)
        if task[0] in self._domain.recursive or self._domain.loose:
            expansion.since = (self._state.key, where.start)
        self._log.append(expansion)
        grown = branch.grow(frame, cell[1], expansion)
        if path:
            grown = replace(network, path, grown, to_front=focus)
            focused = focus
        if self._limits.optimise:
            rest_cost += self._growth(task, branch)
        return grown, where, cost, rest_cost, actions, focused, None

    def _promising(self, task: Task, branch: CompiledBranch, frame: Frame) -> bool:
        """Whether the tasks of a branch can be done as far as nothing ever changes that."""
        early = branch.early
        if early is None or early.holds(self._state, frame):
            return True

        def reason() -> Reason:
            return not_satisfied([('', early.first_failure(self._state, frame))])

        self._search.dead_ends.add(task, 'early', reason)
        return False

    def _growth(self, task: Task, branch: CompiledBranch) -> float:
        least = self._domain.least_costs
        return sum(least.get(name, 0.0) for name in branch.tasks) - least.get(task[0], 0.0)

    # Why there is no way

    def _undecomposed(self, task: Task, methods: Sequence[CompiledMethod]) -> None:
        bound = [(method, method.bind(task)) for method in methods]
        fits = [(method, frame) for method, frame in bound if frame is not None]
        if not fits:
            reason = no_definition_fits(task, primitive=False)
            self._search.dead_ends.add(task, 'head', reason)
            return

        def why() -> Reason:
            branches = [(branch, frame) for method, frame in fits for branch in method.branches]
            return not_satisfied(
                [
                    (
                        branch.label if len(branches) > 1 else branch.name or branch.method,
                        branch.condition.first_failure(self._state, frame),
                    )
                    for branch, frame in branches
                ]
            )

        self._search.dead_ends.add(task, 'method', why)
