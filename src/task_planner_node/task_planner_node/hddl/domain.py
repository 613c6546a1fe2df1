"""HDDL domains: from nodes to the model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from task_planner_node.errors import MissionError
from task_planner_node.hddl.networks import TASK_WORDS, read_network
from task_planner_node.language.model import (
    Atom,
    Axiom,
    Branch,
    Condition,
    Domain,
    Method,
    Operator,
    TaskNetwork,
    Variable,
)
from task_planner_node.language.pddl.actions import (
    ACTION_FIELDS,
    fields_of,
    name_of,
    operator_name,
    parameters_of,
    read_action,
    read_derived,
)
from task_planner_node.language.pddl.formulas import Vocabulary, read_formula
from task_planner_node.language.pddl.ordering import ordered
from task_planner_node.language.pddl.types import OBJECT, Passed, Typed, Types, read_typed
from task_planner_node.language.reader import ListNode, first_word
from task_planner_node.language.reading import Reading, Refused, children_of
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_atom
from task_planner_node.language.walk import tasks_of

SECTIONS = frozenset(
    {'domain', ':requirements', ':types', ':constants', ':predicates', ':functions', ':task'}
    | {':method', ':action', ':derived'}
)
METHOD_FIELDS = TASK_WORDS | {':parameters', ':task', ':precondition', ':ordering', ':constraints'}


@dataclass
class HddlDomain:
    """A domain and what its problems need to know of it."""

    domain: Domain
    vocabulary: Vocabulary
    constants: list[Typed]
    primitive: frozenset[str]


@dataclass
class _Sections:
    """The definitions of a domain by kind."""

    reading: Reading
    nodes: dict[str, list[ListNode]] = field(default_factory=dict)

    def each(self, word: str) -> Iterator[ListNode]:
        yield from self.nodes.get(word, [])

    def attempt(self, read: Callable[[ListNode], None], word: str) -> None:
        """Call ``read`` with each definition, and collect the errors."""
        for node in self.each(word):
            if self.reading.hopeless:
                break
            try:
                read(node)
            except Refused as refused:
                self.reading.errors.append(refused.diagnostic)


def read_domain(reading: Reading, node: ListNode) -> HddlDomain:
    """Read ``(define (domain name) section ...)``; raises MissionError with all errors in it."""
    sections = _Sections(reading)
    for child in node.children[1:]:
        word = first_word(child)
        if reading.hopeless:
            break
        if word not in SECTIONS or not isinstance(child, ListNode):
            text = reading.source.excerpt(child.start, child.end)
            message = f'{text} is no section of a domain{did_you_mean(word, SECTIONS)}'
            reading.errors.append(reading.refuse(child, message).diagnostic)
        else:
            sections.nodes.setdefault(word, []).append(child)
    vocabulary = _read_vocabulary(sections)
    names: list[str] = []
    sections.attempt(lambda each: names.append(name_of(reading, each, 'the domain')), 'domain')
    found = _read_definitions(sections, vocabulary, names[0] if names else '')
    if reading.errors:
        raise MissionError(reading.errors)
    return found


def _read_vocabulary(sections: _Sections) -> Vocabulary:
    reading = sections.reading
    types = Types()
    vocabulary = Vocabulary(types, {} if ':predicates' in sections.nodes else None, {})

    def declare_types(node: ListNode) -> None:
        types.add(read_typed(reading, node.children[1:], variables=False))

    def declare_constants(node: ListNode) -> None:
        typed = read_typed(reading, node.children[1:], variables=False)
        types.check(reading, typed)
        vocabulary.constants = {
            **(vocabulary.constants or {}),
            **{each.name: each for each in typed},
        }

    def declare_predicates(node: ListNode) -> None:
        for child in node.children[1:]:
            whole = ListNode([child, *children_of(child)], child.start, child.end)
            name = name_of(reading, whole, 'a predicate')
            typed = read_typed(reading, children_of(child)[1:], variables=True)
            types.check(reading, typed)
            if vocabulary.predicates is not None:
                vocabulary.predicates[name] = typed

    sections.attempt(declare_types, ':types')
    sections.attempt(declare_constants, ':constants')
    sections.attempt(declare_predicates, ':predicates')
    types.taken = set(vocabulary.predicates or ())
    return vocabulary


def _read_definitions(sections: _Sections, vocabulary: Vocabulary, name: str) -> HddlDomain:
    reading = sections.reading
    tasks: dict[str, list[Typed]] = {}

    def declare_task(node: ListNode) -> None:
        task = name_of(reading, node, 'the task')
        tasks[task] = parameters_of(reading, fields_of(reading, node, {':parameters'}), vocabulary)

    actions: dict[str, list[Typed]] = {}

    def declare_action(node: ListNode) -> None:
        action = name_of(reading, node, 'the action')
        fields = fields_of(reading, node, ACTION_FIELDS)
        actions[action] = parameters_of(reading, fields, vocabulary)

    sections.attempt(declare_task, ':task')
    sections.attempt(declare_action, ':action')
    if reading.errors:
        raise MissionError(reading.errors)
    primitive = frozenset(actions)
    drafts: list[_Draft] = []
    sections.attempt(
        lambda node: drafts.append(_draft(reading, node, vocabulary, primitive)), ':method'
    )
    typed = {
        **tasks,
        **{operator_name(reading, action): parameters for action, parameters in actions.items()},
    }
    passed = _passed(drafts, typed, vocabulary)
    operators: list[Operator] = []
    axioms: list[Axiom] = []
    sections.attempt(
        lambda node: operators.append(read_action(reading, node, vocabulary, passed)), ':action'
    )
    sections.attempt(
        lambda node: axioms.append(read_derived(reading, node, vocabulary)), ':derived'
    )
    abstract = frozenset((task, len(parameters)) for task, parameters in tasks.items())
    domain = Domain(
        reading.source,
        name,
        tuple(operators),
        tuple(draft.method(vocabulary, passed) for draft in drafts),
        tuple(axioms),
        tuple(reading.warnings),
        abstract,
        typed=True,
    )
    return HddlDomain(domain, vocabulary, list((vocabulary.constants or {}).values()), primitive)


@dataclass
class _Draft:
    """A method before it is known which types of its arguments need no test."""

    name: str
    head: Atom
    parameters: list[Typed]
    formulas: list[Condition]
    tasks: TaskNetwork

    def method(self, vocabulary: Vocabulary, passed: Passed) -> Method:
        """The method; its preconditions in a good order."""
        declared = {each.name: each for each in self.parameters}
        callers = passed.get(self.head.name, [])
        checks: list[Condition] = []
        bound: set[str] = set()
        for place, argument in enumerate(self.head.args):
            if isinstance(argument, Variable) and argument.name not in bound:
                bound.add(argument.name)
                typed = declared[argument.name]
                if not vocabulary.types.follows(typed, callers[place : place + 1]):
                    checks.append(vocabulary.types.condition(typed))
        condition = ordered(self.parameters, bound, [*checks, *self.formulas], vocabulary)
        return Method(self.head, (Branch(self.name, condition, self.tasks),), self.name)


def _draft(
    reading: Reading, node: ListNode, vocabulary: Vocabulary, primitive: frozenset[str]
) -> _Draft:
    """Read ``(:method name :parameters (...) :task (...) :precondition formula :subtasks (...) ...)``."""
    name = name_of(reading, node, 'the method')
    fields = fields_of(reading, node, METHOD_FIELDS)
    if ':task' not in fields:
        raise reading.refuse(node, f'the method {name} has no :task')
    parameters = parameters_of(reading, fields, vocabulary)
    head = read_atom(reading, fields[':task'], 'a task')
    vocabulary.check_objects(reading, head)
    if head.name in primitive:
        raise reading.refuse(
            fields[':task'], f'{head.name} is an action: a method cannot define it'
        )
    formulas = [
        read_formula(reading, fields[word], vocabulary)
        for word in (':precondition', ':constraints')
        if word in fields
    ]
    tasks = read_network(reading, fields, vocabulary, primitive)
    names = {each.name for each in parameters}
    for atom in (head, *tasks_of(tasks)):
        check_declared(reading, atom, names)
    return _Draft(name, head, parameters, formulas, tasks)


def check_declared(reading: Reading, atom: Atom, names: set[str]) -> None:
    """Raise Refused for a variable that is no parameter."""
    for argument, node in zip(atom.args, atom.node.children[1:], strict=False):
        if isinstance(argument, Variable) and argument.name not in names:
            hint = did_you_mean(argument.name, names)
            raise reading.refuse(node, f'{argument.name} is no parameter{hint}')


def _passed(drafts: list[_Draft], tasks: dict[str, list[Typed]], vocabulary: Vocabulary) -> Passed:
    """For each task and position the types of all that is passed there.

    The tasks of a problem pass what their declaration demands.
    """
    passed: Passed = {name: [{each.type} for each in typed] for name, typed in tasks.items()}
    constants = vocabulary.constants or {}
    for draft in drafts:
        kinds = {each.name: each.type for each in (*constants.values(), *draft.parameters)}
        for task in tasks_of(draft.tasks):
            for argument, known in zip(task.args, passed.get(task.name, []), strict=False):
                name = argument.name if isinstance(argument, Variable) else str(argument)
                known.add(kinds.get(name, (OBJECT,)))
    return passed
