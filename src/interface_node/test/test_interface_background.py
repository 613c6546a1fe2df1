"""A background executor ends whenever it is closed, with and without work."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
import rclpy.executors
from rclpy.context import Context
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from interface_node.background_node import BackgroundExecutor
from tests.support.spinning import DOMAIN, PATIENCE


@pytest.fixture
def node() -> Iterator[Node]:
    context = Context()
    rclpy.init(
        args=[],
        context=context,
        domain_id=DOMAIN,
        signal_handler_options=SignalHandlerOptions.NO,
    )
    node = Node('background', context=context, start_parameter_services=False)
    yield node
    node.destroy_node()
    rclpy.shutdown(context=context)


def closes(executor: BackgroundExecutor) -> bool:
    closing = threading.Thread(target=executor.close, daemon=True)
    closing.start()
    closing.join(PATIENCE)
    return not closing.is_alive()


def test_callbacks_are_run_until_it_is_closed(node: Node) -> None:
    executor = BackgroundExecutor(node)
    called = threading.Event()
    node.create_timer(0.01, called.set)
    assert called.wait(PATIENCE)
    assert closes(executor)
    called.clear()
    assert not called.wait(0.1)


def test_it_ends_although_it_is_closed_just_before_it_waits(
    node: Node, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What wakes it is gathered, but not yet waited on."""
    gathered, go_on = threading.Event(), threading.Event()

    def pause(*counts: int) -> Any:
        gathered.set()
        assert go_on.wait(PATIENCE)
        return original(*counts)

    original = rclpy.executors.NumberOfEntities
    monkeypatch.setattr(rclpy.executors, 'NumberOfEntities', pause)
    executor = BackgroundExecutor(node)
    assert gathered.wait(PATIENCE)
    later = threading.Timer(0.2, go_on.set)
    later.start()
    assert closes(executor)
    later.join()
