"""HDDL: what is read means in the model what it means in HDDL, and plans come out in the competition's format."""

from __future__ import annotations

import pytest

from task_planner_node.errors import MissionError, Severity
from task_planner_node.hddl import is_hddl, plan_text, read_hddl
from task_planner_node.language import Source, check_mission
from task_planner_node.language.model import (
    And,
    Atom,
    Condition,
    Domain,
    Exists,
    Forall,
    ForEach,
    Holds,
    Not,
    Or,
    Problem,
    Unordered,
    show,
)
from task_planner_node.search.tree import Tree, TreeNode

DOMAIN = """\
; parcels
(define (domain parcels)
 (:requirements :typing :hierarchy :negative-preconditions :equality)
 (:types truck plane - vehicle  vehicle parcel - thing  place)
 (:constants depot - place)
 (:predicates (at ?x - thing ?p - place) (in ?x - parcel ?v - vehicle) (road ?a ?b - place)
   (truck ?x) (closed ?p - place))
 (:task deliver :parameters (?x - parcel ?p - place))
 (:task bring :parameters (?v - vehicle ?p - place))
 (:method by_truck
  :parameters (?x - parcel ?p ?q - place ?t - truck)
  :task (deliver ?x ?p)
  :precondition (and (not (closed ?p)) (not (= ?p ?q)) (at ?x ?q))
  :subtasks (and (t1 (bring ?t ?q)) (t2 (load ?x ?t ?q)) (t3 (bring ?t ?p)) (t4 (unload ?x ?t ?p)))
  :ordering (and (< t1 t2) (< t2 t3) (< t3 t4)))
 (:method stay
  :parameters (?v - vehicle ?p - place)
  :task (bring ?v ?p)
  :precondition (at ?v ?p)
  :subtasks ())
 (:method go
  :parameters (?t - truck ?a ?p - place)
  :task (bring ?t ?p)
  :precondition (and (at ?t ?a) (road ?a ?p))
  :ordered-subtasks (drive ?t ?a ?p))
 (:action drive
  :parameters (?t - truck ?a ?b - place)
  :precondition (and (at ?t ?a) (road ?a ?b))
  :effect (and (not (at ?t ?a)) (at ?t ?b)))
 (:action load
  :parameters (?x - parcel ?v - vehicle ?p - place)
  :precondition (and (at ?x ?p) (at ?v ?p))
  :effect (and (not (at ?x ?p)) (in ?x ?v)))
 (:action unload
  :parameters (?x - parcel ?v - vehicle ?p - place)
  :precondition (and (in ?x ?v) (at ?v ?p)
    (forall (?y - parcel) (or (= ?x ?y) (not (in ?y ?v)) (exists (?q - place) (at ?v ?q)))))
  :effect (and (not (in ?x ?v)) (at ?x ?p)
    (forall (?w - place) (when (closed ?w) (and (not (closed ?w)) (road ?w ?p))))
    (increase (total-cost) 3))))
"""
PROBLEM = """\
(define (problem one) (:domain parcels)
 (:objects t1 - truck A B - place p1 p2 - parcel)
 (:htn :parameters (?x - parcel) :subtasks (and (deliver ?x B) (deliver p2 A))
   :constraints (not (= ?x p2)))
 (:init (at t1 depot) (at p1 A) (at p2 B) (road depot A) (road A B) (road B A)
  (closed depot) (= (total-cost) 0))
 (:goal (and (at p1 B) (at p2 A))))
"""


def read(domain: str = DOMAIN, problem: str = PROBLEM) -> tuple[Domain, Problem]:
    return read_hddl(Source('d.hddl', domain), Source('p.hddl', problem))


def written(condition: Condition) -> object:
    if isinstance(condition, Atom):
        return show(condition)
    if isinstance(condition, Not):
        return 'not', written(condition.condition)
    if isinstance(condition, Holds):
        return show(condition.expression)
    if isinstance(condition, (And, Or)):
        word = 'and' if isinstance(condition, And) else 'or'
        return word, *(written(part) for part in condition.conditions)
    assert isinstance(condition, (Forall, Exists))
    names = [variable.name for variable in condition.variables]
    word = type(condition).__name__.lower()
    return word, *names, written(condition.domain), written(condition.condition)


def test_a_mission_is_read_without_remarks() -> None:
    domain, problem = read()
    assert check_mission(domain, problem) == []
    assert [operator.head.name for operator in domain.operators] == ['!drive', '!load', '!unload']
    assert [(m.name, m.branches[0].name, m.head.name) for m in domain.methods] == [
        ('by_truck', 'by_truck', 'deliver'),
        ('stay', 'stay', 'bring'),
        ('go', 'go', 'bring'),
    ]


def test_types_become_facts_and_tests_where_they_do_not_follow() -> None:
    domain, problem = read()
    facts = {show(fact) for fact in problem.facts}
    assert facts >= {
        '(type-truck t1)',
        '(vehicle t1)',
        '(thing t1)',
        '(object t1)',
        '(place depot)',
    }
    assert '(truck t1)' not in facts, 'truck is a predicate of the domain as well'
    deliver, stay, go = (method.branches[0].condition for method in domain.methods)
    assert written(deliver) == (
        'and',
        ('not', '(closed ?p)'),
        '(at ?x ?q)',
        ('not', '(call equal ?p ?q)'),
        '(type-truck ?t)',
    )
    assert written(stay) == ('and', '(at ?v ?p)')
    assert written(go) == ('and', '(type-truck ?t)', '(at ?t ?a)', '(road ?a ?p)')
    drive, load, unload = (operator.condition for operator in domain.operators)
    assert written(drive) == ('and', '(at ?t ?a)', '(road ?a ?b)')
    assert written(load) == ('and', '(at ?x ?p)', '(at ?v ?p)')
    assert written(unload) == (
        'and',
        (
            'forall',
            '?y',
            ('and', '(parcel ?y)'),
            (
                'or',
                '(call equal ?x ?y)',
                ('not', '(in ?y ?v)'),
                ('exists', '?q', ('and', '(place ?q)'), '(at ?v ?q)'),
            ),
        ),
        '(in ?x ?v)',
        '(at ?v ?p)',
    )


def test_a_caller_with_a_wider_type_makes_an_action_test_its_own() -> None:
    assert written(read()[0].operators[0].condition) == ('and', '(at ?t ?a)', '(road ?a ?b)')
    wider = DOMAIN.replace(
        '(?t - truck ?a ?p - place)\n  :task', '(?t - vehicle ?a ?p - place)\n  :task'
    )
    assert wider != DOMAIN
    drive = read(wider)[0].operators[0]
    assert written(drive.condition) == ('and', '(type-truck ?t)', '(at ?t ?a)', '(road ?a ?b)')


def test_effects() -> None:
    unload = read()[0].operators[2]
    deleted, opened = unload.deletes
    added, joined = unload.adds
    assert isinstance(deleted, Atom)
    assert isinstance(added, Atom)
    assert (show(deleted), show(added)) == ('(in ?x ?v)', '(at ?x ?p)')
    for outer, effect in ((opened, '(closed ?w)'), (joined, '(road ?w ?p)')):
        assert isinstance(outer, ForEach)
        assert written(outer.condition) == ('and', '(place ?w)')
        (inner,) = outer.effects
        assert isinstance(inner, ForEach)
        assert written(inner.condition) == '(closed ?w)'
        (only,) = inner.effects
        assert isinstance(only, Atom)
        assert show(only) == effect
    assert unload.cost == 3


def test_the_initial_network_and_the_goal() -> None:
    _, problem = read()
    assert isinstance(problem.tasks, Unordered)
    assert written(problem.precondition) == ('and', '(parcel ?x)', ('not', '(call equal ?x p2)'))
    assert written(problem.goal) == ('and', '(at p1 B)', '(at p2 A)')


def test_a_cost_that_depends_on_the_arguments_is_looked_up() -> None:
    domain = DOMAIN.replace('(increase (total-cost) 3)', '(increase (total-cost) (toll ?p))')
    found, problem = read(
        domain, PROBLEM.replace('(= (total-cost) 0)', '(= (toll A) 2) (= (toll B) 4)')
    )
    assert '(toll A 2)' in {show(fact) for fact in problem.facts}
    condition = found.operators[2].condition
    assert isinstance(condition, And)
    assert isinstance(condition.conditions[-1], Atom)
    assert condition.conditions[-1].name == 'toll'
    assert found.operators[2].cost == condition.conditions[-1].args[-1]


def test_names_have_no_case_and_either_is_either() -> None:
    domain = DOMAIN.replace(
        '(?v - vehicle ?p - place)\n  :task', '(?v - (either TRUCK plane) ?P - Place)\n  :TASK'
    )
    found, _ = read(domain)
    assert written(found.methods[1].branches[0].condition) == (
        'and',
        ('or', '(type-truck ?v)', '(plane ?v)'),
        '(at ?v ?p)',
    )


@pytest.mark.parametrize(
    ('old', 'new', 'line', 'column', 'message'),
    [
        ('plane - vehicle', 'plane - (vehicle)', 4, 24, 'expected a type'),
        ('depot - place', 'depot - plaice', 5, 14, 'unknown type plaice; did you mean place?'),
        ('(not (closed ?p))', '(not (close ?p))', 13, 27, 'not declared; did you mean closed?'),
        ('(not (closed ?p))', '(not (closed ?p ?q))', 13, 27, 'closed has 1 arguments, not 2'),
        ('(not (closed ?p))', '(closed home)', 13, 30, 'the object home is not declared'),
        ('(not (closed ?p))', '(> (size ?p) 3)', 13, 22, 'numeric fluents'),
        ('(bring ?t ?q)', '(bring ?t ?s)', 14, 32, '?s is no parameter'),
        ('(< t1 t2)', '(< t1 t9)', 15, 24, 'no subtask is called t9'),
        ('(< t1 t2)', '(< t3 t2)', 15, 13, 'form a cycle'),
        ('(< t1 t2)', '(= t1 t2)', 15, 18, 'is written (< name name)'),
        ('t2 (load', 't1 (load', 14, 37, 'two subtasks are called t1'),
        (':task (bring ?v ?p)', ':task (drive ?v ?p)', 18, 9, 'drive is an action'),
        (':subtasks ()', ':subtask ()', 20, 3, 'did you mean :subtasks?'),
        (' :task (deliver ?x ?p)\n', '\n', 10, 2, 'has no :task'),
        ('(increase (total-cost) 3)', '(increase (fuel) 3)', 40, 5, 'numeric fluents'),
        ('(:action drive', '(:durative-action drive', 26, 2, 'is no section'),
        ('?a ?b - place)\n  :pre', '?a ?a - place)\n  :pre', 27, 30, '?a is declared twice'),
    ],
)
def test_what_is_wrong_has_its_place(
    old: str, new: str, line: int, column: int, message: str
) -> None:
    assert old in DOMAIN
    with pytest.raises(MissionError) as caught:
        read(DOMAIN.replace(old, new, 1))
    found = [(d.line, d.column) for d in caught.value.diagnostics if message in d.message]
    assert found == [(line, column)], caught.value


def test_what_is_wrong_in_a_problem_has_its_place_and_all_is_told() -> None:
    problem = PROBLEM.replace('(at p1 A)', '(at p1 C)').replace('(road B A)', '(road B)')
    with pytest.raises(MissionError) as caught:
        read(problem=problem.replace('(:goal', '(:gaol'))
    assert sorted((d.line, d.column, d.source) for d in caught.value.diagnostics) == [
        (5, 30, 'p.hddl'),
        (5, 69, 'p.hddl'),
        (7, 2, 'p.hddl'),
    ]
    with pytest.raises(MissionError, match='has no problem'):
        read(problem=DOMAIN)
    assert is_hddl(Source('p', PROBLEM))
    assert is_hddl(Source('p', '\n; (a)\n ; b\n( DEFINE\n(domain d))'))
    assert not is_hddl(Source('p', '(defdomain d ())'))
    assert not is_hddl(Source('p', '; (define (domain d))'))


def test_another_domains_name_is_no_more_than_a_warning() -> None:
    (remark,) = check_mission(*read(problem=PROBLEM.replace('parcels', 'postbox')))
    assert remark.severity == Severity.WARNING


def test_the_plan_in_the_competitions_format() -> None:
    drive = TreeNode(('!drive', 't1', 'depot', 'A'), primitive=True, step=0)
    note = TreeNode(('!!note', 't1'), primitive=True)
    load = TreeNode(('!load', 'p1', 't1', 'A'), primitive=True, step=1)
    bring = TreeNode(('bring', 't1', 'A'), primitive=False, children=(drive, note), method='go')
    stay = TreeNode(('bring', 't1', 'A'), primitive=False, method_number=2, branch_number=1)
    tree = Tree(
        (
            TreeNode(
                ('deliver', 'p1'), primitive=False, children=(bring, load, stay), branch='by_truck'
            ),
        )
    )
    assert plan_text(tree) == (
        '==>\n0 drive t1 depot A\n1 load p1 t1 A\nroot 2\n'
        '2 deliver p1 -> by_truck 3 1 4\n3 bring t1 A -> go 0\n4 bring t1 A -> bring-2-1\n<==\n'
    )
