"""Starting and stopping: nothing is left behind, and a missing node is named."""

from __future__ import annotations

import os
import re
import signal
import time
from pathlib import Path

from tests.support.missions import ROVER
from tests.support.motion_planner import wait_until_ready
from tests.support.processes import geohtn, node_command, processes_in_namespace, running, started

#: [s] within which Ctrl-C has to end a search.
STOP_WITHIN = 1.0
#: [s] within which a missing node has to be named.
MISSED_WITHIN = 5.0


def wait_until_gone(namespace: str, seconds: float = 10.0) -> list[int]:
    deadline = time.monotonic() + seconds
    while (left := processes_in_namespace(namespace)) and time.monotonic() < deadline:
        time.sleep(0.05)
    return left


def test_up_starts_three_nodes_and_leaves_none_behind() -> None:
    namespace = f'geohtn_up_{os.getpid()}'
    with started('up', '--namespace', namespace) as process:
        assert process.stdout is not None
        assert any('ready' in line for line in process.stdout)
        # The command itself and its three nodes.
        assert len(processes_in_namespace(namespace)) >= 4
        process.send_signal(signal.SIGINT)
        assert process.wait(20) in (0, 130)
    assert wait_until_gone(namespace) == []


def test_when_one_node_dies_the_others_are_stopped() -> None:
    namespace = f'geohtn_death_{os.getpid()}'
    with started('up', '--namespace', namespace) as process:
        assert process.stdout is not None
        assert any('ready' in line for line in process.stdout)
        victims = [
            pid
            for pid in processes_in_namespace(namespace)
            if b'/motion_planner_node/motion_planner_node'
            in (Path('/proc') / str(pid) / 'cmdline').read_bytes()
        ]
        assert len(victims) == 1
        os.kill(victims[0], signal.SIGKILL)
        rest = process.stdout.read()
        assert process.wait(20) == 1
    assert 'motion_planner_node' in rest
    assert wait_until_gone(namespace) == []


def test_killing_the_command_takes_its_nodes_along() -> None:
    namespace = f'geohtn_kill_{os.getpid()}'
    with started('up', '--namespace', namespace) as process:
        assert process.stdout is not None
        assert any('ready' in line for line in process.stdout)
        process.kill()
        process.wait()
    assert wait_until_gone(namespace) == []


def test_missing_nodes_are_named_within_five_seconds() -> None:
    before = time.monotonic()
    done = geohtn('plan', ROVER, '--namespace', f'nobody_{os.getpid()}')
    # Starting Python and importing ROS is not waiting for a node.
    assert time.monotonic() - before < MISSED_WITHIN + 3.0
    assert done.returncode == 3
    assert re.search('interface_node', done.stdout + done.stderr)


def test_a_missing_motion_planner_is_named() -> None:
    namespace = f'geohtn_half_{os.getpid()}'
    with (
        running(node_command('interface_node', namespace)) as interface,
        running(node_command('task_planner_node', namespace)) as task_planner,
    ):
        wait_until_ready(interface)
        wait_until_ready(task_planner)
        done = geohtn('plan', ROVER, '--namespace', namespace)
    assert done.returncode == 3, done.stdout + done.stderr
    assert 'motion_planner_node is not running: start it with `' in done.stdout + done.stderr
    assert 'task_planner_node is' not in done.stdout + done.stderr


def test_ctrl_c_ends_a_search(nodes: str, tmp_path: Path) -> None:
    """Branch and bound over eight goals would take its whole time budget."""
    command = ('plan', ROVER, '--namespace', nodes, '--output', tmp_path)
    with started(*command, '--optimise', '--time-budget', '100') as process:
        assert process.stdout is not None
        # The first line with a best length in metres says that a search is on.
        assert any(re.search(r'\d+(\.\d+)? m\b', line) for line in process.stdout)
        before = time.monotonic()
        process.send_signal(signal.SIGINT)
        rest = process.stdout.read()
        assert process.wait(20) == 130, rest
        assert time.monotonic() - before < STOP_WITHIN
    assert 'Traceback' not in rest
