"""The queue of requests: one at a time, in order, each of them can end early."""

from __future__ import annotations

import threading
from collections.abc import Callable

import pytest

from motion_planner_node.codes import Code
from motion_planner_node.errors import MotionPlannerError, Stopped
from motion_planner_node.turns import Turns

PATIENCE = 60.0


def wait_until(condition: Callable[[], bool]) -> None:
    pause = threading.Event()
    for _ in range(int(PATIENCE / 0.01)):
        if condition():
            return
        pause.wait(0.01)
    raise AssertionError('it did not come to that')


def take(turns: Turns, name: str, told: list[object], budget: float = PATIENCE) -> threading.Thread:
    """Take a turn in a thread, and tell its name or why there was none; returns once it waits."""

    def work() -> None:
        try:
            with turns.take(name, budget):
                told.append(name)
        except MotionPlannerError as error:
            told.append(error.code)

    before = len(turns)
    thread = threading.Thread(target=work)
    thread.start()
    wait_until(lambda: len(turns) > before or not thread.is_alive())
    return thread


def test_turns_come_one_at_a_time_in_the_order_in_which_they_were_asked_for() -> None:
    turns = Turns()
    told: list[object] = []
    with turns.take('first', PATIENCE) as turn:
        threads = [take(turns, name, told) for name in 'abcdef']
        assert not turn()
        assert told == []
    for thread in threads:
        thread.join(PATIENCE)
    assert told == list('abcdef')
    assert len(turns) == 0


def test_all_that_wait_or_run_under_an_id_are_cancelled_and_no_others() -> None:
    turns = Turns()
    told: list[object] = []
    with turns.take('mine', PATIENCE) as turn:
        threads = [take(turns, name, told) for name in ('mine', 'yours', 'mine')]
        assert turns.cancel('nobody') == 0
        assert turns.cancel('mine') == 3
        assert turns.cancel('mine') == 0
        assert turn()
        assert turn.code is Code.CANCELLED
        wait_until(lambda: len(told) == 2)
    for thread in threads:
        thread.join(PATIENCE)
    assert told == [Code.CANCELLED, Code.CANCELLED, 'yours']


def test_waiting_counts_for_the_budget() -> None:
    turns = Turns()
    told: list[object] = []
    with turns.take('first', PATIENCE):
        take(turns, 'hurried', told, 1e-9).join(PATIENCE)
        assert told == [Code.OUT_OF_TIME]
    with turns.take('next', PATIENCE) as turn:
        assert not turn()


def test_what_is_broken_off_says_why() -> None:
    now = [0.0]
    turns = Turns(lambda: now[0])

    def work(then: Callable[[], object]) -> None:
        with turns.take('', 5.0) as turn:
            assert not turn()
            then()
            assert turn()
            raise Stopped

    with pytest.raises(MotionPlannerError, match='was cancelled') as error:
        work(lambda: turns.cancel(''))
    assert error.value.code is Code.CANCELLED
    with pytest.raises(MotionPlannerError, match='budget ran out') as error:
        work(lambda: now.append(now.pop() + 6.0))
    assert error.value.code is Code.OUT_OF_TIME


def test_a_closed_queue_breaks_off_what_is_in_it_and_what_comes() -> None:
    turns = Turns()
    with turns.take('', 1e300) as turn:
        turns.close()
        assert turn()
    with turns.take('', PATIENCE) as turn:
        assert turn()
