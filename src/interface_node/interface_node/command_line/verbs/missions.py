"""``geohtn missions``: the missions that come with the installed package."""

from __future__ import annotations

from argparse import Namespace

from interface_node.command_line.arguments import Parser
from interface_node.command_line.console import Console
from interface_node.command_line.errors import CommandError
from interface_node.command_line.exit_codes import ExitCode
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.missions import installed_missions

SUMMARY = 'list the installed missions'
EXAMPLES = """\
examples:
  geohtn missions
  cp -r "$(geohtn missions --folder rover)" my_mission
"""


def add(parser: Parser) -> None:
    """Declare the arguments."""
    parser.add_argument('--folder', metavar='NAME', help='print only the folder of this mission')


def run(arguments: Namespace, console: Console, interrupts: Interrupts) -> int:
    """Print a line for each mission: its name and folder."""
    del interrupts
    found = installed_missions()
    if arguments.folder is not None:
        if arguments.folder not in found:
            raise CommandError(
                f'there is no installed mission {arguments.folder!r} '
                f'(installed: {", ".join(found) or "none"})',
                ExitCode.INPUT,
            )
        console.print(str(found[arguments.folder]))
        return ExitCode.DONE
    width = max(map(len, found), default=0)
    for name, folder in found.items():
        console.print(f'{name:<{width}}  {folder}')
    if not found:
        console.note('no missions are installed')
    return ExitCode.DONE
