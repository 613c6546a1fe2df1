"""The SHOP reader: every form becomes what it means in the model, and nothing is evaluated."""

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
    Application,
    Assign,
    AssignEach,
    Atom,
    Branch,
    Collect,
    Domain,
    Dotted,
    Enforce,
    Exists,
    First,
    Forall,
    ForEach,
    Holds,
    Immediate,
    Imply,
    Not,
    Operator,
    Or,
    Ordered,
    Pattern,
    Problem,
    Protection,
    SortBy,
    Spread,
    Stated,
    Unordered,
    Variable,
    chain,
    show,
)
from task_planner_node.language.terms import NUMBER
from task_planner_node.language.walk import variables_of

X, Y = Variable('?x'), Variable('?y')


def domain(text: str) -> Domain:
    return read_domain(Source('d.lisp', text))


def operator(text: str) -> Operator:
    (found,) = domain(text).operators
    return found


def branch(text: str) -> Branch:
    (method,) = domain(f'(:method (m ?x) {text})').methods
    (found,) = method.branches
    return found


def condition(text: str) -> Any:
    """The only condition in a list of conditions."""
    found = branch(f'({text}) ()').condition
    assert isinstance(found, And)
    (only,) = found.conditions
    return only


def problem(text: str, **options: Any) -> Problem:
    return read_problem(Source('p.lisp', text), **options)


def fact(text: str) -> tuple[Any, ...]:
    (found,) = problem(f'(defproblem p d ({text}) ())').facts
    return (found.name, *found.args)


def written(found: object) -> str:
    assert isinstance(found, Atom)
    return show(found)


@pytest.mark.parametrize(
    ('text', 'terms'),
    [
        ('(f a B nil ())', ('f', 'a', 'B', (), ())),
        ('(f 1 -2 +3 4. 2.5 -.5 1e3 1.5E-3)', ('f', 1, -2, 3, 4, 2.5, -0.5, 1000.0, 0.0015)),
        ('(f 1+ - + 1/2 a1 2b :key)', ('f', '1+', '-', '+', '1/2', 'a1', '2b', ':key')),
        ('(f (a (b)) (a . (b c)) (a . nil))', ('f', ('a', ('b',)), ('a', 'b', 'c'), ('a',))),
        ('(f (a . b) (a . (b . c)))', ('f', Dotted(('a',), 'b'), Dotted(('a', 'b'), 'c'))),
        ("(f 'a '(b c) (quote d) `(e f))", ('f', 'a', ('b', 'c'), 'd', ('e', 'f'))),
        ('(f "two words" "a \\" b")', ('f', '"two words"', '"a \\" b"')),
        ('(f a ; (comment\n b #| more #| nested |# |# c)', ('f', 'a', 'b', 'c')),
        ('(f #+sbcl a #-sbcl b pkg::c #:d)', ('f', 'b', 'c', 'd')),
    ],
)
def test_ground_terms(text: str, terms: tuple[Any, ...]) -> None:
    found = fact(text)
    assert found == terms
    assert [type(term) for term in found] == [type(term) for term in terms]


def test_terms_with_variables() -> None:
    found = branch("() (t ?x (a ?x) (?x . ?y) ((a . ?x)) (call + ?x 1) (eval (car '(a ?x))))").tasks
    assert isinstance(found, Atom)
    assert found.args[:4] == (
        X,
        Pattern(('a', X)),
        Pattern((X,), Y),
        Pattern((Pattern(('a',), X),)),
    )
    plus, car = found.args[4:]
    assert isinstance(plus, Application)
    assert (plus.function, plus.arguments) == ('+', (X, 1))
    assert isinstance(car, Application)
    assert (car.function, car.arguments) == ('car', (Pattern(('a', X)),))
    assert show(found) == '(t ?x (a ?x) (?x . ?y) ((a . ?x)) (call + ?x 1) (call car (a ?x)))'


def test_anonymous_variables_are_all_different() -> None:
    found = branch('((a ?_ ?_) (b ?_z ?_z)) ()').condition
    assert isinstance(found, And)
    names = {n for atom in found.conditions if isinstance(atom, Atom) for n in variables_of(atom)}
    assert len(names) == 4
    assert show(found.conditions[0]) == '(a ?_ ?_)'


def test_every_condition() -> None:
    assert isinstance(branch('nil ()').condition, And)
    assert written(branch('(at ?x) ()').condition) == '(at ?x)'
    both = condition('(and (a) (or (b) (c)) ())')
    assert isinstance(both, And)
    assert isinstance(both.conditions[1], Or)
    assert isinstance(condition('(NOT (a))'), Not)
    imply = condition('(imply (a ?x) (b ?x))')
    assert isinstance(imply, Imply)
    assert [written(imply.premise), written(imply.conclusion)] == ['(a ?x)', '(b ?x)']
    forall = condition('(forall (?y) (a ?y) ((b ?y) (c)))')
    assert isinstance(forall, Forall)
    assert forall.variables == (Y,)
    assert written(forall.domain) == '(a ?y)'
    assert isinstance(forall.condition, And)
    assert condition('(forall ?y (a ?y) (b ?y))').variables == (Y,)
    exists = condition('(exists (?y) (a ?y))')
    assert isinstance(exists, Exists)
    assert written(exists.domain) == '(a ?y)'
    assign = condition('(assign ?y (+ ?x 1))')
    assert isinstance(assign, Assign)
    assert assign.variable == Y
    assert isinstance(condition("(assign* ?y '(a b))"), AssignEach)
    assert condition("(assign* ?y '(a b))").expression == ('a', 'b')
    for text in ('(eval (> ?x 1))', '(call > ?x 1)', '(eval > ?x 1)', "(call > (quote ?x) '1)"):
        test = condition(text)
        assert isinstance(test, Holds)
        assert isinstance(test.expression, Application)
        assert (test.expression.function, test.expression.arguments) == ('>', (X, 1))
    for word, distinct in (('setof', True), ('bagof', False)):
        collect = condition(f'({word} (pair ?y) (a ?y) ?all)')
        assert isinstance(collect, Collect)
        assert collect.distinct == distinct
        assert collect.term == Pattern(('pair', Y))
        assert collect.variable == Variable('?all')
    enforce = condition('(enforce (a ?x) "no a for" \'?x)')
    assert isinstance(enforce, Enforce)
    assert enforce.message == ('"no a for"', X)
    stated = condition('?x')
    assert isinstance(stated, Stated)
    assert stated.variable == X
    first = branch('(:first (a ?y) (b ?y)) ()').condition
    assert isinstance(first, First)
    assert isinstance(first.condition, And)


@pytest.mark.parametrize(
    ('text', 'comparison'),
    [
        ('(:sort-by ?y (a ?y))', '<'),
        ("(:sort-by ?y #'> (a ?y))", '>'),
        ("(:sort-by ?y '>= ((a ?y)))", '>='),
        ('(:sort-by (* ?y ?y) > (and (a ?y)))', '>'),
    ],
)
def test_sorting(text: str, comparison: str) -> None:
    found = branch(f'{text} ()').condition
    assert isinstance(found, SortBy)
    assert found.comparison == comparison
    assert found.key == Y or isinstance(found.key, Application)


def test_task_lists() -> None:
    nested = branch(
        '() (:ordered (a) (:unordered (b ?x) ((c) (d))) (:task e) (:task :immediate f 1))'
    )
    assert isinstance(nested.tasks, Ordered)
    first, middle, plain, last = nested.tasks.items
    assert written(first) == '(a)'
    assert isinstance(middle, Unordered)
    assert isinstance(middle.items[1], Ordered)
    assert written(plain) == '(e)'
    assert isinstance(last, Immediate)
    assert written(last.task) == '(f 1)'
    for text in ('(:immediate a ?x)', '(:task :immediate a ?x)', '(:immediate (a ?x))'):
        immediate = branch(f'() {text}').tasks
        assert isinstance(immediate, Immediate)
        assert written(immediate.task) == '(a ?x)'
    assert isinstance(branch("() '((a) (b))").tasks, Ordered)
    for text in ('nil', '()', "'()"):
        nothing = branch(f'() {text}').tasks
        assert isinstance(nothing, Ordered)
        assert nothing.items == ()


def test_methods_have_names_and_so_have_their_branches() -> None:
    (method,) = domain(
        '(:method deliver (m ?x) near (a) () far ((b) (c)) ((m ?x)) () (m 1))'
    ).methods
    assert method.name == 'deliver'
    assert [b.name for b in method.branches] == ['near', 'far', '']
    (axiom,) = domain('(:method (m) () ()) (:- (a ?x) one (b ?x) () two ((c) (d)))').axioms
    assert axiom.names == ('one', '', 'two')
    assert len(axiom.bodies) == 3


def test_the_effects_of_operators() -> None:
    found = operator(
        '(:operator (!o ?x ?l) ((a ?x)) (?x (:protection (at ?x)) (forall (?y) (on ?y ?x) ((on ?y ?x))))'
        ' ((b ?x (call + 1 2)) (:protection (not (c ?x))) (:protection ?x) (when (d) ((e) (f)))) (* 2 ?x))'
    )
    whole, released, for_each = found.deletes
    assert whole == X
    assert isinstance(released, Protection)
    assert released.positive
    assert isinstance(for_each, ForEach)
    assert for_each.variables == (Y,)
    added, negative, given, conditional = found.adds
    assert written(added) == '(b ?x (call + 1 2))'
    assert isinstance(negative, Protection)
    assert not negative.positive
    assert isinstance(given, Protection)
    assert given.literal == X
    assert isinstance(conditional, ForEach)
    assert conditional.variables == ()
    assert len(conditional.effects) == 2
    assert isinstance(found.cost, Application)
    spread = operator('(:operator (!o ?d ?a) () ?d ?a)')
    assert isinstance(spread.deletes[0], Spread)
    assert isinstance(spread.adds[0], Spread)
    assert written(operator('(:operator (!o) () () (a 1))').adds[0]) == '(a 1)'


@pytest.mark.parametrize(
    ('text', 'conditions', 'cost'),
    [
        ('(:operator (!o ?x) ((p ?x)) ((d)) ((a)))', 1, 1.0),
        ('(:operator (!o ?x) ((p ?x)) ((d)) ((a)) 7)', 1, 7),
        ('(:operator (!o ?x) ((d)) ((a)))', 0, 1.0),
        ('(:operator (!o ?x) ((d)) ((a)) 7)', 0, 7),
        ('(:op (!o ?x) :precond (and (p ?x)) :delete ((d)) :add ((a)) :cost 7)', 1, 7),
        ('(:op (!o ?x) :add ((a)) :delete ((d)))', 0, 1.0),
    ],
)
def test_operators_in_all_syntaxes(text: str, conditions: int, cost: float) -> None:
    found = operator(text)
    assert written(found.head) == '(!o ?x)'
    assert isinstance(found.condition, And)
    assert len(found.condition.conditions) == conditions
    assert [written(effect) for effect in found.deletes] == ['(d)']
    assert [written(effect) for effect in found.adds] == ['(a)']
    assert found.cost == cost


GEOMETRIC = '((agent ?R)(object a) (?r.x >= 1)) ; note'
BEHAVIOUR = '(slow ?r)'
REFERENCE = '(end ?r)'


PAPER = f'(Operator (!o ?r) ((p ?r)) {GEOMETRIC}\n {BEHAVIOUR} ((a)(not (d))) {REFERENCE})'
SHOP = f"""(:op (!o ?r) :precond (p ?r) :delete ((d)) :add ((a)) :geometric {GEOMETRIC}
 :behaviour {BEHAVIOUR} :geometric-effects {REFERENCE})"""


@pytest.mark.parametrize('text', [PAPER, SHOP])
def test_the_six_fields_of_definition_1(text: str) -> None:
    found = operator(text)
    assert [written(effect) for effect in found.deletes] == ['(d)']
    assert [written(effect) for effect in found.adds] == ['(a)']
    assert found.geometric is not None
    assert found.geometric.text == '((agent ?r)(object a) (?r.x >= 1))'
    assert found.behaviour is not None
    assert found.behaviour.text == BEHAVIOUR
    assert found.reference is not None
    assert found.reference.text == REFERENCE


def test_conditional_effects_in_the_papers_list() -> None:
    found = operator('(Operator (!o ?x) () () ((forall (?y) (on ?y) ((a ?y) (not (b ?y))))))')
    (delete,), (add,) = found.deletes, found.adds
    assert isinstance(delete, ForEach)
    assert isinstance(add, ForEach)
    assert [written(effect) for effect in delete.effects] == ['(b ?y)']
    assert [written(effect) for effect in add.effects] == ['(a ?y)']


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
