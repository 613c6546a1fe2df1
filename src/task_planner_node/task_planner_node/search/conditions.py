"""Conditions at work: bindings enumerated lazily, by depth-first search from left to right."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from task_planner_node.search.state import State
from task_planner_node.search.terms import Frame


@dataclass(frozen=True, slots=True)
class Check:
    """A goal without new bindings."""

    holds: Callable[[State, Frame], bool]
    describe: Callable[[Frame], str]


@dataclass(frozen=True, slots=True)
class Choice:
    """A goal that binds variables, one solution after the other; at its end they are unbound again."""

    solutions: Callable[[State, Frame], Iterator[None]]
    describe: Callable[[Frame], str]


Goal = Check | Choice


class Conjunction:
    """Goals that must all hold."""

    def __init__(self, goals: Sequence[Goal]) -> None:
        self.goals = tuple(goals)
        self._only_checks = all(isinstance(goal, Check) for goal in self.goals)

    def solutions(self, state: State, frame: Frame) -> Iterator[None]:
        """Bind the frame to one solution after the other; counts what it tries as work of the state."""
        goals = self.goals
        count = len(goals)
        choices: list[tuple[int, Iterator[None]]] = []
        index = 0
        while True:
            first = index
            while index < count:
                goal = goals[index]
                if isinstance(goal, Check):
                    if not goal.holds(state, frame):
                        break
                else:
                    iterator = goal.solutions(state, frame)
                    if next(iterator, iterator) is iterator:
                        break
                    choices.append((index, iterator))
                index += 1
            else:
                yield
            state.work += index - first + 1
            if state.work > state.next_look:
                state.look()
            while choices:
                index, iterator = choices[-1]
                if next(iterator, iterator) is iterator:
                    choices.pop()
                else:
                    index += 1
                    break
            else:
                return

    def holds(self, state: State, frame: Frame) -> bool:
        """Whether there is a solution; the frame is left as it was."""
        trial = frame if self._only_checks else frame.copy()
        return any(True for _ in self.solutions(state, trial))

    def first_failure(self, state: State, frame: Frame) -> str:
        """The first goal that cannot be met, with the bindings of the first solution before it."""
        for index, goal in enumerate(self.goals):
            if not Conjunction(self.goals[: index + 1]).holds(state, frame):
                trial = frame.copy()
                for _ in Conjunction(self.goals[:index]).solutions(state, trial):
                    return goal.describe(trial)
        return ''


def disjunction(alternatives: Sequence[Conjunction]) -> Callable[[State, Frame], Iterator[None]]:
    """The solutions of one alternative after the other."""

    def solutions(state: State, frame: Frame) -> Iterator[None]:
        for alternative in alternatives:
            yield from alternative.solutions(state, frame)

    return solutions


def negation(condition: Conjunction) -> Callable[[State, Frame], bool]:
    """Negation as failure; counts as satisfied in a relaxed state."""

    def holds(state: State, frame: Frame) -> bool:
        return state.relaxed or not condition.holds(state, frame)

    return holds
