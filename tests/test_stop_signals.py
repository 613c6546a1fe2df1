"""Signals stop a node wherever they meet its main thread, and leave no lock and no thread behind."""

from __future__ import annotations

import inspect
import os
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Any

import pytest

import interface_node.signals
import motion_planner_node.signals
import task_planner_node.signals
from tests.support.processes import output_of, running
from tests.support.spinning import DOMAIN, PATIENCE

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
INTERRUPTED_BUILDING = """
import signal, sys
from rclpy.node import Node

create, calls = Node.create_{kind}, []

def interrupted(*words, **more):
    calls.append(words)
    if len(calls) == {number}:
        signal.raise_signal(signal.SIGINT)
    return create(*words, **more)

Node.create_{kind} = interrupted
from {name}.__main__ import main
sys.exit(main())
"""
#: What is made when the signal comes: in the base class of the node, in its middle, and at its end.
MOMENTS = [
    *((name, 'publisher', 1) for name in NODES),
    *((name, 'service', 1) for name in NODES),
    ('interface_node', 'client', 1),
    ('task_planner_node', 'client', 1),
    ('task_planner_node', 'service', 7),
    ('motion_planner_node', 'service', 7),
]
#: Calls and returns; more than there are in two rounds of the main loop.
TWO_ROUNDS = 50


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
    signal.raise_signal(number)
    assert signals.exit_code(looks(1)) == 0
    waking = threading.Timer(0.05, signal.pthread_kill, (threading.get_ident(), number))
    waking.start()
    assert signals.exit_code(looks(20)) == 0
    waking.join()


def test_a_node_that_ends_by_itself_has_failed(signals: Any) -> None:
    assert signals.exit_code(looks(1)) == 1


def test_an_interrupt_that_nobody_hears_is_noted(signals: Any) -> None:
    class Forgotten:
        def __del__(self) -> None:
            try:
                signal.raise_signal(signal.SIGTERM)
            except KeyboardInterrupt:
                return

    with signals.interrupting():
        Forgotten()
    assert signals.exit_code(looks(1)) == 0


def looks(most: int) -> Callable[[], bool]:
    """Something that is alive for so many looks."""
    left = iter(range(most))
    return lambda: next(left, None) is not None


@pytest.mark.parametrize('name', NODES)
def test_a_signal_in_the_middle_of_the_imports_stops_a_node(name: str) -> None:
    assert stops_without_complaint(INTERRUPTED_IMPORT.format(name=name))


@pytest.mark.parametrize(('name', 'kind', 'number'), MOMENTS)
def test_a_signal_while_it_is_built_stops_a_node(name: str, kind: str, number: int) -> None:
    script = INTERRUPTED_BUILDING.format(name=name, kind=kind, number=number)
    assert stops_without_complaint(script)


def stops_without_complaint(script: str) -> bool:
    """Whether a script ends with 0, and says no more than that the node was ready."""
    environment = {**os.environ, 'ROS_DOMAIN_ID': str(DOMAIN)}
    with running([sys.executable, '-X', 'faulthandler', '-c', script], environment) as process:
        output = output_of(process, PATIENCE)
    assert process.returncode == 0, output
    return re.fullmatch(r'(.*: ready\n)?', output) is not None


def test_all_nodes_heed_signals_alike() -> None:
    assert len({inspect.getsource(copy) for copy in COPIES}) == 1


def test_no_place_in_the_main_loop_is_a_wrong_one(
    signals: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One signal at each call and each return in turn, in the loop and in the library under it."""
    monkeypatch.setattr(f'{type(signals).__module__}.PERIOD', 0.001)
    met = set()
    for event in range(1, TWO_ROUNDS):
        stopped = threading.Event()
        thread = threading.Thread(target=stopped.wait, daemon=True)
        thread.start()
        met.add(interrupted(signals, thread, event))
        assert thread.is_alive()
        stopped.set()
        thread.join()
    assert {'exit_code', 'is_alive'} <= met


def interrupted(signals: Any, thread: threading.Thread, event: int) -> str:
    """Run a node's main loop with a signal at one call or return; the function that it met."""
    count, met = 0, ''

    def look(frame: FrameType, _event: str, _argument: object) -> None:
        nonlocal count, met
        count += 1
        if count == event:
            met = frame.f_code.co_name
            signal.raise_signal(signal.SIGINT)

    before = sys.getprofile()
    sys.setprofile(look)
    try:
        assert signals.exit_code(thread.is_alive) == 0
    finally:
        sys.setprofile(before)
    return met
