"""Literals without an index: one fact of the predicate is compared after the other, as in the paper.

The facts that fit are found in the same order as through an index, so the plans are the same; what it costs
grows with the number of facts.  ``work`` of the state counts the facts that were compared.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import compress, repeat
from operator import eq

from task_planner_node.search.conditions import Begin
from task_planner_node.search.literals import Look, assigned, matched
from task_planner_node.search.state import Fact, Index, IndexPlan, State
from task_planner_node.search.terms import Frame

Scan = Callable[[State, Frame], Iterator[Fact]]


def scanning(look: Look, plan: IndexPlan) -> Scan:
    """The facts with what is bound in a literal, compared one by one and no further than is asked for."""
    index = look.index()
    number = plan.number(Index(index.name, index.arity, ()))
    key_of, wanted_of = index.key(), look.key()

    def scan(state: State, frame: Frame) -> Iterator[Fact]:
        facts = state.buckets[number].get(())
        if facts is None:
            return
        wanted = wanted_of(frame)
        compared = 0
        equal = map(eq, map(key_of, facts), repeat(wanted))
        for place, fact in compress(enumerate(facts, start=1), equal):
            state.worked(place - compared)
            compared = place
            if state.facts.get(fact) is fact:
                yield fact
        state.worked(len(facts) - compared)

    return scan


def presence(look: Look, plan: IndexPlan) -> Begin:
    """Whether a fact fits; ``look`` leaves nothing free, or other, unbound variables only."""
    scan = scanning(look, plan)

    def begin(state: State, frame: Frame) -> bool:
        for _ in scan(state, frame):
            return True
        return False

    return begin


def absence(look: Look, plan: IndexPlan) -> Begin | None:
    """Whether no fact fits, when its free parts are other, unbound variables; else None."""
    if look.assign() is None:
        return None
    present = presence(look, plan)
    return lambda state, frame: state.relaxed or not present(state, frame)


def enumerating(look: Look, plan: IndexPlan) -> Begin:
    """The facts that fit, one after the other."""
    scan, assign, free = scanning(look, plan), look.assign(), look.free()
    if assign is None:
        return lambda state, frame: matched(free, state, frame, scan(state, frame))
    return lambda state, frame: assigned(assign, frame, scan(state, frame))
