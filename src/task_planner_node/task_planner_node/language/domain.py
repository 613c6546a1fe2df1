"""Reading a domain: operators of the paper and of SHOP, methods and axioms."""

from __future__ import annotations

from task_planner_node.errors import Diagnostic, MissionError
from task_planner_node.language.forms import read_forms
from task_planner_node.language.methods import read_axiom, read_method
from task_planner_node.language.model import Axiom, Domain, Method, Operator
from task_planner_node.language.operators import read_op, read_paper_operator, read_shop_operator
from task_planner_node.language.pddl.shop import WORDS as PDDL_WORDS
from task_planner_node.language.pddl.shop import ShopPddl
from task_planner_node.language.reader import ListNode, Node, Symbol, first_word, unmarked
from task_planner_node.language.reading import Reading, Refused, children_of, elements
from task_planner_node.language.source import Source
from task_planner_node.language.spelling import Spelling
from task_planner_node.language.suggestions import did_you_mean
from task_planner_node.language.terms import read_name

FORMS = (
    *('operator', ':operator', ':op', ':method', ':-', 'defdomain', 'defproblem', ':pddl-method'),
    *sorted(PDDL_WORDS),
)
OTHER_WORDS = frozenset({'defdomain', 'defproblem', 'make-problem'})


def read_domain(source: Source, spelling: Spelling | None = None, name: str = '') -> Domain:
    """Read ``(defdomain name (form ...))`` or bare forms; problems in the same text are left alone.

    ``spelling`` is shared with the problem that belongs to the domain.  Of several domains in the text the one
    called ``name`` is read.  Raises MissionError with every definition that cannot be read.
    """
    reading = Reading(source, spelling)
    forms = read_forms(reading)
    definitions = [node for node in forms if first_word(node) not in OTHER_WORDS]
    found = ''
    try:
        node = _chosen(reading, forms, name)
        if node is not None:
            found, inner = _read_defdomain(reading, node)
            definitions = [*inner, *definitions]
    except Refused as refused:
        reading.errors.append(refused.diagnostic)
    operators, methods, axioms = _read_definitions(reading, definitions)
    if not reading.errors and not operators and not methods and node is None:
        nothing = 'the domain defines no operator and no method'
        reading.errors.append(Diagnostic(nothing, source=source.name))
    if reading.errors:
        raise MissionError(reading.errors)
    return Domain(
        source, found, tuple(operators), tuple(methods), tuple(axioms), tuple(reading.warnings)
    )


def _chosen(reading: Reading, forms: list[Node], name: str) -> Node | None:
    domains = [node for node in forms if first_word(node) == 'defdomain']
    if len(domains) < 2:
        return domains[0] if domains else None
    names = [_read_defdomain(reading, node)[0] for node in domains]
    fitting = [i for i, found in enumerate(names) if found.lower() == name.lower()]
    if not fitting:
        message = 'a text holds one domain, or the problem names one'
        raise reading.refuse(domains[1], f'{message}: this is the second of {", ".join(names)}')
    return domains[fitting[-1]]


def _read_definitions(
    reading: Reading, definitions: list[Node]
) -> tuple[list[Operator], list[Method], list[Axiom]]:
    operators: list[Operator] = []
    methods: list[Method] = []
    axioms: list[Axiom] = []
    pddl = ShopPddl(reading)
    # Types first: actions before them may use them.
    for node in sorted(definitions, key=lambda each: first_word(each) != ':types'):
        word = first_word(node)
        if reading.hopeless:
            break
        try:
            if not isinstance(node, ListNode) or word not in FORMS:
                raise reading.refuse(node, _unknown_form(word))
            if word in PDDL_WORDS:
                pddl.read(_plain(reading, node))
            elif word == 'operator':
                operators.append(read_paper_operator(reading, node))
            elif word == ':op':
                operators.append(read_op(reading, node))
            elif word == ':operator':
                operators.append(read_shop_operator(reading, _plain(reading, node)))
            elif word in (':method', ':pddl-method'):
                methods.append(read_method(reading, _plain(reading, node)))
            else:
                axioms.append(read_axiom(reading, _plain(reading, node)))
        except Refused as refused:
            reading.errors.append(refused.diagnostic)
        except MissionError as error:
            reading.errors.extend(error.diagnostics)
    return operators + pddl.operators, methods, axioms + pddl.axioms


def _plain(reading: Reading, node: ListNode) -> ListNode:
    return ListNode(unmarked(reading.source, node.children), node.start, node.end)


def _unknown_form(word: str) -> str:
    if word == ':include':
        return 'a domain is one text: put what is included into it'
    if not word:
        return 'expected a definition: (Operator ...), (:operator ...), (:method ...) or (:- ...)'
    return f'unknown form ({word} ...)' + did_you_mean(word, FORMS)


def _read_defdomain(reading: Reading, node: Node) -> tuple[str, list[Node]]:
    """The name and the definitions of ``(defdomain name (form ...))``; options of the name are left out."""
    children = children_of(node)
    if len(children) != 3:
        raise reading.refuse(node, 'a domain is written (defdomain name (definition ...))')
    named = children[1]
    name = named.children[0] if isinstance(named, ListNode) and named.children else named
    if not isinstance(name, Symbol):
        raise reading.refuse(named, 'a domain is written (defdomain name (definition ...))')
    return read_name(reading, name), elements(reading, children[2], 'the definitions of the domain')
