"""The SHOP reader: every form becomes what it means in the model, and nothing is evaluated."""

from __future__ import annotations

from typing import Any

import pytest

from task_planner_node.language.model import (
    And,
    Application,
    Assign,
    AssignEach,
    Atom,
    Collect,
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
    Or,
    Ordered,
    Pattern,
    Protection,
    SortBy,
    Spread,
    Stated,
    Unordered,
    Variable,
    show,
)
from task_planner_node.language.walk import variables_of
from tests.support.shop_texts import branch, condition, domain, fact, operator, written

X, Y = Variable('?x'), Variable('?y')


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
