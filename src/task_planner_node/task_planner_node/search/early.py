"""Preconditions of operators that no action changes, known where a method chooses: there they are tested already."""

from __future__ import annotations

from collections.abc import Iterator

from task_planner_node.language.model import (
    And,
    Atom,
    Branch,
    Condition,
    Domain,
    Method,
    Not,
    Operator,
    Protection,
    Term,
    Variable,
    show,
)
from task_planner_node.language.walk import effects_of, tasks_of, variables_of

Literal = Atom | Not
Values = dict[str, Term]


class Early:
    """Literals that a branch's tasks need whatever happens before them, by the branch's variables.

    They are literals of rigid predicates, which no effect names and no axiom defines.  What an operator needs is
    needed too by a task with one method with one branch that leads to it.
    """

    def __init__(self, domain: Domain) -> None:
        self._operators = {operator.head.name: operator for operator in domain.operators}
        self._methods: dict[str, list[Method]] = {}
        for method in domain.methods:
            self._methods.setdefault(method.head.name, []).append(method)
        self._changing = {axiom.head.name for axiom in domain.axioms}
        effects = [e for o in domain.operators for e in (*o.deletes, *o.adds)]
        self._all_rigid = True
        for effect in effects_of(effects):
            if isinstance(effect, Atom):
                self._changing.add(effect.name)
            elif not isinstance(effect, Protection):
                # A variable may stand for a fact of any predicate.
                self._all_rigid = False
        self._known: dict[str, list[Literal]] = {}

    def literals(self, branch: Branch) -> list[Literal]:
        """What the tasks of ``branch`` need beyond its own condition."""
        if not self._all_rigid:
            return []
        own = {_shown(literal) for literal in _conjuncts(branch.condition)}
        found: dict[str, Literal] = {}
        for task in tasks_of(branch.tasks):
            for literal in self._of_task(task):
                found.setdefault(_shown(literal), literal)
        return [literal for text, literal in found.items() if text not in own]

    def _of_task(self, task: Atom) -> Iterator[Literal]:
        definition = self._definition(task.name)
        if definition is None or len(definition.head.args) != len(task.args):
            return
        values: Values = {}
        for parameter, argument in zip(definition.head.args, task.args, strict=True):
            if isinstance(parameter, Variable) and _is_plain(argument):
                values.setdefault(parameter.name, argument)
        for literal in self._of_name(task.name):
            if all(name in values for name in variables_of(literal_atom(literal))):
                yield _substituted(literal, values)

    def _of_name(self, name: str) -> list[Literal]:
        """What a task of this name needs, by the variables of its head."""
        if name not in self._known:
            self._known[name] = []
            definition = self._definition(name)
            if definition is not None:
                self._known[name] = list(self._needs(definition))
        return self._known[name]

    def _needs(self, definition: Operator | Method) -> Iterator[Literal]:
        head = set(variables_of(definition.head))
        if isinstance(definition, Operator):
            candidates = list(_conjuncts(definition.condition))
        else:
            (branch,) = definition.branches
            candidates = list(_conjuncts(branch.condition))
            for task in tasks_of(branch.tasks):
                candidates += self._of_task(task)
        for literal in candidates:
            atom = literal_atom(literal)
            if (
                atom.name not in self._changing
                and all(_is_plain(argument) for argument in atom.args)
                and head.issuperset(variables_of(atom))
            ):
                yield literal

    def _definition(self, name: str) -> Operator | Method | None:
        """The one way to do a task, if there is only one."""
        if name in self._operators:
            return self._operators[name]
        methods = self._methods.get(name, [])
        return methods[0] if len(methods) == 1 and len(methods[0].branches) == 1 else None


def _conjuncts(condition: Condition) -> Iterator[Literal]:
    if isinstance(condition, And):
        for part in condition.conditions:
            yield from _conjuncts(part)
    elif isinstance(condition, Atom) or (
        isinstance(condition, Not) and isinstance(condition.condition, Atom)
    ):
        yield condition


def literal_atom(literal: Literal) -> Atom:
    """The atom of a literal."""
    if isinstance(literal, Atom):
        return literal
    if isinstance(literal.condition, Atom):
        return literal.condition
    raise TypeError(f'not a literal: {literal!r}')


def _is_plain(term: Term) -> bool:
    return isinstance(term, (str, int, float, Variable))


def _substituted(literal: Literal, values: Values) -> Literal:
    atom = literal_atom(literal)
    args = tuple(values[arg.name] if isinstance(arg, Variable) else arg for arg in atom.args)
    changed = Atom(atom.name, args, atom.node)
    return changed if isinstance(literal, Atom) else Not(changed, literal.node)


def _shown(literal: Literal) -> str:
    """A literal as text."""
    return show(literal) if isinstance(literal, Atom) else f'(not {show(literal_atom(literal))})'
