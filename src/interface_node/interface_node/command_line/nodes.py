"""The three nodes as processes: where their executables are, and how they are started."""

from __future__ import annotations

import os
import secrets
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from ament_index_python.packages import PackageNotFoundError, get_package_prefix

from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode

#: In the order of starting; package and executable have the name of the node.
NODES = ('motion_planner_node', 'task_planner_node', 'interface_node')
#: [s] for which nodes that were started together wait for each other: discovery takes its time, and
#: one that ends is noticed by its process.
PATIENCE = 15.0


@dataclass(frozen=True, slots=True)
class NodeSettings:
    """What the nodes are told when they start; ``parameters`` are (node, name, value) in YAML."""

    namespace: str = ''
    log_level: str = 'info'
    parameters: Sequence[tuple[str, str, str]] = ()
    parameters_file: Path | None = None


def unique_namespace() -> str:
    """A namespace that no other process uses."""
    return f'geohtn_{os.getpid()}_{secrets.token_hex(4)}'


def node_command(node: str, settings: NodeSettings) -> list[str]:
    """Command line of a node: the executable that ``ros2 run`` starts, and its ROS arguments.

    Raises:
        CommandError: when the node is not installed where AMENT_PREFIX_PATH points.
    """
    command = [str(_executable(node)), '--ros-args', '--log-level', settings.log_level]
    command.append('--disable-external-lib-logs')
    if settings.namespace:
        command += ['-r', f'__ns:=/{settings.namespace.strip("/")}']
    if node == 'interface_node':
        command += ['-p', f'peer_timeout:={PATIENCE}']
    if settings.parameters_file:
        command += ['--params-file', str(settings.parameters_file)]
    for owner, name, value in settings.parameters:
        if owner == node:
            command += ['-p', f'{name}:={value}']
    return command


def node_environment(environment: Mapping[str, str]) -> dict[str, str]:
    """Environment of a node whose output is read line by line."""
    return {**environment, 'PYTHONUNBUFFERED': '1', 'RCUTILS_COLORIZED_OUTPUT': '0'}


def _executable(node: str) -> Path:
    try:
        executable = Path(get_package_prefix(node)) / 'lib' / node / node
    except (PackageNotFoundError, OSError):
        raise CommandError(
            f'{node} is not installed: source the local_setup file of the workspace',
            ExitCode.NO_NODE,
        ) from None
    if not os.access(executable, os.X_OK):
        raise CommandError(f'{node} is not installed: there is no {executable}', ExitCode.NO_NODE)
    return executable
