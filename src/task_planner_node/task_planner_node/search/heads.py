"""Heads of definitions: from a ground task to a frame with the variables of the head bound."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from task_planner_node.language.model import Atom, Variable
from task_planner_node.search.terms import Compiled, Frame, Slots, match, slots_of

Bind = Callable[[tuple[Any, ...]], Frame | None]


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
        tested = [(i, self.terms[i - 1]) for i in self._tested]

        def bind_and_test(task: tuple[Any, ...]) -> Frame | None:
            if len(task) != size:
                return None
            frame = template.copy()
            for position, term in tested:
                if not match(term, task[position], frame, []):
                    return None
            return frame

        return bind_and_test
