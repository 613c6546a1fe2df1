"""What the search holds on its stack: partial plans and their steps."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from task_planner_node.oracle import Answer, Token
from task_planner_node.search.network import Network


@dataclass(frozen=True, slots=True)
class Step:
    """One action of a plan; ``answer`` is None for a purely symbolic one."""

    action: tuple[str, ...]
    cost: float
    preconditions: str
    start: Token
    answer: Answer | None


@dataclass(slots=True, eq=False)
class Node:
    """A partial plan: what is left to do, and where the robots stand.

    ``lineage`` is the attitude that was last assigned, ``tested`` the version of the nogoods that it survived;
    ``unproven`` tells that something below it was given up without a proof.
    """

    network: Network
    start: Token
    lineage: Token
    mark: int
    tested: int
    actions: int = 0
    length: float = 0.0
    focused: bool = False
    step: Step | None = None
    moves: Iterator[Node | None] = field(default_factory=lambda: iter(()))
    unproven: bool = False


@dataclass(frozen=True, slots=True)
class Limits:
    """How far a search may go; ``max_depth`` counts nested choices."""

    max_depth: int = 200_000
    optimise: bool = False
    use_advice: bool = True
