"""Protections (SHOP2): facts that no operator may make false, or true, as long as they are protected.

They are kept as facts of their own, so that marks and closed sets know of them: ``(PROTECTED, fact, n)`` holds
when the fact is protected at least n times.
"""

from __future__ import annotations

from collections.abc import Callable

from task_planner_node.language.model import show
from task_planner_node.search.state import Fact, State
from task_planner_node.search.terms import Frame

# No name of a predicate has a blank in it.
PROTECTED = 'protected true'
UNPROTECTED = 'protected false'
PROTECTIONS = (PROTECTED, UNPROTECTED)


def guarded(
    deletes: Callable[[State, Frame], list[Fact]], adds: Callable[[State, Frame], list[Fact]]
) -> Callable[[State, Frame], str]:
    """Apply effects with protections among them; tells which one is violated, if one is."""

    def apply(state: State, frame: Frame) -> str:
        removed, added = deletes(state, frame), adds(state, frame)
        for fact in removed:
            if fact[0] in PROTECTIONS:
                _decrease(state, fact)
            else:
                state.remove(fact)
        for fact in added:
            if fact[0] in PROTECTIONS:
                _increase(state, fact)
            else:
                state.add(fact)
        return _violated(state, removed, added)

    return apply


def _count(state: State, protection: Fact) -> int:
    count = 0
    while (*protection, count + 1) in state.facts:
        count += 1
    return count


def _increase(state: State, protection: Fact) -> None:
    state.add((*protection, _count(state, protection) + 1))


def _decrease(state: State, protection: Fact) -> None:
    count = _count(state, protection)
    if count:
        state.remove((*protection, count))


def _violated(state: State, removed: list[Fact], added: list[Fact]) -> str:
    facts = state.facts
    for fact in (*removed, *added):
        if fact[0] in PROTECTIONS:
            name, literal = fact
        else:
            name, literal = (UNPROTECTED if fact in facts else PROTECTED), fact
        if (name, literal, 1) in facts and (literal in facts) != (name == PROTECTED):
            wanted = 'true' if name == PROTECTED else 'false'
            return f'{show(literal)} is protected: it has to stay {wanted}'
    return ''
