"""The search itself: an explicit stack of nodes, each with its lazily enumerated moves."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import inf

from task_planner_node.errors import LimitReached
from task_planner_node.language.model import shorten, show
from task_planner_node.oracle import Answer, Status, Token
from task_planner_node.search.closed import Closed
from task_planner_node.search.dead_ends import DeadEnd, DeadEnds
from task_planner_node.search.domain import CompiledDomain, CompiledMethod
from task_planner_node.search.geometry import Geometry
from task_planner_node.search.guidance import leading_text
from task_planner_node.search.network import (
    Network,
    Path,
    Task,
    all_tasks,
    first_tasks,
    replace,
    rest_after,
)
from task_planner_node.search.partial_plan import Limits, Node, Step
from task_planner_node.search.relaxation import no_definition_fits, prove_dead
from task_planner_node.search.state import State
from task_planner_node.search.statistics import Statistics
from task_planner_node.search.terms import Frame

CHECK_INTERVAL = 64
# The methods whose heads fit a task, each with its frame.
Fitting = list[tuple[CompiledMethod, Frame]]


class Search:
    """Depth-first search over task choices, methods, bindings and geometric alternatives.

    ``check`` is called every CHECK_INTERVAL nodes and raises to end the search.
    """

    def __init__(
        self,
        domain: CompiledDomain,
        state: State,
        geometry: Geometry,
        statistics: Statistics,
        limits: Limits,
        check: Callable[[], None],
    ) -> None:
        self.dead_ends = DeadEnds()
        self.proofs: dict[Task, DeadEnd] = {}
        self.best: tuple[Step, ...] | None = None
        self.best_length = inf
        self.deepest = 0
        self.proven = True
        self.stack: list[Node] = []
        self._closed = Closed()
        self._domain = domain
        self._state = state
        self._geometry = geometry
        self._statistics = statistics
        self._limits = limits
        self._check = check

    def run(self, network: Network, start: Token) -> None:
        """Search; the plan is left in ``best``, and ``proven`` tells whether its absence is a proof.

        Raises LimitReached, Cancelled, GeometryUnavailable, GeometryFailed and MissionError.
        """
        root = Node(network, start, start, mark=self._state.mark(), tested=-1)
        root.moves = self._moves(root)
        stack = self.stack = [root]
        if network is None:
            self._accept()
            return
        nodes = 0
        while stack:
            node = stack[-1]
            self._state.undo(node.mark)
            if node.tested != self._geometry.version:
                node.tested = self._geometry.version
                if self._dead(node):
                    stack.pop()
                    self._statistics.backtracks += 1
                    continue
            child = next(node.moves, node)
            if child is node:
                stack.pop()
                self._closed.add(node.network, self._state, node.start, node.length, node.unproven)
                self._statistics.backtracks += 1
                if stack:
                    stack[-1].unproven |= node.unproven
                else:
                    self.proven = not node.unproven
                continue
            if child is None:
                continue
            nodes += 1
            if nodes % CHECK_INTERVAL == 0:
                self._check()
            if child.length >= self.best_length:
                continue
            seen = self._seen(child)
            if seen is not None:
                node.unproven |= seen
                self._statistics.backtracks += 1
                continue
            stack.append(child)
            self.deepest = max(self.deepest, child.actions)
            if child.network is None:
                self._accept()
                if not self._limits.optimise:
                    return
                stack.pop()
            elif len(stack) > self._limits.max_depth:
                raise LimitReached(self._too_deep(child))

    def _seen(self, node: Node) -> bool | None:
        optimise = self._limits.optimise
        return self._closed.find(node.network, self._state, node.start, node.length, optimise)

    def _accept(self) -> None:
        node = self.stack[-1]
        if self.best is None or node.length < self.best_length:
            self.best = tuple(entry.step for entry in self.stack if entry.step is not None)
            self.best_length = node.length

    def _too_deep(self, node: Node) -> str:
        tasks = first_tasks(node.network)
        task = shorten(show(tasks[0][0])) if tasks else ''
        return f'more than {self._limits.max_depth} nested choices, the last one at {task}'

    def _dead(self, node: Node) -> bool:
        self._check()
        tasks = all_tasks(node.network)
        reasons = prove_dead(self._domain, self._state, self._geometry, tasks, node.lineage)
        for reason in reasons:
            self.proofs.setdefault(reason.task, reason)
        return bool(reasons)

    def _moves(self, node: Node) -> Iterator[Node | None]:
        """The children of a node in the order to try; None asks for another look at the node itself."""
        candidates = first_tasks(node.network)
        fits: dict[Path, Fitting] = {}
        for task, path in candidates:
            if task[0] in self._domain.operators:
                continue
            fitting = self._fitting(task)
            if not fitting:
                self.dead_ends.add(task, 'head', no_definition_fits(task, primitive=False))
                return
            fits[path] = fitting
            method, frame = fitting[0]
            if len(fitting) == 1 and method.unconditional:
                # What it decomposes into depends on nothing that another task could change.
                self._statistics.decompositions += 1
                rest = rest_after(node.network, path)
                branch = method.branches[0].grow(frame, rest)
                yield self._child(node, replace(node.network, path, branch, to_front=False))
                return
        if len(candidates) == 1:
            yield from self._expand(node, *candidates[0], fits)
            return
        if node.focused:
            yield from self._expand(node, *candidates[0], fits)
            candidates = candidates[1:]
        version = self._geometry.version
        ordered = self._in_advised_order(node, candidates)
        if self._geometry.version != version:
            yield None
        for task, path in ordered:
            yield from self._expand(node, task, path, fits)

    def _in_advised_order(
        self, node: Node, candidates: list[tuple[Task, Path]]
    ) -> list[tuple[Task, Path]]:
        """Candidates whose first motion is known change places among themselves, the others stay."""
        if not self._limits.use_advice:
            return candidates
        texts = [leading_text(self._domain, self._state, task) for task, _ in candidates]
        known = [text for text in texts if text is not None]
        ranks = self._geometry.ranks(node.start, node.lineage, known, ask=not node.focused)
        places = [i for i, text in enumerate(texts) if text is not None and text in ranks]
        best_first = sorted(places, key=lambda i: ranks[texts[i] or ''])
        ordered = list(candidates)
        for place, chosen in zip(places, best_first, strict=True):
            ordered[place] = candidates[chosen]
        return ordered

    def _fitting(self, task: Task) -> Fitting:
        bound = ((method, method.bind(task)) for method in self._domain.methods.get(task[0], ()))
        return [(method, frame) for method, frame in bound if frame is not None]

    def _expand(
        self, node: Node, task: Task, path: Path, fits: dict[Path, Fitting]
    ) -> Iterator[Node | None]:
        if task[0] in self._domain.operators:
            return self._apply(node, task, path)
        return self._decompose(node, task, path, fits[path])

    def _decompose(
        self, node: Node, task: Task, path: Path, fitting: Fitting
    ) -> Iterator[Node | None]:
        """SHOP2: every method whose head fits; of each the first branch that can be satisfied."""
        network, state = node.network, self._state
        rest = rest_after(network, path)
        failures: list[str] = []
        applied = False
        for method, frame in fitting:
            for branch in method.branches:
                found = False
                for _ in branch.condition.solutions(state, frame):
                    found = True
                    self._statistics.decompositions += 1
                    grown = branch.grow(frame, rest)
                    if path:
                        grown = replace(network, path, grown, to_front=True)
                    yield self._child(node, grown, focused=bool(path))
                if found:
                    applied = True
                    break
            else:
                if not applied and (task, 'method') not in self.dead_ends.groups:
                    failures += [b.condition.first_failure(state, frame) for b in method.branches]
        if not applied:
            self.dead_ends.add(task, 'method', lambda: _not_satisfied(failures))

    def _apply(self, node: Node, task: Task, path: Path) -> Iterator[Node | None]:
        """Symbolic preconditions first, then the geometric ones, then the effects."""
        operator = self._domain.operators[task[0]]
        frame = operator.bind(task)
        if frame is None:
            self.dead_ends.add(task, 'head', no_definition_fits(task, primitive=True))
            return
        state, network = self._state, node.network
        after = rest_after(network, path)
        if path:
            after = replace(network, path, after, to_front=True)
        action = () if operator.internal else tuple(show(part) for part in task)
        satisfied = False
        for _ in operator.condition.solutions(state, frame):
            satisfied = True
            deletes, adds = operator.effects(frame)
            answers: Iterator[Answer | None] = iter((None,))
            text = ''
            if operator.text is not None:
                text = operator.text(frame)
                answers = self._answers(node, task, text)
            for answer in answers:
                if answer is not None and answer.status != Status.FOUND:
                    yield None
                    continue
                self._statistics.decompositions += 1
                operator.apply(state, deletes, adds)
                step = Step(action, operator.cost, text, node.start, answer) if action else None
                yield self._child(node, after, step=step, answer=answer)
        if not satisfied:
            self.dead_ends.add(
                task,
                'symbolic',
                lambda: _not_satisfied([operator.condition.first_failure(state, frame)]),
            )

    def _answers(self, node: Node, task: Task, text: str) -> Iterator[Answer]:
        """The geometric alternatives; an answer that is not FOUND tells that something was learnt."""
        nogood = self._geometry.nogood(text, node.start, node.lineage)
        if nogood is not None:
            self.dead_ends.add(task, 'geometric', nogood.reason, nogood.objects)
            return
        version = self._geometry.version
        alternatives = self._geometry.alternatives(task, text, node.start, node.lineage)
        exhausted = True
        for count, answer in enumerate(alternatives):
            exhausted = answer.assigned
            if answer.status == Status.FOUND:
                yield answer
                continue
            exhausted = answer.status != Status.UNKNOWN
            if count == 0:
                self.dead_ends.add(task, str(answer.code), answer.message, answer.objects)
            if version != self._geometry.version:
                yield answer
        node.unproven |= not exhausted

    def _child(
        self,
        node: Node,
        network: Network,
        focused: bool = False,
        step: Step | None = None,
        answer: Answer | None = None,
    ) -> Node:
        start, lineage, length = node.start, node.lineage, node.length
        if answer is not None:
            start = answer.end
            lineage = answer.end if answer.assigned else lineage
            length += answer.length
        child = Node(
            network,
            start,
            lineage,
            self._state.mark(),
            self._geometry.version,
            node.actions + (step is not None),
            length,
            focused,
            step,
        )
        child.moves = self._moves(child)
        return child


def _not_satisfied(literals: Sequence[str]) -> str:
    known = [literal for literal in dict.fromkeys(literals) if literal]
    return f'precondition not met: {" or ".join(known)}' if known else 'preconditions not met'
