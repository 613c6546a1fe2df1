"""Proofs that tasks cannot be done any more, by a relaxation of the task network.

Deletions, the order of tasks and negative preconditions are left out, and every branch of a method is open,
so whatever a real decomposition can do, the relaxed one can.  A task that cannot even be done in the relaxation
is dead, and with it every network that holds it, whatever the order of the other tasks.
"""

from __future__ import annotations

from collections.abc import Iterable
from math import inf

from task_planner_node.errors import MissionError, TermRefused
from task_planner_node.language.model import show
from task_planner_node.oracle import Token
from task_planner_node.search.dead_ends import DeadEnd
from task_planner_node.search.domain import CompiledDomain
from task_planner_node.search.geometry import Geometry, Nogood
from task_planner_node.search.network import Task, all_tasks
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.protections import PROTECTIONS
from task_planner_node.search.state import State, TooMuchWork
from task_planner_node.search.unbound import ground

MOST_BINDINGS = 20_000
MOST_WORK = 500_000
MOST_REASONS = 20
NEVER = -1


def prove_dead(
    domain: CompiledDomain,
    state: State,
    geometry: Geometry,
    tasks: Iterable[Task],
    lineage: Token,
) -> list[DeadEnd]:
    """The reasons why not all of ``tasks`` can be done from ``state`` on; empty when nothing is proven.

    Nothing is proven either when the relaxation is too large, or when an axiom or a term in it cannot be
    evaluated: with every branch open, it goes where no decomposition may ever come.

    What is impossible for the attitudes connected to ``lineage`` counts unless an attitude may be assigned
    anew: the first assignment would have to come after tasks that are all subject to it.
    """
    wanted = list(dict.fromkeys(tasks))
    if not all(ground(task) for task in wanted):
        return []
    mark = state.mark()
    state.relaxed = True
    state.most_work = state.work + MOST_WORK
    try:
        for assumed in (lineage, None):
            relaxation = _Relaxation(domain, state, geometry, assumed)
            relaxation.explore(wanted)
            if assumed is None or not relaxation.assigns:
                return relaxation.reasons(wanted)
            state.undo(mark)
        return []
    except (TooMuchWork, RecursionError, MissionError, TermRefused):
        return []
    finally:
        state.undo(mark)
        state.relaxed = False
        state.most_work = inf


def needs(
    domain: CompiledDomain,
    state: State,
    geometry: Geometry,
    tasks: Iterable[Task],
    text: str,
) -> bool:
    """Whether ``tasks`` cannot all be done from ``state`` on without meeting the geometric preconditions ``text``."""
    wanted = list(dict.fromkeys(tasks))
    if not all(ground(task) for task in wanted):
        return False
    mark = state.mark()
    state.relaxed = True
    state.most_work = state.work + MOST_WORK
    try:
        relaxation = _Relaxation(domain, state, geometry, None, text)
        relaxation.explore(wanted)
        return bool(relaxation.reasons(wanted))
    except (TooMuchWork, RecursionError, MissionError, TermRefused):
        return False
    finally:
        state.undo(mark)
        state.relaxed = False
        state.most_work = inf


class _Relaxation:
    """The fixed point of facts that may become true and of decompositions that may be applied."""

    def __init__(
        self,
        domain: CompiledDomain,
        state: State,
        geometry: Geometry,
        lineage: Token | None,
        without: str = '',
    ) -> None:
        self._without = without
        self.assigns = False
        self._domain = domain
        self._state = state
        self._geometry = geometry
        self._lineage = lineage
        self._done: set[Task] = set()
        self._blocked: dict[Task, Nogood] = {}
        self._lost: dict[str, Task] = {}
        self._decompositions: dict[Task, dict[tuple[Task, ...], None]] = {}
        self._agenda: list[Task] = []
        # The facts added that some task reads are counted: so far, when a task was looked at last, and with the latest
        # fact of a predicate.
        self._added = 0
        self._looked: dict[Task, int] = {}
        self._latest: dict[str, int] = {}
        self._bindings = 0

    def explore(self, tasks: Iterable[Task]) -> None:
        """Apply everything until nothing new appears.

        Tasks that appear are looked at in the same pass: a task below many others takes no pass for
        each of them.  In later passes a task is looked at again where there are new facts that it reads.
        """
        self._look_at(tasks)
        before = NEVER
        while before != self._added:
            before = self._added
            for task in self._agenda:
                if self._has_news(task):
                    self._looked[task] = self._added
                    operator = self._domain.operators.get(task[0])
                    if operator is None:
                        self._decompose(task)
                    else:
                        self._apply(operator, task)
        self._close()

    def _look_at(self, tasks: Iterable[Task]) -> None:
        for task in tasks:
            if task not in self._looked:
                self._looked[task] = NEVER
                self._agenda.append(task)

    def _has_news(self, task: Task) -> bool:
        """Whether a task was not looked at since facts appeared that it reads."""
        looked = self._looked[task]
        if looked == NEVER:
            return True
        if looked == self._added:
            return False
        names = self._domain.reads.of(task[0])
        return names is None or any(self._latest.get(name, 0) > looked for name in names)

    def _count(self) -> None:
        self._bindings += 1
        if self._bindings > MOST_BINDINGS:
            raise TooMuchWork

    def _apply(self, operator: CompiledOperator, task: Task) -> None:
        frame = operator.bind(task)
        if frame is None:
            return
        for _ in operator.condition.solutions(self._state, frame):
            self._count()
            adds = [
                fact for fact in operator.adds(self._state, frame) if fact[0] not in PROTECTIONS
            ]
            if operator.text is not None:
                text = operator.text(frame)
                if text == self._without:
                    continue
                nogood = self._geometry.lasting_nogood(text, self._lineage)
                if nogood is not None:
                    self._blocked.setdefault(task, nogood)
                    for fact in adds:
                        self._lost.setdefault(show(fact), task)
                    continue
                self.assigns = self.assigns or operator.assigns
            self._done.add(task)
            for fact in adds:
                if self._state.add(fact) and self._domain.reads.is_read(fact[0]):
                    self._added += 1
                    self._latest[fact[0]] = self._added

    def _decompose(self, task: Task) -> None:
        found = self._decompositions.setdefault(task, {})
        self._count()
        for method in self._domain.methods.get(task[0], ()):
            frame = method.bind(task)
            if frame is None:
                continue
            for branch in method.branches:
                trial = frame.copy()
                for _ in branch.condition.solutions(self._state, trial):
                    self._count()
                    if branch.loose:
                        raise TooMuchWork
                    subtasks = tuple(all_tasks(branch.grow(trial, None, None)))
                    if subtasks not in found:
                        found[subtasks] = None
                        self._look_at(subtasks)

    def _close(self) -> None:
        """Mark every task as done that has a decomposition into tasks that are."""
        changed = True
        while changed:
            changed = False
            for task, ways in reversed(self._decompositions.items()):
                self._state.worked(len(ways))
                if task not in self._done and any(self._done.issuperset(way) for way in ways):
                    self._done.add(task)
                    changed = True

    def reasons(self, tasks: list[Task]) -> list[DeadEnd]:
        """The dead ends below those of ``tasks`` that cannot be done."""
        found: list[DeadEnd] = []
        agenda = [task for task in reversed(tasks) if task not in self._done]
        visited = set(agenda)
        while agenda and len(found) < MOST_REASONS:
            task = agenda.pop()
            ways = self._decompositions.get(task, {})
            if ways:
                below = [sub for way in ways for sub in way if sub not in self._done]
                fresh = [sub for sub in dict.fromkeys(below) if sub not in visited]
                visited.update(fresh)
                agenda.extend(reversed(fresh))
            else:
                found.append(self._reason(task))
        roots = [reason for reason in found if not self._follows(reason, found)]
        return (
            roots
            or found
            or [
                DeadEnd(task, 'it decomposes into itself for ever', count=1)
                for task in tasks
                if task not in self._done
            ]
        )

    def _follows(self, reason: DeadEnd, others: list[DeadEnd]) -> bool:
        """Whether all that it lacks are facts that other dead ends would have made true."""
        blocked = {other.task for other in others if other.task in self._blocked}
        return bool(reason.unmet) and all(self._lost.get(fact) in blocked for fact in reason.unmet)

    def _reason(self, task: Task) -> DeadEnd:
        nogood = self._blocked.get(task)
        if nogood is not None:
            return DeadEnd(task, nogood.reason, nogood.objects, 1)
        operator = self._domain.operators.get(task[0])
        failures: list[tuple[str, str]] = []
        if operator is not None:
            frame = operator.bind(task)
            if frame is not None:
                failures.append(('', operator.condition.first_failure(self._state, frame)))
        for method in self._domain.methods.get(task[0], ()):
            frame = method.bind(task)
            if frame is not None:
                failures += [
                    (branch.label, branch.condition.first_failure(self._state, frame))
                    for branch in method.branches
                ]
        if not failures:
            return DeadEnd(task, no_definition_fits(task, operator is not None), count=1)
        unmet = tuple(dict.fromkeys(literal for _, literal in failures))
        parts = unmet if len(unmet) == 1 else [f'{literal} in {name}' for name, literal in failures]
        return DeadEnd(task, f'nothing can make {" or ".join(parts)} true', count=1, unmet=unmet)


def no_definition_fits(task: Task, primitive: bool) -> str:
    """The reason when no head matches."""
    kind = 'operator' if primitive else 'method'
    return f'no {kind} {show(task[0])} has a head that fits these arguments'
