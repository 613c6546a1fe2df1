"""The verbs of ``geohtn``: their parser, and running one."""

from __future__ import annotations

import sys
from argparse import RawDescriptionHelpFormatter
from collections.abc import Sequence
from importlib.metadata import PackageNotFoundError, version
from types import ModuleType

from interface_node.command_line.arguments import Parser
from interface_node.command_line.console import Console
from interface_node.command_line.diagnostics import write_diagnostics
from interface_node.command_line.errors import CommandError, Interrupted
from interface_node.command_line.exit_codes import TABLE, ExitCode, exit_code_of_signal
from interface_node.command_line.interrupts import Interrupts
from interface_node.command_line.missions import UnreadableMission
from interface_node.command_line.verbs import missions, plan, replay, run, up

_VERBS: dict[str, ModuleType] = {
    'run': run,
    'up': up,
    'plan': plan,
    'replay': replay,
    'missions': missions,
}
_DESCRIPTION = 'Plan missions for mobile robots: what to do, where to stand, how to get there.'


def parser() -> Parser:
    """The parser of all verbs."""
    top = Parser(
        prog='geohtn',
        description=_DESCRIPTION,
        epilog=TABLE,
        formatter_class=RawDescriptionHelpFormatter,
    )
    top.add_argument('--version', action='version', version=f'geohtn {_version()}')
    verbs = top.add_subparsers(dest='verb', metavar='VERB', required=True)
    for name, module in _VERBS.items():
        verb = verbs.add_parser(
            name,
            help=module.SUMMARY,
            description=module.SUMMARY.capitalize() + '.',
            epilog=f'{module.EXAMPLES}\n{TABLE}',
            formatter_class=RawDescriptionHelpFormatter,
        )
        module.add(verb)
    return top


def dispatch(argv: Sequence[str] | None, interrupts: Interrupts) -> int:
    """Run one verb; returns the exit code."""
    arguments = parser().parse_args(argv)
    console = Console(sys.stdout, sys.stderr)
    try:
        interrupts.check()
        exit_code: int = _VERBS[arguments.verb].run(arguments, console, interrupts)
    except Interrupted as interrupted:
        console.end_status()
        console.error('stopped')
        return exit_code_of_signal(interrupted.signal_number)
    except UnreadableMission as error:
        console.end_status()
        write_diagnostics(console, error.diagnostics, ())
        return ExitCode.INPUT
    except CommandError as error:
        console.end_status()
        console.error(error.message, error.details)
        return error.exit_code
    return exit_code


def _version() -> str:
    try:
        return version('interface_node')
    except PackageNotFoundError:
        return 'unknown'
