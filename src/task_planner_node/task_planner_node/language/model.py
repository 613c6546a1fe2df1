"""A mission as it was written: operators, methods, axioms, facts and tasks, each with its place in the text.

Ground terms are plain Python: a symbol is a ``str``, a number an ``int`` or a ``float``, a list a ``tuple``,
``nil`` is ``()``, and a list that ends in something other than nil a ``Dotted``.  Symbols that differ in case
only are one and the same ``str`` (see language/spelling.py), so that ``==`` compares without case.

The model is the meeting point of the readers (SHOP, HDDL) and the search.  The docstrings here are its semantics.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from task_planner_node.errors import Diagnostic
from task_planner_node.language.reader import ListNode, Node
from task_planner_node.language.source import Source


@dataclass(frozen=True, slots=True)
class Dotted:
    """A ground list that does not end in nil: ``(a b . c)``.

    There is at least one item, and the tail is a symbol or a number: chain() makes lists of this form.
    """

    items: tuple[Any, ...]
    tail: str | int | float


# mypy has no recursive alias for tuples of itself in the versions supported: Any is a ground term.
Ground = str | int | float | tuple[Any, ...] | Dotted


@dataclass(frozen=True, slots=True)
class Variable:
    """A name that begins with a question mark.

    Readers give every anonymous variable (``?_``, ``?_name``) a name of its own, ``?_#1`` and so on.
    """

    name: str

    @property
    def anonymous(self) -> bool:
        """Whether nothing else may refer to it."""
        return self.name.startswith('?_') and '#' in self.name


@dataclass(frozen=True, slots=True)
class Pattern:
    """A list with variables or applications in it; ``tail`` stands behind a dot, as in ``(?first . ?others)``.

    The tail is None (nil), a variable, an application, or a symbol or number, as in ``(?x . last)``.
    """

    items: tuple[Term, ...]
    tail: Variable | Application | str | int | float | None = None


@dataclass(frozen=True, slots=True, eq=False)
class Application:
    """A function applied to arguments: ``(call + ?x 1)``, or a part of what is in an ``eval``.

    ``function`` is the name in lower case; language/functions.py has all of them and evaluates.  Arguments are
    terms: their values are passed, a Pattern's as the list it builds.  As a term an application stands
    for its value and needs all its variables bound; the heads of operators, methods and axioms have none.
    """

    function: str
    arguments: tuple[Term, ...]
    node: Node


Term = str | int | float | tuple[Any, ...] | Dotted | Variable | Pattern | Application


def chain(items: tuple[Any, ...], tail: Ground) -> Ground:
    """The ground list of ``items`` before ``tail``: a tuple when the tail is a list, else Dotted."""
    if isinstance(tail, tuple):
        return items + tail
    if not items:
        return tail
    if isinstance(tail, Dotted):
        return Dotted(items + tail.items, tail.tail)
    return Dotted(items, tail)


@dataclass(frozen=True, slots=True, eq=False)
class Atom:
    """A literal, a task or a head: a name and its arguments."""

    name: str
    args: tuple[Term, ...]
    node: ListNode


# Conditions.  They are tested from left to right; a solution binds variables, and each further solution is a
# choice to backtrack to.  A variable that is bound already is tested, not bound anew.


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


# Task networks.


@dataclass(frozen=True, slots=True, eq=False)
class Immediate:
    """A task with priority: once it may come next it does, before all tasks that are not immediate."""

    task: Atom


@dataclass(frozen=True, slots=True, eq=False)
class Ordered:
    """Tasks that are done one after the other."""

    items: tuple[TaskNetwork, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Unordered:
    """Tasks that may be interleaved in any way."""

    items: tuple[TaskNetwork, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Partial:
    """Tasks under a partial order that nested Ordered and Unordered cannot express (HDDL's ``:ordering``).

    ``before`` holds pairs (i, j) of indices into ``items``: all of item i is done before any of item j.  It has
    no cycle and no pair that follows from others.
    """

    items: tuple[Atom, ...]
    before: tuple[tuple[int, int], ...]


# The variables of a task that nothing bound are unbound in it, and are bound for all tasks of the same
# branch by whatever binds one of them first: the head of a method, or the preconditions of an operator.
TaskNetwork = Atom | Immediate | Ordered | Unordered | Partial


# Effects.  All effects of an operator are grounded in the state before it; deletions then come before additions.


@dataclass(frozen=True, slots=True, eq=False)
class ForEach:
    """``(forall (?v ...) condition (effect ...))``: the effects for every solution of ``condition``.

    Without variables it is a conditional effect, ``(when condition effects)``.
    """

    variables: tuple[Variable, ...]
    condition: Condition
    effects: tuple[Effect, ...]
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Spread:
    """A variable as a whole add or delete list; its value is a list of facts."""

    variable: Variable
    node: Node


@dataclass(frozen=True, slots=True, eq=False)
class Protection:
    """``(:protection literal)``; ``(:protection (not literal))`` when not ``positive``.

    Among the additions it protects: no operator may make the literal false (true) until the same protection was
    deleted as often as it was added.  Protecting what does not hold once the operator is applied is an error.
    """

    literal: Atom | Variable
    positive: bool
    node: Node


# A variable stands for one fact, which is its value: a list that begins with a name.
Effect = Atom | Variable | ForEach | Spread | Protection


@dataclass(frozen=True, slots=True, eq=False)
class GeometricText:
    """A geometric field as raw text of the same length as in the source, comments blanked out."""

    text: str
    node: ListNode


@dataclass(frozen=True, slots=True, eq=False)
class Operator:
    """An augmented planning operator (Definition 1); without the geometric fields it is SHOP2's.

    ``behaviour`` holds the behaviour constraints, ``reference`` the reference to the geometric effects.
    The cost is a number or an expression whose value is one, grounded like the effects.
    Each solution of the condition is a choice.
    """

    head: Atom
    condition: Condition
    geometric: GeometricText | None
    deletes: tuple[Effect, ...]
    adds: tuple[Effect, ...]
    cost: Term = 1.0
    behaviour: GeometricText | None = None
    reference: GeometricText | None = None

    @property
    def internal(self) -> bool:
        """Whether it changes the state without being an action of the plan (``!!``)."""
        return self.head.name.startswith('!!')


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """One way of a method; its name may be empty."""

    name: str
    condition: Condition
    tasks: TaskNetwork


@dataclass(frozen=True, slots=True, eq=False)
class Method:
    """How a task is decomposed: by the first branch whose condition can be satisfied; its name may be empty.

    Each solution of that branch's condition is a choice, and so is each method whose head fits.
    """

    head: Atom
    branches: tuple[Branch, ...]
    name: str = ''


@dataclass(frozen=True, slots=True, eq=False)
class Axiom:
    """The head holds when a body does; of the bodies the first that can be satisfied counts.

    ``names`` has a name for each body, which may be empty.
    """

    head: Atom
    bodies: tuple[Condition, ...]
    names: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Domain:
    """All definitions of a domain in the order of the text; the name is empty for bare forms.

    ``declared`` are the names of tasks that need no method, ``typed`` tells that HDDL declared all variables, and
    ``remarks`` are warnings that reading it gave.
    """

    source: Source
    name: str = ''
    operators: tuple[Operator, ...] = ()
    methods: tuple[Method, ...] = ()
    axioms: tuple[Axiom, ...] = ()
    remarks: tuple[Diagnostic, ...] = ()
    declared: frozenset[tuple[str, int]] = frozenset()
    typed: bool = False


@dataclass(frozen=True, slots=True, eq=False)
class Problem:
    """The initial state and the tasks; ``domain_node`` is where the domain is named, if it is.

    Each solution of ``precondition`` in the initial state is a choice, and binds variables of the tasks (HDDL's
    parameters of ``:htn``).  ``goal`` has to hold when all tasks are done.  ``goals`` are the literals that the
    tasks name, for reporting progress only.
    """

    source: Source
    name: str
    domain_name: str
    domain_node: Node | None
    facts: tuple[Atom, ...]
    tasks: TaskNetwork
    tasks_node: Node
    goals: tuple[Atom, ...] = field(default=())
    precondition: Condition = NOTHING
    goal: Condition = NOTHING
    remarks: tuple[Diagnostic, ...] = ()


def show(term: object) -> str:
    """A term or a ground task as it is written in a mission."""
    if isinstance(term, str):
        return term
    if isinstance(term, Variable):
        return '?_' if term.anonymous else term.name
    if isinstance(term, Atom):
        return f'({" ".join([term.name, *(show(argument) for argument in term.args)])})'
    if isinstance(term, Application):
        words = ['call', term.function, *(show(argument) for argument in term.arguments)]
        return f'({" ".join(words)})'
    if isinstance(term, (Pattern, Dotted)):
        tail = f' . {show(term.tail)}' if term.tail is not None else ''
        return f'({" ".join(show(item) for item in term.items)}{tail})'
    if isinstance(term, tuple):
        return f'({" ".join(show(item) for item in term)})' if term else 'nil'
    return str(term)


def shorten(text: str, limit: int = 100) -> str:
    """At most ``limit`` characters of ``text``."""
    return text if len(text) <= limit else text[: limit - 4] + ' ...'
