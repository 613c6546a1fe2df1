"""HDDL's actions and derived predicates: from nodes to the model."""

from __future__ import annotations

from collections.abc import Iterable

from task_planner_node.language.model import NOTHING, Atom, Axiom, Condition, Operator
from task_planner_node.language.pddl.formulas import (
    Vocabulary,
    read_effects,
    read_formula,
    read_variables,
)
from task_planner_node.language.pddl.ordering import ordered
from task_planner_node.language.pddl.types import Passed, Typed
from task_planner_node.language.reader import ListNode, Node, Symbol
from task_planner_node.language.reading import Reading
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_name

ACTION_FIELDS = frozenset({':parameters', ':precondition', ':effect'})


def fields_of(
    reading: Reading, node: ListNode, allowed: Iterable[str], skipped: int = 2
) -> dict[str, Node]:
    """The fields of a definition by keyword; raises Refused for another keyword or one given twice."""
    fields: dict[str, Node] = {}
    rest = node.children[skipped:]
    for word, value in zip(rest[::2], rest[1::2], strict=False):
        name = word.text.lower() if isinstance(word, Symbol) else ''
        if name not in allowed:
            text = reading.source.excerpt(word.start, word.end)
            raise reading.refuse(word, f'unexpected {text}{did_you_mean(name, allowed)}')
        if name in fields:
            raise reading.refuse(word, f'{name} is given twice')
        fields[name] = value
    if len(rest) % 2:
        raise reading.refuse(rest[-1], 'nothing stands behind this')
    return fields


def name_of(reading: Reading, node: ListNode, what: str) -> str:
    """The name behind the first word of a definition."""
    if len(node.children) < 2 or not isinstance(node.children[1], Symbol):
        raise reading.refuse(node, f'the name of {what} is missing')
    return read_name(reading, node.children[1])


def parameters_of(reading: Reading, fields: dict[str, Node], vocabulary: Vocabulary) -> list[Typed]:
    """The typed parameters among the fields of a definition."""
    if ':parameters' not in fields:
        return []
    return read_variables(reading, fields[':parameters'], vocabulary.types)


def operator_name(reading: Reading, action: str) -> str:
    """The name of the operator for an action."""
    return reading.spelling.of(f'!{action}')


def read_action(
    reading: Reading, node: ListNode, vocabulary: Vocabulary, passed: Passed | None
) -> Operator:
    """Read ``(:action name :parameters (...) :precondition formula :effect effect)``: the operator ``!name``.

    Parameters whose type follows from what is ``passed`` are not tested.  In SHOP's domains nothing is known of
    that (None), and types are tested last, since arguments may be unbound.
    """
    name = name_of(reading, node, 'the action')
    fields = fields_of(reading, node, ACTION_FIELDS)
    parameters = parameters_of(reading, fields, vocabulary)
    formula: Condition = NOTHING
    if ':precondition' in fields:
        formula = read_formula(reading, fields[':precondition'], vocabulary)
    effects = read_effects(reading, fields.get(':effect', ListNode([], 0, 0)), vocabulary)
    callers = [] if passed is None else passed.get(operator_name(reading, name), [])
    checks = [
        vocabulary.types.condition(each)
        for place, each in enumerate(parameters)
        if not vocabulary.types.follows(each, callers[place : place + 1])
    ]
    formulas = [formula, *effects.lookups]
    formulas = [*formulas, *checks] if passed is None else [*checks, *formulas]
    bound = [each.name for each in parameters]
    condition = ordered(parameters, bound, formulas, vocabulary)
    head = Atom(operator_name(reading, name), tuple(each.variable for each in parameters), node)
    cost = 1.0 if effects.cost is None else effects.cost
    return Operator(head, condition, None, tuple(effects.deletes), tuple(effects.adds), cost)


def read_derived(reading: Reading, node: ListNode, vocabulary: Vocabulary) -> Axiom:
    """Read ``(:derived (predicate ?x - type ...) formula)``."""
    if len(node.children) != 3 or not isinstance(node.children[1], ListNode):
        raise reading.refuse(node, 'expected (:derived (predicate ?variable ...) formula)')
    head = node.children[1]
    name = name_of(reading, ListNode([head, *head.children], head.start, head.end), 'the predicate')
    variables = ListNode(head.children[1:], head.start, head.end)
    typed = read_variables(reading, variables, vocabulary.types)
    body = read_formula(reading, node.children[2], vocabulary)
    condition = ordered(typed, (), [body], vocabulary)
    return Axiom(Atom(name, tuple(each.variable for each in typed), head), (condition,), ('',))
