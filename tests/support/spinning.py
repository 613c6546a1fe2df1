"""A node in a context and threads of its own."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

#: Of this process alone; above 101 domains share ports with other programs.
DOMAIN = 1 + os.getpid() % 100
#: Longest wait [s].
PATIENCE = 20.0


@contextmanager
def spinning(
    make: Callable[[Context], Node],
    release: Callable[[Any], object] = lambda _: None,
    close: Callable[[Any], object] = lambda node: node.destroy_node(),
) -> Iterator[Any]:
    """The node that is made; in the end it is to ``release`` what waits, and to ``close``."""
    context = Context()
    rclpy.init(args=[], context=context, domain_id=DOMAIN)
    node = make(context)
    executor = MultiThreadedExecutor(num_threads=4, context=context)
    executor.add_node(node)

    stopped = threading.Event()

    def spin() -> None:
        while not stopped.is_set():
            executor.spin_once()

    thread = threading.Thread(target=spin)
    thread.start()
    try:
        yield node
    finally:
        release(node)
        stopped.set()
        executor.create_task(lambda: None)  # work ends spin_once
        thread.join()
        executor.shutdown(timeout_sec=PATIENCE)
        close(node)
        rclpy.shutdown(context=context)
