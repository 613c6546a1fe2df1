"""Quantifiers, assignments, sorting and the other conditions that are neither literals nor connectives."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cmp_to_key
from typing import Any

from task_planner_node.errors import MissionError
from task_planner_node.language.functions import FunctionFailed, comparison_of
from task_planner_node.language.model import shorten, show
from task_planner_node.language.reader import Node
from task_planner_node.language.source import Source
from task_planner_node.search.conditions import Begin, Conjunction, Found, restoring
from task_planner_node.search.state import Fact, State, TooMuchWork
from task_planner_node.search.terms import Compiled, Computed, Frame, build

Compute = Callable[[Frame], Any]


def value(term: Compiled) -> Compute:
    """How to get the value of a compiled term."""
    if isinstance(term, Computed):
        return term.value
    return lambda frame: build(term, frame)


def true(compute: Compute) -> Begin:
    """Whether the value is not nil."""
    return lambda _, frame: compute(frame) != ()


def stated(
    slot: int, name: str, holds: Callable[[State, Fact], bool], source: Source, node: Node
) -> Begin:
    """Whether the value of a variable holds, as a literal."""

    def begin(state: State, frame: Frame) -> bool:
        fact = frame[slot]
        if isinstance(fact, tuple) and fact and isinstance(fact[0], str):
            return holds(state, fact)
        shown = 'nothing' if fact is None else shorten(show(fact))
        message = f'{name} has to be a literal, (name argument ...), and not {shown}'
        raise MissionError([source.diagnostic(node.start, node.end, message)])

    return begin


def implication(premise: Conjunction, conclusion: Conjunction, slots: Sequence[int]) -> Begin:
    """The conclusion where the premise can be satisfied; ``slots`` are all that the conclusion may bind."""
    bound = restoring(slots, conclusion.begin) if conclusion.binds else conclusion.begin

    def begin(state: State, frame: Frame) -> Found:
        if not premise.holds(state, frame):
            return True
        return relaxed(state, frame) if state.relaxed else bound(state, frame)

    def relaxed(state: State, frame: Frame) -> Found:
        return either(bound(state, frame)) if conclusion.binds else True

    def either(found: Found) -> Iterator[None]:
        yield
        if found is not True and found is not False:
            yield from found

    return begin


def universal(domain: Conjunction, condition: Conjunction) -> Begin:
    """Whether every solution of the domain satisfies the condition; counts as satisfied in a relaxed state."""

    def begin(state: State, frame: Frame) -> bool:
        if state.relaxed:
            return True
        trial = frame.copy()
        for _ in domain.solutions(state, trial):
            state.worked(1)
            if not condition.holds(state, trial):
                return False
        return True

    return begin


def existential(condition: Conjunction) -> Begin:
    """Whether there is a solution."""
    return condition.holds


def comparison(slot: int, compute: Compute) -> Begin:
    """Whether a variable has a computed value."""
    return lambda _, frame: bool(frame[slot] == compute(frame))


def assignment(slot: int, compute: Compute, maybe: bool) -> Begin:
    """Bind a variable, or compare with ``maybe`` when it may have a value already."""

    def assign(_: State, frame: Frame) -> bool:
        frame[slot] = compute(frame)
        return True

    def assign_or_compare(_: State, frame: Frame) -> Found:
        if frame[slot] is not None:
            return bool(frame[slot] == compute(frame))
        return assigned(frame, compute(frame))

    def assigned(frame: Frame, result: Any) -> Iterator[None]:
        frame[slot] = result
        yield
        frame[slot] = None

    return assign_or_compare if maybe else assign


def assignments(slot: int, compute: Compute, source: Source, node: Node) -> Begin:
    """Bind a variable to each element of a list; an element that it has already is found once."""

    def begin(state: State, frame: Frame) -> Found:
        items = compute(frame)
        if not isinstance(items, tuple):
            message = f'assign* needs a list, not {shorten(show(items))}'
            raise MissionError([source.diagnostic(node.start, node.end, message)])
        before = frame[slot]
        if before is not None:
            return before in items
        return each(state, frame, items)

    def each(state: State, frame: Frame, items: tuple[Any, ...]) -> Iterator[None]:
        for item in items:
            state.worked(1)
            frame[slot] = item
            yield
        frame[slot] = None

    return begin


def collection(
    condition: Conjunction, term: Compute, slot: int, distinct: bool, maybe: bool
) -> Begin:
    """Bind a variable to the list of a term's values for all solutions; fails without a solution.

    With ``maybe`` the variable may have a value already, which is then compared.
    """

    def begin(state: State, frame: Frame) -> Found:
        if state.relaxed:
            raise TooMuchWork
        trial = frame.copy()
        values = []
        for _ in condition.solutions(state, trial):
            state.worked(1)
            values.append(term(trial))
        if not values:
            return False
        found = tuple(dict.fromkeys(values)) if distinct else tuple(values)
        if not maybe:
            frame[slot] = found
            return True
        if frame[slot] is not None:
            return bool(frame[slot] == found)
        return bind(frame, found)

    def bind(frame: Frame, found: tuple[Any, ...]) -> Iterator[None]:
        frame[slot] = found
        yield
        frame[slot] = None

    return begin


def enforced(
    condition: Conjunction, message: Sequence[Compute], source: Source, node: Node
) -> Begin:
    """The solutions of the condition; without one the mission is in error."""

    def begin(state: State, frame: Frame) -> Found:
        found = condition.begin(state, frame)
        if found is False:
            return nothing(state, frame)
        return found if found is True else counted(state, frame, found)

    def counted(state: State, frame: Frame, found: Iterator[None]) -> Iterator[None]:
        count = 0
        for _ in found:
            count += 1
            yield
        if not count:
            nothing(state, frame)

    def nothing(state: State, frame: Frame) -> bool:
        if state.relaxed:
            return False
        text = ' '.join(show(part(frame)) for part in message)
        raise MissionError([source.diagnostic(node.start, node.end, text or 'not satisfied')])

    return begin


def first(condition: Conjunction, loose: Sequence[int]) -> Begin:
    """The first solution only; all of them in a relaxed state.

    ``loose`` slots may have a value before and surely have one after.
    """

    def begin(state: State, frame: Frame) -> Found:
        found = condition.begin(state, frame)
        if found is True or found is False or state.relaxed:
            return found
        return next(found, found) is None

    return restoring(loose, begin) if loose else begin


def sorted_by(
    condition: Conjunction,
    key: Compute,
    comparison: str,
    slots: Sequence[int],
    source: Source,
    node: Node,
) -> Begin:
    """All solutions in the order of their keys; ``slots`` are all that they may bind."""
    places = tuple(slots)
    compare = cmp_to_key(comparison_of(comparison))

    def begin(state: State, frame: Frame) -> Found:
        if state.relaxed:
            return condition.begin(state, frame)
        before = [frame[slot] for slot in places]
        rows: list[tuple[Any, list[Any]]] = []
        for _ in condition.solutions(state, frame):
            state.worked(1)
            rows.append((key(frame), [frame[slot] for slot in places]))
        put(frame, before)
        return each(frame, ordered(rows), before) if rows else False

    def ordered(rows: list[tuple[Any, list[Any]]]) -> list[tuple[Any, list[Any]]]:
        try:
            return sorted(rows, key=lambda row: compare(row[0]))
        except FunctionFailed as failure:
            message = f'the keys of :sort-by cannot be compared: ({comparison} ...) {failure}'
            raise MissionError([source.diagnostic(node.start, node.end, message)]) from failure

    def each(frame: Frame, rows: list[tuple[Any, list[Any]]], before: list[Any]) -> Iterator[None]:
        for _, values in rows:
            put(frame, values)
            yield
        put(frame, before)

    def put(frame: Frame, values: list[Any]) -> None:
        for slot, item in zip(places, values, strict=True):
            frame[slot] = item

    return begin
