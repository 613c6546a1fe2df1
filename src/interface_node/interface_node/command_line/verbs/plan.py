"""``geohtn plan``: plan a mission with nodes that are running already."""

from __future__ import annotations

from argparse import Namespace

from interface_node.command_line import arguments as shared
from interface_node.command_line.age import age
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
#: [s] from the start of the command; with what it takes to end, an error comes within 5 s.
_PATIENCE = 4.2


def add(parser: shared.Parser) -> None:
    """Declare the arguments."""
    shared.add_mission(parser)
    shared.add_namespace(parser, 'none')
    parser.add_argument(
        '--wait',
        metavar='S',
        type=shared.seconds,
        help='how long to look for the interface node, in seconds '
        f'(until {_PATIENCE} after the start)',
    )


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Plan the mission; the exit code says how it ended."""
    from interface_node.command_line.mission_client_node import MissionClient

    mission = shared.mission_of(arguments)
    goal = shared.goal_of(arguments, mission)
    name = arguments.namespace or ''
    check = checking(interrupts)
    with MissionClient(name) as client:
        patience = _PATIENCE - age() if arguments.wait is None else arguments.wait
        wait_for_nodes(client, patience, name, check, speaker='interface_node')
        result = plan_mission(client, goal, console, check)
        return report(result, goal, console)
