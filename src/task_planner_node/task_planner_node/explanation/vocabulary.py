"""What a mission's facts, effects and axioms speak of, and the words that may be misspelt in a dead end."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from task_planner_node.language.model import Domain, Problem
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.walk import facts_of, is_open
from task_planner_node.search.dead_ends import DeadEnd
from task_planner_node.search.network import Task

# A literal without lists as it is shown: its name and its arguments.
LITERAL = re.compile(r'\(([^\s()]+)((?: [^\s()]+)*)\)')
NAME = re.compile(r'\(([^\s()]+)')
# What begins a condition that is no literal.
WORDS = frozenset(
    {'not', 'and', 'or', 'imply', 'forall', 'exists', 'assign', 'assign*', 'eval', 'call'}
    | {'setof', 'bagof', ':sort-by'}
)


def labels_of(task: Task) -> list[str]:
    """The arguments of a task, those in lists too."""

    def flat(term: object) -> Iterator[str]:
        if isinstance(term, str):
            yield term
        elif isinstance(term, tuple):
            for part in term:
                yield from flat(part)

    return list(flat(task[1:]))


class Vocabulary:
    """The predicates and objects of a mission."""

    def __init__(self, domain: Domain, problem: Problem) -> None:
        self._problem = problem
        self._made = {fact.name for op in domain.operators for fact in facts_of(op.adds)}
        self._made |= {axiom.head.name for axiom in domain.axioms}
        self._stated = {fact.name for fact in problem.facts}
        self._anything = any(is_open(operator.adds) for operator in domain.operators)
        facts = [(fact.name, *fact.args) for fact in problem.facts]
        self._labels = {label for fact in facts for label in labels_of(fact)}

    def with_suspects(self, dead_end: DeadEnd) -> DeadEnd:
        """Add which predicate nothing ever makes true, or which object no fact speaks of."""
        if self._anything:
            return dead_end
        return self._unknown_predicate(dead_end) or self._unknown_object(dead_end) or dead_end

    def _unknown_predicate(self, dead_end: DeadEnd) -> DeadEnd | None:
        known = self._made | self._stated
        for literal in dead_end.unmet:
            found = NAME.match(literal)
            name = found.group(1) if found else ''
            if name and name not in WORDS and name not in known:
                reason = f'no fact or effect ever makes {literal} true{did_you_mean(name, known)}'
                if len(dead_end.unmet) > 1:
                    reason = f'{dead_end.reason}; {reason}'
                return replace(dead_end, reason=reason)
        return None

    def _unknown_object(self, dead_end: DeadEnd) -> DeadEnd | None:
        for name, text in LITERAL.findall(' '.join(dead_end.unmet)):
            words = [] if name in self._made else text.split()
            for place, word in enumerate(words):
                if word not in self._labels and word != 'nil' and not word.startswith('?'):
                    alike = (
                        f.args[place]
                        for f in self._problem.facts
                        if (f.name, len(f.args)) == (name, len(words))
                    )
                    hint = did_you_mean(word, (label for label in alike if isinstance(label, str)))
                    reason = f'{dead_end.reason}; unknown object {word}: no fact speaks of it{hint}'
                    return replace(dead_end, reason=reason, objects=(word,))
        return None
