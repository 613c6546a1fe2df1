"""``geohtn up``: keep the three nodes running."""

from __future__ import annotations

import time
from argparse import Namespace
from pathlib import Path
from tempfile import TemporaryDirectory

from interface_node.command_line import arguments as shared
from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError, Interrupted
from interface_node.command_line.exit_codes import ExitCode
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.planning import START_PATIENCE, checking, wait_for_nodes
from interface_node.command_line.running_nodes import running_nodes

SUMMARY = 'start the three nodes and keep them running until Ctrl-C'
EXAMPLES = """\
examples:
  geohtn up
  geohtn up --namespace team_a --param motion_planner_node.seed:=7
  geohtn up --params-file geohtn.yaml --log-level debug --verbose
"""
_POLL = 0.05


def add(parser: shared.Parser) -> None:
    """Declare the arguments."""
    shared.add_namespace(parser, 'none')
    shared.add_node_settings(parser)
    parser.add_argument(
        '--log-directory',
        metavar='DIR',
        type=Path,
        help="folder for the nodes' logs (a temporary one)",
    )


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Run the nodes until a signal comes (exit code 0) or one of them dies (1)."""
    with TemporaryDirectory(prefix='geohtn_') as temporary:
        try:
            _keep_up(arguments, console, interrupts, Path(temporary))
        except Interrupted:
            console.note('the nodes have stopped')
            return ExitCode.DONE
        except CommandError as error:
            raise CommandError(error.message, ExitCode.FAILED, error.details) from None
    return ExitCode.DONE


def _keep_up(
    arguments: Namespace, console: Console, interrupts: Interrupts, temporary: Path
) -> None:
    name = arguments.namespace or ''
    settings = shared.node_settings_of(arguments, name)
    logs = arguments.log_directory or temporary
    with running_nodes(settings, console, logs, verbose=arguments.verbose) as nodes_live:
        from interface_node.command_line.mission_client_node import MissionClient

        check = checking(interrupts, nodes_live)
        with MissionClient(name) as client:
            wait_for_nodes(client, START_PATIENCE, name, check)
        console.print(f'the nodes are ready in namespace /{name}; Ctrl-C stops them')
        while True:
            check()
            time.sleep(_POLL)
