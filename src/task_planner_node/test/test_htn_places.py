"""Where the remarks about a failure point, and what they name as its cause."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from task_planner_node.errors import Diagnostic, Severity
from task_planner_node.oracle import (
    Advice,
    AdviceQuery,
    Answer,
    CandidateAdvice,
    Code,
    Query,
    Scope,
    Status,
    TextCheck,
)
from task_planner_node.outcomes import Outcome, Result

Plan = Callable[..., Result]
DOMAIN = """\
(defdomain inspection (
(Operator (!start_at ?r ?dock) ((dock ?dock))
  ((agent ?r)(object ?dock) (setProperty(?r.x, ?dock.x)))
  ((started ?r)))
(Operator (!read_gauge ?r ?gauge) ((gauge ?gauge)(started ?r))
  ((agent ?r)(object ?gauge)   ; two comments
   ; and a line of its own
   (distance(?r, ?gauge) >= ?gauge.size) (distance(?r, ?gauge) <= ?gauge.colour + 1))
  ((was_read ?gauge)))
(:method (read-all ?_robot nil) () ())
(:method (read-all ?r (?gauge . ?others)) ()
  (:unordered (!read_gauge ?r ?gauge) (read-all ?r ?others)))
))
"""
PROBLEM = """\
(defproblem round inspection
  ((dock dock0) (gauge boiler) (gauge pump))
  ((!start_at robot0 dock0)
   (read-all robot0 (boiler pump))))
"""


class Plant:
    """Finds everything but what a test says otherwise, by a word of the ground preconditions."""

    def __init__(
        self, answers: dict[str, Answer] | None = None, advice: dict[str, int] | None = None
    ) -> None:
        self.queries: list[Query] = []
        self._answers = answers or {}
        self._advice = advice or {}

    def check(self, text: str, _source: str, _line: int, _column: int) -> TextCheck:
        return TextCheck('setProperty' in text)

    def satisfy(self, query: Query) -> Answer:
        self.queries.append(query)
        for word, answer in self._answers.items():
            if word in query.preconditions:
                return answer
        return Answer(Status.FOUND, assigned='setProperty' in query.preconditions, length=1.0)

    def advise(self, query: AdviceQuery) -> Advice:
        codes = [
            next((code for word, code in self._advice.items() if word in text), 0)
            for text in query.preconditions
        ]
        candidates = tuple(CandidateAdvice(code=code) for code in codes)
        return Advice(candidates, tuple(i for i, code in enumerate(codes) if not code))


def place_of(diagnostic: Diagnostic) -> tuple[str, int, int, str]:
    return diagnostic.source, diagnostic.line, diagnostic.column, diagnostic.text


def error_of(result: Result) -> Diagnostic:
    (error,) = (d for d in result.diagnostics if d.severity == Severity.ERROR)
    return error


def test_the_mission_is_good_before_it_is_spoilt(plan: Plan) -> None:
    result = plan(DOMAIN, PROBLEM, Plant())
    assert result.outcome == Outcome.SOLVED
    assert not result.diagnostics


def test_a_task_that_never_ends_is_found_on_its_line(plan: Plan) -> None:
    domain = DOMAIN.replace('(:method (read-all ?_robot nil) () ())', '').replace(
        '(:unordered (!read_gauge ?r ?gauge) (read-all ?r ?others))',
        '((read-all ?r (?gauge . ?others)))',
    )
    result = plan(domain, PROBLEM, Plant())
    assert result.outcome == Outcome.NO_PLAN
    assert 'it decomposes into itself for ever' in result.explanation
    assert place_of(error_of(result)) == ('p.lisp', 4, 4, '(read-all robot0 (boiler pump))')


def test_a_task_that_lacks_its_base_case_is_found_on_its_line(plan: Plan) -> None:
    result = plan(DOMAIN.replace('(:method (read-all ?_robot nil) () ())', ''), PROBLEM, Plant())
    assert result.outcome == Outcome.NO_PLAN
    assert place_of(error_of(result)) == ('p.lisp', 4, 14, 'robot0')


@pytest.mark.parametrize('word', ['boiler.size', 'boiler.colour'])
def test_what_the_motion_planner_does_not_know_is_found_in_the_operator(
    plan: Plan, word: str
) -> None:
    class Strict(Plant):
        def satisfy(self, query: Query) -> Answer:
            column = query.preconditions.find(word) + 1
            if not column:
                return super().satisfy(query)
            remark = Diagnostic('unknown property', 1, column, word)
            return Answer(Status.ERROR, Code.UNKNOWN_PROPERTY, diagnostics=(remark,))

    result = plan(DOMAIN, PROBLEM, Strict())
    assert result.outcome == Outcome.INVALID
    source, line, column, text = place_of(error_of(result))
    assert (source, line) == ('d.lisp', 8)
    assert text == word.replace('boiler', '?gauge')
    assert DOMAIN.split('\n')[line - 1][column - 1 :].startswith(text)


@pytest.mark.parametrize(
    ('old', 'new', 'reason', 'place'),
    [
        (
            '(boiler pump)',
            '(boiler pmp)',
            'unknown object pmp: no fact speaks of it; did you mean pump?',
            (4, 29),
        ),
        (
            'robot0 dock0)',
            'robot0 boilr)',
            'nothing can make (dock boilr) true; unknown object boilr: no fact speaks of it',
            (3, 22),
        ),
        (
            '(dock dock0)',
            '(bay dock0)',
            'no fact or effect ever makes (dock dock0) true',
            (3, 4),
        ),
        ('(!start_at robot0 dock0)', '', 'nothing can make (started robot0) true', (4, 4)),
    ],
)
def test_an_object_that_no_fact_speaks_of_is_named(
    plan: Plan, old: str, new: str, reason: str, place: tuple[int, int]
) -> None:
    assert old in PROBLEM
    result = plan(DOMAIN, PROBLEM.replace(old, new), Plant())
    assert result.outcome == Outcome.NO_PLAN
    first = next(d for d in result.diagnostics if d.severity == Severity.ERROR)
    assert (first.line, first.column) == place
    assert first.message.endswith(reason)


def test_a_robot_that_no_fact_speaks_of_is_likened_to_robots(
    plan: Plan, rover_mission: tuple[str, str]
) -> None:
    domain, problem = rover_mission
    problem = problem.replace('has_photo_of rover0 location3', 'has_photo_of rover7 location3')
    result = plan(domain, problem, Plant())
    assert result.outcome == Outcome.NO_PLAN
    assert len(result.diagnostics) == 2
    lines = problem.split('\n')
    for diagnostic in result.diagnostics:
        assert 'did you mean rover0?' in diagnostic.message
        assert lines[diagnostic.line - 1][diagnostic.column - 1 :].startswith('rover7 location3')


def test_a_start_in_an_obstacle_is_named_once(plan: Plan) -> None:
    blocked = Answer(Status.IMPOSSIBLE, Code.START_IN_OBSTACLE, Scope.ANY_START, 'in an obstacle')
    result = plan(DOMAIN, PROBLEM, Plant({'setProperty': blocked}))
    assert result.outcome == Outcome.NO_PLAN
    assert error_of(result).message == '(!start_at robot0 dock0): in an obstacle'
    assert 'started' not in result.explanation


def test_what_is_dead_for_another_reason_than_the_start_is_named_too(plan: Plan) -> None:
    blocked = Answer(Status.IMPOSSIBLE, Code.START_IN_OBSTACLE, Scope.ANY_START, 'in an obstacle')
    problem = PROBLEM.replace('(boiler pump)', '(boiler pmp)')
    result = plan(DOMAIN.replace('(gauge ?gauge)', ''), problem, Plant({'setProperty': blocked}))
    assert [d.line for d in result.diagnostics if d.severity == Severity.ERROR] == [3]
    result = plan(DOMAIN, problem, Plant({'setProperty': blocked}))
    assert '(gauge pmp)' in result.explanation


def test_what_the_advice_calls_faulty_is_asked_for_first(
    plan: Plan, rover_mission: tuple[str, str]
) -> None:
    faulty = Answer(Status.ERROR, Code.UNKNOWN_OBJECT, message='no object location7')
    world = Plant({'object location7': faulty}, {'location7': int(Code.UNKNOWN_OBJECT)})
    result = plan(*rover_mission, world)
    assert result.outcome == Outcome.INVALID
    assert error_of(result).text == 'location7'
    assert len(world.queries) == 2
