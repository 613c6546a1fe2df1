"""``geohtn run``: plan a mission with three nodes of its own."""

from __future__ import annotations

import os
from argparse import Namespace

from interface_node.command_line import arguments as shared
from interface_node.command_line.console import Console
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.nodes import unique_namespace
from interface_node.command_line.planning import (
    START_PATIENCE,
    checking,
    plan_mission,
    report,
    wait_for_nodes,
)
from interface_node.command_line.running_nodes import running_nodes

SUMMARY = 'plan a mission: start the three nodes, plan, print the plan, stop them'
EXAMPLES = """\
examples:
  geohtn run rover                          the installed mission of that name
  geohtn run my_mission --output results    domain.lisp, problem.lisp, world.yaml in my_mission
  geohtn run rover --world other.yaml --seed 7
  geohtn run rover --optimise --time-budget 20
  geohtn run rover --guidance nearest_first
"""


def add(parser: shared.Parser) -> None:
    """Declare the arguments."""
    shared.add_mission(parser)
    shared.add_namespace(parser, 'one that nobody else uses')
    shared.add_node_settings(parser)


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Plan the mission; the exit code says how it ended."""
    mission = shared.mission_of(arguments)
    goal = shared.goal_of(arguments, mission)
    os.environ.setdefault('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    name = arguments.namespace or unique_namespace()
    settings = shared.node_settings_of(arguments, name)
    logs = shared.output_directory_of(arguments, mission) / 'logs'
    console.status('starting the nodes')
    with running_nodes(settings, console, logs, verbose=arguments.verbose) as nodes_live:
        from interface_node.command_line.mission_client_node import MissionClient

        check = checking(interrupts, nodes_live)
        with MissionClient(name) as client:
            wait_for_nodes(client, START_PATIENCE, name, check)
            result = plan_mission(client, goal, console, check)
            return report(result, goal, console)
