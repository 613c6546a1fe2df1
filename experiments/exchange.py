"""A motion planner in a process of its own, and a client of it, for experiments on the service."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter
from typing import Any

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

#: [s] for the node to start, which includes compiling where nothing is compiled yet.
PATIENCE = 120.0
#: [s] after which a request is sent again: discovery can lose the first response.
LOST = 3.0
#: [s] for all exchanges of a client together, and for the node to end when it is asked to.
DEADLINE, GOODBYE = 600.0, 20.0

#: Sends a request of a type of service, and gives the response.
Exchange = Callable[[Any, Any], Any]


def own_namespace(name: str) -> str:
    """A namespace that no other process has."""
    return f'experiment_{name}_{os.getpid()}'


@contextmanager
def motion_planner(namespace: str, world: Path) -> Iterator[int]:
    """The motion planner's node with a world, in a process of its own; gives its id."""
    arguments = ['--ros-args', '-r', f'__ns:=/{namespace}', '-p', f'world:={world}']
    process = subprocess.Popen(
        [sys.executable, '-m', 'motion_planner_node', *arguments],
        stderr=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        yield process.pid
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.wait(GOODBYE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


@contextmanager
def client(namespace: str, services: Mapping[Any, str]) -> Iterator[Exchange]:
    """A function that sends a request to the motion planner and waits for the response.

    ``services`` are the names of the services by their types.
    """
    rclpy.init(args=[])
    node = Node('experiment', namespace=f'/{namespace}')
    executor = SingleThreadedExecutor()
    try:
        executor.add_node(node)
        clients = {kind: node.create_client(kind, name) for kind, name in services.items()}
        if not all(each.wait_for_service(PATIENCE) for each in clients.values()):
            raise SystemExit('the motion planner did not start')
        end = perf_counter() + DEADLINE

        def exchange(kind: Any, request: Any) -> Any:
            future, sent = clients[kind].call_async(request), perf_counter()
            while not future.done():
                executor.spin_once(1.0)
                if perf_counter() > end:
                    raise SystemExit(f'the exchanges took more than {DEADLINE:.0f} s')
                if perf_counter() - sent > LOST:
                    future, sent = clients[kind].call_async(request), perf_counter()
            return future.result()

        yield exchange
    finally:
        executor.shutdown()
        node.destroy_node()
        rclpy.try_shutdown()
