"""What the search holds on its stack: partial plans, their choices, and the log of what was done."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from task_planner_node.oracle import Answer, Purpose, Token
from task_planner_node.search.methods import CompiledBranch
from task_planner_node.search.network import Cell, Network, Path, Task
from task_planner_node.search.operators import CompiledOperator
from task_planner_node.search.unbound import Values

if TYPE_CHECKING:
    from task_planner_node.search.tours import Following


def origin_of(task: Task, parent: Expansion | None) -> int:
    """A hash of a task and of all that it came from."""
    chain = []
    while parent is not None and parent.origin is None:
        chain.append(parent)
        parent = parent.parent
    origin = parent.origin if parent is not None else 0
    for expansion in reversed(chain):
        origin = expansion.origin = hash((expansion.task, origin))
    return hash((task, origin))


class Expansion:
    """A task that was done by an operator or decomposed by a branch: one line of the search's log.

    ``since`` identifies the facts and the attitudes at a recursive task; ``mark`` is the length of the trail after an
    operator.  ``origin`` is that of origin_of, once it was asked for.
    """

    __slots__ = ('by', 'mark', 'motion', 'origin', 'parent', 'place', 'since', 'task', 'values')

    def __init__(
        self,
        task: Task,
        parent: Expansion | None,
        place: int,
        by: CompiledOperator | CompiledBranch,
    ) -> None:
        self.task = task
        self.parent = parent
        self.place = place
        self.by = by
        self.mark = 0
        self.motion: Motion | None = None
        self.since: tuple[int, Token] | None = None
        self.values: Values | None = None
        self.origin: int | None = None


@dataclass(frozen=True, slots=True)
class Motion:
    """What belongs to a step beside its action."""

    cost: float
    preconditions: str = ''
    start: Token = ()
    answer: Answer | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Whereabouts:
    """Where the robots stand, and how far [m] they went.

    ``lineage`` is the attitude that was last assigned; ``met`` are the geometric preconditions that were met so far,
    when optimising; ``tour`` is the one that is followed.
    """

    start: Token
    lineage: Token
    length: float
    met: frozenset[str] = frozenset()
    tour: Following | None = None


@dataclass(frozen=True, slots=True)
class Chosen:
    """The task to go on with, and whether the search then stays with it."""

    cell: Cell
    path: Path
    focus: bool


# What is left to do; where the robots stand; cost so far; a lower bound of the cost of the rest; actions so far;
# whether the search stays with the first task; the task to go on with, if that was chosen.
Position = tuple[Network, Whereabouts, float, float, int, bool, Chosen | None]
# An empty tuple asks for another look at the choice: something was learnt that may make it hopeless.
Moves = Iterator[Position | tuple[()]]
# The only way to go on, none, or several.
Way = Position | Moves | None


class Node:
    """A choice: a position, and the positions to go on from, lazily.

    ``mark``, ``logged`` and ``entered`` are the lengths of the trail, the log and the list of visited positions
    at the choice; ``tested`` is the version of the nogoods that it survived.  ``unproven`` tells that something
    below it was given up without a proof, ``postponed`` that something was left for a later round.
    """

    __slots__ = (
        'entered',
        'logged',
        'mark',
        'moves',
        'network',
        'position',
        'postponed',
        'tested',
        'unproven',
        'where',
    )

    def __init__(
        self, position: Position, mark: int, logged: int, entered: int, tested: int
    ) -> None:
        self.position = position
        self.network = position[0]
        self.where = position[1]
        self.mark = mark
        self.logged = logged
        self.entered = entered
        self.tested = tested
        self.unproven = False
        self.postponed = False
        self.moves: Moves = iter(())


@dataclass(frozen=True, slots=True)
class Limits:
    """How far a search may go, and what it is after.

    ``max_depth`` counts the decompositions and actions of one plan.  ``plans`` is how many plans are wanted: the
    first ones, or the cheapest ones with ``optimise``.  ``purpose`` says which order of tasks advice is asked for.
    ``most_requests`` and ``most_backtracks`` are how much a search may take before it gives up.  A search that is
    ``examined`` looks at a relaxation of the whole before it begins.
    """

    max_depth: int = 1_000_000
    optimise: bool = False
    use_advice: bool = True
    plans: int = 1
    purpose: Purpose = Purpose.SHORTEST_TOUR
    most_requests: int | None = None
    most_backtracks: int | None = None
    examined: bool = True
