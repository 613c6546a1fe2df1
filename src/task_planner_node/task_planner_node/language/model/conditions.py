"""Conditions, and what each of them means.

They are tested from left to right; a solution binds variables, and each further solution is a choice to backtrack
to.  A variable that is bound already is tested, not bound anew.
"""

from __future__ import annotations

from dataclasses import dataclass

from task_planner_node.language.model.terms import Atom, Term, Variable
from task_planner_node.language.reader import Node


@dataclass(frozen=True, slots=True, eq=False)
class Not:
    """Holds when ``condition`` cannot be satisfied (negation as failure); binds nothing."""

    condition: Condition
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class And:
    """Holds when all conditions do, tested from left to right; trivially when there are none."""

    conditions: tuple[Condition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Or:
    """Holds when one of the conditions does; each that does is a choice."""

    conditions: tuple[Condition, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Imply:
    """``(imply premise conclusion)``: the premise cannot be satisfied, or else the conclusion holds.

    The same as ``Or(Not(premise), conclusion)``, except that the conclusion is not looked at when the premise fails.
    """

    premise: Condition
    conclusion: Condition
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Forall:
    """``(forall (?v ...) domain condition)``: every solution of ``domain`` satisfies ``condition``.

    The ``variables`` are the quantifier's own: a variable outside of it may have the same name and another
    value.  Binds nothing.
    """

    variables: tuple[Variable, ...]
    domain: Condition
    condition: Condition
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Exists:
    """``(exists (?v ...) domain condition)``: some solution of ``domain`` satisfies ``condition``.

    Like Forall in its variables; holds at most once, and binds nothing.
    """

    variables: tuple[Variable, ...]
    domain: Condition
    condition: Condition
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Assign:
    """``(assign ?v expression)``: binds the variable to the value, or compares when it is bound."""

    variable: Variable
    expression: Term
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class AssignEach:
    """``(assign* ?v expression)``: the value is a list; each of its elements in turn is a choice."""

    variable: Variable
    expression: Term
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Holds:
    """``(eval expression)`` or ``(call f ...)`` as a condition: holds when the value is not nil."""

    expression: Term
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Collect:
    """``(setof term condition ?v)``, or ``bagof``: binds ``variable`` to the list of ``term`` for all solutions.

    In the order of the solutions, for a set without repetitions; fails when there is no solution.
    The variables of term and condition that are not bound before stay unbound after.
    """

    term: Term
    condition: Condition
    variable: Variable
    distinct: bool
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Stated:
    """A variable in the place of a literal: holds when its value, ``(name argument ...)``, holds as a literal does."""

    variable: Variable
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Enforce:
    """``(enforce condition message ...)``: like ``condition``, but without a solution the mission is in error.

    The search then raises MissionError with ``message`` (its values shown, with blanks between) at ``node``.
    """

    condition: Condition
    message: tuple[Term, ...]
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class First:
    """``(:first condition ...)``: the first solution only."""

    condition: Condition


@dataclass(frozen=True, slots=True, eq=False)
class SortBy:
    """``(:sort-by key [#'comparison] condition)``: the solutions in the order of their keys.

    All solutions are found first.  The sort is stable; ``comparison`` names a function of two arguments that
    holds when its first belongs before its second, ``<`` when it was left out.
    """

    key: Term
    comparison: str
    condition: Condition
    node: Node


Condition = (
    Atom
    | Not
    | And
    | Or
    | Imply
    | Forall
    | Exists
    | Assign
    | AssignEach
    | Holds
    | Collect
    | Stated
    | Enforce
    | First
    | SortBy
)
NOTHING = And(())
