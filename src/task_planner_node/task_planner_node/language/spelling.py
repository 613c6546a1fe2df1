"""Names without case: symbols that differ in case only become one and the same string, the first spelling."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from task_planner_node.language.reader import Node, Symbol


class Spelling:
    """The spelling of every name of a mission: a table that its domain and its problem are read with.

    The motion planner knows labels by their exact spelling.  So what stands as an argument, above all in the
    facts of the problem, is learnt before predicates and tasks, which nobody else sees.
    """

    def __init__(self) -> None:
        self._first: dict[str, str] = {'t': 't'}

    def learn(self, nodes: Iterable[Node]) -> None:
        """Take over the spelling of all symbols in ``nodes``, those that begin a list after the others."""
        symbols = list(_symbols(nodes))
        for text, _ in sorted(symbols, key=lambda symbol: symbol[1]):
            self.of(text)

    def of(self, text: str) -> str:
        """The spelling of a name."""
        return self._first.setdefault(text.lower(), text)


def _symbols(nodes: Iterable[Node]) -> Iterator[tuple[str, bool]]:
    """All symbols, each with whether it begins a list."""
    agenda: list[tuple[Node, bool]] = [(node, False) for node in nodes][::-1]
    while agenda:
        node, first = agenda.pop()
        if isinstance(node, Symbol):
            yield node.text, first
        else:
            agenda.extend((child, i == 0) for i, child in reversed(list(enumerate(node.children))))
