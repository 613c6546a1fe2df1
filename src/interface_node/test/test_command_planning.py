"""Planning with nodes that are there, missing, dying, slow or refusing; no ROS needed."""

from __future__ import annotations

import io
import os
import signal
from collections.abc import Callable
from math import inf

import pytest

from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError, Interrupted
from interface_node.command_line.exit_codes import ExitCode, exit_code_of
from interface_node.command_line.goals import MissionGoal
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.missions import Mission, Source
from interface_node.command_line.planning import checking, plan_mission, report, wait_for_nodes
from interface_node.command_line.results import MissionResult, Progress
from interface_node.plan import Diagnostic, Plan, Step

SOURCE = Source('/abs/domain.lisp', 'domain.lisp', '(broken')
GOAL = MissionGoal(Mission('survey', {'domain': SOURCE}))
SOLVED = MissionResult(Plan('survey', 'SOLVED', steps=(Step(('!go', 'rover0')),)), ('a.json',))


class FakeClient:
    """Nodes that need some polls to appear and to plan."""

    def __init__(
        self,
        result: MissionResult | None = SOLVED,
        polls_to_appear: int = 0,
        polls_to_plan: int = 2,
        polls_to_vanish: float = inf,
        polls_to_fall_silent: float = inf,
        hidden: tuple[str, ...] = ('motion_planner_node', 'interface_node'),
    ):
        self.progress = Progress('searching')
        self.result: MissionResult | None = None
        self.cancelled = 0
        self.heard = 0
        self._to_silence = polls_to_fall_silent
        self._outcome = result
        self._to_appear = polls_to_appear
        self._to_plan = polls_to_plan
        self._to_vanish = polls_to_vanish
        self._started = False
        self._hidden = hidden

    def missing(self) -> tuple[str, ...]:
        self._to_appear -= 1
        self._to_vanish -= 1
        if self._to_appear >= 0 or self._to_vanish < 0:
            return self._hidden
        return ()

    def start(self, goal: MissionGoal) -> None:
        self._started = goal is GOAL

    def wait(self, seconds: float) -> bool:
        assert seconds <= 1.0
        self._to_silence -= 1
        self.heard += self._to_silence >= 0
        self._to_plan -= 1
        if self._to_plan > 0:
            return False
        self.result = self._outcome
        return self._started

    def cancel(self) -> None:
        self.cancelled += 1


def quiet() -> Console:
    return Console(io.StringIO(), io.StringIO(), {})


def nothing() -> None:
    """A check that finds nothing."""


def test_nodes_may_take_a_while_to_appear() -> None:
    wait_for_nodes(FakeClient(polls_to_appear=3), 60.0, '', nothing)


def test_missing_nodes_are_named_with_how_to_start_them() -> None:
    with pytest.raises(CommandError) as caught:
        wait_for_nodes(FakeClient(polls_to_appear=10**9), 0.0, 'team', nothing)
    assert caught.value.exit_code == 3
    assert 'motion_planner_node and interface_node are not running' in caught.value.message
    assert '`geohtn up --namespace team`' in caught.value.message


def test_of_a_node_that_speaks_for_the_others_no_more_is_asked_than_to_be_there() -> None:
    there = FakeClient(polls_to_appear=10**9, hidden=('motion_planner_node',))
    wait_for_nodes(there, 60.0, '', nothing, speaker='interface_node')
    none_there = FakeClient(polls_to_appear=10**9)
    with pytest.raises(CommandError, match='motion_planner_node and interface_node are not'):
        wait_for_nodes(none_there, 0.0, '', nothing, speaker='interface_node')


def test_a_check_ends_the_waiting_for_nodes() -> None:
    with pytest.raises(CommandError, match='died'):
        wait_for_nodes(FakeClient(polls_to_appear=10**9), 60.0, '', dying(after=2))


def test_a_mission_is_planned() -> None:
    client = FakeClient()
    assert plan_mission(client, GOAL, quiet(), nothing) is SOLVED
    assert client.cancelled == 0


def test_a_signal_cancels_the_mission() -> None:
    client = FakeClient(polls_to_plan=10**9)
    with Interrupts() as interrupts:
        os.kill(os.getpid(), signal.SIGINT)
        with pytest.raises(Interrupted) as caught:
            plan_mission(client, GOAL, quiet(), checking(interrupts, nothing))
    assert caught.value.signal_number == signal.SIGINT
    assert client.cancelled == 1


def test_a_dying_node_cancels_the_mission() -> None:
    client = FakeClient(polls_to_plan=10**9)
    with pytest.raises(CommandError, match='died'):
        plan_mission(client, GOAL, quiet(), dying(after=3))
    assert client.cancelled == 1


def test_an_interface_that_vanishes_ends_the_waiting() -> None:
    with pytest.raises(CommandError, match='went away') as caught:
        plan_mission(FakeClient(polls_to_plan=10**9, polls_to_vanish=3), GOAL, quiet(), nothing)
    assert caught.value.exit_code == 3


@pytest.mark.parametrize(('polls_to_fall_silent', 'polls_to_plan'), [(3, 100), (0, 10**9)])
def test_an_interface_that_falls_silent_ends_the_waiting(
    polls_to_fall_silent: int, polls_to_plan: int
) -> None:
    client = FakeClient(polls_to_plan=polls_to_plan, polls_to_fall_silent=polls_to_fall_silent)
    with pytest.raises(CommandError, match='interface_node no longer answers') as caught:
        plan_mission(client, GOAL, quiet(), nothing)
    assert caught.value.exit_code == 3
    assert client.cancelled == 1


def test_the_first_news_may_take_longer_than_others() -> None:
    client = FakeClient(polls_to_plan=100, polls_to_fall_silent=0)
    assert plan_mission(client, GOAL, quiet(), nothing) is SOLVED


def test_an_interface_that_tells_how_it_goes_is_waited_for() -> None:
    assert plan_mission(FakeClient(polls_to_plan=1000), GOAL, quiet(), nothing) is SOLVED


def test_a_refused_mission_is_told_why_and_what_to_do() -> None:
    with pytest.raises(CommandError, match='another mission is being planned: wait') as caught:
        plan_mission(FakeClient(result=None), GOAL, quiet(), nothing)
    assert caught.value.exit_code == 1


def dying(after: int) -> Callable[[], None]:
    left = [after]

    def check() -> None:
        left[0] -= 1
        if left[0] < 0:
            raise CommandError('it died', ExitCode.NO_NODE)

    return check


def test_a_plan_goes_to_standard_output() -> None:
    out, err = io.StringIO(), io.StringIO()
    assert report(SOLVED, GOAL, Console(out, err, {})) == 0
    assert out.getvalue().startswith('SOLUTION PLAN:\n1:(!go rover0)\n\n')
    assert out.getvalue().endswith('a.json\n')
    assert err.getvalue() == ''


@pytest.mark.parametrize(('warning', 'code'), [(False, 1), (True, 0)])
def test_a_file_that_could_not_be_written_is_told_beside_the_plan(
    *, warning: bool, code: int
) -> None:
    remark = Diagnostic('cannot be written: Not a directory', '/abs/out', warning=warning)
    plan = Plan('survey', 'SOLVED', str(remark), (remark,), steps=(Step(('!go', 'rover0')),))
    out, err = io.StringIO(), io.StringIO()
    assert report(MissionResult(plan), GOAL, Console(out, err, {})) == code
    assert out.getvalue().startswith('SOLUTION PLAN:\n1:(!go rover0)\n\n')
    severity = 'warning' if warning else 'error'
    assert err.getvalue() == f'/abs/out: {severity}: cannot be written: Not a directory\n'


def test_why_there_is_no_plan_goes_to_standard_error() -> None:
    out, err = io.StringIO(), io.StringIO()
    remark = Diagnostic('it is not closed', '/abs/domain.lisp', 1, 1, '(broken')
    plan = Plan('survey', 'INVALID', 'the domain is wrong\nline two', (remark,))
    assert report(MissionResult(plan), GOAL, Console(out, err, {})) == 2
    assert out.getvalue() == ''
    assert err.getvalue() == (
        'domain.lisp:1:1: error: it is not closed\n'
        '    (broken\n'
        '    ^~~~~~~\n'
        'geohtn: INVALID: the domain is wrong\n'
        '    line two\n'
    )


def test_an_explanation_does_not_repeat_the_diagnostics() -> None:
    remark = Diagnostic('it is not closed', '/abs/domain.lisp', 1, 1)
    for explanation, expected in (
        (str(remark), 'geohtn: INVALID: 1 error in the mission\n'),
        (f'{remark}\nmore', 'geohtn: INVALID: more\n'),
    ):
        err = io.StringIO()
        plan = Plan('survey', 'INVALID', explanation, (remark,))
        report(MissionResult(plan), GOAL, Console(io.StringIO(), err, {}))
        assert err.getvalue().endswith(f'    ^\n{expected}')


def test_without_an_explanation_that_is_said() -> None:
    err = io.StringIO()
    assert report(MissionResult(Plan('s', 'FAILED')), GOAL, Console(io.StringIO(), err, {})) == 1
    assert err.getvalue() == 'geohtn: FAILED: the nodes did not say why\n'


@pytest.mark.parametrize(
    ('outcome', 'code'),
    [
        ('SOLVED', 0),
        ('NO_PLAN', 2),
        ('LIMIT', 1),
        ('CANCELLED', 130),
        ('INVALID', 2),
        ('UNAVAILABLE', 3),
        ('FAILED', 1),
        ('outcome 77', 1),
    ],
)
def test_exit_codes_tell_outcomes_apart(outcome: str, code: int) -> None:
    assert exit_code_of(outcome) == code
