"""Walking through the model: the tasks, literals and variables in it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from task_planner_node.language.model import (
    And,
    Application,
    Assign,
    AssignEach,
    Atom,
    Collect,
    Condition,
    Effect,
    Enforce,
    Exists,
    First,
    Forall,
    ForEach,
    Holds,
    Immediate,
    Imply,
    Not,
    Or,
    Pattern,
    Protection,
    SortBy,
    Spread,
    Stated,
    TaskNetwork,
    Variable,
)


def tasks_of(network: TaskNetwork) -> Iterator[Atom]:
    """All tasks of a network in the order of the text."""
    if isinstance(network, Atom):
        yield network
    elif isinstance(network, Immediate):
        yield network.task
    else:
        for item in network.items:
            yield from tasks_of(item)


def effects_of(effects: Iterable[Effect]) -> Iterator[Effect]:
    """All effects that are not made of others, also those under a condition, in the order of the text."""
    for effect in effects:
        if isinstance(effect, ForEach):
            yield from effects_of(effect.effects)
        else:
            yield effect


def parts_of(condition: Condition) -> tuple[Condition, ...]:
    """The conditions that a condition is made of."""
    if isinstance(condition, (And, Or)):
        return condition.conditions
    if isinstance(condition, Imply):
        return condition.premise, condition.conclusion
    if isinstance(condition, (Forall, Exists)):
        return condition.domain, condition.condition
    if isinstance(condition, (Not, Collect, Enforce, First, SortBy)):
        return (condition.condition,)
    return ()


def atoms_of(condition: Condition, positive: bool = True) -> Iterator[tuple[Atom, bool]]:
    """All literals of a condition, each with whether it has to hold for the condition to."""
    if isinstance(condition, Atom):
        yield condition, positive
    elif isinstance(condition, Not):
        yield from atoms_of(condition.condition, not positive)
    elif isinstance(condition, (Imply, Forall)):
        before, after = parts_of(condition)
        yield from atoms_of(before, not positive)
        yield from atoms_of(after, positive)
    else:
        for part in parts_of(condition):
            yield from atoms_of(part, positive)


def facts_of(effects: tuple[Effect, ...]) -> Iterator[Atom]:
    """The literals that effects make true or false, also under a quantifier; protections are none."""
    for effect in effects:
        if isinstance(effect, Atom):
            yield effect
        elif isinstance(effect, ForEach):
            yield from facts_of(effect.effects)


def conditions_in(effects: tuple[Effect, ...]) -> Iterator[Condition]:
    """The conditions of quantified and conditional effects."""
    for effect in effects:
        if isinstance(effect, ForEach):
            yield effect.condition
            yield from conditions_in(effect.effects)


def variables_of(term: object) -> Iterator[str]:
    """The names of the variables of a term or an atom, in order, repeated ones repeated."""
    if isinstance(term, Variable):
        yield term.name
    elif isinstance(term, Atom):
        for argument in term.args:
            yield from variables_of(argument)
    elif isinstance(term, Application):
        for argument in term.arguments:
            yield from variables_of(argument)
    elif isinstance(term, Pattern):
        for item in term.items:
            yield from variables_of(item)
        yield from variables_of(term.tail)


def is_ground(term: object) -> bool:
    """Whether a term has neither variables nor applications in it."""
    return not isinstance(term, (Variable, Pattern, Application))


def variables_in_condition(condition: Condition) -> Iterator[str]:
    """The names of all variables of a condition, repeated ones repeated."""
    if isinstance(condition, Atom):
        yield from variables_of(condition)
    elif isinstance(condition, (Assign, AssignEach)):
        yield condition.variable.name
        yield from variables_of(condition.expression)
    elif isinstance(condition, Holds):
        yield from variables_of(condition.expression)
    elif isinstance(condition, Stated):
        yield condition.variable.name
    elif isinstance(condition, Collect):
        yield from variables_of(condition.term)
        yield condition.variable.name
    elif isinstance(condition, SortBy):
        yield from variables_of(condition.key)
    elif isinstance(condition, Enforce):
        for word in condition.message:
            yield from variables_of(word)
    elif isinstance(condition, (Forall, Exists)):
        yield from (variable.name for variable in condition.variables)
    for part in parts_of(condition):
        yield from variables_in_condition(part)


def variables_in_effects(effects: tuple[Effect, ...]) -> Iterator[str]:
    """The names of all variables of effects, repeated ones repeated."""
    for effect in effects:
        if isinstance(effect, (Spread, Protection)):
            inner = effect.variable if isinstance(effect, Spread) else effect.literal
            yield from variables_of(inner)
        elif isinstance(effect, ForEach):
            yield from (variable.name for variable in effect.variables)
            yield from variables_in_condition(effect.condition)
            yield from variables_in_effects(effect.effects)
        else:
            yield from variables_of(effect)


def is_open(effects: tuple[Effect, ...]) -> bool:
    """Whether some of the facts are known in the search only: a variable stands for them."""
    return any(
        isinstance(effect, (Variable, Spread))
        or (isinstance(effect, ForEach) and is_open(effect.effects))
        for effect in effects
    )
