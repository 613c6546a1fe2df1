"""Conditions at work: bindings enumerated lazily, by depth-first search from left to right."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame

# True: holds in exactly one way, whose bindings are in the frame.  False: does not hold.  Else the solutions,
# not begun; each binds the frame.  A goal leaves values behind only in variables that were surely unbound before it:
# who asks whether a variable is bound puts those back.
Found = bool | Iterator[None]
Begin = Callable[[State, Frame], Found]
Describe = Callable[[Frame], str]


@dataclass(frozen=True, slots=True)
class Goal:
    """A part of a condition; ``binds`` tells whether it may change the frame."""

    begin: Begin
    describe: Describe
    binds: bool = True


class Conjunction:
    """Goals that must all hold."""

    __slots__ = ('_steps', 'binds', 'goals')

    def __init__(self, goals: Sequence[Goal]) -> None:
        self.goals = tuple(goals)
        self.binds = any(goal.binds for goal in goals)
        self._steps = tuple(goal.begin for goal in goals)

    def begin(self, state: State, frame: Frame) -> Found:
        """Go as far as there is only one way."""
        index = 0
        for step in self._steps:
            index += 1
            found = step(state, frame)
            if found is True:
                continue
            state.work += index
            if found is False:
                return False
            return self._enumerate(found, index, state, frame)
        return True

    def solutions(self, state: State, frame: Frame) -> Iterator[None]:
        """Bind the frame to one solution after the other."""
        found = self.begin(state, frame)
        if found is True:
            yield
        elif found is not False:
            yield from found

    def holds(self, state: State, frame: Frame) -> bool:
        """Whether there is a solution; the frame is left as it was."""
        found = self.begin(state, frame.copy() if self.binds else frame)
        if found is True or found is False:
            return found
        return any(True for _ in found)

    def _enumerate(
        self, first: Iterator[None], index: int, state: State, frame: Frame
    ) -> Iterator[None]:
        """All solutions of ``first`` and of the goals from ``index`` on; counts what it tries as work."""
        steps = self._steps
        count = len(steps)
        choices: list[tuple[int, Iterator[None]]] = [(index, first)]
        while choices:
            index, iterator = choices[-1]
            if next(iterator, iterator) is iterator:
                choices.pop()
                continue
            begun = index
            while index < count:
                found = steps[index](state, frame)
                index += 1
                if found is True:
                    continue
                if found is not False:
                    choices.append((index, found))
                break
            else:
                yield
            state.work += index - begun + 1
            if state.work > state.next_look:
                state.look()

    def first_failure(self, state: State, frame: Frame) -> str:
        """The first goal that cannot be met, with the bindings of the first solution before it."""
        for index, goal in enumerate(self.goals):
            if not Conjunction(self.goals[: index + 1]).holds(state, frame):
                trial = frame.copy()
                for _ in Conjunction(self.goals[:index]).solutions(state, trial):
                    return goal.describe(trial)
        return ''


def restoring(slots: Sequence[int], solutions: Begin) -> Begin:
    """The same solutions, after which the ``slots`` are as they were before."""
    places = tuple(slots)

    def begin(state: State, frame: Frame) -> Found:
        before = [frame[slot] for slot in places]
        found = solutions(state, frame)
        if found is False:
            put(before, frame)
            return False
        return again(found, before, frame)

    def again(found: Found, before: list[Any], frame: Frame) -> Iterator[None]:
        if found is True:
            yield
        elif found is not False:
            yield from found
        put(before, frame)

    def put(before: list[Any], frame: Frame) -> None:
        for slot, value in zip(places, before, strict=True):
            frame[slot] = value

    return begin


def disjunction(alternatives: Sequence[Conjunction], slots: Sequence[int]) -> Begin:
    """The solutions of one alternative after the other; ``slots`` are all that they may bind."""
    parts = [restoring(slots, part.begin) for part in alternatives]
    if not any(part.binds for part in alternatives):
        return lambda state, frame: any(part.begin(state, frame) for part in alternatives)

    def solutions(state: State, frame: Frame) -> Iterator[None]:
        for part in parts:
            found = part(state, frame)
            if found is not False and found is not True:
                yield from found

    return solutions


def negation(condition: Conjunction) -> Begin:
    """Negation as failure; counts as satisfied in a relaxed state."""

    def begin(state: State, frame: Frame) -> bool:
        return state.relaxed or not condition.holds(state, frame)

    return begin
