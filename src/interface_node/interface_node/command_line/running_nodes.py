"""The three nodes under a supervisor, and what they say passed on to the console."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode
from interface_node.command_line.log_lines import Filter
from interface_node.command_line.nodes import NODES, NodeSettings, node_command, node_environment
from interface_node.command_line.supervisor import Supervisor


@contextmanager
def running_nodes(
    settings: NodeSettings,
    console: Console,
    log_directory: Path,
    *,
    verbose: bool = False,
    nodes: tuple[str, ...] = NODES,
) -> Iterator[Callable[[], None]]:
    """Start nodes and end them when the block is left; yields a check that they all live.

    Their output goes into a file each in ``log_directory``, and warnings and errors to the
    console too; with ``verbose`` everything.

    Raises:
        CommandError: NO_NODE when a node cannot be started, or, from the check, when one died.
    """
    filters = {node: Filter() for node in nodes}

    def pass_on(node: str, line: str) -> None:
        if filters[node].passes(line) or verbose:
            console.note(f'{console.styled_err(f"{node}:", "dim")} {line}')

    commands = {node: node_command(node, settings) for node in nodes}
    try:
        log_directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CommandError(
            f'{log_directory} cannot be written: {error.strerror}', ExitCode.INPUT
        ) from None
    with Supervisor(log_directory, pass_on, node_environment(os.environ)) as supervisor:
        for node, command in commands.items():
            _start(supervisor, node, command)

        def check() -> None:
            death = supervisor.death()
            if death:
                raise CommandError(
                    f'{death.name} {death.reason}; its output is in {death.log}',
                    ExitCode.NO_NODE,
                    death.last_lines,
                )

        yield check


def _start(supervisor: Supervisor, node: str, command: list[str]) -> None:
    try:
        supervisor.start(node, command)
    except OSError as error:
        raise CommandError(
            f'{node} cannot be started: {error.filename}: {error.strerror}', ExitCode.NO_NODE
        ) from None
