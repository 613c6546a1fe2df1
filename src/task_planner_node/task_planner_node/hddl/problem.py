"""HDDL problems: from nodes to the model."""

from __future__ import annotations

from collections.abc import Callable

from task_planner_node.errors import MissionError
from task_planner_node.hddl.domain import HddlDomain, check_declared
from task_planner_node.hddl.networks import TASK_WORDS, read_network
from task_planner_node.language.model import NOTHING, Atom, Condition, Ordered, Problem, TaskNetwork
from task_planner_node.language.pddl.actions import fields_of, name_of, parameters_of
from task_planner_node.language.pddl.formulas import COMPARISONS, Vocabulary, read_formula
from task_planner_node.language.pddl.ordering import ordered
from task_planner_node.language.pddl.types import Typed, read_typed
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word
from task_planner_node.language.reading import Reading, Refused
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_atom, read_name, read_term
from task_planner_node.language.walk import atoms_of, tasks_of

SECTIONS = (
    *('problem', ':domain', ':requirements', ':objects', ':init', ':htn', ':htnti', ':goal'),
    ':metric',
)
HTN_FIELDS = TASK_WORDS | {':parameters', ':ordering', ':constraints'}


def read_problem(reading: Reading, node: ListNode, of: HddlDomain) -> Problem:
    """Read ``(define (problem name) section ...)`` for a domain; raises MissionError with all errors in it."""
    return _Reader(reading, node, of).read()


class _Reader:
    def __init__(self, reading: Reading, node: ListNode, of: HddlDomain) -> None:
        self._reading = reading
        self._node = node
        self._of = of
        self._name = ''
        self._domain: Symbol | None = None
        self._facts: list[Atom] = []
        self._tasks: TaskNetwork = Ordered(())
        self._tasks_node: Node = node
        self._precondition: Condition = NOTHING
        self._goal: Condition = NOTHING
        constants = {each.name: each for each in of.constants}
        self._vocabulary = Vocabulary(of.vocabulary.types, of.vocabulary.predicates, constants)

    def read(self) -> Problem:
        reading = self._reading
        sections: dict[str, ListNode] = {}
        for child in self._node.children[1:]:
            word = first_word(child)
            if not isinstance(child, ListNode) or word not in SECTIONS or word in sections:
                text = reading.source.excerpt(child.start, child.end)
                twice = ' more than once' if word in sections else did_you_mean(word, SECTIONS)
                message = f'{text} is no section of a problem{twice}'
                reading.errors.append(reading.refuse(child, message).diagnostic)
            else:
                sections[word] = child
        steps: list[tuple[str, Callable[[ListNode], None]]] = [
            ('problem', self._read_name),
            (':domain', self._read_domain_name),
            (':objects', self._read_objects),
            (':init', self._read_init),
            (':htn', self._read_htn),
            (':goal', self._read_goal),
        ]
        for word, step in steps:
            if word in sections:
                try:
                    step(sections[word])
                except Refused as refused:
                    reading.errors.append(refused.diagnostic)
            elif word == ':objects':
                self._add_objects([])
        if reading.errors:
            raise MissionError(reading.errors)
        goals = tuple(atom for atom, positive in atoms_of(self._goal) if positive)
        return Problem(
            reading.source,
            self._name,
            read_name(reading, self._domain) if self._domain else '',
            self._domain,
            tuple(self._facts),
            self._tasks,
            self._tasks_node,
            goals,
            self._precondition,
            self._goal,
            tuple(reading.warnings),
        )

    def _read_name(self, node: ListNode) -> None:
        self._name = name_of(self._reading, node, 'the problem')

    def _read_domain_name(self, node: ListNode) -> None:
        name_of(self._reading, node, 'the domain')
        name = node.children[1]
        self._domain = name if isinstance(name, Symbol) else None

    def _read_objects(self, node: ListNode) -> None:
        typed = read_typed(self._reading, node.children[1:], variables=False)
        self._vocabulary.types.check(self._reading, typed)
        self._add_objects(typed)

    def _add_objects(self, typed: list[Typed]) -> None:
        known = self._vocabulary.constants or {}
        self._vocabulary.constants = {**known, **{each.name: each for each in typed}}
        for each in self._vocabulary.constants.values():
            self._facts += self._vocabulary.types.facts(each)

    def _read_init(self, node: ListNode) -> None:
        for child in node.children[1:]:
            if self._reading.hopeless:
                break
            try:
                self._read_fact(child)
            except Refused as refused:
                self._reading.errors.append(refused.diagnostic)

    def _read_fact(self, node: Node) -> None:
        reading = self._reading
        word = first_word(node)
        if word == 'not':
            return
        if word == '=' and isinstance(node, ListNode) and len(node.children) == 3:
            function, value = node.children[1:]
            if first_word(function) != 'total-cost':
                atom = read_atom(reading, function, 'a function')
                number = read_term(reading, value)
                self._facts.append(Atom(atom.name, (*atom.args, number), atom.node))
            return
        if word in COMPARISONS:
            raise reading.refuse(node, f'({word} ...) is no fact')
        fact = read_atom(reading, node, 'a fact')
        self._vocabulary.check(reading, fact)
        check_declared(reading, fact, set())
        self._facts.append(fact)

    def _read_htn(self, node: ListNode) -> None:
        reading, vocabulary = self._reading, self._vocabulary
        fields = fields_of(reading, node, HTN_FIELDS, skipped=1)
        parameters = parameters_of(reading, fields, vocabulary)
        self._tasks = read_network(reading, fields, vocabulary, self._of.primitive)
        self._tasks_node = next((fields[word] for word in fields if word in TASK_WORDS), node)
        names = {each.name for each in parameters}
        for task in tasks_of(self._tasks):
            check_declared(reading, task, names)
        formulas = []
        if ':constraints' in fields:
            formulas.append(read_formula(reading, fields[':constraints'], vocabulary))
        self._precondition = ordered(parameters, (), formulas, vocabulary)

    def _read_goal(self, node: ListNode) -> None:
        if len(node.children) != 2:
            raise self._reading.refuse(node, 'expected (:goal formula)')
        self._goal = read_formula(self._reading, node.children[1], self._vocabulary)
