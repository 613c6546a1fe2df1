"""The predicates whose facts decide how a task may be done in a relaxation, told from the text of a domain."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from task_planner_node.language.model import Atom, Condition, Domain, Forall, Not, Stated
from task_planner_node.language.walk import conditions_in, parts_of


class Reads:
    """What the conditions of operators and methods, and of what they make true, look at in a relaxed state.

    Axioms are followed; what always holds there, as a negation does, looks at nothing.
    """

    def __init__(self, domain: Domain) -> None:
        conditions: dict[str, list[Condition]] = {}
        for operator in domain.operators:
            own = conditions.setdefault(operator.head.name, [])
            own += (operator.condition, *conditions_in(operator.adds))
        for method in domain.methods:
            own = conditions.setdefault(method.head.name, [])
            own += (branch.condition for branch in method.branches)
        self._bodies: dict[str, list[Condition]] = {}
        for axiom in domain.axioms:
            self._bodies.setdefault(axiom.head.name, []).extend(axiom.bodies)
        self._of = {name: self._predicates(own) for name, own in conditions.items()}
        known = [names for names in self._of.values() if names is not None]
        self._all = frozenset().union(*known) if len(known) == len(self._of) else None

    def of(self, task: str) -> frozenset[str] | None:
        """Predicates that tasks of this name look at; None where the search alone knows some literal's."""
        return self._of.get(task, frozenset())

    def is_read(self, predicate: str) -> bool:
        """Whether any task may look at the facts of a predicate."""
        return self._all is None or predicate in self._all

    def _predicates(self, conditions: Iterable[Condition]) -> frozenset[str] | None:
        names: set[str] = set()
        agenda = list(conditions)
        while agenda:
            for part in _leaves(agenda.pop()):
                if isinstance(part, Stated):
                    return None
                if isinstance(part, Atom) and part.name not in names:
                    names.add(part.name)
                    agenda += self._bodies.get(part.name, ())
        return frozenset(names)


def _leaves(condition: Condition) -> Iterator[Condition]:
    """The parts of a condition that are not made of others, without those that always hold in a relaxed state."""
    if isinstance(condition, (Not, Forall)):
        return
    parts = parts_of(condition)
    if not parts:
        yield condition
    for part in parts:
        yield from _leaves(part)
