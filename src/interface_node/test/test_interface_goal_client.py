"""The client of actions takes no response before its request is noted."""

from __future__ import annotations

from threading import Event, Thread
from typing import Any

import pytest
from rclpy.action import ActionClient

from interface_node.goal_client_node import GoalClient

#: [s] until what has to happen counts as not happening.
DEADLINE = 10.0


@pytest.mark.parametrize(
    'send', ['send_goal_async', '_cancel_goal_async', '_get_result_async'], ids=str
)
def test_what_is_sent_is_noted_before_a_response_is_taken(
    send: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """rclpy's part is replaced by one that is in the middle of sending for as long as it is told."""
    sending, noted = Event(), Event()
    done: list[str] = []

    def slow(*_: Any, **__: Any) -> None:
        sending.set()
        assert noted.wait(DEADLINE)
        done.append('noted')

    monkeypatch.setattr(ActionClient, '__init__', lambda *_: None)
    monkeypatch.setattr(ActionClient, '__del__', lambda *_: None, raising=False)
    monkeypatch.setattr(ActionClient, send, slow)
    monkeypatch.setattr(ActionClient, 'take_data', lambda _: done.append('taken'))
    client = GoalClient()
    sender = Thread(target=getattr(client, send), args=('goal',))
    sender.start()
    assert sending.wait(DEADLINE)
    taker = Thread(target=client.take_data)
    taker.start()
    taker.join(0.1)
    noted.set()
    for thread in (sender, taker):
        thread.join(DEADLINE)
    assert done == ['noted', 'taken']
