"""Callbacks of a node in a thread of their own, for callers that wait elsewhere."""

from __future__ import annotations

from threading import Event, Thread

from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node


class BackgroundExecutor:
    """Runs the callbacks of `node` until it is closed; close it before the node and its context.

    The thread ends before the executor is shut down: that destroys the guard that would wake it, and
    a thread that was about to wait would do so for ever.
    """

    def __init__(self, node: Node) -> None:
        self._executor = SingleThreadedExecutor(context=node.context)
        self._executor.add_node(node)
        self._closed = Event()
        self._thread = Thread(target=self._spin, name=node.get_name(), daemon=True)
        self._thread.start()

    def close(self) -> None:
        """End the thread after the callback that it is in."""
        self._closed.set()
        self._executor.create_task(lambda: None)  # work ends spin_once; wake() alone does not
        self._thread.join()
        self._executor.shutdown()

    def _spin(self) -> None:
        while not self._closed.is_set():
            self._executor.spin_once()
