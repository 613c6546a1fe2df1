"""Signals stop a node wherever they meet its main thread, and leave no lock and no thread behind."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from types import FrameType
from typing import Any

import pytest

import interface_node.signals
import motion_planner_node.signals
import task_planner_node.signals

#: Each node has its own copy, as the packages depend on messages alone.
COPIES = [interface_node.signals, motion_planner_node.signals, task_planner_node.signals]
NODES = [copy.__name__.split('.')[0] for copy in COPIES]
INTERRUPTED_IMPORT = """
import signal, sys

class Interrupter:
    def find_spec(self, name, path=None, target=None):
        if name == 'rclpy':
            signal.raise_signal(signal.SIGINT)

sys.meta_path.insert(0, Interrupter())
from {name}.__main__ import main
sys.exit(main())
"""
#: [s]
PATIENCE = 20.0
#: Instructions; more than the main loop takes twice.
TWO_ROUNDS = 200


@pytest.fixture(params=COPIES, ids=NODES)
def signals(request: pytest.FixtureRequest) -> Iterator[Any]:
    before = {number: signal.getsignal(number) for number in request.param.STOPPING}
    try:
        yield request.param.StopSignals()
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_the_first_signal_interrupts_where_that_is_asked_for(
    signals: Any, number: signal.Signals
) -> None:
    with pytest.raises(KeyboardInterrupt), signals.interrupting():
        signal.raise_signal(number)
    signal.raise_signal(number)  # what is cleaned up then is not interrupted


def test_a_signal_from_before_interrupts_too(signals: Any) -> None:
    signal.raise_signal(signal.SIGTERM)
    with pytest.raises(KeyboardInterrupt), signals.interrupting():
        pytest.fail('this should not be reached')


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_elsewhere_it_is_waited_for(signals: Any, number: signal.Signals) -> None:
    with signals.interrupting():
        pass
    assert not signals.wait(0.01)
    signal.raise_signal(number)
    assert signals.wait(0.0)
    waking = threading.Timer(0.05, signal.pthread_kill, (threading.get_ident(), number))
    waking.start()
    assert signals.wait(PATIENCE)
    waking.join()


def test_an_interrupt_that_nobody_hears_is_noted(signals: Any) -> None:
    class Forgotten:
        def __del__(self) -> None:
            try:
                signal.raise_signal(signal.SIGTERM)
            except KeyboardInterrupt:
                return

    with signals.interrupting():
        Forgotten()
    assert signals.wait(0.0)


@pytest.mark.parametrize('name', NODES)
def test_a_signal_in_the_middle_of_the_imports_stops_a_node_without_a_word(name: str) -> None:
    done = subprocess.run(
        [sys.executable, '-c', INTERRUPTED_IMPORT.format(name=name)],
        capture_output=True,
        text=True,
        timeout=3 * PATIENCE,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, '', '')


def test_no_place_in_the_main_loop_is_a_wrong_one(signals: Any) -> None:
    """One signal at each instruction in turn, of the loop and of the library that it calls."""
    met = set()
    for instruction in range(1, TWO_ROUNDS):
        stopped = threading.Event()
        thread = threading.Thread(target=stopped.wait)
        thread.start()
        met.add(interrupted(signals, thread, instruction))
        assert thread.is_alive()
        stopped.set()
        thread.join()
    assert {'loop', 'is_alive', 'wait'} <= met


def interrupted(signals: Any, thread: threading.Thread, instruction: int) -> str:
    """Run a node's main loop with a signal at one instruction; the function that it met."""
    count, met = 0, ''

    def trace(frame: FrameType, event: str, _argument: object) -> Any:
        nonlocal count, met
        frame.f_trace_opcodes = True
        if event == 'opcode':
            count += 1
            if count == instruction:
                met = frame.f_code.co_name
                signal.raise_signal(signal.SIGINT)
        return trace

    def loop() -> None:
        while thread.is_alive() and not signals.wait(0.001):
            pass

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        loop()
    finally:
        sys.settrace(before)
    return met
