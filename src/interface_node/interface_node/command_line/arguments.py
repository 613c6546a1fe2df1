"""What verbs share on the command line: types that refuse nonsense in a sentence, and options."""

from __future__ import annotations

import re
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from collections.abc import Callable
from math import isfinite
from pathlib import Path
from typing import NoReturn

from interface_node.command_line.goals import MissionGoal
from interface_node.command_line.missions import (
    FILE_NAMES,
    Mission,
    installed_missions,
    mission_folder,
    read_mission,
)
from interface_node.command_line.nodes import NODES, NodeSettings

LOG_LEVELS = ('debug', 'info', 'warn', 'error', 'fatal')


class Parser(ArgumentParser):
    """An argument parser whose errors are one line; exit code 2."""

    def error(self, message: str) -> NoReturn:
        """Write what is wrong and where to read on, and exit."""
        self.exit(2, f'geohtn: {message} (see `{self.prog} --help`)\n')


def whole_number(least: int, bits: int) -> Callable[[str], int]:
    """A type: whole numbers from ``least`` that fit into ``bits`` bits."""

    def parse(text: str) -> int:
        if re.fullmatch(r'[0-9]{1,20}', text) and least <= int(text) < 2**bits:
            return int(text)
        raise ArgumentTypeError(f'{text!r} is no whole number from {least} to {2**bits - 1}')

    return parse


def seconds(text: str) -> float:
    """A type: a time [s] greater than 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not (isfinite(value) and value > 0):
        raise ArgumentTypeError(f'{text!r} is no time in seconds greater than 0')
    return value


def namespace(text: str) -> str:
    """A type: a ROS namespace, without slashes at its ends."""
    name = text.strip('/')
    if name and not re.fullmatch(r'[A-Za-z_]\w*(/[A-Za-z_]\w*)*', name, re.ASCII):
        raise ArgumentTypeError(
            f'{text!r} is no namespace: letters, digits and _, not a digit first, / between parts'
        )
    return name


def parameter(text: str) -> tuple[str, str, str]:
    """A type: NODE.NAME:=VALUE, the value in YAML."""
    match = re.fullmatch(r'(\w+)\.([\w.]+):=(.+)', text, re.ASCII)
    if not match:
        raise ArgumentTypeError(f'{text!r} is not of the form NODE.NAME:=VALUE')
    node, name, value = match.groups()
    if node not in NODES:
        raise ArgumentTypeError(f'{text!r}: there is no node {node}, only {", ".join(NODES)}')
    return node, name, value


def existing_file(text: str) -> Path:
    """A type: a file that is there."""
    path = Path(text)
    if not path.is_file():
        raise ArgumentTypeError(f'there is no file {text!r}')
    return path


def add_mission(parser: ArgumentParser) -> None:
    """The mission and how to search it."""
    parser.add_argument(
        'mission', metavar='MISSION', help='a folder, or the name of an installed mission'
    )
    for role, file_name in FILE_NAMES.items():
        parser.add_argument(
            f'--{role}', metavar='FILE', help=f'use this file instead of {file_name}'
        )
    parser.add_argument('--output', metavar='DIR', help='folder for results (out/MISSION)')
    parser.add_argument(
        '--seed',
        metavar='N',
        type=whole_number(0, 64),
        default=0,
        help='of all random choices: same mission and seed, same plan (0)',
    )
    parser.add_argument(
        '--time-budget',
        metavar='S',
        type=seconds,
        default=0.0,
        help="stop searching after this many seconds (the nodes' own limit)",
    )
    parser.add_argument(
        '--max-alternatives',
        metavar='N',
        type=whole_number(1, 32),
        default=0,
        help="destinations to try for each action (the nodes' own limit)",
    )
    parser.add_argument(
        '--no-advice', action='store_true', help='keep the goals in their written order'
    )
    parser.add_argument(
        '--guidance',
        choices=('tour', 'nearest_first'),
        default='',
        help="order of goals that advice is asked for (the nodes' own)",
    )
    parser.add_argument(
        '--optimise',
        action='store_true',
        help='search on for shorter plans until the time budget is spent',
    )


def add_node_settings(parser: ArgumentParser) -> None:
    """How nodes are started."""
    parser.add_argument(
        '--param',
        metavar='NODE.NAME:=VALUE',
        type=parameter,
        action='append',
        default=[],
        help='set a parameter of a node; may be repeated',
    )
    parser.add_argument(
        '--params-file',
        metavar='FILE',
        type=existing_file,
        help='ROS parameter file for all three nodes',
    )
    parser.add_argument(
        '--log-level', choices=LOG_LEVELS, default='info', help='of the nodes (info)'
    )
    parser.add_argument(
        '--verbose', action='store_true', help='show all that the nodes log, not only warnings'
    )


def add_namespace(parser: ArgumentParser, default: str) -> None:
    """The namespace of the nodes."""
    parser.add_argument(
        '--namespace',
        metavar='NAME',
        type=namespace,
        help=f'ROS namespace of the nodes ({default})',
    )


def mission_of(arguments: Namespace) -> Mission:
    """Read the mission that the arguments name; raises what :mod:`missions` raises."""
    folder = mission_folder(arguments.mission, installed_missions())
    return read_mission(folder, {role: getattr(arguments, role) for role in FILE_NAMES})


def output_directory_of(arguments: Namespace, mission: Mission) -> Path:
    """Absolute folder for the results of a mission."""
    output = arguments.output or Path('out') / mission.name
    return Path(output).absolute()


def goal_of(arguments: Namespace, mission: Mission) -> MissionGoal:
    """What to ask the interface node for."""
    return MissionGoal(
        mission=mission,
        output_directory=str(output_directory_of(arguments, mission)),
        seed=arguments.seed,
        time_budget=arguments.time_budget,
        max_alternatives=arguments.max_alternatives,
        use_advice=not arguments.no_advice,
        optimise=arguments.optimise,
        guidance=arguments.guidance,
    )


def node_settings_of(arguments: Namespace, name: str) -> NodeSettings:
    """How to start the nodes in namespace ``name``."""
    return NodeSettings(
        namespace=name,
        log_level=arguments.log_level,
        parameters=tuple(arguments.param),
        parameters_file=arguments.params_file,
    )
