"""HDDL's goal descriptions and effects: from nodes to the model."""

from __future__ import annotations

from dataclasses import dataclass, field

from task_planner_node.language.model import (
    NOTHING,
    And,
    Application,
    Atom,
    Condition,
    Effect,
    Exists,
    Forall,
    ForEach,
    Holds,
    Imply,
    Not,
    Or,
    Term,
    Variable,
)
from task_planner_node.language.pddl.types import Typed, Types, read_typed
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, children_of, is_nil
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import NUMBER, read_atom, read_term

COMPARISONS = frozenset({'<', '<=', '>', '>='})
ASSIGNMENTS = frozenset({'assign', 'increase', 'decrease', 'scale-up', 'scale-down'})


@dataclass
class Vocabulary:
    """What the formulas of a domain may speak of; without declarations everything goes.

    ``predicates`` holds the types of the arguments, ``constants`` the type of each declared object.
    """

    types: Types = field(default_factory=Types)
    predicates: dict[str, list[Typed]] | None = None
    constants: dict[str, Typed] | None = None

    def check(self, reading: Reading, atom: Atom) -> None:
        """Raise Refused for an undeclared predicate or object, or another number of arguments."""
        if self.predicates is not None:
            if atom.name not in self.predicates:
                hint = did_you_mean(atom.name, self.predicates)
                raise reading.refuse(atom.node, f'the predicate {atom.name} is not declared{hint}')
            count = len(self.predicates[atom.name])
            if count != len(atom.args):
                message = f'{atom.name} has {count} arguments, not {len(atom.args)}'
                raise reading.refuse(atom.node, message)
        self.check_objects(reading, atom)

    def check_objects(self, reading: Reading, atom: Atom) -> None:
        """Raise Refused for an undeclared object among the arguments."""
        for argument, node in zip(atom.args, atom.node.children[1:], strict=False):
            if not isinstance(argument, (str, Variable)):
                raise reading.refuse(node, 'an argument is a name or a variable')
            known = self.constants is None or isinstance(argument, Variable)
            if not known and argument not in (self.constants or {}):
                hint = did_you_mean(str(argument), self.constants or {})
                raise reading.refuse(node, f'the object {argument} is not declared{hint}')


def read_formula(reading: Reading, node: Node, vocabulary: Vocabulary) -> Condition:
    """Read a goal description: literals, and, or, not, imply, forall, exists, equality."""
    if is_nil(node):
        return NOTHING
    if isinstance(node, Symbol):
        raise reading.refuse(node, f'expected a formula, a list, and not the symbol {node.text}')
    word = first_word(node)

    def parts() -> tuple[Condition, ...]:
        return tuple(read_formula(reading, child, vocabulary) for child in node.children[1:])

    if not word:
        return And(tuple(read_formula(reading, child, vocabulary) for child in node.children))
    if word == 'and':
        return And(parts())
    if word == 'or':
        return Or(parts())
    if word == 'not':
        _check(reading, node, 1)
        return Not(parts()[0], node)
    if word == 'imply':
        _check(reading, node, 2)
        premise, conclusion = parts()
        return Imply(premise, conclusion, node)
    if word in ('forall', 'exists'):
        return _read_quantified(reading, node, vocabulary)
    if word == '=':
        return _read_equality(reading, node)
    if word in COMPARISONS:
        raise reading.refuse(node, f'({word} ...): numeric fluents are not supported')
    atom = read_atom(reading, node, 'a literal')
    vocabulary.check(reading, atom)
    return atom


def _check(reading: Reading, node: ListNode, count: int) -> None:
    if len(node.children) != count + 1:
        found = len(node.children) - 1
        raise reading.refuse(node, f'({first_word(node)} ...) takes {count} parts, not {found}')


def _read_quantified(reading: Reading, node: ListNode, vocabulary: Vocabulary) -> Condition:
    """``(forall (?x - type ...) formula)``; the domain is that the variables have their types."""
    _check(reading, node, 2)
    typed = read_variables(reading, node.children[1], vocabulary.types)
    domain = And(tuple(vocabulary.types.condition(each) for each in typed))
    body = read_formula(reading, node.children[2], vocabulary)
    variables = tuple(each.variable for each in typed)
    if first_word(node) == 'forall':
        return Forall(variables, domain, body, node)
    return Exists(variables, domain, body, node)


def read_variables(reading: Reading, node: Node, types: Types) -> list[Typed]:
    """Read typed variables: those of a quantifier, or the parameters of a definition."""
    if isinstance(node, Symbol) and not is_nil(node):
        raise reading.refuse(node, f'expected variables, a list, and not the symbol {node.text}')
    typed = read_typed(reading, children_of(node), variables=True)
    types.check(reading, typed)
    for i, each in enumerate(typed):
        if any(each.name == other.name for other in typed[:i]):
            raise reading.refuse(each.node, f'{each.name} is declared twice')
    return typed


def _read_equality(reading: Reading, node: ListNode) -> Condition:
    _check(reading, node, 2)
    if any(isinstance(child, ListNode) for child in node.children[1:]):
        raise reading.refuse(node, '(= ...): numeric fluents are not supported')
    terms = tuple(read_term(reading, child) for child in node.children[1:])
    return Holds(Application('equal', terms, node), node)


@dataclass
class Effects:
    """What an action does: deletions, additions, and the cost if ``increase`` states one."""

    deletes: list[Effect] = field(default_factory=list)
    adds: list[Effect] = field(default_factory=list)
    cost: Term | None = None
    lookups: list[Atom] = field(default_factory=list)


def read_effects(reading: Reading, node: Node, vocabulary: Vocabulary) -> Effects:
    """Read an effect: literals, and, not, forall, when, and the increase of the total cost.

    A cost that depends on the arguments becomes a fact to look up: ``lookups`` go to the preconditions.
    """
    effects = Effects()
    _add_effect(reading, node, vocabulary, effects)
    return effects


def _add_effect(reading: Reading, node: Node, vocabulary: Vocabulary, effects: Effects) -> None:
    if is_nil(node):
        return
    word = first_word(node)
    if not isinstance(node, ListNode):
        raise reading.refuse(node, f'expected an effect, and not the symbol {node.text}')
    if word == 'and' or not word:
        for child in node.children[1 if word else 0 :]:
            _add_effect(reading, child, vocabulary, effects)
    elif word == 'not':
        _check(reading, node, 1)
        effects.deletes.append(_literal(reading, node.children[1], vocabulary))
    elif word in ('forall', 'when'):
        _check(reading, node, 2)
        _add_conditional(reading, node, vocabulary, effects)
    elif word in ASSIGNMENTS:
        _add_cost(reading, node, effects)
    else:
        effects.adds.append(_literal(reading, node, vocabulary))


def _literal(reading: Reading, node: Node, vocabulary: Vocabulary) -> Atom:
    atom = read_atom(reading, node, 'a literal')
    vocabulary.check(reading, atom)
    return atom


def _add_conditional(
    reading: Reading, node: ListNode, vocabulary: Vocabulary, effects: Effects
) -> None:
    typed: list[Typed] = []
    condition: Condition = NOTHING
    body = node.children[2]
    if first_word(node) == 'forall':
        typed = read_variables(reading, node.children[1], vocabulary.types)
        condition = And(tuple(vocabulary.types.condition(each) for each in typed))
    else:
        condition = read_formula(reading, node.children[1], vocabulary)
    inner = Effects()
    _add_effect(reading, body, vocabulary, inner)
    if inner.cost is not None:
        raise reading.refuse(node, 'a cost that depends on the state is not supported')
    variables = tuple(each.variable for each in typed)
    for source, target in ((inner.deletes, effects.deletes), (inner.adds, effects.adds)):
        if source:
            target.append(ForEach(variables, condition, tuple(source), node))


def _add_cost(reading: Reading, node: ListNode, effects: Effects) -> None:
    _check(reading, node, 2)
    target, amount = node.children[1:]
    if (
        first_word(node) != 'increase'
        or first_word(target) != 'total-cost'
        or effects.cost is not None
    ):
        raise reading.refuse(node, 'numeric fluents other than the total cost are not supported')
    if isinstance(amount, Symbol) and NUMBER.fullmatch(amount.text):
        effects.cost = read_term(reading, amount)
    elif isinstance(amount, ListNode) and first_word(amount) not in ('+', '-', '*', '/'):
        atom = read_atom(reading, amount, 'a function')
        cost = Variable('?cost#')
        effects.lookups.append(Atom(atom.name, (*atom.args, cost), amount))
        effects.cost = cost
    else:
        raise reading.refuse(node, 'the cost has to be a number or a function of the arguments')
