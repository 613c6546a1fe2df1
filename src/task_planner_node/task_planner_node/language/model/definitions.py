"""Task networks, effects, and the definitions that domains and problems consist of."""

from __future__ import annotations

from dataclasses import dataclass, field

from task_planner_node.errors import Diagnostic
from task_planner_node.language.model.conditions import NOTHING, Condition
from task_planner_node.language.model.terms import Atom, Term, Variable
from task_planner_node.language.reader import ListNode, Node
from task_planner_node.language.source import Source


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
