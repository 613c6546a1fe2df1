"""``geohtn replay``: ask a motion planner everything that a recording holds again."""

from __future__ import annotations

import os
from argparse import Namespace
from pathlib import Path
from tempfile import TemporaryDirectory

from interface_node.command_line import arguments as shared
from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.nodes import unique_namespace
from interface_node.command_line.planning import START_PATIENCE, checking, wait_for_nodes
from interface_node.command_line.running_nodes import running_nodes
from interface_node.recording.errors import RecordingError
from interface_node.recording.reader import read_serialised

SUMMARY = 'ask every request of a recording again and compare the answers'
EXAMPLES = """\
examples:
  geohtn replay out/rover/mission.mcap
"""
_NODE = 'motion_planner_node'


def add(parser: shared.Parser) -> None:
    """Declare the arguments."""
    parser.add_argument('file', metavar='FILE.mcap', type=Path, help='a recording of a mission')
    shared.add_node_settings(parser)


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Replay with a motion planner of its own: 0 when all answers are the same, 1 when not."""
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    try:
        for _ in read_serialised(arguments.file):
            interrupts.check()
        return _replay(arguments, console, interrupts)
    except RecordingError as error:
        raise CommandError(str(error), ExitCode.INPUT) from None


def _replay(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    name = unique_namespace()
    settings = shared.node_settings_of(arguments, name)
    console.status(f'starting {_NODE}')
    with (
        TemporaryDirectory(prefix='geohtn_') as logs,
        running_nodes(
            settings, console, Path(logs), verbose=arguments.verbose, nodes=(_NODE,)
        ) as node_lives,
    ):
        from interface_node.command_line.mission_client_node import MissionClient
        from interface_node.replay_node import MotionPlannerUnavailable, replay

        check = checking(interrupts, node_lives)
        with MissionClient(name) as client:
            wait_for_nodes(client, START_PATIENCE, name, check, nodes=(_NODE,))

        def should_stop() -> bool:
            check()
            return False

        console.status('replaying')
        try:
            report = replay(arguments.file, namespace=name, should_stop=should_stop)
        except MotionPlannerUnavailable as error:
            raise CommandError(str(error), ExitCode.NO_NODE) from None
        console.end_status()
    for sentence in report.differences:
        console.print(sentence)
    for sentence in report.skipped:
        console.note(f'not compared: {sentence}')
    console.print(
        f'{report.requests} requests and {report.advices} advices asked again: '
        f'{report.equal} answers are the same, {len(report.differences)} differ, '
        f'{len(report.skipped)} not compared'
    )
    return ExitCode.DONE if report.same else ExitCode.FAILED
