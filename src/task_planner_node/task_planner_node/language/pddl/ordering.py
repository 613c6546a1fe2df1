"""The order in which the preconditions of HDDL are best tested: what is bound first, types where they are needed.

HDDL's formulas have no order; SHOP's are tested from left to right and bind variables on the way.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from task_planner_node.language.model import And, Atom, Condition, Exists, Forall
from task_planner_node.language.pddl.formulas import Vocabulary
from task_planner_node.language.pddl.types import Type, Typed
from task_planner_node.language.walk import parts_of, variables_in_condition, variables_of


def ordered(
    parameters: Sequence[Typed],
    bound: Iterable[str],
    formulas: Iterable[Condition],
    vocabulary: Vocabulary,
) -> And:
    """All of ``formulas`` for parameters of which ``bound`` have a value, and known types, before.

    Literals come first that bind least, each followed by the types of what it binds; a parameter that no literal
    binds ranges over its type; everything else comes as soon as its variables are bound.
    """
    declared = {each.name: each for each in parameters}
    literals: list[Atom] = []
    tests: list[Condition] = []
    for formula in _flat(formulas):
        if isinstance(formula, Atom):
            literals.append(formula)
        else:
            tests.append(formula)
    found: list[Condition] = []
    known = set(bound)
    while True:
        ready = [test for test in tests if free(test) <= known]
        found += ready
        tests = [test for test in tests if test not in ready]
        if literals:
            literal = min(literals, key=lambda atom: len(set(variables_of(atom)) - known))
            literals.remove(literal)
            found.append(literal)
            for name in _unchecked(literal, known, declared, vocabulary):
                found.append(vocabulary.types.condition(declared[name]))
            known |= set(variables_of(literal))
            continue
        missing = next((each for each in parameters if each.name not in known), None)
        if missing is None:
            return And((*found, *tests))
        found.append(vocabulary.types.condition(missing))
        known.add(missing.name)


def _flat(formulas: Iterable[Condition]) -> Iterable[Condition]:
    for formula in formulas:
        if isinstance(formula, And):
            yield from _flat(formula.conditions)
        else:
            yield formula


def free(condition: Condition) -> set[str]:
    """The variables of a condition that are not its quantifiers' own."""
    if isinstance(condition, (Forall, Exists)):
        inner = free(condition.domain) | free(condition.condition)
        return inner - {variable.name for variable in condition.variables}
    parts = parts_of(condition)
    if not parts:
        return set(variables_in_condition(condition))
    return set().union(*(free(part) for part in parts))


def _unchecked(
    literal: Atom, known: set[str], declared: dict[str, Typed], vocabulary: Vocabulary
) -> list[str]:
    """The variables that the literal binds and whose type does not follow from its predicate."""
    places = (vocabulary.predicates or {}).get(literal.name, [])
    kinds: dict[str, Type] = {}
    for place, argument in enumerate(literal.args):
        for name in variables_of(argument):
            if place < len(places):
                kinds.setdefault(name, places[place].type)
    new = dict.fromkeys(name for name in variables_of(literal) if name not in known)
    return [
        name
        for name in new
        if name in declared
        and not vocabulary.types.covers(declared[name].type, kinds.get(name, ('object',)))
    ]
