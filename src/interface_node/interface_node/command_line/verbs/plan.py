"""``geohtn plan``: plan a mission with nodes that are running already."""

from __future__ import annotations

from argparse import Namespace

from interface_node.command_line import arguments as shared
from interface_node.command_line.console import Console
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.planning import checking, plan_mission, report, wait_for_nodes

SUMMARY = 'plan a mission with nodes that are running already (geohtn up, ros2 launch)'
EXAMPLES = """\
examples:
  geohtn plan rover
  geohtn plan my_mission --namespace team_a --seed 7
  geohtn plan rover --guidance nearest_first
"""
#: [s] Discovery announces itself again after 3 s when it was not heard; with what it takes to start
#: and to end the command, an error comes within 5 s.
_PATIENCE = 3.7


def add(parser: shared.Parser) -> None:
    """Declare the arguments."""
    shared.add_mission(parser)
    shared.add_namespace(parser, 'none')
    parser.add_argument(
        '--wait',
        metavar='S',
        type=shared.seconds,
        default=_PATIENCE,
        help='how long to look for the interface node, in seconds (%(default)s)',
    )


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Plan the mission; the exit code says how it ended."""
    from interface_node.command_line.mission_client_node import MissionClient

    mission = shared.mission_of(arguments)
    goal = shared.goal_of(arguments, mission)
    name = arguments.namespace or ''
    check = checking(interrupts)
    with MissionClient(name) as client:
        wait_for_nodes(client, arguments.wait, name, check, speaker='interface_node')
        result = plan_mission(client, goal, console, check)
        return report(result, goal, console)
