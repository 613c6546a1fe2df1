"""Bad missions: every fault is named with its file, line and column."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from task_planner_node.errors import Severity
from task_planner_node.oracle import Answer, Oracle, Query, Status
from task_planner_node.outcomes import Outcome, Result

Plan = Callable[..., Result]

DOMAIN = """\
(defdomain d (
(:operator (!move ?a ?b)
  ((at ?a))
  ((at ?a))
  ((at ?b)))
(:method (go ?b)
  ((at ?a))
  ((!move ?a ?b)))
))
"""
PROBLEM = '(defproblem p d ((at home)) ((go work)))'


def changed(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new, 1)


def test_the_mission_is_good_before_it_is_spoilt(plan: Plan) -> None:
    result = plan(DOMAIN, PROBLEM)
    assert result.outcome == Outcome.SOLVED
    assert [step.action for step in result.steps] == [('!move', 'home', 'work')]
    assert not result.diagnostics


@pytest.mark.parametrize(
    ('old', 'new', 'line', 'column', 'message'),
    [
        ('(:method', '(:metod', 6, 1, 'did you mean :method?'),
        ('(!move ?a ?b)))', '(!moove ?a ?b)))', 8, 4, 'did you mean !move?'),
        ('((!move ?a ?b)', '((!move ?a)', 8, 4, '!move takes 2 arguments, not 1'),
        ('((at ?b)))\n', '((at ?c)))\n', 5, 4, '?c in an effect is bound by neither'),
        ('(!move ?a ?b)\n', '(move ?a ?b)\n', 2, 12, "begins with '!'"),
        ('(:method (go', '(:method (!go', 6, 10, 'names an operator'),
        (
            '  ((at ?a))\n  ((!',
            '  ((call > 1 ?c))\n  ((!',
            7,
            4,
            '?c in a call is bound by neither',
        ),
        (
            '  ((at ?a))\n  ((!',
            '  ((call leap 1))\n  ((!',
            7,
            10,
            'leap is no function of a domain',
        ),
        ('  ((at ?a))\n  ((!', '  ((eval (zzz "x")))\n  ((!', 7, 11, 'Lisp is not evaluated'),
        ('  ((at ?a))\n  ((!', '  ((eval *now*))\n  ((!', 7, 10, 'a variable of Lisp'),
        ('  ((at ?a))\n  ((!', '  ((call car 1 2))\n  ((!', 7, 4, 'car takes 1 arguments, not 2'),
        ('  ((at ?a))\n  ((!', '  (forall (?x) ())\n  ((!', 7, 3, 'and not 2 parts'),
        ('  ((at ?a))\n  ((!', '  (not (at ?a) (at ?b))\n  ((!', 7, 3, 'exactly one'),
        ('  ((at ?a))\n  ((!', '  at\n  ((!', 8, 3, 'a branch has preconditions and tasks'),
        ('((at ?b)))\n', '((at |b c|)))\n', 5, 8, 'not supported'),
        ('((at ?b)))\n', '((at #xff)))\n', 5, 8, 'not supported'),
        ('((at ?b)))\n', "((at ?b ')))\n", 5, 11, "nothing stands behind '"),
        ('((at ?b)))\n', "((at ''''''''''b)))\n", 5, 9, 'more than 8 marks in a row'),
        ('((at ?b)))\n', '((at ?b . c)))\n', 5, 11, "no '.' here"),
        ('((at ?b)))\n', '((at (?b . c d))))\n', 5, 12, "a '.' can only"),
        ('((at ?b)))\n', '((at (. ?b))))\n', 5, 9, 'an element has to stand before'),
        ('((at ?b)))\n', f'((at {"9" * 400})))\n', 5, 8, 'too large'),
        ('((at ?b)))\n', '((at 1e999)))\n', 5, 8, 'too large'),
        ('((at ?b)))\n', '((at ?b)) often)\n', 5, 13, 'is a number'),
        ('((at ?b)))\n', '((at ?b)) -1)\n', 5, 13, 'not negative'),
        ('((at ?b)))\n', '((at ?b)) (+ ?c 1))\n', 5, 13, '?c in the cost is bound by neither'),
        ('((at ?b)))\n', '((not (at ?b))))\n', 5, 4, 'belongs into its delete list'),
        ('((at ?b)))\n', '((at "b)))\n', 5, 8, 'the string that begins here does not end'),
        ('((at ?b)))\n', '((at b))) #| \n', 5, 13, '|# is missing'),
        ('\n  ((at ?a))\n  ((at ?b)))\n', ')\n', 2, 1, 'has 2 fields'),
        ('(defdomain d (', '(defdomain (d (', 1, 1, 'not closed'),
        ('(:method', '(Operator (!x) () ())\n(:method', 6, 1, 'has 3'),
        (
            '(:method',
            '(Operator (!x) () () fast () ())\n(:method',
            6,
            22,
            'behaviour constraints, a',
        ),
        ('(:method', '(:op (!x) :addd ())\n(:method', 6, 11, 'did you mean :add?'),
        ('(:method', '(:op (!x) :add () :add ())\n(:method', 6, 19, ':add is given twice'),
        ('(:method', '(:op (!x) :add)\n(:method', 6, 1, 'nothing stands behind :add'),
        ('(:method (go', '(:method (go (call + 1 2)) () ())\n(:method (go', 6, 14, 'not computed'),
        ('(:method', '(:operator (!move ?a ?b) () () ())\n(:method', 6, 12, 'line 2, column 12'),
        (
            '(:method',
            '(Operator (!x ?r) () ((agent ?r)(object ?o)) ())\n(:method',
            6,
            41,
            '?o in the geometric preconditions is bound by neither',
        ),
    ],
)
def test_a_bad_domain_is_refused_with_its_place(
    plan: Plan, old: str, new: str, line: int, column: int, message: str
) -> None:
    result = plan(changed(DOMAIN, old, new), PROBLEM)
    assert result.outcome == Outcome.INVALID
    found = [(d.source, d.line, d.column) for d in result.diagnostics if message in d.message]
    assert found == [('d.lisp', line, column)], result.explanation


@pytest.mark.parametrize(
    ('text', 'line', 'column', 'message'),
    [
        ('(defproblem p d ((at home)) ((go work))', 1, 1, 'not closed'),
        ('(defproblem p d ((at home)) ((go work))))', 1, 41, "unexpected ')'"),
        ('(defproblem p\n e ((at home)) ((go work)))', 2, 2, 'the domain is d'),
        ('(defproblem p d ((at ?x)) ((go work)))', 1, 18, 'no variables: ?x'),
        ('(defproblem p d ((at (call + 1 2))) ((go work)))', 1, 18, 'not computed'),
        ('(defproblem p d (at home) ((go work)))', 1, 18, 'a fact'),
        ('(defproblem p d ((at home)) ((fly work)))', 1, 30, 'no method is defined'),
        ('(defproblem p d ((at home)) ((go work now)))', 1, 30, 'go takes 1 arguments, not 2'),
        ('(defproblem p d ((at home)))', 1, 1, 'this one has 3 fields'),
        ('(defprobelm p d ((at home)) ((go work)))', 1, 1, 'did you mean defproblem?'),
        ('', 0, 0, 'no problem'),
        (f'{PROBLEM}\n{PROBLEM}', 2, 1, 'second'),
        (f'{PROBLEM}\n(garbage)', 2, 1, '(garbage) is neither a problem nor a definition'),
        (f'{PROBLEM} word', 1, 42, 'word is neither a problem nor a definition'),
        (f'{PROBLEM}\n(:metod (x) () ())', 2, 1, 'did you mean :method?'),
    ],
)
def test_a_bad_problem_is_refused_with_its_place(
    plan: Plan, text: str, line: int, column: int, message: str
) -> None:
    result = plan(DOMAIN, text or '; nothing')
    assert result.outcome == Outcome.INVALID
    found = [(d.source, d.line, d.column) for d in result.diagnostics if message in d.message]
    assert found[:1] == [('p.lisp', line, column)], result.explanation


def test_all_errors_are_told_at_once(plan: Plan) -> None:
    domain = changed(
        changed(DOMAIN, '((!move ?a ?b)', '((!moove ?a ?b)'), '((at ?b)))\n', '((at ?c)))\n'
    )
    result = plan(domain, changed(PROBLEM, 'p d', 'p e'))
    errors = [d for d in result.diagnostics if d.severity == Severity.ERROR]
    assert [(d.source, d.line) for d in errors] == [
        ('d.lisp', 5),
        ('d.lisp', 8),
        ('p.lisp', 1),
    ]


def test_a_misspelt_predicate_is_a_warning_and_the_reason_why_there_is_no_plan(plan: Plan) -> None:
    result = plan(changed(DOMAIN, '((at ?a))\n  ((!', '((att ?a))\n  ((!'), PROBLEM)
    assert result.outcome == Outcome.NO_PLAN
    warning = next(d for d in result.diagnostics if d.severity == Severity.WARNING)
    assert (warning.source, warning.line, warning.column) == ('d.lisp', 7, 4)
    assert warning.message == 'no fact or effect ever makes (att ?a) true; did you mean at?'
    assert (
        '(go work): no fact or effect ever makes (att ?a) true; did you mean at?'
        in result.explanation
    )
    place = next(d for d in result.diagnostics if d.severity == Severity.ERROR)
    assert (place.source, place.line, place.column) == ('p.lisp', 1, 34)


def test_a_predicate_with_another_number_of_arguments_is_a_warning(plan: Plan) -> None:
    result = plan(DOMAIN, '(defproblem p d ((at home)(at home now)) ((go work)))')
    assert result.outcome == Outcome.SOLVED
    result = plan(changed(DOMAIN, '((at ?a))\n  ((!', '((at ?a)(at ?a ?b))\n  ((!'), PROBLEM)
    assert any('at has 1 arguments elsewhere, not 2' in d.message for d in result.diagnostics)


class Refusing:
    """Knows no object but location0."""

    def __init__(self, base: Oracle, code: int, message: str) -> None:
        self._base = base
        self._code = code
        self._message = message
        self.check = base.check
        self.advise = base.advise

    def satisfy(self, query: Query) -> Answer:
        if 'location3' in query.preconditions:
            return Answer(Status.ERROR, self._code, message=self._message)
        return self._base.satisfy(query)


def test_an_object_that_the_world_lacks_is_found_in_the_problem(
    plan: Plan, rover_mission: tuple[str, str], rover_motion_planner: Callable[[], Oracle]
) -> None:
    oracle = Refusing(rover_motion_planner(), 302, 'the world has no object location3')
    result = plan(*rover_mission, oracle)
    assert result.outcome == Outcome.INVALID
    (diagnostic,) = result.diagnostics
    lines = rover_mission[1].split('\n')
    assert diagnostic.source == 'p.lisp'
    assert lines[diagnostic.line - 1] == '(has_photo_of rover0 location3)'
    assert lines[diagnostic.line - 1][diagnostic.column - 1 :].startswith('location3')


def test_a_changed_world_is_no_fault_of_the_mission(
    plan: Plan, rover_mission: tuple[str, str], rover_motion_planner: Callable[[], Oracle]
) -> None:
    oracle = Refusing(rover_motion_planner(), 308, 'the world was replaced')
    result = plan(*rover_mission, oracle)
    assert result.outcome == Outcome.FAILED
    assert 'the world was replaced' in result.explanation


def test_a_property_that_the_world_lacks_is_found_in_the_domain(
    plan: Plan, rover_mission: tuple[str, str], rover_motion_planner: Callable[[], Oracle]
) -> None:
    oracle = Refusing(rover_motion_planner(), 304, 'location3 has no property height')
    result = plan(*rover_mission, oracle)
    assert result.outcome == Outcome.INVALID
    (diagnostic,) = result.diagnostics
    assert diagnostic.source == 'd.lisp'
    before = rover_mission[0].split('\n')[: diagnostic.line - 1]
    assert before[-1] == ';; geometric preconditions'
    assert '!take_photo' in '\n'.join(before)
