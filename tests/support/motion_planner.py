"""A motion planner node as a process of its own, and a client of it."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import rclpy
from geohtn_msgs import msg, srv
from rclpy.executors import SingleThreadedExecutor

from tests.support.processes import running
from tests.support.spinning import DOMAIN

PACKAGE = Path(__file__).resolve().parents[2] / 'src' / 'motion_planner_node'
ROVER = PACKAGE.parent / 'interface_node' / 'missions' / 'rover' / 'world.yaml'
DEADLINE = 60.0
START = msg.AgentState(agent='rover0', x=20.0, y=20.0, heading=0.0)


def start_node(*arguments: str) -> AbstractContextManager[subprocess.Popen[str]]:
    environment = os.environ | {
        'PYTHONPATH': os.pathsep.join([str(PACKAGE), os.environ.get('PYTHONPATH', '')]),
        'ROS_DOMAIN_ID': str(DOMAIN),
        'ROS_AUTOMATIC_DISCOVERY_RANGE': 'LOCALHOST',
        'PYTHONUNBUFFERED': '1',
    }
    return running(
        [sys.executable, '-X', 'faulthandler', '-m', 'motion_planner_node', *arguments],
        environment,
    )


def wait_until_ready(process: subprocess.Popen[str]) -> None:
    assert process.stdout is not None
    lines = []
    for line in process.stdout:
        lines.append(line)
        if line.rstrip().endswith(': ready'):
            return
    raise AssertionError('the node ended before it was ready:\n' + ''.join(lines))


class Asker:
    """A client of the node; every wait has a deadline."""

    def __init__(self) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context, domain_id=DOMAIN)
        self.node = rclpy.create_node('asker', context=self.context, namespace='tests')
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.events: list[Any] = []
        self.node.create_subscription(
            msg.PlanningEvent, '/planning_events', self.events.append, 100
        )

    def close(self) -> None:
        self.executor.shutdown()
        self.node.destroy_node()
        rclpy.shutdown(context=self.context)

    def spin_until(self, done: Callable[[], bool]) -> None:
        end = time.monotonic() + DEADLINE
        while not done():
            assert time.monotonic() < end, 'the node did not answer in time'
            self.executor.spin_once(timeout_sec=0.2)

    def call(self, kind: Any, name: str, **fields: Any) -> Any:
        client = self.node.create_client(kind, name)
        try:
            assert client.wait_for_service(timeout_sec=DEADLINE)
            return self.wait_for(client.call_async(kind.Request(**fields)))
        finally:
            self.node.destroy_client(client)

    def wait_for(self, future: Any) -> Any:
        self.spin_until(future.done)
        return future.result()

    def satisfy(self, preconditions: str, **fields: Any) -> Any:
        fields = {'start': [START]} | fields
        request = msg.GeometricRequest(preconditions=preconditions, **fields)
        return self.call(srv.SatisfyPreconditions, '/satisfy_preconditions', request=request).answer

    def advise(self, *preconditions: str, **fields: Any) -> Any:
        fields = {'start': [START]} | fields
        request = msg.AdviceRequest(preconditions=list(preconditions), **fields)
        return self.call(srv.Advise, '/advise', request=request).answer

    def set_world(self, text: str) -> Any:
        return self.call(srv.SetWorld, '/set_world', source='world.yaml', yaml=text)
