"""Heads of definitions: from a ground task to a frame with the variables of the head bound."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from task_planner_node.language.model import Atom, Variable
from task_planner_node.search.terms import Compiled, Frame, ListPattern, Slots, match, slots_of

Bind = Callable[[tuple[Any, ...]], Frame | None]
# Matches an argument of a task and binds what the head has there; False where it does not fit.
Take = Callable[[Any, Frame], bool]


class Head:
    """A head, compiled before anything else of its definition.

    ``known`` tells for each argument whether tasks have a value there.  ``bound`` holds the slots that have a value
    once the head fits, ``terms`` the arguments.
    """

    def __init__(self, atom: Atom, slots: Slots, known: Sequence[bool] | None = None) -> None:
        self._slots = slots
        slots.constant(atom.name)
        self.terms: list[Compiled] = [slots.compile(argument) for argument in atom.args]
        given = [True] * len(self.terms) if known is None else list(known)
        self._tested = [i + 1 for i, is_known in enumerate(given) if is_known]
        self.bound: set[int] = set(slots.constants())
        for position in self._tested:
            self.bound |= slots_of(self.terms[position - 1])
        # The variables of such a head have the slots 1, 2 ... in the order of the arguments.
        distinct = len({arg.name for arg in atom.args if isinstance(arg, Variable)})
        self._plain = distinct == len(self.terms) == len(self._tested)

    def binder(self) -> Bind:
        """How to bind a task; to be asked for when the rest of the definition is compiled."""
        size = len(self.terms) + 1
        template = self._slots.template
        if self._plain:
            tail = template[size:]

            def bind(task: tuple[Any, ...]) -> Frame | None:
                return [*task, *tail] if len(task) == size else None

            return bind
        seen = set(self._slots.constants())
        tested: list[tuple[int, Take]] = []
        for position in self._tested:
            term = self.terms[position - 1]
            tested.append((position, _taking(term, seen)))
            seen |= slots_of(term)

        def bind_and_test(task: tuple[Any, ...]) -> Frame | None:
            if len(task) != size:
                return None
            frame = template.copy()
            for position, take in tested:
                if not take(task[position], frame):
                    return None
            return frame

        return bind_and_test


def _taking(term: Compiled, seen: set[int]) -> Take:
    """How to match an argument; the slots ``seen`` have a value before."""
    if isinstance(term, int):
        return _equal(term) if term in seen else _variable(term)
    if isinstance(term, ListPattern):
        slots = [*term.items] if term.tail is None else [*term.items, term.tail]
        if len(slots_of(term) - seen) == len(slots) and all(isinstance(s, int) for s in slots):
            return _variables(term)
    return lambda value, frame: match(term, value, frame, [])


def _equal(slot: int) -> Take:
    return lambda value, frame: bool(frame[slot] == value)


def _variable(slot: int) -> Take:
    def take(value: Any, frame: Frame) -> bool:
        frame[slot] = value
        return True

    return take


def _variables(term: ListPattern) -> Take:
    """A list of variables that have no value before, each another."""
    slots: list[Any] = [*term.items]
    count, tail = len(slots), term.tail

    def take(value: Any, frame: Frame) -> bool:
        if not isinstance(value, tuple):
            return match(term, value, frame, [])
        if len(value) < count or (tail is None and len(value) > count):
            return False
        for slot, part in zip(slots, value, strict=False):
            frame[slot] = part
        if isinstance(tail, int):
            frame[tail] = value[count:]
        return True

    return take
