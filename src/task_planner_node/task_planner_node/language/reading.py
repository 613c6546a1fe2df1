"""What the readers of one text share: the text, the spelling of names, and the remarks so far."""

from __future__ import annotations

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.language.model import Variable
from task_planner_node.language.reader import ListNode, Node, Symbol
from task_planner_node.language.source import Source
from task_planner_node.language.spelling import Spelling

#: Errors beyond these are not looked for: nobody reads them.
MOST_ERRORS = 100


class Refused(Exception):
    """A form that is not in the language; the diagnostic says where and why."""

    def __init__(self, diagnostic: Diagnostic) -> None:
        super().__init__(diagnostic.message)
        self.diagnostic = diagnostic


class Reading:
    """The reading of one text; ``errors`` and ``warnings`` are what has been found so far, ``names`` the
    spelling of the names.

    HDDL has no ``anonymous`` variables.
    """

    def __init__(
        self, source: Source, spelling: Spelling | None = None, *, anonymous: bool = True
    ) -> None:
        self.source = source
        self.spelling = spelling or Spelling()
        self.errors: list[Diagnostic] = []
        self.warnings: list[Diagnostic] = []
        self.names: dict[str, str] = {}
        self._anonymous = 0 if anonymous else None

    @property
    def hopeless(self) -> bool:
        """Whether so much is wrong that reading on helps nobody."""
        return len(self.errors) >= MOST_ERRORS

    def refuse(self, node: Node, message: str) -> Refused:
        """The error for ``node``, to be raised."""
        return Refused(self.source.diagnostic(node.start, node.end, message, Severity.ERROR))

    def warn(self, node: Node, message: str) -> None:
        """Note a warning about ``node``."""
        where = self.source.diagnostic(node.start, node.end, message, Severity.WARNING)
        self.warnings.append(where)

    def variable(self, name: str) -> Variable:
        """The variable of that name; each anonymous one is another."""
        if name.startswith('?_') and self._anonymous is not None:
            self._anonymous += 1
            return Variable(f'{name}#{self._anonymous}')
        return Variable(self.spelling.of(name))


def is_nil(node: Node) -> bool:
    """Whether the node is ``nil`` or ``()``."""
    if isinstance(node, Symbol):
        return node.text.lower() == 'nil'
    return not node.children


def is_variable(node: Node) -> bool:
    """Whether the node is a symbol that begins with a question mark."""
    return isinstance(node, Symbol) and node.text.startswith('?')


def children_of(node: Node) -> list[Node]:
    """The children of a list, none for a symbol."""
    return node.children if isinstance(node, ListNode) else []


def elements(reading: Reading, node: Node, what: str) -> list[Node]:
    """The children of a list that is expected as ``what``; none for nil."""
    if is_nil(node):
        return []
    if isinstance(node, Symbol):
        raise reading.refuse(node, f'expected {what}, a list, and not the symbol {node.text}')
    return node.children
