"""The SHOP reader: how names are spelt, what is bound when, and what is remarked upon."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from task_planner_node.errors import MissionError, Severity
from task_planner_node.language import (
    Source,
    Spelling,
    check_mission,
    problem_names,
    read_domain,
    read_problem,
)
from task_planner_node.language.model import (
    And,
    Ordered,
    Unordered,
    chain,
    show,
)
from task_planner_node.language.terms import NUMBER
from tests.support.shop_texts import domain, fact, problem, written


def test_names_have_no_case_and_labels_are_spelt_as_in_the_facts() -> None:
    spelling = Spelling()
    facts = problem(
        '(DEFPROBLEM p D ((Camera Cam_0) (AT rover0)) ((GO Rover0)))', spelling=spelling
    )
    text = '(Defdomain d ((:Method (go ?R) ((camera CAM_0) (at ?r) (Not (camera ?R))) NIL)))'
    found = read_domain(Source('d.lisp', text), spelling)
    (method,) = found.methods
    conditions = method.branches[0].condition
    assert isinstance(conditions, And)
    assert written(conditions.conditions[0]) == '(Camera Cam_0)'
    assert written(facts.facts[1]) == '(AT rover0)'
    assert isinstance(facts.tasks, Ordered)
    assert written(facts.tasks.items[0]) == '(GO rover0)'
    assert not [d for d in check_mission(found, facts) if 'domain' in d.message]


def test_a_label_is_spelt_as_itself_and_not_as_a_predicate_or_a_task_before_it() -> None:
    spelling = Spelling()
    found = problem(
        '(defproblem p d ((ROVER rover) (Pilot rover)) ((DRIVE rover)))', spelling=spelling
    )
    assert [written(fact) for fact in found.facts] == ['(rover rover)', '(Pilot rover)']
    text = (
        '(:method (DRIVE ?x) ((CAMERA ?x camera)) ((!O ?x base))) (:operator (!o ?x BASE) () () ())'
    )
    (method,) = read_domain(Source('d.lisp', text), spelling).methods
    condition_found = method.branches[0].condition
    assert isinstance(condition_found, And)
    assert written(condition_found.conditions[0]) == '(camera ?x camera)'


def test_a_label_that_is_spelt_in_two_ways_is_a_warning() -> None:
    text = '(defproblem p d ((at Rover0 a) (at ROVER0 b) (list (has rover0 Rover0)) (A 1)) ())'
    remarks = problem(text).remarks
    assert [remark.message for remark in remarks] == [
        'ROVER0 is Rover0, spelt differently: names have no case',
        'rover0 is Rover0, spelt differently: names have no case',
    ]
    assert [text[remark.column - 1 :][:6] for remark in remarks] == ['ROVER0', 'rover0']


@pytest.mark.parametrize(
    'text',
    [
        '((or (a ?y) (b ?y)) (call > ?y ?x))',
        '((not (a ?y)) (call > ?x 1))',
        '((assign ?y 1) (assign* ?z (list ?y)) (call > ?z 0))',
        '((setof ?y (a ?y) ?ys) (call length ?ys))',
        '((forall (?y) (a ?y) ((call > ?y ?x))))',
        '((forall (?y) (a ?y) ((assign ?z ?y) (call > ?z ?x))))',
        '(:sort-by ?y (a ?y))',
        '((:first (a ?y)) (call > ?y 1))',
        '((call variablep ?y) (a ?y))',
        '((a ?y (call + ?x 1)))',
    ],
)
def test_what_is_bound_before_it_is_computed_is_no_error(text: str) -> None:
    found = domain(f'(:method (m ?x) {text} ())')
    facts = problem('(defproblem p () ((a 1) (b 1)) ())')
    errors = [d for d in check_mission(found, facts) if d.severity == Severity.ERROR]
    assert errors == []


@pytest.mark.parametrize(
    'text',
    [
        '((call > ?y 1) (a ?y))',
        '((assign ?y (+ ?y 1)))',
        '((or (call > ?y 1) (b ?x)))',
        '((a ?x (call + ?y 1)))',
        '((not (call > ?y 1)))',
    ],
)
def test_what_is_not_bound_before_it_is_computed_is_an_error(text: str) -> None:
    found = domain(f'(:method (m ?x) {text} ())')
    facts = problem('(defproblem p () ((a 1) (b 1)) ())')
    (error,) = [d for d in check_mission(found, facts) if d.severity == Severity.ERROR]
    assert error.message == '?y in a call is bound by neither the head nor the preconditions'


def test_several_problems_and_domains_in_one_text() -> None:
    text = """
    (in-package :shop-user)
    (defun helper (x) "Lisp ( in a text" (format t "~a~%" x) `(a ,@x) #\\( )
    (defdomain (one :type pddl-domain :redefine-ok t) ((:method (m) () ())))
    (eval-when (:load-toplevel) (defdomain two ((:method (m) () ()) (:method (n) () ()))))
    (defproblem p1 one ((a)) ((m)))
    (defproblem (p2 :redefine-ok t) two nil (m) :redefine-ok t)
    #.(make-problem 'p3 'two '((a) (b 1)) '(:unordered (m) (n)))
    (defproblem p4 NIL (m))
    (find-plans 'p1 :verbose :plans)
    #+sbcl (defproblem p5 one () (m))
    #-sbcl (defproblem p6 one () (m))
    """
    source = Source('all.lisp', text)
    assert problem_names(source) == ['p1', 'p2', 'p3', 'p4', 'p6']
    third = read_problem(source, name='P3')
    assert (third.domain_name, len(third.facts)) == ('two', 2)
    assert isinstance(third.tasks, Unordered)
    fourth = read_problem(source, name='p4')
    assert (fourth.domain_name, fourth.facts) == ('', ())
    two = read_domain(source, name='two')
    assert len(two.methods) == 2
    assert ['Lisp is not evaluated' in d.message for d in two.remarks] == [True]
    with pytest.raises(MissionError, match='name one of p1, p2, p3, p4, p6'):
        read_problem(source)
    with pytest.raises(MissionError, match='has no problem p9: it has p1'):
        read_problem(source, name='p9')
    with pytest.raises(MissionError, match='the second of one, two'):
        read_domain(source)


@pytest.mark.parametrize(
    ('text', 'names'),
    [
        ('(:method (m ?x ?y) ((a ?x)) ())', ['?y']),
        ('(:method (m ?x) ((a ?x ?z)) ())', ['?z']),
        ('(:method (m ?x) ((a ?z)) ((!o ?z)) ((b ?x)) ())', []),
        ('(:method (m ?_x) ((a ?_)) ())', []),
        ('(:method (m ?x) ((assign ?z (+ ?x 1)) (call > ?z 1)) ())', []),
        ('(:method (m ?x) ((forall (?z) (a ?z) ((b ?x)))) ())', []),
        ('(:operator (!p ?x ?y) () () ((a ?x)))', ['?y']),
        ('(:operator (!p ?x ?y) () () ((a ?x)) ?y)', []),
        ('(Operator (!p ?x ?r) () ((agent ?r)) ((a ?x)))', []),
        ('(:method (m) () ()) (:- (a ?x) ((b ?y)))', ['?y', '?x']),
        ('(:- (a ?x ?x) ())(:method (m) () ())', []),
    ],
)
def test_variables_that_occur_once(text: str, names: list[str]) -> None:
    found = domain(text + ' (:operator (!o ?z) () () ((a ?z)))')
    remarks = check_mission(found, problem('(defproblem p () ((b 1)) ())'))
    once = [remark.message.split()[0] for remark in remarks if 'only once' in remark.message]
    assert sorted(once) == sorted(names)
    for remark in remarks:
        if 'only once' in remark.message:
            assert text[remark.column - 1 :].startswith(remark.message.split()[0])


def test_nothing_says_that_a_predicate_is_never_true_where_effects_are_variables() -> None:
    text = '(:operator (!!assert ?g) () () (?g) 0) (:method (m) ((goal ?x) (not (on ?x))) ())'
    found = domain(text)
    assert not [
        d for d in check_mission(found, problem('(defproblem p () () (m))')) if 'ever' in d.message
    ]


NAMES = st.text(st.sampled_from('abcxyz019-_+*!<>=:.%&@~^$'), min_size=1, max_size=8).filter(
    lambda text: (
        not text[0].isdigit()
        and '::' not in text
        and text not in {'.', 'nil'}
        and not NUMBER.fullmatch(text)
    )
)
ATOMS = NAMES | st.integers() | st.floats(allow_nan=False, allow_infinity=False)
GROUND = st.recursive(
    ATOMS,
    lambda inner: (
        st.lists(inner, max_size=4).map(tuple)
        | st.builds(chain, st.lists(inner, min_size=1, max_size=3).map(tuple), inner)
    ),
    max_leaves=15,
)


@given(st.lists(GROUND, max_size=4).map(tuple))
def test_what_is_shown_is_read_back(terms: tuple[Any, ...]) -> None:
    found = fact(show(('f', *terms)))
    assert found == ('f', *terms)
    assert show(found) == show(('f', *terms))
