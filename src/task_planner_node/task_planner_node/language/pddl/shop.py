"""PDDL inside of SHOP3's ``defdomain``: types, actions, derived predicates."""

from __future__ import annotations

from task_planner_node.language.model import Atom, Axiom, Operator, Variable
from task_planner_node.language.pddl.actions import read_action, read_derived
from task_planner_node.language.pddl.formulas import Vocabulary
from task_planner_node.language.pddl.types import read_typed
from task_planner_node.language.reader import ListNode, first_word
from task_planner_node.language.reading import Reading

#: What says nothing that the search needs: the facts of a problem say of what type an object is.
SKIPPED = frozenset({':requirements', ':predicates', ':static', ':functions', ':constants'})
WORDS = SKIPPED | {':types', ':action', ':derived'}


class ShopPddl:
    """The PDDL definitions of one domain; a type is a predicate of the same name, which facts state."""

    def __init__(self, reading: Reading) -> None:
        self._reading = reading
        self._vocabulary = Vocabulary()
        self.operators: list[Operator] = []
        self.axioms: list[Axiom] = []

    def read(self, node: ListNode) -> None:
        """Read types, an action or a derived predicate; everything else is left out."""
        word = first_word(node)
        if word == ':types':
            self._declare(node)
        elif word == ':action':
            self.operators.append(read_action(self._reading, node, self._vocabulary, None))
        elif word == ':derived':
            self.axioms.append(read_derived(self._reading, node, self._vocabulary))

    def _declare(self, node: ListNode) -> None:
        """Take over ``(:types ...)``: a supertype holds of what has one of its types."""
        typed = read_typed(self._reading, node.children[1:], variables=False)
        self._vocabulary.types.add(typed)
        variable = Variable('?x')
        for each in typed:
            place = ListNode([], each.node.start, each.node.end)
            for parent in each.type:
                if parent != 'object':
                    body = Atom(each.name, (variable,), place)
                    self.axioms.append(Axiom(Atom(parent, (variable,), place), (body,), ('',)))
